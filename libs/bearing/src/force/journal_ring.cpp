#include "force/journal_ring.h"

#include <cmath>

#include "hersey/core/two_pi.h"

namespace hersey::bearing {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Lines at equal angles around a whole circumference, as far apart as the grid's on average.
Index lines_around(const film::Grid& grid) {
  Index intervals = 0;
  for (int i = 0; i < grid.n_phi; ++i)
    if (grid.next(i) >= 0) ++intervals;
  return static_cast<Index>(std::lround(static_cast<double>(intervals) * two_pi / covered_angle(grid)));
}

}  // namespace

double covered_angle(const film::Grid& grid) {
  double covered = 0;
  for (int i = 0; i < grid.n_phi; ++i)
    if (const int next = grid.next(i); next >= 0) covered += grid.phi(next) - grid.phi(i) + (next > i ? 0 : two_pi);
  return covered;
}

JournalRing::JournalRing(const film::Grid& grid)
    : grid_(grid),
      lines_(lines_around(grid)),
      step_(two_pi / static_cast<double>(lines_)),
      first_(static_cast<std::size_t>(grid.n_phi)),
      value_(first_.size()),
      slope_(first_.size()),
      curvature_(first_.size(), {1, -2, 1}) {
  turn(0);
}

// (wear.8): the spline B of a line and of its neighbours at a distance of at most half a step.
void JournalRing::turn(double angle) {
  for (std::size_t i = 0; i < first_.size(); ++i) {
    const double at = (grid_.phi(static_cast<int>(i)) - angle) / step_, nearest = std::round(at), t = at - nearest;
    const Index before = (static_cast<Index>(nearest) - 1) % lines_;
    first_[i] = before < 0 ? before + lines_ : before;
    value_[i] = {(0.5 - t) * (0.5 - t) / 2, 0.75 - t * t, (0.5 + t) * (0.5 + t) / 2};
    slope_[i] = {t - 0.5, -2 * t, t + 0.5};
  }
}

VectorXd JournalRing::spread(const VectorXd& values, const Weights& weights, double factor) const {
  VectorXd nodal = VectorXd::Zero(grid_.size());
  for (std::size_t i = 0; i < first_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      nodal.segment(static_cast<Index>(i) * grid_.n_z, grid_.n_z) +=
          factor * weights[i][k] * values.segment(line(i, k) * grid_.n_z, grid_.n_z);
  return nodal;
}

// A journal that rotates forwards brings to a node what lay before it.
VectorXd JournalRing::by_angle(const VectorXd& values) const { return spread(values, slope_, -1 / step_); }

VectorXd JournalRing::by_angle_twice(const VectorXd& values) const {
  return spread(values, curvature_, 1 / (step_ * step_));
}

VectorXd JournalRing::at_lines(const VectorXd& values) const {
  const Eigen::Map<const Eigen::MatrixXd> rows(values.data(), grid_.n_z, lines_);
  Eigen::MatrixXd on_lines(grid_.n_z, lines_);
  for (Index k = 0; k < lines_; ++k)
    on_lines.col(k) = 0.75 * rows.col(k) + 0.125 * (rows.col((k + lines_ - 1) % lines_) + rows.col((k + 1) % lines_));
  return on_lines.reshaped();
}

VectorXd JournalRing::collected(const VectorXd& nodal) const {
  VectorXd values = VectorXd::Zero(size());
  for (std::size_t i = 0; i < first_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      values.segment(line(i, k) * grid_.n_z, grid_.n_z) +=
          value_[i][k] * nodal.segment(static_cast<Index>(i) * grid_.n_z, grid_.n_z);
  return values;
}

}  // namespace hersey::bearing
