#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "hersey/bearing/thrust_bearing.h"
#include "hersey/core/two_pi.h"
#include "interpret/bearings/kinds/approach_point.h"
#include "interpret/bearings/kinds/film_reader.h"
#include "interpret/bearings/kinds/kinds.h"

// Pads in sectors of an annulus, from the values of their mapping.
namespace hersey::model {
namespace {

constexpr double to_degrees = 180 / std::numbers::pi;

/// Share of the annulus' width that a reference film thickness has where none is given.
constexpr double kThinness = 1.0 / 1000;

/// Nodes along each pad, and around a washer, where none are given.
constexpr int kLinesOfPad = 41, kLinesOfWasher = 120;

// Pads that meet to this angle leave no groove between them [rad].
constexpr double kSameAngle = 1e-9;

/// Film, pads, features and shapes of a thrust bearing.
class ThrustReader {
 public:
  ThrustReader(Context& context, const Value& value, Bearing& bearing)
      : context_(context), value_(value), bearing_(bearing), film_(bearing.film), reader_(context, value, bearing) {}

  void read() {
    read_size();
    is_forward_ = value_.find("sense") == nullptr || value_.find("sense")->text != "negative";
    reader_.set_surfaces({.fixed = "stator", .moving = "runner", .size = film_.L});
    reader_.read_lubricant();
    reader_.read_cavitation();
    read_pads();
    read_edges();
    read_grid();
    for (const auto& [name, feature] : section(value_, "features"))
      if (!feature.broken) read_feature(feature, name);
    if (const Value* most = value_.find("permissible_pressure"); most != nullptr && !most->broken)
      bearing_.permissible_pressure = most->number;
    reader_.read_contact();
    reader_.read_temperature();
    reader_.read_pressure_scale();
    reader_.require_gauge_pressures();
    reader_.read_shear();
    read_kind();
    reader_.read_heat();
    if (context_.has_fault_in(value_.path)) return;
    require_a_pressure();
    warn_of_corners();
    std::vector<film::Edge> edges{film_.edge_left, film_.edge_right};
    for (const film::PatchEnds& ends : film_.ends) edges.insert(edges.end(), {ends.first, ends.last});
    reader_.warn_of_starvation(edges);
  }

 private:
  void read_size() {
    const double inner = number_of(value_, "inner_diameter"), outer = number_of(value_, "outer_diameter");
    film_.surface = film::Annulus{};
    if (context_.has_fault_in(value_.path)) return;
    if (inner >= outer) {
      context_.fault(*value_.find("outer_diameter"), fmt::format("{:.4g} mm", 1e3 * outer),
                     fmt::format("more than the inner diameter, {:.4g} mm", 1e3 * inner));
      return;
    }
    film_.R = 0.25 * (inner + outer);
    film_.L = 0.5 * (outer - inner);
    const Value* reference = value_.find("reference_film_thickness");
    film_.c = reference != nullptr && !reference->broken ? reference->number : kThinness * film_.L;
  }

  void read_pads() {
    const Value *equal = value_.find("pads"), *sectors = value_.find("sectors");
    if (equal != nullptr && sectors != nullptr) {
      context_.fault_at_key(*sectors, "both 'pads' and 'sectors'", "one of them",
                            "'pads' stands for equal pads, 'sectors' gives each by itself");
      return;
    }
    if (equal != nullptr && !context_.has_fault_in(equal->path)) read_equal(*equal);
    for (const auto& [name, sector] : section(value_, "sectors")) {
      if (!sector.broken && !context_.has_fault_in(sector.path))
        add_pad(name, number_of(sector, "middle"), number_of(sector, "arc"), sector);
    }
    std::vector<std::size_t> order(pads_.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(),
              [this](std::size_t a, std::size_t b) { return pads_[a].from < pads_[b].from; });
    std::vector<bearing::SectorPad> pads;
    std::vector<const Value*> values;
    for (const std::size_t k : order) pads.push_back(pads_[k]), values.push_back(pad_values_[k]);
    pads_ = std::move(pads), pad_values_ = std::move(values);
    if (sectors != nullptr) require_room();
  }

  void read_equal(const Value& value) {
    const int count = integer_of(value, "count");
    const double arc = number_of(value, "arc");
    if (count * arc > two_pi + kSameAngle) {
      context_.fault(
          *value.find("arc"),
          fmt::format("{} pads of {:.4g} deg, {:.4g} deg in all", count, to_degrees * arc, to_degrees * count * arc),
          "360 deg in all at most");
      return;
    }
    for (int k = 0; k < count; ++k)
      add_pad(std::to_string(k + 1), number_of(value, "angle") + two_pi * k / count, arc, value);
  }

