#include "time_stepping/step_error.h"

#include <algorithm>
#include <cmath>

namespace hersey::run {
namespace {

constexpr double kBacklash = 0.01;  // of the pitch of teeth, about a usual backlash

}  // namespace

StepError::StepError(const model::Model& model, model::Machine& machine)
    : model_(model), machine_(machine), scales_(machine.mechanism->position_scales()) {}

const Eigen::VectorXd& StepError::measure(const solver::State& end, const Eigen::VectorXd& error) {
  const Eigen::Index coordinates = error.size();
  const auto journals = 2 * static_cast<Eigen::Index>(machine_.bearings.size());
  errors_.resize(coordinates + journals + static_cast<Eigen::Index>(machine_.gear_meshes.size()));
  errors_.setZero();  // kinds with fewer coordinates leave places
  errors_.head(coordinates) = error.cwiseQuotient(scales_);
  worst_bearing_ = worst_mesh_ = -1;
  of_coordinates_ = coordinates > 0 ? errors_.head(coordinates).cwiseAbs().maxCoeff(&worst_coordinate_) : 0;
  largest_ = of_coordinates_;
  if (machine_.bearings.empty() && machine_.gear_meshes.empty()) return errors_;
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
  for (std::size_t i = 0; i < machine_.gear_meshes.size(); ++i) {
    const double share = share_of_teeth(machine_.gear_meshes[i], end);
    errors_[coordinates + journals + static_cast<Eigen::Index>(i)] = share;
    if (std::abs(share) <= largest_) continue;
    largest_ = std::abs(share);
    worst_bearing_ = -1, worst_mesh_ = static_cast<int>(i);
  }
  return errors_;
}

double StepError::share_of_teeth(const model::BuiltMesh& mesh, const solver::State& end) const {
  const auto deflection = [&](const solver::State& state) {
    return mesh.mesh->load(machine_.mechanism->relative_motion(state, mesh.force)).deflection;
  };
  return (deflection(moved_) - deflection(end)) / (kBacklash * mesh.mesh->pitch());
}

std::string StepError::worst() const {
  if (worst_mesh_ >= 0) return "the teeth of " + machine_.gear_meshes[static_cast<std::size_t>(worst_mesh_)].name;
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
