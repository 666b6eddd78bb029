#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "hersey/core/two_pi.h"
#include "hersey/film/gap_shape.h"
#include "interpret/bearings/kinds/film_reader.h"
#include "interpret/context/interpret.h"
#include "schema/film_vocabulary.h"
#include "schema/profile_shapes.h"

namespace hersey::model {
namespace {

// Positions of a rotating journal at which its shape is compared with that of the bore.
constexpr int angles_tried = 72;

/// Fractional indices of positions among a grid's nodes.
double index_of_angle(const film::Grid& grid, double phi) {
  const double whole = std::floor(phi / two_pi), within = phi - two_pi * whole;
  int i = 0;
  while (i + 1 < grid.n_phi && grid.phi(i + 1) <= within) ++i;
  const double next = i + 1 < grid.n_phi ? grid.phi(i + 1) : grid.phi(0) + two_pi;
  return whole * grid.n_phi + i + (within - grid.phi(i)) / (next - grid.phi(i));
}

double index_of_height(const film::Grid& grid, double z_over_L) {
  int j = 0;
  while (j + 2 < grid.n_z && grid.z_over_L(j + 1) <= z_over_L) ++j;
  return j + (z_over_L - grid.z_over_L(j)) / (grid.z_over_L(j + 1) - grid.z_over_L(j));
}

/// Cells of the grid that a feature is wide; where it travels, on the coarsest part of its way.
struct Cells {
  double around = 0, along = 0;
};

/// Width of the widest cell of patches that a feature touches [rad].
double widest_cell_below(const film::Grid& grid, const film::SurfaceFeature& feature) {
  double widest = 0;
  for (int i = 0; i < grid.n_phi; ++i) {
    if (grid.next(i) < 0) continue;
    const double width = grid.phi(i + 1) - grid.phi(i), middle = 0.5 * (grid.phi(i) + grid.phi(i + 1));
    if (std::abs(std::remainder(middle - feature.phi, two_pi)) < 0.5 * (feature.arc + width))
      widest = std::max(widest, width);
  }
  return widest > 0 ? widest : film::mean_step(grid);
}

Cells cells_across(const film::FilmModel& film, const film::SurfaceFeature& feature) {
  const film::Grid& grid = film.grid;
  const double bottom = (feature.z - 0.5 * feature.length) / film.L, top = (feature.z + 0.5 * feature.length) / film.L;
  Cells cells;
  cells.along = index_of_height(grid, top) - index_of_height(grid, bottom);
  if (!grid.closes()) {
    cells.around = feature.arc / widest_cell_below(grid, feature);
    return cells;
  }
  if (feature.surface == film::Surface::shell) {
    cells.around =
        index_of_angle(grid, feature.phi + 0.5 * feature.arc) - index_of_angle(grid, feature.phi - 0.5 * feature.arc);
    return cells;
  }
  double widest = grid.phi(0) + two_pi - grid.phi(grid.n_phi - 1);
  for (int i = 0; i + 1 < grid.n_phi; ++i) widest = std::max(widest, grid.phi(i + 1) - grid.phi(i));
  cells.around = feature.arc / widest;
  return cells;
}

/// Features, grid and shape of one bearing's film.
class SurfaceReader {
 public:
  SurfaceReader(Context& context, const Value& value, Bearing& bearing)
      : context_(context), value_(value), bearing_(bearing), film_(bearing.film) {}

  void read() {
    read_features();
    read_grid();
    check_resolution();
    read_shape();
  }

 private:
  void read_features() {
    for (const auto& [name, value] : section(value_, "features")) {
      if (value.broken) continue;
      film_.features.push_back(feature_of(value, name));
      FilmReader(context_, value_, bearing_).read_feed(value, film_.features.back());
      check_position(value, film_.features.back());
      check_overlap(value);
      warn_of_added_depths(value);
      check_line(value);
      warn_of_open_edge(value);
    }
  }

  [[nodiscard]] film::SurfaceFeature feature_of(const Value& value, const std::string& name) const {
    film::SurfaceFeature feature;
    feature.name = name;
    feature.surface = meaning_of(value, "on", feature_surface_words);
    feature.phi = number_of(value, "angle");
    feature.z = number_of(value, "z");
    feature.depth = number_of(value, "depth");
    const bool is_round = value.text == "hole", is_oval = value.text == "oval_hole";
    if (is_round || is_oval) {
      feature.shape = film::Ellipse{};
      feature.arc = number_of(value, is_round ? "diameter" : "around") / std::max(film_.R, 1e-12);
      feature.length = number_of(value, is_round ? "diameter" : "along");
    } else {
      feature.arc = number_of(value, "arc");
      feature.length = value.find("length") != nullptr ? number_of(value, "length") : film_.L;
    }
    return feature;
  }

