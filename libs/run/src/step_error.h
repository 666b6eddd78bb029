#pragma once

#include <Eigen/Dense>
#include <string>

#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/equations.h"

namespace hersey::run {

/// Measures the local error of a step: the largest of all joint coordinates, angles in rad and lengths over the
/// machine's size, and of all journals' positions in their shells over the radial clearance.
class StepError {
 public:
  StepError(const model::Model& model, model::Machine& machine);

  /// @param error  increment of position, shape (nv): solver::StepJudge.
  [[nodiscard]] double measure(const solver::State& end, const Eigen::VectorXd& error);

  /// What the last error measured is the error of, e.g. "joint guide, x" or "the journal in bearing big_end".
  [[nodiscard]] std::string worst() const;

 private:
  const model::Model& model_;
  model::Machine& machine_;
  Eigen::VectorXd scales_;
  solver::State moved_;
  Eigen::Index worst_coordinate_ = 0;
  int worst_bearing_ = -1;
};

/// The first step to try: one in which the start's velocity and acceleration alone move as much as the tolerance.
[[nodiscard]] double first_step(const solver::Equations& equations, const solver::State& start,
                                const model::ErrorControl& control);

}  // namespace hersey::run
