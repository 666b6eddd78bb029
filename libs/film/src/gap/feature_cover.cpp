#include "gap/feature_cover.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hersey/core/two_pi.h"

namespace hersey::film {
namespace {

/// A fraction of a cell and its derivative by the feature's angle.
struct Fraction {
  double value = 0;
  double phi = 0;
};

/// Surroundings of a node in the frame of a feature: distances of its neighbours and width of its control volume [m,
/// m]. The feature's middle lies at a distance `d` around the bearing [rad] and `z` along it [m] behind the node.
struct Surroundings {
  double d = 0, z = 0;
  double R = 1;                       ///< length per unit of phi [m]
  double to_phi = 0, to_z = 0;        ///< distance of the neighbours towards the feature [m]
  double width_phi = 0, width_z = 0;  ///< of the control volume [m]
  double back = 0, ahead = 0;         ///< half-way to the neighbours around the bearing [rad]
  double below = 0, above = 0;  ///< half-way to the neighbours along z [m]; mirrored at an edge unless within_film()

  [[nodiscard]] bool is_on_edge() const { return below == 0 || above == 0; }
};

Surroundings surroundings(const Grid& grid, const GridGeometry& g, int i, int j, double d, double z) {
  const int last = grid.n_z - 1, previous = grid.before(i);
  const double behind = g.step(previous < 0 ? i : previous, j), before = grid.next(i) < 0 ? behind : g.step(i, j);
  const double under = g.dz[std::max(j - 1, 0)], over = g.dz[std::min(j, last - 1)];
  Surroundings s;
  s.d = d, s.z = z;
  s.to_phi = d > 0 ? behind : before;
  s.to_z = z > 0 ? under : over;
  s.R = g.R * g.stretch[j];
  s.width_phi = g.width_phi[i] * g.stretch[j], s.width_z = g.width_z[j];
  s.back = 0.5 * behind / s.R, s.ahead = 0.5 * before / s.R;
  s.below = 0.5 * under, s.above = 0.5 * over;
  return s;
}

/// Returns the surroundings of a node, cut off at the edges of the film.
Surroundings within_film(Surroundings s, const Grid& grid, int i, int j) {
  if (j == 0) s.below = 0;
  if (j == grid.n_z - 1) s.above = 0;
  if (grid.before(i) < 0) s.back = 0;
  if (grid.next(i) < 0) s.ahead = 0;
  return s;
}

/// Returns a ramp from 1 inside an interval of half-width `half` to 0 one `step` beyond it; d is the distance from its
/// middle.
Fraction ramp(double d, double half, double step) {
  const double outside = (std::abs(d) - half) / step;
  if (outside <= 0) return {1, 0};
  return {std::max(1 - outside, 0.0), (d > 0 ? 1 : -1) / step};
}

/// Row weights (film.22) follow from the conductance between a node and the feature's edge, which is a fraction of one
/// cell away.
Fraction row_weight(const Rectangle& /*shape*/, const SurfaceFeature& feature, const Surroundings& s, double unit) {
  const Fraction around = ramp(s.d, 0.5 * feature.arc, s.to_phi / s.R);
  const double along = ramp(s.z, 0.5 * feature.length, s.to_z).value;
  const double covered = around.value * along;
  const double by_phi = unit * s.to_phi / s.width_z, by_z = unit * s.to_z / s.width_phi;
  const double sum = covered + (1 - around.value) * by_phi + (1 - along) * by_z, gap = sum - covered;
  const double covered_phi = around.phi * along, gap_phi = -by_phi * around.phi;
  return {covered / sum, (covered_phi * gap - covered * gap_phi) / (sum * sum)};
}

/// Returns the fraction of a node's cell that an ellipse with the given half-axes covers, by Gauss' rule along z and
/// exact around.
Fraction ellipse_fraction(const Surroundings& s, double half_arc, double half_length) {
  // Gauss' rule has four points on each half of the cell: Abramowitz and Stegun (1964), table 25.4.
  static constexpr std::array<double, 4> point{-0.861136311594052575, -0.339981043584856265, 0.339981043584856265,
                                               0.861136311594052575};
  static constexpr std::array<double, 4> weight{0.347854845137453857, 0.652145154862546143, 0.652145154862546143,
                                                0.347854845137453857};
  const double cell = s.back + s.ahead, height = s.below + s.above;
  const double first = s.d - s.back, last = s.d + s.ahead;
  Fraction fraction;
  for (const double half : {0.25, 0.75}) {
    for (std::size_t k = 0; k < point.size(); ++k) {
      const double y = (s.z - s.below + height * (half + 0.25 * point[k])) / half_length;
      if (std::abs(y) >= 1) continue;
      const double reach = half_arc * std::sqrt(1 - y * y);
      const double right = std::min(last, reach), left = std::max(first, -reach);
      if (right <= left) continue;
      // In the frame of the feature the cell moves backwards as the feature rotates forwards.
      const double moving = (first > -reach ? 1.0 : 0.0) - (last < reach ? 1.0 : 0.0);
      fraction.value += 0.25 * weight[k] * (right - left) / cell;
      fraction.phi += 0.25 * weight[k] * moving / cell;
    }
  }
  return fraction;
}

Fraction row_weight(const Ellipse& /*shape*/, const SurfaceFeature& feature, const Surroundings& s, double /*unit*/) {
  // The ellipse is grown by half a cell all around, as the ramps of a rectangle are: its edge then lies where the
  // ellipse's does.
  const Fraction covered =
      ellipse_fraction(s, 0.5 * (feature.arc + s.back + s.ahead), 0.5 * (feature.length + s.below + s.above));
  const double unit = 4;  // conductance of all four faces over that of one, equal in both directions
  const double open = 1 - covered.value, sum = covered.value + unit * open;
  if (covered.value == 0) return {};
  return {covered.value / sum, unit * covered.phi / (sum * sum)};
}

/// Returns the length of [first, last] that lies within +-half, or within +-half a revolution away, and its derivative
/// as the interval's borders move backwards.
Fraction overlap(double first, double last, double half) {
  Fraction sum;
  for (const double image : {-two_pi, 0.0, two_pi}) {
    const double left = std::max(first, image - half), right = std::min(last, image + half);
    if (right <= left) continue;
    sum.value += right - left;
    sum.phi += (first > image - half ? 1.0 : 0.0) - (last < image + half ? 1.0 : 0.0);
  }
  return sum;
}

/// Returns the fraction of the cell's height that a rectangle covers.
double overlap_along(const SurfaceFeature& feature, const Surroundings& s) {
  const double half = 0.5 * feature.length;
  return std::max(0.0, std::min(s.z + s.above, half) - std::max(s.z - s.below, -half)) / (s.below + s.above);
}

/// Returns the fraction of a control volume that a feature covers.
Fraction covered(const Rectangle& /*shape*/, const SurfaceFeature& feature, const Surroundings& s) {
  if (feature.arc >= two_pi) return {overlap_along(feature, s), 0};
  const Fraction around = overlap(s.d - s.back, s.d + s.ahead, 0.5 * feature.arc);
  const double along = overlap_along(feature, s) / (s.back + s.ahead);
  return {around.value * along, around.phi * along};
}

Fraction covered(const Ellipse& /*shape*/, const SurfaceFeature& feature, const Surroundings& s) {
  return ellipse_fraction(s, 0.5 * feature.arc, 0.5 * feature.length);
}

/// Returns the fraction of the circumferential flow through a control volume that passes the feature. A feature
/// narrower than the control volume is passed by all of the flow when it lies inside wholly.
Fraction mixed_rectangle(const SurfaceFeature& feature, const Surroundings& s) {
  if (feature.arc >= two_pi) return {1, 0};
  const double smaller = std::min(s.back + s.ahead, feature.arc);
  const Fraction around = overlap(s.d - s.back, s.d + s.ahead, 0.5 * feature.arc);
  return {around.value / smaller, around.phi / smaller};
}

/// Returns the fraction of missing oil that a feature supplies where it has mixed the given fraction of the oil that
/// passes.
Fraction drawn(double fraction, double fraction_journal) {
  const double half = std::min(2 * fraction, 1.0);
  return {half * half, fraction < 0.5 ? 4 * half * fraction_journal : 0};
}

// mix() sets the feature's fractions of the oil that passes a node's control volume and of the oil that it lacks
// (film.22, thermal.14).

void mix(const Rectangle& /*shape*/, const SurfaceFeature& feature, const Surroundings& s, CoveredNode& node) {
  const Fraction around = mixed_rectangle(feature, s);
  const double along = overlap_along(feature, s), higher = std::max(1.0, (s.below + s.above) / feature.length);
  const Fraction draws = drawn(around.value, around.phi);
  const double draws_along = s.is_on_edge() ? 1 : drawn(higher * along, 0).value;
  node.mixed_fraction = around.value * along;
  node.draws = draws.value * draws_along, node.draws_journal = draws.phi * draws_along;
}

void mix(const Ellipse& /*shape*/, const SurfaceFeature& feature, const Surroundings& s, CoveredNode& node) {
  const double wider = std::max(1.0, (s.back + s.ahead) / feature.arc);
  const Fraction covered = ellipse_fraction(s, 0.5 * feature.arc, 0.5 * feature.length);
  const double higher = std::max(1.0, (s.below + s.above) / feature.length);
  const Fraction draws =
      s.is_on_edge() ? Fraction{1, 0} : drawn(wider * higher * covered.value, wider * higher * covered.phi);
  node.mixed_fraction = std::min(1.0, wider * covered.value);
  node.draws = draws.value, node.draws_journal = draws.phi;
}

}  // namespace

SurfaceFeature without_border(SurfaceFeature feature, const FilmModel& model, const GridGeometry& geometry) {
  if (feature.arc < two_pi) feature.arc -= same_position * geometry.mean_dx / geometry.R;
  const bool reaches = std::abs(feature.z) + 0.5 * feature.length >= 0.5 * model.L * (1 - 1e-9);  // to round-off
  if (!reaches) feature.length -= same_position * geometry.mean_dz;
  return feature;
}

double unit_conductance(const GridGeometry& geometry) {
  return 2 * (geometry.mean_dz / geometry.mean_dx + geometry.mean_dx / geometry.mean_dz);
}

void cover(const FilmModel& model, const GridGeometry& geometry, const SurfaceFeature& feature, double phi_journal,
           std::vector<CoveredNode>& nodes) {
  const Grid& grid = model.grid;
  const double unit = unit_conductance(geometry);
  const bool travels = feature.surface == Surface::journal;
  const double middle = feature.phi + (travels ? phi_journal : 0.0);
  for (int i = 0; i < grid.n_phi; ++i) {
    const double d = geometry.from_to(middle, geometry.phi[i]);
    for (int j = 0; j < grid.n_z; ++j) {
      const Surroundings s = surroundings(grid, geometry, i, j, d, geometry.z[j] - feature.z);
      if (std::abs(d) >= 0.5 * feature.arc + s.to_phi / s.R) break;
      if (std::abs(s.z) >= 0.5 * feature.length + s.to_z) continue;
      const Fraction fraction =
          std::visit([&](const auto& shape) { return row_weight(shape, feature, s, unit); }, feature.shape);
      const double centrality =
          1 - 2 * std::max(std::abs(d) / feature.arc, std::abs(geometry.z[j] - feature.z) / feature.length);
      if (fraction.value == 0) continue;
      CoveredNode& node = nodes.emplace_back();
      node = {.node = grid.index(i, j),
              .fraction = fraction.value,
              .fraction_journal = fraction.phi,
              .centrality = centrality};
      const Surroundings inside = within_film(s, grid, i, j);
      std::visit([&](const auto& shape) { mix(shape, feature, inside, node); }, feature.shape);
      if (!travels) node.fraction_journal = node.draws_journal = 0;
    }
  }
}

void cover_cells(const FilmModel& model, const GridGeometry& geometry, const SurfaceFeature& feature,
                 double phi_journal, std::vector<CoveredNode>& nodes) {
  const Grid& grid = model.grid;
  const bool travels = feature.surface == Surface::journal;
  const double middle = feature.phi + (travels ? phi_journal : 0.0);
  for (int i = 0; i < grid.n_phi; ++i) {
    const double d = geometry.from_to(middle, geometry.phi[i]);
    for (int j = 0; j < grid.n_z; ++j) {
      const Surroundings s = within_film(surroundings(grid, geometry, i, j, d, geometry.z[j] - feature.z), grid, i, j);
      const Fraction fraction =
          std::visit([&](const auto& shape) { return covered(shape, feature, s); }, feature.shape);
      if (fraction.value > 0)
        nodes.push_back(
            {.node = grid.index(i, j), .fraction = fraction.value, .fraction_journal = travels ? fraction.phi : 0});
    }
  }
}

}  // namespace hersey::film
