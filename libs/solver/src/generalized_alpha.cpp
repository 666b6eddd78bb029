#include "hersey/solver/generalized_alpha.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fast_motions.h"
#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/core/stopwatch.h"
#include "hersey/solver/sparse_lu.h"

namespace hersey::solver {
namespace {

using Eigen::VectorXd;
using Index = Equations::Index;

/// Round-off of a constraint: positions are sums of a few lengths of the mechanism's size.
constexpr double kConstraintRoundOff = 1e-13;

/// Share of the tolerance required of iterations with old factors. Residuals of full Newton iterations lie far below
/// the tolerance; residuals close to it in every step would accumulate in the multipliers.
constexpr double kWithOldFactors = 0.01;

/// A step that differs by more than this share from the one before is of another length; equal ones differ by
/// round-off.
constexpr double kOtherLength = 0.01;

/// An acceleration that changes by less than this share of itself in a step belongs to a motion that steps resolve.
constexpr double kLargestChange = 0.5;

/// Largest ratio of successive residuals for which old factors are kept.
constexpr double kFastEnough = 0.05;

/// A residual that is expected below this many times its tolerance is found without the tangent: it ends the step as a
/// rule.
constexpr double kLooksSolved = 10;

/// Share of the prediction's residual at which a step chosen by its error is solved: the error of the prediction is
/// three times the estimated error, so that a third of a percent of the latter remains.
constexpr double kOfPrediction = 1e-3;

/// A correction by Newton's method of a solution within its tolerance squares what is left of 1e-8: round-off.
constexpr int kLastCorrections = 1;

/// The largest residual left in this way, relative to the terms balanced.
constexpr double kLargestLeft = 1e-7;

/// True if one more step of Newton's method will solve the equations, since each leaves in proportion to the square of
/// the residual (theory manual, after integrator.20).
bool looks_solved(double last, double now) {
  const double nearer = now / last;
  return std::isfinite(last) && now * nearer * nearer < kLooksSolved;
}

}  // namespace

/// Algorithmic history, and everything a step needs, allocated once.
struct GeneralizedAlpha::Workspace {
  explicit Workspace(double spectral_radius) : parameters(spectral_radius) {}

  AlphaParameters parameters;
  bool started = false;
  double last_dt = 0;
  VectorXd a;         ///< algorithmic acceleration at the last accepted state
  VectorXd a_before;  ///< a step earlier; empty: the last step was the first, or of another length

  // One step
  State trial;
  Stage stage;
  VectorXd dq_before, lambda_before;  ///< values before an increment
  VectorXd a_n, dq, dq_predicted, v_predicted, vdot_predicted, increment, residual, scale, tolerance, rhs;
  Equations::SparseMatrix tangent;
  SparseLu lu;
  Index analysed = -1;
  bool is_tangent_current = false;  ///< `tangent` is that of the trial state, its motions not yet divided by m
  double linear_solve_time = 0;
  double worst_row = 0;   ///< largest residual of a row relative to its tolerance at the last assembly
  double condensed = 0;   ///< that of the condensed equations
  double enough = 0;      ///< residuals of rows with which the step is solved, relative to their tolerances
  Index worst_index = 0;  ///< the row of the larger of both; -1: a condensed equation
  VectorXd error;         ///< estimate of the step's local error of position
  SettledStart
      start;  ///< start of the step: the motion of the state, or what remains of it after fast motions have decayed
  VectorXd v_start;         ///< velocity the step starts from
  std::string why_outside;  ///< why the last assembly was outside the domain, empty if inside