  void check_position(const Value& value, const film::SurfaceFeature& feature) {
    const double reach = std::abs(feature.z) + 0.5 * feature.length, round_off = 1e-9 * film_.L;
    if (film_.L > 0 && reach > 0.5 * film_.L + round_off) {
      context_.fault_at_key(value, fmt::format("it reaches {:.4g} mm from the middle of the bearing", 1e3 * reach),
                            fmt::format("at most half the bearing's width, {:.4g} mm", 0.5e3 * film_.L));
    }
    if (feature.arc > 2 * std::numbers::pi + 1e-6) {
      context_.fault_at_key(value, "a hole wider than the bearing's circumference", "a smaller one");
    }
  }

  void check_resolution() {
    const film::Grid& grid = film_.grid;
    for (const auto& [name, value] : section(value_, "features")) {
      const auto feature = std::find_if(film_.features.begin(), film_.features.end(),
                                        [&, &wanted = name](const auto& f) { return f.name == wanted; });
      if (feature == film_.features.end() || context_.has_fault_in(value.path) || film_.L <= 0) continue;
      warn_of_narrow_land(value, feature - film_.features.begin());
      const Cells cells = cells_across(film_, *feature);
      if (cells.around >= 2 - 1e-6 && cells.along >= 2 - 1e-6) continue;
      const auto enough = [](int n, double has) { return has >= 2 ? n : std::ceil(2 * n / has - 1e-6); };
      const double around = enough(grid.n_phi, cells.around), along = enough(grid.n_z - 1, cells.along) + 1;
      const bool is_possible = std::max(around, along) <= 2000;
      context_.fault_at_key(
          value, fmt::format("fewer than 3 nodes of the {} x {} grid across it", grid.n_phi, grid.n_z),
          is_possible ? "a finer grid or a larger one of it" : "a larger one of it",
          is_possible ? fmt::format("grid: {{circumferential: {}, axial: {}}} would do", around, along) : "");
    }
  }

  [[nodiscard]] bool has_pressure(std::size_t feature, double pressure) const {
    return bearing_.feature_pressures[feature].is_constant() && film_.features[feature].pressure == pressure &&
           !film_.features[feature].restrictor;
  }

  /// Two fed features of one surface that overlap must have one pressure: no film lies between them. Those of two
  /// surfaces may meet as the journal rotates.
  void check_overlap(const Value& value) {
    const std::size_t last = film_.features.size() - 1;
    const film::SurfaceFeature& feature = film_.features[last];
    for (std::size_t k = 0; k < last && feature.is_fed; ++k) {
      const film::SurfaceFeature& other = film_.features[k];
      if (!other.is_fed || (has_pressure(k, feature.pressure) && has_pressure(last, other.pressure))) continue;
      const std::string name =
          fmt::format("'{}' ({})", other.name, position_text(*section_value("features", other.name)));
      if (other.surface == feature.surface) {
        if (film::overlap(feature, other))
          context_.fault_at_key(value, "overlaps " + name + ", which has another pressure",
                                "the same constant pressure, or room between them");
      } else if (std::abs(feature.z - other.z) < 0.5 * (feature.length + other.length) &&
                 !joins_features(context_.model, bearing_.name, feature.name, other.name)) {
        warn_at_key(value, "passes over " + name + ", which has another pressure, as the journal rotates");
      }
    }
  }

  /// Each feature widens the gap by its own depth: where two lie on each other, by both.
  void warn_of_added_depths(const Value& value) {
    const std::size_t last = film_.features.size() - 1;
    const film::SurfaceFeature& feature = film_.features[last];
    for (std::size_t k = 0; k < last; ++k) {
      const film::SurfaceFeature& other = film_.features[k];
      if (other.surface != feature.surface || feature.depth == 0 || other.depth == 0 || !film::overlap(feature, other))
        continue;
      context_.model.warnings.push_back(
          {value.key_position, value.path,
           fmt::format("overlaps '{}' ({}), and where both lie they are {:.4g} mm deep, the sum of both", other.name,
                       position_text(*section_value("features", other.name)), 1e3 * (feature.depth + other.depth)),
           "grooves and holes with room between them, or a depth of one of the two alone", ""});
    }
  }

