#include "step_error.h"

#include <algorithm>
#include <cmath>

namespace hersey::run {

StepError::StepError(const model::Model& model, model::Machine& machine)
    : model_(model), machine_(machine), scales_(machine.mechanism->position_scales()) {}

double StepError::measure(const solver::State& end, const Eigen::VectorXd& error) {
  worst_bearing_ = -1;
  double largest = error.size() > 0 ? error.cwiseQuotient(scales_).cwiseAbs().maxCoeff(&worst_coordinate_) : 0;
  if (machine_.bearings.empty()) return largest;
  moved_ = end;
  machine_.mechanism->retract(end.q, error, moved_.q);
  for (std::size_t i = 0; i < machine_.bearings.size(); ++i) {
    const mbd::ForceId force = machine_.bearings[i].force;
    const Vector3 shift = machine_.mechanism->relative_motion(moved_, force).X_AB.r -
                          machine_.mechanism->relative_motion(end, force).X_AB.r;
    const double share = shift.head<2>().norm() / model_.bearings[i].film.c;
    if (share <= largest) continue;
    largest = share;
    worst_bearing_ = static_cast<int>(i);
  }
  return largest;
}

std::string StepError::worst() const {
  if (worst_bearing_ >= 0) {
    return "the journal in bearing " + model_.bearings[static_cast<std::size_t>(worst_bearing_)].name;
  }
  return machine_.mechanism->name_of_row(worst_coordinate_);
}

double first_step(const solver::Equations& equations, const solver::State& start, const model::ErrorControl& control) {
  const Eigen::VectorXd scales = equations.position_scales();
  const double v = start.v.cwiseQuotient(scales).lpNorm<Eigen::Infinity>();
  const double a = start.vdot.cwiseQuotient(scales).lpNorm<Eigen::Infinity>();
  double dt = 0.01 * control.largest;
  if (v > 0) dt = std::min(dt, control.tolerance / v);
  if (a > 0) dt = std::min(dt, std::sqrt(control.tolerance / a));
  return dt;
}

}  // namespace hersey::run