  void choose_start(Equations& equations, const State& state, double dt);
  void predict(double dt);
  void begin_iteration(IterationStart at);
  void accept_acceleration();
  [[nodiscard]] bool is_of_other_length() const { return std::abs(stage.dt - last_dt) > kOtherLength * last_dt; }
  void set_trial(Equations& equations, const State& state, const VectorXd& at);
  bool assemble(Equations& equations, const GeneralizedAlphaOptions& options, bool with_tangent = true);
  void measure(Equations& equations, const GeneralizedAlphaOptions& options);
  [[nodiscard]] double worst() const { return std::max(worst_row, condensed); }
  [[nodiscard]] double worst_of_allowed() const { return std::max(worst_row / std::max(1.0, enough), condensed); }
  /// Theory manual eq. (integrator.18) and (integrator.19), their tolerances times `share`.
  [[nodiscard]] bool is_solved(double share) const {
    return worst_row <= std::max(share, enough) && condensed <= share;
  }
  bool factorise(Index nv);
  bool solve_increment(Index nv);
  bool enter_domain(Equations& equations, const State& state, const GeneralizedAlphaOptions& options);
  bool move(Equations& equations, const State& state, const GeneralizedAlphaOptions& options, bool with_tangent);
  void return_to_constraints(Equations& equations);
  void end_on_constraints(Equations& equations);
  VectorXd remove_violation(const VectorXd& violation, VectorXd& motion);
  void estimate_error();
  [[nodiscard]] std::string worst_name(const Equations& equations) const;
};

/// Theory manual eq. (integrator.6), and (integrator.9) where the step does not resolve how the motion starts.
void GeneralizedAlpha::Workspace::choose_start(Equations& equations, const State& state, double dt) {
  // Member by member, into what the last step took from the heap.
  start.offset.setZero(state.v.size());
  start.v = state.v;
  start.vdot = state.vdot;
  if (!stage.fresh) return;
  if (std::optional<SettledStart> settled = settle_fast_motions(equations, state, dt)) start = std::move(*settled);
  a = start.vdot;
  a_before.resize(0);
  last_dt = dt;
  equations.begin_step(state, dt);
}

/// The step with a_{n+1} = a_n, a_n carried over to the length of this step (integrator.7): dq, v and vdot that belong
/// together by (integrator.2) and (integrator.3), and how an increment moves them (integrator.5).
void GeneralizedAlpha::Workspace::predict(double dt) {
  const auto& [alpha_m, alpha_f, gamma, beta] = parameters;
  a_n = start.vdot + (dt / last_dt) * (a - start.vdot);
  v_start = start.v;
  dq_predicted = start.offset + dt * v_start + (0.5 * dt * dt) * a_n;
  v_predicted = v_start + dt * a_n;
  vdot_predicted = (a_n - alpha_f * start.vdot) / (1 - alpha_f);
  stage.dt = dt;
  stage.parameters = parameters;
  stage.k = 1;
  stage.c = gamma / (beta * dt);
  stage.m = (1 - alpha_m) / ((1 - alpha_f) * beta * dt * dt);
}

/// The iteration begins with the algorithmic acceleration going on as over the last step of this length: films, whose
/// gaps are differences of large motions, are then near their end. Accelerations that change by much of themselves in a
/// step are those of motions it does not resolve, and stay.
void GeneralizedAlpha::Workspace::begin_iteration(IterationStart at) {
  dq = dq_predicted;
  if (at == IterationStart::prediction || a_before.size() == 0 || is_of_other_length()) return;
  const double reach = parameters.beta * stage.dt * stage.dt;
  for (Index i = 0; i < dq.size(); ++i)
    if (const double change = a[i] - a_before[i]; std::abs(change) < kLargestChange * std::abs(a[i]))
      dq[i] += reach * change;
}

/// Accepts the algorithmic acceleration of a step.
void GeneralizedAlpha::Workspace::accept_acceleration() {
  if (is_of_other_length())
    a_before.resize(0);
  else
    a_before = a;
  a = a_n + (dq - dq_predicted) / (parameters.beta * stage.dt * stage.dt);
}

/// Sets the trial state with the increment of position `at`.
void GeneralizedAlpha::Workspace::set_trial(Equations& equations, const State& state, const VectorXd& at) {
  stage.dq = at;
  equations.retract(state.q, at, trial.q);
  trial.v = v_predicted + stage.c * (at - dq_predicted);
  trial.vdot = vdot_predicted + stage.m * (at - dq_predicted);
}

/// Assembles at the trial state; returns false and sets `why_outside` outside the domain of the equations.
bool GeneralizedAlpha::Workspace::assemble(Equations& equations, const GeneralizedAlphaOptions& options,
                                           bool with_tangent) {
  equations.assemble(trial, stage, residual, scale, with_tangent ? &tangent : nullptr);
  is_tangent_current = with_tangent;
  why_outside = equations.domain_error();
  if (why_outside.empty() && !residual.allFinite()) why_outside = "the residual is not a number";
  if (!why_outside.empty()) return false;
  measure(equations, options);
  return true;
}

/// Residuals relative to their tolerances. Motions: rtol of the terms balanced (integrator.18). Constraints: a
/// violation acts on the multipliers like an acceleration of violation/(beta dt^2), so it is measured against beta dt^2
/// vdot.
void GeneralizedAlpha::Workspace::measure(Equations& equations, const GeneralizedAlphaOptions& options) {
  const double rtol = options.rtol;
  const Index nv = equations.nv(), n = nv + equations.nlambda();
  tolerance = rtol * scale;
  const double reach = parameters.beta * stage.dt * stage.dt;
  VectorXd& along = rhs;  // |G| |vdot|
  along.setZero(n);
  for (Index column = 0; column < nv; ++column)
    for (Equations::SparseMatrix::InnerIterator entry(tangent, column); entry; ++entry)
      if (entry.row() >= nv) along[entry.row()] += std::abs(entry.value() * trial.vdot[column]);
  for (Index i = nv; i < n; ++i)
    tolerance[i] = std::clamp(rtol * reach * along[i], kConstraintRoundOff * scale[i],
                              std::max(rtol, kConstraintRoundOff) * scale[i]);
  worst_row = 0;
  worst_index = 0;
  for (Index i = 0; i < n; ++i) {
    if (residual[i] == 0) continue;
    const double ratio = std::abs(residual[i]) / tolerance[i];
    if (ratio <= worst_row) continue;
    worst_row = ratio;
    worst_index = i;
  }
  condensed = equations.internal_residual() / std::max(rtol, options.condensed_rtol);
  if (condensed > worst_row) worst_index = -1;
}

/// Factorises the tangent, with motions divided by m and multipliers by m: then no entry grows as dt shrinks (Bottasso,
/// Bauchau and Cardona 2007). False if it is singular.
bool GeneralizedAlpha::Workspace::factorise(Index nv) {
  const Stopwatch watch(linear_solve_time);
  const double m = stage.m;
  for (Index column = 0; column < nv; ++column)
    for (Equations::SparseMatrix::InnerIterator entry(tangent, column); entry; ++entry)
      if (entry.row() < nv) entry.valueRef() /= m;
  is_tangent_current = false;
  if (analysed != tangent.nonZeros()) {
    lu.analyse(tangent);
    analysed = tangent.nonZeros();
  }
  return lu.factorise({tangent.valuePtr(), static_cast<std::size_t>(tangent.nonZeros())});
}

/// Computes the Newton increment with the existing factors; returns false if it is not finite.
bool GeneralizedAlpha::Workspace::solve_increment(Index nv) {
  const Stopwatch watch(linear_solve_time);
  const Index n = residual.size();
  increment = -residual;
  increment.head(nv) /= stage.m;
  lu.solve({increment.data(), static_cast<std::size_t>(n)});
  increment.tail(n - nv) *= stage.m;
  return increment.allFinite();
}

/// Assembles where the iteration begins; the step is shortened until the equations accept it.
bool GeneralizedAlpha::Workspace::enter_domain(Equations& equations, const State& state,
                                               const GeneralizedAlphaOptions& options) {
  trial.t = state.t + stage.dt;
  trial.lambda = state.lambda;
  for (int halvings = 0;; ++halvings) {
    set_trial(equations, state, dq);
    if (assemble(equations, options)) return true;
    if (halvings >= options.max_halvings) return false;
    dq *= halvings + 1 < options.max_halvings ? 0.5 : 0.0;
  }
}

/// Moves by the increment, halved until the equations accept it.
bool GeneralizedAlpha::Workspace::move(Equations& equations, const State& state, const GeneralizedAlphaOptions& options,
                                       bool with_tangent) {
  const Index nv = equations.nv();
  dq_before = dq;
  lambda_before = trial.lambda;
  double length = 1;
  for (int halvings = 0; halvings <= options.max_halvings; ++halvings, length *= 0.5) {
    dq = dq_before + length * increment.head(nv);
    trial.lambda = lambda_before + length * increment.tail(increment.size() - nv);
    set_trial(equations, state, dq);
    if (assemble(equations, options, with_tangent)) return true;
  }
  return false;
}

/// Removes the violation of the constraints from a motion by constraint forces alone, J [x; y] = [0; -violation].
/// @return these forces
VectorXd GeneralizedAlpha::Workspace::remove_violation(const VectorXd& violation, VectorXd& motion) {
  const Index nv = motion.size();
  rhs.setZero(tangent.rows());
  rhs.tail(violation.size()) = -violation;
  lu.solve({rhs.data(), static_cast<std::size_t>(rhs.size())});
  motion += rhs.head(nv);
  return rhs.tail(violation.size());
}

/// Projects velocities and accelerations onto the constraints (integrator.16).
void GeneralizedAlpha::Workspace::return_to_constraints(Equations& equations) {
  VectorXd velocity, bias, phi, lengths;
  Equations::SparseMatrix G;
  equations.constraint_rates(trial, velocity, bias);
  equations.constraints(trial, phi, lengths, &G);
  remove_violation(velocity, trial.v);
  trial.lambda += remove_violation(G * trial.vdot + bias, trial.vdot);
  remove_violation(G * a + bias, a);
}

/// Projects the end of a step chosen by its error onto the constraints, (integrator.13): the modes of the constraints,
/// (integrator.12), end with the step, so that its error does not depend on previous lengths. The algorithmic
/// acceleration goes on from the state's as it would without constraints: what the next step does across them is of its
/// own length's third power.
void GeneralizedAlpha::Workspace::end_on_constraints(Equations& equations) {
  VectorXd velocity, bias, phi, lengths;
  Equations::SparseMatrix G;
  equations.constraint_rates(trial, velocity, bias);
  equations.constraints(trial, phi, lengths, &G);
  remove_violation(velocity, trial.v);
  trial.lambda += remove_violation(G * trial.vdot + bias, trial.vdot);
  const double ahead = 0.5 - parameters.gamma;  // the instant that `a` belongs to, in steps
  remove_violation(G * (a - trial.vdot - ahead * (trial.vdot - start.vdot)), a);
}

/// The step's local error of position, theory manual eq. (integrator.11): what the third derivative contributes beyond
/// the method's own use of it.
void GeneralizedAlpha::Workspace::estimate_error() {
  const auto& [alpha_m, alpha_f, gamma, beta] = parameters;
  const double share = 0.5 * gamma - beta - 1.0 / 12;
  error = (share / beta) * (dq - dq_predicted);
}

std::string GeneralizedAlpha::Workspace::worst_name(const Equations& equations) const {
  return worst_index < 0 ? equations.name_of_internal_residual() : equations.name_of_row(worst_index);
}

GeneralizedAlpha::GeneralizedAlpha(const GeneralizedAlphaOptions& options) : options_(options) {
  HERSEY_REQUIRE(0 <= options.spectral_radius && options.spectral_radius <= 1, "a spectral radius lies in 0..1");
  HERSEY_REQUIRE(options.rtol > 0 && options.max_iterations > 0 && options.max_halvings >= 0, "options are positive");
  work_ = std::make_unique<Workspace>(options.spectral_radius);
}

GeneralizedAlpha::~GeneralizedAlpha() = default;
GeneralizedAlpha::GeneralizedAlpha(GeneralizedAlpha&&) noexcept = default;
GeneralizedAlpha& GeneralizedAlpha::operator=(GeneralizedAlpha&&) noexcept = default;

void GeneralizedAlpha::reset() { work_->started = false; }

double GeneralizedAlpha::linear_solve_time() const { return work_->linear_solve_time; }

StepSummary GeneralizedAlpha::step(Equations& equations, State& state, double dt) {
  return step(equations, state, dt, {});
}

StepSummary GeneralizedAlpha::step(Equations& equations, State& state, double dt, const StepCheck& is_accurate) {
  HERSEY_REQUIRE(dt > 0, "time runs forward");
  const bool is_chosen = is_accurate && options_.chosen_by_error;
  if (options_.spectral_radius == 1 && equations.nlambda() > 0 && !is_chosen)
    throw InputError({.position = {},
                      .path = "spectral_radius",
                      .found = "1 in a mechanism with drives or closed loops",
                      .expected = "a value below 1",
                      .suggestion = "0.95 dissipates little; at 1 the multipliers of equal steps grow without bound"});
  Workspace& w = *work_;
  if (!w.started) {
    w.started = true;
    w.stage.fresh = true;
  }
  const bool may_go_on = equations.has_condensed_unknowns() && !equations.needs_tangent();
  StepSummary first = attempt(equations, state, dt, is_accurate,
                              may_go_on && !is_chosen ? IterationStart::beyond : IterationStart::prediction);
  if (first.solved() || first.status == StepStatus::inaccurate || !may_go_on || w.stage.fresh) return first;
  // Condensed unknowns, too, begin a step that is begun again where the last one ended.
  StepSummary again = attempt(equations, state, dt, is_accurate, IterationStart::prediction);
  again.iterations += first.iterations;
  return again;
}

StepSummary GeneralizedAlpha::attempt(Equations& equations, State& state, double dt, const StepCheck& is_accurate,
                                      IterationStart begins) {
  Workspace& w = *work_;
  StepSummary summary;
  const bool is_chosen = is_accurate && options_.chosen_by_error;
  equations.begin_step(state, dt);
  w.choose_start(equations, state, dt);
  w.predict(dt);
  w.begin_iteration(begins);

  const auto fail = [&](StepStatus status, const std::string& why) {
    summary.status = status;
    summary.residual = w.worst_of_allowed();
    summary.worst_row = w.worst_name(equations);
    summary.message = fmt::format("t = {:.9g} s, step {:.3g} s: {}", state.t, dt, why);
    return summary;
  };
  if (!w.enter_domain(equations, state, options_)) return fail(StepStatus::domain_error, w.why_outside);
  // Factors serve as long as they bring the residual down fast (theory manual, integrator.20). Condensed unknowns move
  // with each tangent and need their own.
  const bool may_keep_factors = !equations.has_condensed_unknowns();
  const bool needs_tangent = equations.needs_tangent();
  w.enough = is_chosen ? std::min(kOfPrediction * w.worst_row, kLargestLeft / options_.rtol) : 0;
  bool keeps_factors = false;
  int corrections = has_last_corrections_ ? kLastCorrections : 0;
  double last = std::numeric_limits<double>::infinity();  // the residual one iteration ago
  for (;;) {
    const bool may_go_on = summary.iterations < options_.max_iterations;
    const bool is_solved = w.is_solved(keeps_factors && may_go_on ? kWithOldFactors : 1);
    const bool is_corrected = is_solved && may_go_on && corrections > 0;
    if (is_corrected) {
      --corrections;
      keeps_factors = false;
    } else if (is_solved) {
      if (equations.is_step_consistent()) break;
      if (!w.assemble(equations, options_)) return fail(StepStatus::domain_error, w.why_outside);
      keeps_factors = false;
      continue;
    }
    if (!may_go_on)
      return fail(StepStatus::no_convergence,
                  fmt::format("no convergence in {} iterations; worst equation: {}, {:.3g} times its tolerance",
                              summary.iterations, w.worst_name(equations), w.worst()));
    ++summary.iterations;
    if (!keeps_factors && !w.is_tangent_current && !w.assemble(equations, options_))
      return fail(StepStatus::domain_error, w.why_outside);
    const double before = w.worst();
    if (!(keeps_factors || w.factorise(equations.nv())) || !w.solve_increment(equations.nv()))
      return fail(StepStatus::singular, "the equations are singular here; worst equation: " + w.worst_name(equations));
    const bool with_tangent = !may_keep_factors && (needs_tangent || is_corrected || !looks_solved(last, before));
    last = before;
    if (!w.move(equations, state, options_, with_tangent)) return fail(StepStatus::domain_error, w.why_outside);
    keeps_factors = may_keep_factors && w.worst() < kFastEnough * before;
  }

  const bool has_factors_of_constraints = summary.iterations > 0 && equations.nlambda() > 0;
  if (is_accurate) {
    w.estimate_error();
    if (!is_accurate(w.trial, w.error)) return fail(StepStatus::inaccurate, "its error exceeds the tolerance");
  }
  w.accept_acceleration();
  if (is_chosen && has_factors_of_constraints)
    w.end_on_constraints(equations);
  else if (options_.returns_to_constraints && has_factors_of_constraints &&
           std::abs(dt - w.last_dt) > kOtherLength * w.last_dt)
    w.return_to_constraints(equations);
  w.last_dt = dt;
  w.stage.fresh = false;
  state = w.trial;
  equations.accept_step(state);
  summary.status = StepStatus::converged;
  summary.residual = w.worst_of_allowed();
  return summary;
}

void GeneralizedAlpha::persist(Archive& archive) {
  Workspace& w = *work_;
  archive.io("started", w.started);
  archive.io("fresh", w.stage.fresh);
  archive.io("last_dt", w.last_dt);
  archive.io("a", w.a);
  archive.io("a_before", w.a_before);
  archive.io("analysed", w.analysed);
  const Archive::Group group(archive, "lu");
  w.lu.persist(archive);
}

}  // namespace hersey::solver