  // The first end of the first pad lies within half a revolution on either side of the x-axis; the others follow.
  void add_pad(const std::string& name, double middle, double arc, const Value& value) {
    const double begins = middle - 0.5 * arc;
    double from = std::remainder(begins, two_pi);
    if (!pads_.empty()) {
      const double behind = std::fmod(std::fmod(begins - pads_[0].from, two_pi) + two_pi, two_pi);
      from = pads_[0].from + behind;
    }
    pads_.push_back({name, from, from + std::min(arc, two_pi)});
    pad_values_.push_back(&value);
  }

  void require_room() {
    const auto text = [](const bearing::SectorPad& pad) {
      return fmt::format("'{}' ({:.5g} to {:.5g} deg)", pad.name, to_degrees * pad.from, to_degrees * pad.to);
    };
    for (std::size_t k = 0; k < pads_.size() && pads_.size() > 1; ++k) {
      const bool is_last = k + 1 == pads_.size();
      const bearing::SectorPad& next = pads_[is_last ? 0 : k + 1];
      if (pads_[k].to <= next.from + (is_last ? two_pi : 0) + kSameAngle) continue;
      context_.fault_at_key(*pad_values_[k], "pad " + text(pads_[k]) + " overlaps " + text(next),
                            "pads with grooves between them, 360 deg in all at most");
    }
  }

  void read_edges() {
    const auto content = [&](const char* key) -> const Value* {
      const Value* all = value_.find(key);
      return all == nullptr || all->broken || all->members.empty() ? nullptr : &all->members.front().value;
    };
    const Value *pressures = content("edge_pressure"), *fills = content("ambient_fill");
    const auto part = [](const Value* all, const char* key) -> const Value* {
      if (all == nullptr) return nullptr;
      return all->type->kind == Type::Kind::object ? all->find(key) : all;
    };
    const auto edge = [&](const char* key) {
      const Value *pressure = part(pressures, key), *fill = part(fills, key);
      film::Edge outside = pressure != nullptr && !pressure->broken ? reader_.edge_of(*pressure) : film::Edge{};
      if (outside.kind == film::EdgeKind::pressure)
        outside.ambient_fill = fill != nullptr && !fill->broken ? fill->number : 1;
      return outside;
    };
    // The runner comes in over the leading edge: the one with the smaller angle of pads made for a positive rotation.
    film::Edge leading = edge("leading");
    const film::Edge trailing = edge("trailing");
    if (const Value* flow = given(value_, "edge_flow")) {
      if (pads_.empty()) context_.fault(*flow, "a flow to the leading edges of a washer, which has none", "`pads`");
      reader_.read_edge_flow(*flow, leading);
    }
    film_.ends.assign(pads_.size(),
                      is_forward_ ? film::PatchEnds{leading, trailing} : film::PatchEnds{trailing, leading});
    film_.edge_left = edge("inner");
    film_.edge_right = edge("outer");
  }

  void read_grid() {
    const Value* grid = value_.find("grid");
    if (grid == nullptr || context_.has_fault_in(grid->path) || film_.L <= 0) return;
    const int lines = grid->find("along") != nullptr ? integer_of(*grid, "along")
                      : pads_.empty()                ? kLinesOfWasher
                                                     : kLinesOfPad;
    film_.grid = bearing::thrust_grid(pads_, lines, integer_of(*grid, "radial"));
  }

  void read_feature(const Value& value, const std::string& name) {
    film::SurfaceFeature feature;
    feature.name = name;
    feature.phi = number_of(value, "angle");
    const double radius = value.find("radius") != nullptr ? number_of(value, "radius") : film_.R;
    feature.z = radius - film_.R;
    feature.depth = number_of(value, "depth");
    if (value.text == "hole") {
      feature.shape = film::Ellipse{};
      feature.length = number_of(value, "diameter");
      feature.arc = feature.length / std::max(radius, 1e-12);
    } else {
      feature.arc = number_of(value, "arc");
      feature.length = value.find("width") != nullptr ? number_of(value, "width") : film_.L;
    }
    reader_.read_feed(value, feature);
    check_feature(value, feature);
    film_.features.push_back(std::move(feature));
  }

