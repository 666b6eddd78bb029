#pragma once

#include <Eigen/Dense>

#include "hersey/core/archive.h"

namespace hersey::film {

/// By how much of what was foretold walls follow their corrections from cycle to cycle (theory manual, thermal.65):
/// less than one where warmer walls bring more heat of their own, as contact does in films that thin.
class WallPace {
 public:
  /// @param missing  now, of any quantities, shape (n). @param per_kelvin  of each, > 0, shape (n)
  void learn(const Eigen::VectorXd& missing, const Eigen::VectorXd& per_kelvin);
  /// Between 1/2 and 1; 1 until two corrections are known.
  [[nodiscard]] double share() const { return share_; }
  /// By how much the missing is to fall before learn() is called again, at a share of one, shape (n).
  void foretell(const Eigen::VectorXd& fall) { foretold_ = fall; }
  /// What is learned.
  void persist(Archive& archive);

 private:
  double share_ = 1;
  Eigen::VectorXd missing_, foretold_;
};

}  // namespace hersey::film
