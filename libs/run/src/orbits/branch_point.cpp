#include "orbits/branch_point.h"

#include <cmath>
#include <limits>

namespace hersey::run {
namespace {

constexpr double kMotion =
    0.25;  // share of the range that counts as much as a change of all coordinates by their swing

}  // namespace

BranchMetric::BranchMetric(const BranchPoint& point, double range, const mbd::Mechanism& mechanism, double scale)
    : weights_(point.sizes.cwiseInverse()), range_(range) {
  const Eigen::Index nv = mechanism.nv();
  for (Eigen::Index i = 0; i < nv; ++i)
    if (point.ways[i] == 0) weights_[i] = weights_[nv + i] = 0;
  const auto count = static_cast<double>((weights_.array() > 0).count());
  if (count > 0) weights_ *= scale * kMotion / std::sqrt(count);
}

Eigen::VectorXd BranchMetric::way(const mbd::Mechanism& mechanism, const MotionAtValue& from,
                                  const MotionAtValue& to) const {
  Eigen::VectorXd way(weights_.size() + 1);
  way << way_between(mechanism, from.motion, to.motion).head(weights_.size()).cwiseProduct(weights_),
      (to.value - from.value) / range_;
  return way;
}

double motion_over_value(const Eigen::VectorXd& way) {
  const double value = std::abs(way[way.size() - 1]);
  return value > 0 ? way.head(way.size() - 1).norm() / value : std::numeric_limits<double>::infinity();
}

MotionAtValue combine(const mbd::Mechanism& mechanism, const std::vector<MotionAtValue>& of,
                      const Eigen::VectorXd& weights) {
  std::vector<Motion> motions;
  MotionAtValue combined;
  for (std::size_t k = 0; k < of.size(); ++k) {
    motions.push_back(of[k].motion);
    combined.value += weights[static_cast<Eigen::Index>(k)] * of[k].value;
    combined.period += weights[static_cast<Eigen::Index>(k)] * of[k].period;
  }
  combined.motion = combine(mechanism, motions, weights);
  return combined;
}

}  // namespace hersey::run