  void check_feature(const Value& value, const film::SurfaceFeature& feature) {
    if (context_.has_fault_in(value_.path) || film_.L <= 0) return;
    constexpr double round_off = 1 + 1e-9;
    if (std::abs(feature.z) + 0.5 * feature.length > 0.5 * film_.L * round_off) {
      context_.fault_at_key(
          value,
          fmt::format("it reaches from {:.4g} to {:.4g} mm from the axis",
                      1e3 * (film_.R + feature.z - 0.5 * feature.length),
                      1e3 * (film_.R + feature.z + 0.5 * feature.length)),
          fmt::format("{:.4g} to {:.4g} mm", 1e3 * (film_.R - 0.5 * film_.L), 1e3 * (film_.R + 0.5 * film_.L)));
      return;
    }
    const auto lies_within = [&](const bearing::SectorPad& pad) {
      const double from_middle = std::abs(std::remainder(feature.phi - 0.5 * (pad.from + pad.to), two_pi));
      return from_middle + 0.5 * feature.arc <= 0.5 * (pad.to - pad.from) + kSameAngle;
    };
    if (!pads_.empty() && std::none_of(pads_.begin(), pads_.end(), lies_within)) {
      context_.fault_at_key(value, "it does not lie within one pad", "a hole or pocket within one of the pads");
      return;
    }
    const double cells_along = feature.arc / film::mean_step(film_.grid),
                 cells_across = feature.length * (film_.grid.n_z - 1) / film_.L;
    if (std::min(cells_along, cells_across) < 2 - 1e-6)
      context_.fault_at_key(value, "fewer than 3 nodes of the grid across it", "a finer grid or a larger one of it",
                            fmt::format("{:.2g} cells along, {:.2g} across", cells_along, cells_across));
  }

  void read_kind() {
    std::vector<bearing::SectorShape> shapes;
    if (const Value* shape = value_.find("shape"); shape != nullptr) {
      for (const auto& [index, one] : shape->members)
        if (!one.broken) read_shape(one, shapes);
    }
    bearing_.kind = std::make_shared<bearing::ThrustBearing>(pads_, std::move(shapes), is_forward_);
  }

  void read_shape(const Value& value, std::vector<bearing::SectorShape>& shapes) {
    if (value.text == "barrel") return shapes.emplace_back(bearing::SectorBarrel{number_of(value, "drop")}), void();
    if (value.text == "cone") return shapes.emplace_back(bearing::SectorCone{number_of(value, "rise")}), void();
    if (context_.has_fault_in(value_.path + ".pads") || context_.has_fault_in(value_.path + ".sectors")) return;
    if (pads_.empty()) {
      context_.fault(value, fmt::format("a {} of a washer, which has no leading edge", value.text),
                     "`pads` or `sectors`; or `barrel`, `cone`");
      return;
    }
    if (value.text == "crown") return shapes.emplace_back(bearing::SectorCrown{number_of(value, "drop")}), void();
    if (value.text == "incline")
      return shapes.emplace_back(
                 bearing::SectorIncline{std::tan(number_of(value, "along")), std::tan(number_of(value, "across"))}),
             void();
    double shortest = two_pi;
    for (const bearing::SectorPad& pad : pads_) shortest = std::min(shortest, pad.to - pad.from);
    const bool has_arc = value.find("arc") != nullptr;
    const double arc = has_arc ? number_of(value, "arc") : shortest;
    if (has_arc && arc > shortest + kSameAngle) {
      context_.fault(*value.find("arc"), fmt::format("{:.4g} deg, longer than a pad", to_degrees * arc),
                     fmt::format("at most the pads' arc, {:.4g} deg", to_degrees * shortest));
      return;
    }
    if (value.text == "ramp") return read_ramp(value, has_arc, arc, shapes);
    for (const bearing::SectorPad& pad : pads_) {
      film_.features.push_back({.name = "step_" + pad.name,
                                .phi = is_forward_ ? pad.from + 0.5 * arc : pad.to - 0.5 * arc,
                                .z = 0,
                                .arc = arc,
                                .length = film_.L,
                                .is_fed = false,
                                .depth = number_of(value, "depth")});
      bearing_.feature_pressures.push_back(reader_.not_fed(value.path));
      check_feature(value, film_.features.back());
    }
  }

  void read_ramp(const Value& value, bool has_arc, double arc, std::vector<bearing::SectorShape>& shapes) {
    for (const bearing::SectorPad& pad : pads_) {
      if (has_arc || std::abs(pad.to - pad.from - arc) < kSameAngle) continue;
      context_.fault_at_key(value, "a ramp over the whole of pads that differ in size", "an `arc` of the ramp");
      return;
    }
    shapes.emplace_back(bearing::SectorRamp{number_of(value, "rise"), arc});
  }