  /// A supply line goes from edge to edge: fixed in the shell it crosses what lies there, else what it passes over.
  void check_line(const Value& value) {
    const std::size_t last = film_.features.size() - 1;
    const film::SurfaceFeature& feature = film_.features[last];
    const Value* supply = value_.find("supply");
    if (film_.supply.kind == film::SupplyKind::none || !feature.is_fed || has_pressure(last, film_.supply.pressure) ||
        supply->broken)
      return;
    const std::string line = fmt::format("the supply line ({})", position_text(*supply));
    const bool is_fixed = film_.supply.kind == film::SupplyKind::fixed_angle;
    if (!is_fixed || feature.surface == film::Surface::journal) {
      warn_at_key(value,
                  fmt::format("{} {}, which has another pressure", is_fixed ? "passes over" : "may lie under", line));
    } else if (film::contains(feature, film_.supply.phi, feature.z)) {
      context_.fault_at_key(value, "lies on " + line + ", which has another pressure",
                            "the same constant pressure, or another angle");
    }
  }

  /// If regions of different pressures touch, the flow between them has no limit as the grid is refined.
  void warn_at_key(const Value& value, std::string found) {
    context_.model.warnings.push_back({value.key_position, value.path, std::move(found),
                                       "the same constant pressure, or that they never meet",
                                       "while they do, the flow from one to the other depends on the grid"});
  }

  void warn_of_open_edge(const Value& value) {
    const std::size_t last = film_.features.size() - 1;
    const film::SurfaceFeature& feature = film_.features[last];
    if (!feature.is_fed || film_.L <= 0) return;
    const auto meets = [&](double side, const film::Edge& edge) {
      return edge.kind == film::EdgeKind::pressure &&
             side * feature.z + 0.5 * feature.length > 0.5 * film_.L * (1 - 1e-9) && !has_pressure(last, edge.pressure);
    };
    if (!meets(-1, film_.edge_left) && !meets(1, film_.edge_right)) return;
    context_.model.warnings.push_back(
        {value.key_position, value.path, "it is open to an edge that has another pressure",
         fmt::format(
             "a `length` that ends before the edge, below {:.4g} mm, or the feature's pressure as edge_pressure",
             1e3 * film_.L),
         "the flow from it over that edge depends on the grid and grows as that is refined"});
  }

  /// The grid sees the land between a feature and an edge of another pressure as no less than about half a cell.
  void warn_of_narrow_land(const Value& value, std::ptrdiff_t index) {
    const film::SurfaceFeature& feature = film_.features[static_cast<std::size_t>(index)];
    const film::Grid& grid = film_.grid;
    if (!feature.is_fed) return;
    double narrowest = std::numeric_limits<double>::infinity();
    const auto look = [&](double side, const film::Edge& edge, double cell) {
      if (edge.kind == film::EdgeKind::closed) return;
      const double land = 0.5 * film_.L - side * feature.z - 0.5 * feature.length;
      if (land <= 1e-9 * film_.L || land >= 0.5 * cell || has_pressure(static_cast<std::size_t>(index), edge.pressure))
        return;
      narrowest = std::min(narrowest, land);
    };
    const int last = grid.n_z - 1;
    look(-1, film_.edge_left, film_.L * (grid.z_over_L(1) - grid.z_over_L(0)));
    look(1, film_.edge_right, film_.L * (grid.z_over_L(last) - grid.z_over_L(last - 1)));
    if (!std::isfinite(narrowest)) return;
    const double enough = std::ceil(0.5 * film_.L / narrowest - 1e-6) + 1;
    context_.model.warnings.push_back(
        {value.key_position, value.path,
         fmt::format("it ends {:.3g} mm from an edge that has another pressure, less than half a cell of the grid",
                     1e3 * narrowest),
         enough > 2000 ? "land that the grid resolves, or a feature that ends at the edge"
                       : fmt::format("grid.axial of at least {:.0f}, or cells refined towards edges", enough),
         "the flow over that land depends on the grid"});
  }

  [[nodiscard]] const Value* section_value(const std::string& name, const std::string& member) const {
    for (const auto& [key, value] : section(value_, name)) {
      if (key == member) return &value;
    }
    return nullptr;
  }

  [[nodiscard]] static std::string position_text(const Value& value) {
    return fmt::format("{}:{}", value.key_position.file, value.key_position.line);
  }

