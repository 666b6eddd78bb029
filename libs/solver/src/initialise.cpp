#include "hersey/solver/initialise.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hersey/core/contract.h"
#include "kkt.h"

namespace hersey::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Equations::Index;

/// Weights of a minimum-norm increment: held components move only if nothing else can.
VectorXd mobilities(Index nv, const std::vector<Index>& held) {
  VectorXd weight = VectorXd::Ones(nv);
  for (Index k : held) {
    HERSEY_REQUIRE(0 <= k && k < nv, "a held component exists");
    weight[k] = 1e-7;
  }
  return weight;
}

/// The smallest dx, in the weighted norm, with G dx = -residual (least squares where G is deficient).
VectorXd smallest_increment(const Equations::SparseMatrix& G, const VectorXd& residual, const VectorXd& weight) {
  const MatrixXd weighted = MatrixXd(G) * weight.asDiagonal();
  return -(weight.asDiagonal() * weighted.completeOrthogonalDecomposition().solve(residual));
}

std::vector<std::string> names_of(const Equations& equations, const std::vector<Index>& rows, Index offset) {
  std::vector<std::string> names;
  for (Index row : rows) {
    std::string name = equations.name_of_row(offset + row);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  }
  return names;
}

/// Newton's method on Phi; leaves the state where it ended.
void assemble_positions(Equations& equations, State& state, const VectorXd& weight, const InitialiseOptions& options,
                        InitialiseSummary& summary) {
  // The largest increment of one coordinate [rad or m]: half a radian keeps a joint on its branch.
  constexpr double largest_increment = 0.5;
  VectorXd phi, scale, q;
  Equations::SparseMatrix G;
  for (;; ++summary.iterations) {
    equations.constraints(state, phi, scale, &G);
    Index worst = 0;
    summary.residual = phi.size() > 0 ? phi.cwiseQuotient(scale).cwiseAbs().maxCoeff(&worst) : 0;
    if (summary.residual <= options.rtol) return;
    if (summary.iterations == options.max_iterations || !phi.allFinite()) {
      summary.status = InitialiseStatus::cannot_assemble;
      summary.message = fmt::format(
          "the mechanism cannot be assembled: after {} iterations {} is still open by {:.3g}; check the geometry, the "
          "initial values and the drives it belongs to",
          summary.iterations, equations.name_of_row(equations.nv() + worst), phi[worst]);
      return;
    }
    VectorXd dx = smallest_increment(G, phi, weight);
    if (const double largest = dx.lpNorm<Eigen::Infinity>(); largest > largest_increment)
      dx *= largest_increment / largest;
    equations.retract(state.q, dx, q);
    state.q = q;
  }
}

}  // namespace

InitialiseSummary initialise(Equations& equations, State& state, const InitialiseOptions& options) {
  const Index nv = equations.nv(), nlambda = equations.nlambda();
  HERSEY_REQUIRE(state.q.size() == equations.nq() && state.v.size() == nv, "the state belongs to the equations");
  InitialiseSummary summary;
  summary.status = InitialiseStatus::consistent;
  State trial = state;
  trial.vdot.setZero(nv);
  trial.lambda.setZero(nlambda);
  const VectorXd weight = mobilities(nv, options.held);

  VectorXd phi, scale, velocity, gamma;
  Equations::SparseMatrix G;
  assemble_positions(equations, trial, weight, options, summary);
  equations.constraints(trial, phi, scale, &G);
  const MatrixXd dense_G(G);
  // Conflicting constraints are redundant ones, and that is the better message.
  if (const RankAnalysis rank = analyse_rank(dense_G); !rank.involved.empty()) {
    summary.status = InitialiseStatus::redundant;
    summary.redundant = names_of(equations, rank.involved, nv);
    summary.message = fmt::format(
        "{} of {} constraints say what others say already; they are among: {}. Free a "
        "motion in one of these, for example with a spherical or cylindrical joint",
        nlambda - rank.rank, nlambda, fmt::join(summary.redundant, "; "));
    return summary;
  }
  if (!summary.consistent()) return summary;

  equations.constraint_rates(trial, velocity, gamma);
  if (nlambda > 0) trial.v += smallest_increment(G, velocity, weight);

  equations.begin_step(trial, 0);
  VectorXd h;
  MatrixXd M;
  if (std::string trouble = assemble_forces(equations, trial, h, M); !trouble.empty()) {
    summary.status = InitialiseStatus::domain_error;
    summary.message = fmt::format("at the start, t = {:.6g} s: {}", trial.t, trouble);
    return summary;
  }
  equations.constraint_rates(trial, velocity, gamma);
  AccelerationSolution solution = solve_kkt(M, dense_G, h, gamma);
  if (!solution.undetermined.empty()) {
    summary.status = InitialiseStatus::undetermined;
    summary.undetermined = names_of(equations, solution.undetermined, 0);
    summary.message = fmt::format(
        "nothing determines the acceleration of: {}. Give the bodies there mass and inertia, "
        "or hold the motion by a joint or a drive",
        fmt::join(summary.undetermined, "; "));
    return summary;
  }
  trial.vdot = std::move(solution.vdot);
  trial.lambda = std::move(solution.lambda);
  state = std::move(trial);
  equations.accept_step(state);
  return summary;
}

}  // namespace hersey::solver
