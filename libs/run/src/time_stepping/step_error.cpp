#include "time_stepping/step_error.h"

#include <algorithm>
#include <cmath>

namespace hersey::run {

StepError::StepError(const model::Model& model, model::Machine& machine)
    : model_(model), machine_(machine), scales_(machine.mechanism->position_scales()) {}

const Eigen::VectorXd& StepError::measure(const solver::State& end, const Eigen::VectorXd& error) {
  const Eigen::Index coordinates = error.size();
  errors_.resize(coordinates + 2 * static_cast<Eigen::Index>(machine_.bearings.size()));
  errors_.setZero();  // kinds with fewer coordinates leave places
  errors_.head(coordinates) = error.cwiseQuotient(scales_);
  worst_bearing_ = -1;
  of_coordinates_ = coordinates > 0 ? errors_.head(coordinates).cwiseAbs().maxCoeff(&worst_coordinate_) : 0;
  largest_ = of_coordinates_;
  if (machine_.bearings.empty()) return errors_;
  moved_ = end;
  machine_.mechanism->retract(end.q, error, moved_.q);
  for (std::size_t i = 0; i < machine_.bearings.size(); ++i) {
    const mbd::ForceId force = machine_.bearings[i].force;
    const Eigen::VectorXd share = machine_.bearings[i].bearing->gap().relative_shift(
        machine_.mechanism->relative_motion(end, force).X_AB, machine_.mechanism->relative_motion(moved_, force).X_AB);
    errors_.segment(coordinates + 2 * static_cast<Eigen::Index>(i), share.size()) = share;
    if (share.norm() <= largest_) continue;
    largest_ = share.norm();
    worst_bearing_ = static_cast<int>(i);
  }
  return errors_;
}

std::string StepError::worst() const {
  if (worst_bearing_ >= 0) {
    const model::Bearing& bearing = model_.bearings[static_cast<std::size_t>(worst_bearing_)];
    return "the " + bearing.kind->moving_surface() + " in bearing " + bearing.name;
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
