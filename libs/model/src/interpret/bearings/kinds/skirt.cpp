#include "hersey/bearing/skirt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "interpret/bearings/kinds/film_reader.h"
#include "interpret/bearings/kinds/kinds.h"

// A piston's skirt in its liner, from the values of its mapping.
namespace hersey::model {
namespace {

/// Film and shapes of a skirt.
class SkirtReader {
 public:
  SkirtReader(Context& context, const Value& value, Bearing& bearing)
      : context_(context), value_(value), bearing_(bearing), film_(bearing.film), reader_(context, value, bearing) {}

  void read() {
    film_.surface = film::Skirt{};
    film_.R = number_of(value_, "diameter") / 2;
    film_.L = number_of(value_, "length");
    film_.c = value_.find("diametral_clearance") != nullptr ? number_of(value_, "diametral_clearance") / 2
                                                            : number_of(value_, "radial_clearance");
    reader_.set_surfaces({.fixed = "skirt", .moving = "liner", .size = film_.R});
    check_thinness();
    reader_.read_lubricant();
    reader_.read_cavitation();
    read_grid();
    read_edges();
    if (const Value* most = value_.find("permissible_pressure"); most != nullptr && !most->broken)
      bearing_.permissible_pressure = most->number;
    reader_.read_contact();
    reader_.read_temperature();
    reader_.read_pressure_scale();
    reader_.require_gauge_pressures();
    reader_.read_shear();
    read_shapes();
    if (context_.has_fault_in(value_.path)) return;
    require_a_pressure();
    reader_.warn_of_starvation(edges());
  }

 private:
  /// Lubrication theory takes the gap to be thin: a clearance of the skirt's own size is a wrong unit.
  void check_thinness() {
    const Value* clearance = value_.find("radial_clearance");
    if (clearance == nullptr) clearance = value_.find("diametral_clearance");
    if (clearance == nullptr || clearance->broken || film_.R <= 0 || film_.c < 0.1 * film_.R) return;
    context_.fault(*clearance, "a clearance of more than a tenth of the radius",
                   "a thin gap: common are radial clearances of 0.0003 to 0.002 radii");
  }

  void read_grid() {
    const Value* grid = value_.find("grid");
    if (grid == nullptr || context_.has_fault_in(value_.path)) return;
    const double arc = number_of(value_, "arc");
    const double antithrust = value_.find("arc_antithrust") != nullptr ? number_of(value_, "arc_antithrust") : arc;
    film_.grid = bearing::skirt_grid(arc, antithrust, integer_of(*grid, "around"), integer_of(*grid, "along"));
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
    const film::Edge sides = edge("sides");
    film_.ends.assign(bearing::skirt_sides.size(), {.first = sides, .last = sides});
    film_.edge_left = edge("bottom");
    film_.edge_right = edge("top");
    if (const Value* oil = content("oil"); oil != nullptr && !oil->broken) read_oil(*oil);
  }

  /// Reads the oil on the liner: of each edge a layer, theory manual eq. (skirt.12), or all that the film draws in.
  void read_oil(const Value& oil) {
    const Value* fills = value_.find("ambient_fill");
    if (fills != nullptr && fills->given) {
      context_.fault_at_key(*value_.find("oil"), "both 'oil' and 'ambient_fill'", "one of them",
                            "a layer on the liner brings so much per way, a fill is drawn in as the film asks for it");
      return;
    }
    const bool is_of_each = oil.type->kind == Type::Kind::object;
    const Value *top = is_of_each ? oil.find("top") : &oil, *bottom = is_of_each ? oil.find("bottom") : &oil;
    if (top == nullptr || bottom == nullptr || top->broken || bottom->broken) return;
    read_layer(*top, film_.edge_right);
    read_layer(*bottom, film_.edge_left);
    const Value* sides = oil.find("sides");
    const bool is_flooded = sides != nullptr ? sides->text == "flooded" : oil.text == "flooded";
    for (film::PatchEnds& ends : film_.ends)
      for (film::Edge* edge : {&ends.first, &ends.last})
        if (edge->kind == film::EdgeKind::pressure) edge->ambient_fill = is_flooded ? 1 : 0;
  }

