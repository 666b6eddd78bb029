#include "feature_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hersey::film {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// A share of a cell and its derivative with the feature's angle.
struct Share {
  double value = 0;
  double phi = 0;
};

double axial_step(const FilmModel& model) { return model.L / (model.grid.n_z - 1); }

/// From 1 inside an interval of half-width `half` to 0 one `step` beyond it; d is the distance from its middle.
Share ramp(double d, double half, double step) {
  const double outside = (std::abs(d) - half) / step;
  if (outside <= 0) return {1, 0};
  if (outside >= 1) return {0, 0};
  return {1 - outside, (d > 0 ? 1 : -1) / step};
}

/// Row shares (film.25): the conductance from a node to the feature's edge where that is a share of one cell away.
Share held_rectangle(const FilmModel& model, const Share& around, double along) {
  const double dx = model.R * turn / model.grid.n_phi, dz = axial_step(model);
  const double to_phi = dx / dz, to_z = dz / dx, unit = unit_conductance(model);
  const double covered = around.value * along;
  const double gap = unit * ((1 - around.value) * to_phi + (1 - along) * to_z);
  if (covered == 0) return {};
  const double sum = covered + gap;
  const double covered_phi = around.phi * along, gap_phi = -unit * to_phi * around.phi;
  return {covered / sum, (covered_phi * gap - covered * gap_phi) / (sum * sum)};
}

/// Share of the cell around (d, z) that an ellipse with the given half-axes covers, by Gauss' rule along z and exact
/// around: dimensionless in both directions.
Share ellipse_share(double d, double z, double half_arc, double half_length, double dphi, double dz) {
  // Four points on each half of the cell: Abramowitz and Stegun (1964), table 25.4.
  static constexpr std::array<double, 4> place{-0.861136311594052575, -0.339981043584856265, 0.339981043584856265,
                                               0.861136311594052575};
  static constexpr std::array<double, 4> weight{0.347854845137453857, 0.652145154862546143, 0.652145154862546143,
                                                0.347854845137453857};
  Share share;
  for (int half = -1; half <= 1; half += 2) {
    for (std::size_t k = 0; k < place.size(); ++k) {
      const double y = (z + 0.25 * dz * (half + place[k])) / half_length;
      if (std::abs(y) >= 1) continue;
      const double reach = half_arc * std::sqrt(1 - y * y);
      const double right = std::min(d + 0.5 * dphi, reach), left = std::max(d - 0.5 * dphi, -reach);
      if (right <= left) continue;
      // Seen from the feature the cell moves backwards as the feature turns forwards.
      const double moving = (d - 0.5 * dphi > -reach ? 1.0 : 0.0) - (d + 0.5 * dphi < reach ? 1.0 : 0.0);
      share.value += 0.25 * weight[k] * (right - left) / dphi;
      share.phi += 0.25 * weight[k] * moving / dphi;
    }
  }
  return share;
}

Share held_ellipse(const FilmModel& model, const SurfaceFeature& feature, double d, double z) {
  const double dphi = turn / model.grid.n_phi, dz = axial_step(model);
  // Grown by half a cell all around, as the ramps of a rectangle are: its edge then lies where the ellipse's does.
  const Share covered = ellipse_share(d, z, 0.5 * (feature.arc + dphi), 0.5 * (feature.length + dz), dphi, dz);
  const double unit = 4;  // conductance of all four faces over that of one, both directions alike
  const double open = 1 - covered.value, sum = covered.value + unit * open;
  if (covered.value == 0) return {};
  return {covered.value / sum, unit * covered.phi / (sum * sum)};
}

}  // namespace

double unit_conductance(const FilmModel& model) {
  const double dx = model.R * turn / model.grid.n_phi, dz = axial_step(model);
  return 2 * (dz / dx + dx / dz);
}

void cover(const FilmModel& model, const SurfaceFeature& feature, double phi_journal, std::vector<CoveredNode>& nodes) {
  const Grid& grid = model.grid;
  const double dphi = turn / grid.n_phi, dz = axial_step(model);
  const bool travels = feature.surface == Surface::journal;
  const double middle = feature.phi + (travels ? phi_journal : 0.0);
  for (int i = 0; i < grid.n_phi; ++i) {
    const double d = std::remainder(i * dphi - middle, turn);
    if (std::abs(d) >= 0.5 * feature.arc + dphi) continue;
    for (int j = 0; j < grid.n_z; ++j) {
      const double z = j * dz - 0.5 * model.L - feature.z;
      if (std::abs(z) >= 0.5 * feature.length + dz) continue;
      const Share held =
          feature.shape == FeatureShape::ellipse
              ? held_ellipse(model, feature, d, z)
              : held_rectangle(model, ramp(d, 0.5 * feature.arc, dphi), ramp(z, 0.5 * feature.length, dz).value);
      if (held.value > 0) nodes.push_back({grid.index(i, j), held.value, travels ? held.phi : 0});
    }
  }
}

}  // namespace hersey::film