  /// Between closed edges the pressure is known up to a constant only, unless something holds it.
  void require_a_pressure() {
    std::vector<film::Edge> edges{film_.edge_left, film_.edge_right};
    for (const film::PatchEnds& ends : film_.ends) edges.insert(edges.end(), {ends.first, ends.last});
    const bool is_fed =
        std::any_of(film_.features.begin(), film_.features.end(), [](const auto& f) { return f.is_fed; });
    const bool is_closed =
        std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.kind == film::EdgeKind::closed; });
    if (is_closed && !is_fed)
      context_.fault_at_key(*value_.find("edge_pressure"), "closed edges and no feed: the pressure is given nowhere",
                            "an open edge, or a hole or pocket with a pressure in 'features'");
  }

  /// Where a groove and an edge of another pressure meet, the flow past the corner has no limit as the grid is refined.
  void warn_of_corners() {
    if (film_.ends.empty()) return;
    const film::PatchEnds& ends = film_.ends.front();
    for (const film::Edge& end : {ends.first, ends.last}) {
      for (const film::Edge& side : {film_.edge_left, film_.edge_right}) {
        if (end.kind != film::EdgeKind::pressure || side.kind != film::EdgeKind::pressure ||
            end.pressure == side.pressure)
          continue;
        const Value& at = *value_.find("edge_pressure");
        context_.model.warnings.push_back(
            {at.key_position, at.path,
             fmt::format("grooves at {:.4g} bar that are open to an edge of another pressure", 1e-5 * end.pressure),
             "one pressure around each pad; or a washer whose grooves end before the edges: pockets with a pressure",
             "the flow past the corner, and its power, depend on the grid and grow as that is refined"});
        return;
      }
    }
  }

  Context& context_;
  const Value& value_;
  Bearing& bearing_;
  film::FilmModel& film_;
  FilmReader reader_;
  std::vector<bearing::SectorPad> pads_;
  std::vector<const Value*> pad_values_;
  bool is_forward_ = true;
};

/// Below a ramp or a step the film of a runner that turns the other way widens in the direction of motion.
void warn_of_sense(Context& context, const Value& bearing, const Value& speed, bool is_forward) {
  const Value* shape = bearing.find("shape");
  const bool serves_one_sense =
      shape != nullptr && std::any_of(shape->members.begin(), shape->members.end(), [](const Member& member) {
        return member.value.text == "ramp" || member.value.text == "step";
      });
  if (!serves_one_sense || speed.broken || speed.number == 0 || (speed.number > 0) == is_forward) return;
  context.model.warnings.push_back(
      {speed.position, speed.path, "a runner that turns against the sense that ramps or steps are made for",
       is_forward ? "a speed > 0, or `sense: negative`" : "a speed < 0, or `sense: positive`",
       "their film then widens in the direction of motion and bears next to nothing"});
}

}  // namespace

void read_thrust(Context& context, const Value& value, Bearing& bearing) {
  read_frames(context, value, {.fixed = "stator", .moving = "runner", .size = 0}, bearing);
  ThrustReader(context, value, bearing).read();
}

void read_thrust_point(Context& context, const Value& bearing_value, Bearing& bearing) {
  const Value* value = bearing_value.find("operating_point");
  if (value == nullptr || value->broken) return;
  ThrustPoint point;
  point.tilt_x = std::tan(number_of(*value, "tilt_x"));
  point.tilt_y = std::tan(number_of(*value, "tilt_y"));
  if (!read_approach(context, *value, two_pi * bearing.film.R * bearing.film.L, bearing, point)) return;
  warn_of_sense(context, bearing_value, *value->find("speed"), bearing.kind->is_forward());
  bearing.operating_point = point;
}

ShortNames thrust_short_names(const Model& /*model*/, const Bearing& bearing) {
  const std::string path = "bearings." + bearing.name + ".", point = path + "operating_point.";
  return {.paths = {{"speed", point + "speed"},
                    {"load", point + "load"},
                    {"film_thickness", point + "film_thickness"},
                    {"approach_speed", point + "approach_speed"},
                    {"tilt_x", point + "tilt_x"},
                    {"tilt_y", point + "tilt_y"},
                    {"inner_diameter", path + "inner_diameter"},
                    {"outer_diameter", path + "outer_diameter"},
                    {"viscosity", "lubricants." + bearing.lubricant + ".viscosity"}},
          .load_or_position = {"load", "film_thickness"}};
}

}  // namespace hersey::model