  void read_layer(const Value& oil, film::Edge& edge) {
    if (oil.text == "flooded") return;
    edge.layer = oil.number;
    if (edge.kind != film::EdgeKind::pressure || edge.pressure > film_.p_cav) {
      context_.fault(oil, "a layer of oil before an edge that is not at the cavitation pressure",
                     "edge_pressure: that of `cavitation`, at which nothing but the layer comes in, or `flooded`");
    } else if (!film::cavitation_law(film_).has_fill()) {
      context_.fault(oil, "a layer of oil before a film that does not conserve oil",
                     "cavitation: mass_conserving, or `flooded`");
    }
  }

  void read_shapes() {
    std::vector<bearing::SkirtShape> shapes;
    if (const Value* shape = value_.find("shape"); shape != nullptr) {
      for (const auto& [index, one] : shape->members)
        if (!one.broken) read_shape(one, shapes);
    }
    std::optional<bearing::LinerBore> liner;
    const Value* bore = value_.find("liner_shape");
    const Value* file = bore != nullptr && !bore->broken ? bore->find("file") : nullptr;
    constexpr double any_height = 0;  // where in the liner the skirt will be is not known here
    if (file != nullptr)
      if (auto measured = measured_shape_of(context_, *file, any_height))
        liner = bearing::LinerBore{std::move(*measured)};
    bearing_.kind = std::make_shared<bearing::PistonSkirt>(std::move(shapes), std::move(liner));
  }

  void read_shape(const Value& value, std::vector<bearing::SkirtShape>& shapes) {
    if (value.text == "barrel") {
      const bearing::SkirtBarrel barrel{number_of(value, "top"), number_of(value, "bottom"), number_of(value, "apex")};
      const Value* apex = value.find("apex");
      if (apex != nullptr && !apex->broken && film_.L > 0 && std::abs(barrel.apex) >= 0.5 * film_.L)
        context_.fault(*apex, fmt::format("a widest place {:.4g} mm from the middle", 1e3 * barrel.apex),
                       fmt::format("one within the skirt, less than {:.4g} mm from its middle", 0.5e3 * film_.L));
      return shapes.emplace_back(barrel), void();
    }
    if (value.text == "ovality")
      return shapes.emplace_back(bearing::SkirtOvality{number_of(value, "top"), number_of(value, "bottom")}), void();
    const Value* file = value.find("file");
    if (file == nullptr || film_.L <= 0 || film_.grid.patches.empty()) return;
    if (auto measured = measured_shape_of(context_, *file, film_.L, &film_.grid))
      shapes.emplace_back(bearing::SkirtTable{std::move(*measured)});
  }

  [[nodiscard]] std::vector<film::Edge> edges() const {
    std::vector<film::Edge> all{film_.edge_left, film_.edge_right};
    for (const film::PatchEnds& ends : film_.ends) all.insert(all.end(), {ends.first, ends.last});
    return all;
  }

  /// Between closed edges the pressure is known up to a constant only.
  void require_a_pressure() {
    const std::vector<film::Edge> all = edges();
    if (std::any_of(all.begin(), all.end(), [](const auto& e) { return e.kind == film::EdgeKind::pressure; })) return;
    context_.fault_at_key(*value_.find("edge_pressure"), "closed edges: the pressure is given nowhere", "an open edge");
  }