  void read_shape() {
    const Value* shape = value_.find("shape");
    if (shape == nullptr) return;
    for (const auto& [index, value] : shape->members) {
      if (!value.broken) read_profile(value);
    }
    if (context_.has_fault_in(value_.path) || film_.c <= 0 || film_.L <= 0) return;
    double smallest = film_.c;
    for (int k = 0; k < angles_tried; ++k) {
      smallest = std::min(smallest, film_.c + film::gap_opening(film_, two_pi * k / angles_tried).minCoeff());
    }
    if (smallest > 0) return;
    context_.fault_at_key(*shape, fmt::format("a shape that closes the gap by {:.4g} um", -1e6 * smallest),
                          fmt::format("deviations within the clearance, {:.4g} um", 1e6 * film_.c));
  }

  void read_profile(const Value& value) {
    if (value.broken) return;
    const film::Surface on = meaning_of(value, "on", profile_surface_words);
    if (value.text != "table") {
      film_.profiles.push_back({read_alternative(value, profile_shapes()), on});
    } else if (const Value* file = value.find("file")) {
      if (auto shape = measured_shape_of(context_, *file, film_.L)) film_.profiles.push_back({std::move(*shape), on});
    }
  }

  void read_grid() {
    const Value* grid = value_.find("grid");
    if (grid == nullptr || grid->broken) return;
    film_.grid = {.n_phi = integer_of(*grid, "circumferential"), .n_z = integer_of(*grid, "axial")};
    const Value* refine = grid->find("refine");
    if (context_.has_fault_in(grid->path) || film_.L <= 0 || film_.R <= 0) return;
    if (refine == nullptr && film_.ends.empty()) return;
    std::vector<film::Refinement> around, along;
    for (const auto& [index, region] : refine != nullptr ? refine->members : std::vector<Member>()) {
      if (region.text == "angle") {
        around.push_back({number_of(region, "angle"), number_of(region, "reach"), number_of(region, "factor")});
      } else if (region.text == "edges") {
        refine_edges(region, along);
      } else {
        refine_features(region, around, along);
      }
    }
    film_.grid = film_.ends.empty() ? film::graded_grid(film_.grid.n_phi, film_.grid.n_z, around, along)
                                    : film::graded_grid(patches_of_arcs(), film_.grid.n_z, around, along);
  }

  /// Lines at the same distance in all arcs: as many as `circumferential` would lay around a whole bore. Their number
  /// lets two coarser grids have every second and every fourth of them.
  [[nodiscard]] std::vector<film::Patch> patches_of_arcs() const {
    constexpr double half = 0.5 + 1e-9;  // angles of arcs that are turned differ by round-off
    std::vector<film::Patch> patches;
    for (const film::Arc& arc : film::arcs_of(film_)->arcs) {
      const double quarters = 0.25 * film_.grid.n_phi * (arc.to - arc.from) / two_pi;
      patches.push_back({.from = arc.from,
                         .to = arc.to,
                         .lines = 4 * std::max(1, static_cast<int>(std::floor(quarters + half))) + 1});
    }
    return patches;
  }

  void refine_edges(const Value& region, std::vector<film::Refinement>& along) const {
    const double reach = region.find("reach") != nullptr ? number_of(region, "reach") / film_.L : 0.125;
    for (const double edge : {-0.5, 0.5}) along.push_back({edge, reach, number_of(region, "factor")});
  }

  void refine_features(const Value& region, std::vector<film::Refinement>& around,
                       std::vector<film::Refinement>& along) const {
    const double given = region.find("reach") != nullptr ? number_of(region, "reach") : 0;
    const double factor = number_of(region, "factor");
    for (const film::SurfaceFeature& feature : film_.features) {
      for (const double side : {-0.5, 0.5}) {
        const double border = (feature.z + side * feature.length) / film_.L;
        if (std::abs(border) < 0.5 - 1e-9) {
          along.push_back({border, (given > 0 ? given : 0.25 * feature.length) / film_.L, factor});
        }
        if (feature.surface == film::Surface::journal || feature.arc >= two_pi - 1e-9) continue;
        around.push_back({feature.phi + side * feature.arc, given > 0 ? given / film_.R : 0.25 * feature.arc, factor});
      }
    }
  }

  Context& context_;
  const Value& value_;
  Bearing& bearing_;
  film::FilmModel& film_;
};

}  // namespace

void require_above_cavitation(Context& context, const Value& pressure, const film::FilmModel& film) {
  if (pressure.broken || pressure.number >= film.p_cav) return;
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%g Pa, below the cavitation pressure %g Pa", pressure.number, film.p_cav);
  context.fault(pressure, text.data(), "at least the cavitation pressure, on the same scale",
                "with gauge pressures, cavitation is often near -1 bar");
}

void read_surfaces(Context& context, const Value& value, Bearing& bearing) {
  SurfaceReader(context, value, bearing).read();
}

}  // namespace hersey::model
