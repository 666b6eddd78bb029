#include "hersey/solver/initialise.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "assemble_positions.h"
#include "hersey/core/contract.h"
#include "kkt.h"
#include "massless.h"

namespace hersey::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Equations::Index;

/// Mobility of fixed components relative to free ones if the constraints cannot be satisfied otherwise. It is small
/// enough that the free ones do as much as they can, and large enough that the remaining violation is solved below the
/// tolerance of the constraints.
constexpr double kReluctance = 1e-3;

/// Sets the mobility of `components`.
void weigh(const std::vector<Index>& components, double mobility, VectorXd& weight) {
  for (const Index k : components) {
    HERSEY_REQUIRE(0 <= k && k < weight.size(), "a fixed component exists");
    weight[k] = mobility;
  }
}

std::vector<std::string> names_of(const Equations& equations, const std::vector<Index>& rows, Index offset) {
  std::vector<std::string> names;
  for (Index row : rows) {
    std::string name = equations.name_of_row(offset + row);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  }
  return names;
}

/// Residuals of equal name together, the widest open first. @pre there are constraints
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
  const double least = 1e-3 * open.front().size;
  std::erase_if(open, [&](const OpenConstraint& one) { return one.size < least; });
  return open;
}

/// Closes the constraints: with fixed components unchanged if possible, otherwise from the closest configuration found
/// by the least change of fixed components, and at last with all components free. Stiff components move only if nothing
/// else closes the constraints. If the iteration ends early, it is repeated from a disturbed guess.
class Assembly {
 public:
  Assembly(Equations& equations, State& state, const InitialiseOptions& options, InitialiseSummary& summary)
      : equations_(equations), state_(state), options_(options), summary_(summary), guess_(state), closest_(state) {}

  void run() {
    if (close_with_fixed_at_rest()) return;
    summary_.conflict = open_constraints(equations_, closest_);
    const bool closed = attempt(closest_, mobility(kReluctance, 0)) || attempt(guess_, mobility(1, 0)) ||
                        attempt(disturbed(mobility(1, 0)), mobility(1, 0)) ||
                        (!options_.stiff.empty() && attempt(guess_, mobility(kReluctance, 1)));
    if (!closed) fail();
  }

 private:
  [[nodiscard]] VectorXd mobility(double mobility_of_fixed, double mobility_of_stiff) const {
    VectorXd weight = VectorXd::Ones(equations_.nv());
    weigh(options_.fixed, mobility_of_fixed, weight);
    weigh(options_.stiff, mobility_of_stiff, weight);
    return weight;
  }

  [[nodiscard]] State disturbed(const VectorXd& mobility) const {
    State aside = guess_;
    disturb(equations_, aside, mobility);
    return aside;
  }

  bool close_with_fixed_at_rest() {
    const VectorXd at_rest = mobility(0, 0);
    return attempt(guess_, at_rest) || attempt(disturbed(at_rest), at_rest);
  }

  /// Iterates from `from`; the state is that at the end of the iteration.
  bool attempt(const State& from, const VectorXd& mobility) {
    state_ = from;
    const ClosureResult result = close_constraints(equations_, state_, mobility, options_);
    summary_.iterations += result.iterations;
    if (result.residual < summary_.residual) {
      summary_.residual = result.residual;
      closest_ = state_;
    }
    return result.closed;
  }

  void fail() {
    state_ = closest_;
    summary_.status = InitialiseStatus::cannot_assemble;
    summary_.open = open_constraints(equations_, state_);
    std::vector<std::string> gaps;
    gaps.reserve(summary_.open.size());
    for (const OpenConstraint& open : summary_.open) gaps.push_back(fmt::format("{} by {:.4g}", open.name, open.size));
    summary_.message = fmt::format(
        "the mechanism cannot be assembled; where it comes closest these are open: {}; check the geometry, the initial "
        "values and the drives they belong to",
        fmt::join(gaps, "; "));
  }

  Equations& equations_;
  State& state_;
  const InitialiseOptions& options_;
  InitialiseSummary& summary_;
  State guess_, closest_;
};

/// Projects velocities onto the constraints with the smallest change of the free ones, in units of position_scales();
/// fixed ones change only if this is not sufficient.
void project_velocities(Equations& equations, State& state, const InitialiseOptions& options) {
  if (equations.nlambda() == 0) return;
  VectorXd weight = VectorXd::Ones(equations.nv());
  weigh(options.fixed_rates, 1e-7, weight);
  weigh(options.stiff, 1e-10, weight);
  weight = weight.cwiseProduct(equations.position_scales());
  VectorXd velocity, gamma, phi, row_scale;
  Equations::SparseMatrix G;
  equations.constraints(state, phi, row_scale, &G);
  // Weights so far apart cost digits, which the second pass returns.
  for (int pass = 0; pass < 2; ++pass) {
    equations.constraint_rates(state, velocity, gamma);
    state.v += smallest_increment(G, velocity, weight);
  }
}

