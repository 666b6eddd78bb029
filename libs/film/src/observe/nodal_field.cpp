#include "hersey/film/nodal_field.h"

#include <algorithm>
#include <cmath>

#include "gap/grid_geometry.h"
#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"

namespace hersey::film {

NodalField::NodalField(const FilmModel& model) : grid_(model.grid), weights_(model.grid.size()) {
  const GridGeometry geometry(model);
  phi_ = geometry.phi, z_ = geometry.z;
  for (int i = 0; i < grid_.n_phi; ++i)
    for (int j = 0; j < grid_.n_z; ++j) weights_[grid_.index(i, j)] = geometry.weight(i, j);
}

double NodalField::at(const Eigen::VectorXd& values, double phi, double z) const {
  HERSEY_REQUIRE(values.size() == weights_.size(), "a value for each node");
  const double sliver = 1e-9 * (z_[z_.size() - 1] - z_[0]);  // round-off of the mesh that asks
  if (z < z_[0] - sliver || z > z_[z_.size() - 1] + sliver) return 0;
  const double from_first = phi - phi_[0];
  const double angle = phi_[0] + from_first - two_pi * std::floor(from_first / two_pi);
  const auto line = static_cast<int>(std::upper_bound(phi_.begin(), phi_.end(), angle) - phi_.begin()) - 1;
  const int i = std::max(line, 0), next = grid_.next(i);
  const auto row = static_cast<int>(std::upper_bound(z_.begin(), z_.end(), z) - z_.begin()) - 1;
  const int j = std::clamp(row, 0, grid_.n_z - 2);
  const double t = std::clamp((z - z_[j]) / (z_[j + 1] - z_[j]), 0.0, 1.0);
  const auto on = [&](int k) { return (1 - t) * values[grid_.index(k, j)] + t * values[grid_.index(k, j + 1)]; };
  if (next < 0) return angle - phi_[i] < 1e-9 ? on(i) : 0;  // the last line of a patch, to round-off
  const double end = next > i ? phi_[next] : phi_[next] + two_pi, s = (angle - phi_[i]) / (end - phi_[i]);
  return (1 - s) * on(i) + s * on(next);
}

}  // namespace hersey::film
