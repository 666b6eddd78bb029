#include "hersey/solver/initialise.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "assemble_positions.h"
#include "hersey/core/contract.h"
#include "kkt.h"

namespace hersey::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Equations::Index;

/// Weights of a minimum-norm increment: held components move only if nothing else can.
VectorXd mobilities(Index nv, const InitialiseOptions& options) {
  VectorXd weight = VectorXd::Ones(nv);
  const auto weigh = [&](const std::vector<Index>& components, double mobility) {
    for (Index k : components) {
      HERSEY_REQUIRE(0 <= k && k < nv, "a held component exists");
      weight[k] = mobility;
    }
  };
  weigh(options.held, 1e-7);
  weigh(options.stiff, 1e-10);
  return weight;
}

std::vector<std::string> names_of(const Equations& equations, const std::vector<Index>& rows, Index offset) {
  std::vector<std::string> names;
  for (Index row : rows) {
    std::string name = equations.name_of_row(offset + row);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  }
  return names;
}

/// Residuals of equal name together, the widest open first.
std::vector<OpenConstraint> open_constraints(Equations& equations, const State& state) {
  VectorXd phi, scale;
  equations.constraints(state, phi, scale, nullptr);
  std::vector<OpenConstraint> open;
  for (Index i = 0; i < phi.size(); ++i) {
    const std::string name = equations.name_of_row(equations.nv() + i);
    const auto same = [&](const OpenConstraint& other) { return other.name == name; };
    auto found = std::find_if(open.begin(), open.end(), same);
    if (found == open.end()) found = open.insert(open.end(), {name, 0.0});
    found->size = std::hypot(found->size, phi[i]);
  }
  std::sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return a.size > b.size; });
  const double least = open.empty() ? 0 : 1e-3 * open.front().size;
  std::erase_if(open, [&](const OpenConstraint& one) { return one.size < least; });
  return open;
}

/// Closes the constraints: first with what is held at rest, then with everything free but what is stiff, each also from
/// a disturbed guess; at last with that free too. Leaves the state where it ended, or at the closest configuration
/// found.
void assemble_positions(Equations& equations, State& state, const InitialiseOptions& options,
                        InitialiseSummary& summary) {
  const State guess = state;
  State closest = state;
  double least = std::numeric_limits<double>::infinity();
  const auto attempt = [&](bool hold, bool stiff, bool disturbed) {
    VectorXd mobility = VectorXd::Ones(equations.nv());
    if (hold)
      for (const Index k : options.held) mobility[k] = 0;
    if (stiff)
      for (const Index k : options.stiff) mobility[k] = 0;
    state = guess;
    if (disturbed) disturb(equations, state, mobility);
    const ClosureResult result = close_constraints(equations, state, mobility, options);
    summary.iterations += result.iterations;
    if (result.residual < least) {
      least = result.residual;
      closest = state;
    }
    return result.closed;
  };
  bool closed = attempt(true, true, false) || attempt(true, true, true) || attempt(false, true, false) ||
                attempt(false, true, true);
  if (!closed && !options.stiff.empty()) closed = attempt(false, false, false);
  if (!closed) state = closest;
  summary.residual = least;
  if (closed) return;
  summary.status = InitialiseStatus::cannot_assemble;
  summary.open = open_constraints(equations, state);
  std::vector<std::string> gaps;
  gaps.reserve(summary.open.size());
  for (const OpenConstraint& open : summary.open) gaps.push_back(fmt::format("{} by {:.4g}", open.name, open.size));
  summary.message = fmt::format(
      "the mechanism cannot be assembled; where it comes closest these are open: {}; check the geometry, the initial "
      "values and the drives they belong to",
      fmt::join(gaps, "; "));
}

/// Says which constraints repeat others, looked at in the assembled state or, where there is none, away from special
/// positions: at the closest configuration of a loop that cannot be closed rows always depend on each other.
bool report_redundancy(Equations& equations, const State& state, bool assembled, InitialiseSummary& summary) {
  VectorXd phi, scale;
  Equations::SparseMatrix G;
  State place = state;
  if (!assembled) disturb(equations, place, VectorXd::Ones(equations.nv()));
  equations.constraints(place, phi, scale, &G);
  if (has_full_rank(G)) return false;
  RankAnalysis rank = analyse_rank(MatrixXd(G));
  // Rows that repeat others but hold all the same are not what keeps a loop open.
  if (!assembled) {
    const double least = 1e-9 * phi.cwiseQuotient(scale).lpNorm<Eigen::Infinity>();
    std::erase_if(rank.involved, [&](Index row) { return std::abs(phi[row]) <= least * scale[row]; });
  }
  if (rank.involved.empty()) return false;
  const Index nlambda = equations.nlambda();
  summary.status = InitialiseStatus::redundant;
  summary.redundant = names_of(equations, rank.involved, equations.nv());
  summary.message = fmt::format(
      "{} of {} constraints say what others say already; they are among: {}. Free a "
      "motion in one of these, for example with a spherical or cylindrical joint",
      nlambda - rank.rank, nlambda, fmt::join(summary.redundant, "; "));
  return true;
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
  const VectorXd weight = mobilities(nv, options);

  assemble_positions(equations, trial, options, summary);
  // Conflicting constraints are redundant ones, and that is the better message.
  if (report_redundancy(equations, trial, summary.consistent(), summary) || !summary.consistent()) return summary;

  VectorXd velocity, gamma, phi, scale;
  Equations::SparseMatrix G;
  equations.constraints(trial, phi, scale, &G);
  equations.constraint_rates(trial, velocity, gamma);
  if (nlambda > 0) trial.v += smallest_increment(G, velocity, weight);

  equations.begin_step(trial, 0);
  VectorXd h;
  Equations::SparseMatrix S;
  if (std::string trouble = assemble_forces(equations, trial, 0, h, S); !trouble.empty()) {
    summary.status = InitialiseStatus::domain_error;
    summary.message = fmt::format("at the start, t = {:.6g} s: {}", trial.t, trouble);
    return summary;
  }
  equations.constraint_rates(trial, velocity, gamma);
  AccelerationSolution solution = solve_kkt(S, nv, h, gamma);
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

bool solve_accelerations(Equations& equations, State& state, double dt) {
  VectorXd h, velocity, gamma;
  Equations::SparseMatrix S;
  if (!assemble_forces(equations, state, dt, h, S).empty()) return false;
  equations.constraint_rates(state, velocity, gamma);
  AccelerationSolution solution = solve_kkt(S, equations.nv(), h, gamma);
  if (!solution.undetermined.empty()) return false;
  state.vdot = std::move(solution.vdot);
  state.lambda = std::move(solution.lambda);
  return true;
}

}  // namespace hersey::solver
