#pragma once

#include <Eigen/Dense>
#include <string>

#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/equations.h"

namespace hersey::run {

/// Measures the local error of a step: of all joint coordinates, angles in rad and lengths over the machine's size, and
/// of all journals' positions in their shells over the radial clearance, and of the deflections of gears' teeth over a
/// hundredth of their pitch.
class StepError {
 public:
  StepError(const model::Model& model, model::Machine& machine);

  /// @param error  increment of position, shape (nv): solver::StepCheck.
  /// @returns all errors with their signs: of the coordinates, then of each journal along x and y of its shell,
  /// then of each gear mesh.
  [[nodiscard]] const Eigen::VectorXd& measure(const solver::State& end, const Eigen::VectorXd& error);

  /// The largest of the errors last measured; for a journal, the length of its error vector.
  [[nodiscard]] double largest() const { return largest_; }

  /// The largest of the coordinates alone.
  [[nodiscard]] double of_coordinates() const { return of_coordinates_; }

  /// Name of the quantity with the largest error, e.g. "joint guide, x" or "the journal in bearing big_end".
  [[nodiscard]] std::string worst() const;

 private:
  /// Of the deflection between `end` and `moved_`.
  [[nodiscard]] double share_of_teeth(const model::BuiltMesh& mesh, const solver::State& end) const;

  const model::Model& model_;
  model::Machine& machine_;
  Eigen::VectorXd scales_;
  solver::State moved_;
  Eigen::VectorXd errors_;
  double largest_ = 0, of_coordinates_ = 0;
  Eigen::Index worst_coordinate_ = 0;
  int worst_bearing_ = -1, worst_mesh_ = -1;
};

/// The first step to try: one in which the start's velocity and acceleration alone move as much as the tolerance.
[[nodiscard]] double first_step(const solver::Equations& equations, const solver::State& start,
                                const model::ErrorControl& control);

}  // namespace hersey::run
