#include "hersey/solver/kinematics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "assemble_positions.h"
#include "constraint_space.h"
#include "kkt.h"

namespace hersey::solver {
namespace {

using Eigen::VectorXd;
using Index = Equations::Index;

KinematicsSummary failure(KinematicsSummary summary, KinematicsStatus status, std::string message) {
  summary.status = status;
  summary.message = std::move(message);
  return summary;
}

}  // namespace

std::vector<std::string> free_coordinates(Equations& equations, const State& state) {
  const Eigen::MatrixXd Z = free_directions(equations, state);
  std::vector<std::string> names;
  for (Index k = 0; k < Z.rows(); ++k)
    if (Z.row(k).norm() > 1e-6) names.push_back(equations.name_of_row(k));
  return names;
}

KinematicsSummary solve_kinematics(Equations& equations, State& state) {
  KinematicsSummary summary;
  State trial = state;
  const Index nv = equations.nv();
  const ClosureResult closure = close_constraints(equations, trial, VectorXd::Ones(nv), {.rtol = 1e-13});
  summary.iterations = closure.iterations;
  summary.residual = closure.residual;
  if (!closure.closed && closure.residual > 1e-11) {
    VectorXd phi, scale;
    Index worst = 0;
    equations.constraints(trial, phi, scale, nullptr);
    phi.cwiseQuotient(scale).cwiseAbs().maxCoeff(&worst);
    return failure(summary, KinematicsStatus::cannot_close,
                   fmt::format("t = {:.9g} s: the mechanism cannot follow its drives: {} stays open by {:.3g}", trial.t,
                               equations.name_of_row(nv + worst), phi[worst]));
  }
  // At a dead point drives and constraints do not prescribe the motion; rates and forces grow without bound.
  summary.undetermined = free_coordinates(equations, trial);
  if (!summary.undetermined.empty())
    return failure(summary, KinematicsStatus::undetermined,
                   fmt::format("t = {:.9g} s: a dead point: drives and joints do not prescribe the motion of {} here",
                               trial.t, fmt::join(summary.undetermined, ", ")));
  VectorXd velocity, gamma, phi, scale;
  Equations::SparseMatrix G;
  equations.constraints(trial, phi, scale, &G);
  equations.constraint_rates(trial, velocity, gamma);
  trial.v += smallest_increment(G, velocity, VectorXd::Ones(nv));
  equations.begin_step(trial, 0);
  VectorXd h;
  Equations::SparseMatrix S;
  if (const Outcome forces = assemble_forces(equations, trial, 0, h, S); !forces.solved())
    return failure(summary, KinematicsStatus::singular, fmt::format("t = {:.9g} s: {}", trial.t, forces.message));
  equations.constraint_rates(trial, velocity, gamma);
  AccelerationSolution solution = solve_kkt(S, nv, h, gamma);
  if (!solution.vdot.allFinite())
    return failure(summary, KinematicsStatus::singular,
                   fmt::format("t = {:.9g} s: the accelerations are not numbers: look at the drives", trial.t));
  trial.vdot = std::move(solution.vdot);
  trial.lambda = std::move(solution.lambda);
  state = std::move(trial);
  equations.accept_step(state);
  summary.status = KinematicsStatus::solved;
  return summary;
}

}  // namespace hersey::solver
