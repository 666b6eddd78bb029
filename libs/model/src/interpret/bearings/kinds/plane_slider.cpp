#include "hersey/bearing/plane_slider.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "interpret/bearings/kinds/approach_point.h"
#include "interpret/bearings/kinds/film_reader.h"
#include "interpret/bearings/kinds/kinds.h"

// A pad on a plane runner, from the values of its mapping.
namespace hersey::model {
namespace {

/// Share of the length that a reference film thickness has where none is given.
constexpr double kUsualThinness = 1.0 / 2000;

/// Film, features and shapes of a pad.
class PadReader {
 public:
  PadReader(Context& context, const Value& value, Bearing& bearing)
      : context_(context), value_(value), bearing_(bearing), film_(bearing.film), reader_(context, value, bearing) {}

  void read() {
    length_ = number_of(value_, "length");
    film_.surface = film::Plane{};
    film_.R = 1;  // y in metres is then the film's coordinate phi
    film_.L = number_of(value_, "width");
    const Value* reference = value_.find("reference_film_thickness");
    film_.c = reference != nullptr && !reference->broken ? reference->number : kUsualThinness * length_;
    reader_.set_surfaces({.fixed = "pad", .moving = "runner", .size = length_});
    reader_.read_lubricant();
    reader_.read_cavitation();
    read_grid();
    read_edges();
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
  }

 private:
  void read_grid() {
    const Value* grid = value_.find("grid");
    if (grid == nullptr || context_.has_fault_in(grid->path) || length_ <= 0) return;
    film_.grid = bearing::slider_grid(length_, integer_of(*grid, "along"), integer_of(*grid, "across"));
  }

  void read_edges() {
    film_.ends.resize(1);
    const Value* edges = value_.find("edge_pressure");
    if (edges == nullptr || edges->broken || edges->members.empty()) return;
    const Value& content = edges->members.front().value;
    const auto edge = [&](const char* key) {
      const Value* own = content.type->kind == Type::Kind::object ? content.find(key) : &content;
      film::Edge outside = own != nullptr && !own->broken ? reader_.edge_of(*own) : film::Edge{};
      if (outside.kind == film::EdgeKind::pressure) outside.ambient_fill = number_of(value_, "ambient_fill");
      return outside;
    };
    film_.ends.front() = {.first = edge("leading"), .last = edge("trailing")};
    film_.edge_left = edge("left");
    film_.edge_right = edge("right");
  }

  void read_feature(const Value& value, const std::string& name) {
    film::SurfaceFeature feature;
    feature.name = name;
    feature.phi = number_of(value, "y");
    feature.z = number_of(value, "z");
    feature.depth = number_of(value, "depth");
    if (value.text == "hole") {
      feature.shape = film::Ellipse{};
      feature.arc = feature.length = number_of(value, "diameter");
    } else {
      feature.arc = number_of(value, "along");
      feature.length = value.find("across") != nullptr ? number_of(value, "across") : film_.L;
    }
    reader_.read_feed(value, feature);
    check_extent(value, feature);
    film_.features.push_back(std::move(feature));
  }

  void check_extent(const Value& value, const film::SurfaceFeature& feature) {
    if (context_.has_fault_in(value_.path) || length_ <= 0 || film_.L <= 0) return;
    const double along = std::abs(feature.phi) + 0.5 * feature.arc, across = std::abs(feature.z) + 0.5 * feature.length;
    constexpr double round_off = 1 + 1e-9;
    if (along > 0.5 * length_ * round_off || across > 0.5 * film_.L * round_off) {
      context_.fault_at_key(
          value,
          fmt::format("it reaches {:.4g} mm along and {:.4g} mm across from the pad's middle", 1e3 * along,
                      1e3 * across),
          fmt::format("at most half of the pad, {:.4g} and {:.4g} mm", 0.5e3 * length_, 0.5e3 * film_.L));
      return;
    }
    const double cells_along = feature.arc * (film_.grid.n_phi - 1) / length_,
                 cells_across = feature.length * (film_.grid.n_z - 1) / film_.L;
    if (std::min(cells_along, cells_across) >= 2 - 1e-6) return;
    context_.fault_at_key(
        value, fmt::format("fewer than 3 nodes of the {} x {} grid across it", film_.grid.n_phi, film_.grid.n_z),
        "a finer grid or a larger one of it",
        fmt::format("grid: {{along: {:.0f}, across: {:.0f}}} would do",
                    std::max<double>(film_.grid.n_phi, std::ceil(2 * length_ / feature.arc) + 1),
                    std::max<double>(film_.grid.n_z, std::ceil(2 * film_.L / feature.length) + 1)));
  }

