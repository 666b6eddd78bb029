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

NodalField::Interval NodalField::around(double phi) const {
  const double from_first = phi - phi_[0];
  const double angle = phi_[0] + from_first - two_pi * std::floor(from_first / two_pi);
  const auto line = static_cast<int>(std::upper_bound(phi_.begin(), phi_.end(), angle) - phi_.begin()) - 1;
  Interval interval;
  interval.i = std::max(line, 0), interval.next = (interval.i + 1) % grid_.n_phi;
  const double begin = phi_[interval.i];
  const double end = interval.next > interval.i ? phi_[interval.next] : phi_[interval.next] + two_pi;
  interval.s = (angle - begin) / (end - begin), interval.from_line = angle - begin;
  return interval;
}

/// Linear along line i, constant beyond its ends.
double NodalField::on_line(const Eigen::VectorXd& values, int i, double z) const {
  const auto row = static_cast<int>(std::upper_bound(z_.begin(), z_.end(), z) - z_.begin()) - 1;
  const int j = std::clamp(row, 0, grid_.n_z - 2);
  const double t = std::clamp((z - z_[j]) / (z_[j + 1] - z_[j]), 0.0, 1.0);
  return (1 - t) * values[grid_.index(i, j)] + t * values[grid_.index(i, j + 1)];
}

double NodalField::at(const Eigen::VectorXd& values, double phi, double z) const {
  HERSEY_REQUIRE(values.size() == weights_.size(), "a value for each node");
  const double sliver = 1e-9 * (z_[z_.size() - 1] - z_[0]);  // round-off of the mesh that asks
  if (z < z_[0] - sliver || z > z_[z_.size() - 1] + sliver) return 0;
  const Interval in = around(phi);
  if (grid_.next(in.i) < 0)  // the last line of a patch, to round-off
    return in.from_line < 1e-9 ? on_line(values, in.i, z) : 0;
  return (1 - in.s) * on_line(values, in.i, z) + in.s * on_line(values, in.next, z);
}

double NodalField::continued(const Eigen::VectorXd& values, double phi, double z) const {
  HERSEY_REQUIRE(values.size() == weights_.size(), "a value for each node");
  const Interval in = around(phi);
  return (1 - in.s) * on_line(values, in.i, z) + in.s * on_line(values, in.next, z);
}

}  // namespace hersey::film