  Context& context_;
  const Value& value_;
  Bearing& bearing_;
  film::FilmModel& film_;
  FilmReader reader_;
};

/// Reads the position by both ends' offsets, or the side force for which it is sought.
void read_side_position(Context& context, const Value& value, const Bearing& bearing, SkirtPoint& point) {
  const Value *top = given(value, "offset_top"), *bottom = given(value, "offset_bottom"),
              *force = given(value, "side_force");
  if ((top == nullptr) != (bottom == nullptr)) {
    context.fault_at_key(top != nullptr ? *top : *bottom, "the offset of one end", "those of both ends");
  } else if (force == nullptr && top == nullptr) {
    context.fault_at_key(value, "neither offsets nor 'side_force'",
                         "both of 'offset_top' and 'offset_bottom', or a 'side_force'");
  } else if (force != nullptr && top != nullptr) {
    context.fault_at_key(*force, "offsets and 'side_force' together", "one of them",
                         "with --set, give the other one as 'none'");
  }
  if (context.has_fault_in(value.path)) return;
  if (force != nullptr) {
    point.side_force = force->number;
    if (force->number == 0) context.fault(*force, "no side force", "one other than 0, or offsets");
    if (point.velocity_top != 0 || point.velocity_bottom != 0)
      context.fault(*value.find(point.velocity_top != 0 ? "velocity_top" : "velocity_bottom"),
                    "a velocity along an offset that is sought", "velocities with offsets", "their force is found");
    require_bearable(context, *force, 2 * bearing.film.R * bearing.film.L);
    return;
  }
  point.offset_top = top->number, point.offset_bottom = bottom->number;
  if (point.tilt != 0)
    context.fault(*value.find("tilt"), "a tilt beside the offsets of both ends, which give it", "no tilt");
}

/// The smallest gap of the rigid surfaces there; with a side force, of a skirt that stands in the middle [m].
double gap_at(const Bearing& bearing, const SkirtPoint& point) {
  bearing::OperatingPoint at;
  at.e = at.e_rate = bearing::Coordinates::Zero(1);
  at.e[0] = 0.5 * (point.offset_top + point.offset_bottom);
  at.tilt.x() = point.side_force ? point.tilt : (point.offset_top - point.offset_bottom) / bearing.film.L;
  return bearing.kind->steady_coordinates(bearing.film)->smallest_gap(at, at.e);
}

}  // namespace

void read_skirt(Context& context, const Value& value, Bearing& bearing) {
  read_frames(context, value, {.fixed = "skirt", .moving = "liner", .size = 0}, bearing);
  SkirtReader(context, value, bearing).read();
}

void read_skirt_point(Context& context, const Value& bearing_value, Bearing& bearing) {
  const Value* value = bearing_value.find("operating_point");
  if (value == nullptr || value->broken) return;
  SkirtPoint point;
  point.position = value->key_position;
  point.speed = number_of(*value, "speed");
  point.velocity_top = number_of(*value, "velocity_top");
  point.velocity_bottom = number_of(*value, "velocity_bottom");
  point.tilt = std::tan(number_of(*value, "tilt"));
  read_side_position(context, *value, bearing, point);
  if (context.has_fault_in(value->path)) return;
  const bool is_smooth = bearing.film.asperities.model == film::AsperityModel::none;
  if (is_smooth && point.speed == 0 && point.velocity_top == 0 && point.velocity_bottom == 0) {
    context.fault(*value->find("speed"), "a skirt at rest, which moves no oil", "a speed, velocities, or asperities");
    return;
  }
  if (context.has_fault_in(bearing_value.path)) return;
  if (gap_at(bearing, point) <= 0) {
    context.fault_at_key(*value, "a skirt that touches the liner", "offsets or a tilt that leave a gap everywhere",
                         "reduce them, or the shapes");
    return;
  }
  bearing.operating_point = point;
}

ShortNames skirt_short_names(const Model& model, const Bearing& bearing) {
  const std::string path = "bearings." + bearing.name + ".", point = path + "operating_point.";
  const bool is_diametral = model.positions.contains(path + "diametral_clearance");
  return {.paths = {{"speed", point + "speed"},
                    {"offset_top", point + "offset_top"},
                    {"offset_bottom", point + "offset_bottom"},
                    {"velocity_top", point + "velocity_top"},
                    {"velocity_bottom", point + "velocity_bottom"},
                    {"side_force", point + "side_force"},
                    {"tilt", point + "tilt"},
                    {"clearance", path + (is_diametral ? "diametral_clearance" : "radial_clearance")},
                    {"length", path + "length"},
                    {"diameter", path + "diameter"},
                    {"viscosity", "lubricants." + bearing.lubricant + ".viscosity"}},
          .load_or_position = {}};
}

}  // namespace hersey::model
