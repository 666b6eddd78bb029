#pragma once

#include <Eigen/Dense>

#include "hersey/core/archive.h"

namespace hersey::film {

/// Relaxation of walls that follow their corrections from cycle to cycle, from the ratio of observed to predicted
/// changes (theory manual, thermal.65). It is less than one where warmer walls increase their own heat, as contact does
/// in films that thin.
class WallRelaxation {
 public:
  /// Updates the relaxation. @param missing  present values of any quantities, shape (n). @param per_kelvin  change of
  /// each with temperature, > 0, shape (n)
  void learn(const Eigen::VectorXd& missing, const Eigen::VectorXd& per_kelvin);
  /// Relaxation between 1/2 and 1; 1 until two corrections are known.
  [[nodiscard]] double factor() const { return factor_; }
  /// Sets the predicted fall of `missing` until the next learn(), at a factor of one, shape (n).
  void predict(const Eigen::VectorXd& fall) { predicted_ = fall; }
  /// Saves or restores the relaxation.
  void persist(Archive& archive);

 private:
  double factor_ = 1;
  Eigen::VectorXd missing_, predicted_;
};

}  // namespace hersey::film