/// Reports redundant constraints in the assembled state or, if there is none, away from singular positions: at the
/// closest configuration of a loop that cannot be closed, rows always depend on each other.
bool report_redundancy(Equations& equations, const State& state, bool assembled, InitialiseSummary& summary) {
  VectorXd phi, scale;
  Equations::SparseMatrix G;
  State examined = state;
  if (!assembled) disturb(equations, examined, VectorXd::Ones(equations.nv()));
  equations.constraints(examined, phi, scale, &G);
  if (has_full_rank(G)) return false;
  RankAnalysis rank = analyse_rank(MatrixXd(G));
  // Redundant rows that are satisfied are not the cause of an open loop.
  if (!assembled) {
    equations.constraints(state, phi, scale, nullptr);
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

void outside_domain(const State& state, const std::string& why, InitialiseSummary& summary) {
  summary.status = InitialiseStatus::domain_error;
  summary.message = fmt::format("at the start, t = {:.6g} s: {}", state.t, why);
}

/// Accelerations and multipliers of `trial`, and the velocities of motions that have no inertia if these are balanced;
/// false, with the reason, where they are not determined.
bool find_accelerations(Equations& equations, State& trial, bool balances_massless, InitialiseSummary& summary) {
  const Index nv = equations.nv();
  VectorXd h, velocity, gamma;
  Equations::SparseMatrix S;
  const auto assembled = [&] {
    equations.begin_step(trial, 0);
    const Outcome forces = assemble_forces(equations, trial, 0, h, S);
    if (!forces.solved()) outside_domain(trial, forces.message, summary);
    equations.constraint_rates(trial, velocity, gamma);
    return forces.solved();
  };
  if (!assembled()) return false;
  AccelerationSolution solution = solve_kkt(S, nv, h, gamma);
  if (!solution.undetermined.empty() && !balances_massless) solution = solve_kkt_but_massless(S, nv, h, gamma);
  if (!solution.undetermined.empty()) {
    const MasslessSummary balance = balance_massless(equations, trial, massless_motions(S, nv));
    if (!balance.undetermined.empty()) {
      summary.status = InitialiseStatus::undetermined;
      summary.undetermined = names_of(equations, balance.undetermined, 0);
      summary.message = fmt::format(
          "nothing determines the motion of: {}. Give the bodies there mass and inertia, "
          "or hold the motion by a joint, a drive, a damper or a film",
          fmt::join(summary.undetermined, "; "));
    } else if (!balance.solved()) {
      outside_domain(trial, balance.message, summary);
    }
    if (!balance.solved() || !assembled()) return false;
    solution = solve_kkt_but_massless(S, nv, h, gamma);
  }
  trial.vdot = std::move(solution.vdot);
  trial.lambda = std::move(solution.lambda);
  return true;
}

}  // namespace

InitialiseSummary assemble_positions(Equations& equations, State& state, const InitialiseOptions& options) {
  InitialiseSummary summary;
  summary.status = InitialiseStatus::consistent;
  summary.residual = std::numeric_limits<double>::infinity();
  Assembly(equations, state, options, summary).run();
  return summary;
}

InitialiseSummary initialise(Equations& equations, State& state, const InitialiseOptions& options) {
  const Index nv = equations.nv(), nlambda = equations.nlambda();
  HERSEY_REQUIRE(state.q.size() == equations.nq() && state.v.size() == nv, "the state belongs to the equations");
  InitialiseSummary summary;
  summary.status = InitialiseStatus::consistent;
  State trial = state;
  trial.vdot.setZero(nv);
  trial.lambda.setZero(nlambda);
  summary.residual = std::numeric_limits<double>::infinity();
  Assembly(equations, trial, options, summary).run();
  // Conflicting constraints are redundant ones, and that is the better message.
  if (report_redundancy(equations, trial, summary.solved(), summary) || !summary.solved()) return summary;

  project_velocities(equations, trial, options);

  if (!find_accelerations(equations, trial, options.balances_massless, summary)) return summary;
  state = std::move(trial);
  equations.accept_step(state);
  return summary;
}

namespace {

/// Projects the velocities onto the constraints by constraint impulses alone (integrator.15).
bool shed_violations(Equations& equations, State& state, double dt) {
  if (equations.nlambda() == 0) return true;
  VectorXd h, velocity, gamma;
  Equations::SparseMatrix S;
  if (!assemble_forces(equations, state, dt, h, S).solved()) return false;
  equations.constraint_rates(state, velocity, gamma);
  const AccelerationSolution change = solve_kkt(S, equations.nv(), VectorXd::Zero(equations.nv()), velocity);
  if (!change.undetermined.empty() || !change.vdot.allFinite()) return false;
  state.v += change.vdot;
  return true;
}

}  // namespace

bool restart(Equations& equations, State& state, double dt) {
  State trial = state;
  if (!shed_violations(equations, trial, dt) || !solve_accelerations(equations, trial, dt)) return false;
  state = std::move(trial);
  return true;
}

bool solve_accelerations(Equations& equations, State& state, double dt) {
  VectorXd h, velocity, gamma;
  Equations::SparseMatrix S;
  if (!assemble_forces(equations, state, dt, h, S).solved()) return false;
  equations.constraint_rates(state, velocity, gamma);
  AccelerationSolution solution = solve_kkt(S, equations.nv(), h, gamma);
  // Motions without inertia stay in balance.
  if (!solution.undetermined.empty()) solution = solve_kkt_but_massless(S, equations.nv(), h, gamma);
  state.vdot = std::move(solution.vdot);
  state.lambda = std::move(solution.lambda);
  return true;
}

}  // namespace hersey::solver
