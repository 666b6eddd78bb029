#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/mbd/mechanism.h"
#include "hersey/run/orbits.h"
#include "time_stepping/motion.h"

namespace hersey::run {

/// A motion at a value of the parameter, with its period [s].
struct MotionAtValue {
  Motion motion;
  double value = 0;
  double period = 0;
};

/// A period that has been run: a trial of x = P(x; value).
struct PeriodTrial {
  Motion start;
  MotionAtValue end;
};

/// An orbit that has been found, and what the search for the next one begins with.
struct BranchPoint {
  OrbitAtValue orbit;
  MotionAtValue at;                 ///< at the start of a period
  Eigen::VectorXd sizes;            ///< Swing::sizes() of its period
  Eigen::VectorXd ways;             ///< Swing::ways(): 0 of what stands still or goes round
  bool is_rest = false;             ///< nothing oscillates
  std::vector<PeriodTrial> trials;  ///< near it, its own first
};

/// Measure of the way between motions at different values of the parameter.
class BranchMetric {
 public:
  /// @param point  whose swings are the sizes; coordinates that stand still or go round do not count
  /// @param range  of the parameter
  /// @param scale  by which motions count more than usual
  BranchMetric(const BranchPoint& point, double range, const mbd::Mechanism& mechanism, double scale = 1);
  /// Returns the way, whose squares add up to that of its length: shares of the swings, then that of the range.
  [[nodiscard]] Eigen::VectorXd way(const mbd::Mechanism& mechanism, const MotionAtValue& from,
                                    const MotionAtValue& to) const;

 private:
  Eigen::VectorXd weights_;
  double range_;
};

/// Returns the length of the way's part of motions over that of its part of the value; infinite where the value stays.
[[nodiscard]] double motion_over_value(const Eigen::VectorXd& way);

/// Weighted sum of motions, values and periods. @param weights  their sum is 1
[[nodiscard]] MotionAtValue combine(const mbd::Mechanism& mechanism, const std::vector<MotionAtValue>& of,
                                    const Eigen::VectorXd& weights);

}  // namespace hersey::run