  /// The pad with its shapes. A step is a pocket of the pad, whose border is a jump of the gap.
  void read_kind() {
    std::vector<bearing::PadShape> shapes;
    if (const Value* shape = value_.find("shape"); shape != nullptr) {
      for (const auto& [index, one] : shape->members)
        if (!one.broken) read_shape(one, shapes);
    }
    if (length_ > 0) bearing_.kind = std::make_shared<bearing::PlaneSlider>(length_, std::move(shapes));
  }

  void read_shape(const Value& value, std::vector<bearing::PadShape>& shapes) {
    if (value.text == "crown") return shapes.emplace_back(bearing::PadCrown{number_of(value, "drop")}), void();
    if (value.text == "barrel") return shapes.emplace_back(bearing::PadBarrel{number_of(value, "drop")}), void();
    const double length = value.find("length") != nullptr ? number_of(value, "length") : length_;
    if (length_ > 0 && length > length_) {
      context_.fault(*value.find("length"), fmt::format("{:.4g} mm, longer than the pad", 1e3 * length),
                     fmt::format("at most the pad's length, {:.4g} mm", 1e3 * length_));
      return;
    }
    if (value.text == "ramp") return shapes.emplace_back(bearing::PadRamp{number_of(value, "rise"), length}), void();
    film_.features.push_back({.name = "step",
                              .phi = 0.5 * (length - length_),
                              .z = 0,
                              .arc = length,
                              .length = film_.L,
                              .is_fed = false,
                              .depth = number_of(value, "depth")});
    bearing_.feature_pressures.push_back(reader_.not_fed(value.path));
    check_extent(value, film_.features.back());
  }

  /// Between closed edges the pressure is known up to a constant only, unless something holds it.
  void require_a_pressure() {
    const film::PatchEnds& ends = film_.ends.front();
    const std::vector<film::Edge> edges{ends.first, ends.last, film_.edge_left, film_.edge_right};
    const bool is_fed =
        std::any_of(film_.features.begin(), film_.features.end(), [](const auto& f) { return f.is_fed; });
    const bool is_closed =
        std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.kind == film::EdgeKind::closed; });
    if (is_closed && !is_fed) {
      context_.fault_at_key(*value_.find("edge_pressure"), "closed edges and no feed: the pressure is given nowhere",
                            "an open edge, or a hole or pocket with a pressure in 'features'");
    }
  }

  Context& context_;
  const Value& value_;
  Bearing& bearing_;
  film::FilmModel& film_;
  FilmReader reader_;
  double length_ = 0;
};

}  // namespace

void read_plane_slider(Context& context, const Value& value, Bearing& bearing) {
  read_frames(context, value, {.fixed = "pad", .moving = "runner", .size = 0}, bearing);
  PadReader(context, value, bearing).read();
}

void read_plane_slider_point(Context& context, const Value& bearing_value, Bearing& bearing) {
  const Value* value = bearing_value.find("operating_point");
  if (value == nullptr || value->broken) return;
  SliderPoint point;
  point.tilt_along = std::tan(number_of(*value, "tilt_along"));
  point.tilt_across = std::tan(number_of(*value, "tilt_across"));
  const double area = number_of(bearing_value, "length") * bearing.film.L;
  if (!read_approach(context, *value, area, bearing, point)) return;
  bearing.operating_point = point;
}

ShortNames plane_slider_short_names(const Model& /*model*/, const Bearing& bearing) {
  const std::string path = "bearings." + bearing.name + ".", point = path + "operating_point.";
  return {.paths = {{"speed", point + "speed"},
                    {"load", point + "load"},
                    {"film_thickness", point + "film_thickness"},
                    {"approach_speed", point + "approach_speed"},
                    {"tilt_along", point + "tilt_along"},
                    {"tilt_across", point + "tilt_across"},
                    {"length", path + "length"},
                    {"width", path + "width"},
                    {"viscosity", "lubricants." + bearing.lubricant + ".viscosity"}},
          .load_or_position = {"load", "film_thickness"}};
}

}  // namespace hersey::model
