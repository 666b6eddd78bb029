#include "time_stepping/time_stepper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hersey/solver/dormand_prince.h"
#include "hersey/solver/generalized_alpha.h"
#include "hersey/solver/initialise.h"
#include "hersey/solver/kinematics.h"
#include "time_stepping/instants.h"

namespace hersey::run {
namespace {

constexpr double kMeaningless = 0.02;  // rad, or sizes of the machine, that one step may be off
constexpr double kOneInstant = 1e-6;   // of the fixed step: instants that others reckon up
constexpr double kOfTolerance = 0.1;   // share of a step's error that the films' residual may contribute
constexpr double kLargestCondensed = 1e-6;
constexpr double kOfHalvedStep = 8;     // ratio of the error to its tolerance at which a step is halved
constexpr double kCreeping = 1.0 / 16;  // of the fixed step: an impact asks for shorter ones, not a motion throughout
constexpr double kShortest = 1.0 / 64;  // share of the fixed step below which steps are accepted whatever their error

// The estimate of the explicit method's error is of its order. Its steps are long: changes of the error over more than
// one step ahead say nothing. They have no modes of the constraints that growth could excite; at a growth of 1.5 the
// start takes twice as many steps, at 5 a third of all steps is rejected.
constexpr const char* kAdviceToExplicit =
    "; where constraints depend on each other at an instant, as where all bars of a linkage lie in line, "
    "`integrator: generalized_alpha` goes on, or a larger tolerance may";
constexpr double kOrderOfDormandPrince = 8;
constexpr double kReachOfDormandPrince = 1;
constexpr double kGrowthOfDormandPrince = 2;

solver::GeneralizedAlphaOptions options_of_generalized_alpha(const model::Model& model) {
  solver::GeneralizedAlphaOptions options;
  options.spectral_radius = model.simulation.spectral_radius;
  options.rtol = model.simulation.tolerance;
  options.max_iterations = model.simulation.max_iterations;
  options.chosen_by_error = model.simulation.error_control.has_value();
  if (const auto& control = model.simulation.error_control)
    options.condensed_rtol = std::min(kOfTolerance * control->tolerance, kLargestCondensed);
  options.returns_to_constraints = !model.bearings.empty();
  for (const model::Bearing& bearing : model.bearings) {
    if (bearing.coupling.scheme == model::CouplingScheme::partitioned) {
      options.max_iterations = std::max(options.max_iterations, bearing.coupling.max_iterations);
    }
  }
  return options;
}

std::unique_ptr<solver::Integrator> integrator_of(const model::Model& model) {
  if (model.simulation.integrator == model::Integrator::dormand_prince)
    return std::make_unique<solver::DormandPrince>();
  return std::make_unique<solver::GeneralizedAlpha>(options_of_generalized_alpha(model));
}

}  // namespace

TimeStepper::TimeStepper(const model::Model& model, model::Machine& machine)
    : model_(model),
      machine_(machine),
      integrator_(integrator_of(model)),
      step_error_(model, machine),
      energy_(model, machine),
      has_smooth_motion_(model.bearings.empty() && machine.mechanism->elastic_coordinates().empty()) {}

void TimeStepper::plan(const solver::State& state, const mbd::Observation& start) {
  energy_.begin(state);
  const auto& limits = model_.simulation.error_control;
  if (!limits || model_.simulation.analysis == model::Analysis::kinematics) {
    const model::Simulation& run = model_.simulation;
    targets_ = TargetInstants::equal(run.start, run.duration, run.step);
    if (run.analysis != model::Analysis::kinematics) bends_ = jumps(model_);
    return;
  }
  bends_ = kinks(model_, machine_.mechanism->spec(), start);
  targets_ = TargetInstants(instants_to_hit(model_, bends_));
  solver::StepControlOptions options{.smallest = limits->smallest, .largest = limits->largest, .unit = unit_of_steps()};
  if (model_.simulation.integrator == model::Integrator::dormand_prince) {
    options.order = kOrderOfDormandPrince;
    options.reach = kReachOfDormandPrince;
    options.largest_growth = kGrowthOfDormandPrince;
  }
  control_.emplace(options, first_step(*machine_.mechanism, state, *limits));
}

// Bodies with a displacement of every node factorise a matrix for every step size: few of them then, parts of the
// interval between the instants to hit.
double TimeStepper::unit_of_steps() const {
  const auto is_nodal = [](const model::Body& body) { return body.flexible && body.flexible->nodal; };
  if (std::none_of(model_.bodies.begin(), model_.bodies.end(), is_nodal)) return 0;
  return targets_.front() - model_.simulation.start;
}

double TimeStepper::slack() const { return kOneInstant * model_.simulation.step; }

// The next target; or, where the limit comes first, that. Fixed steps on the way to or from an instant between the
// targets are equal: a machine that others step by intervals of their own has steps of one length.
double TimeStepper::next_stop(const solver::State& state, double limit) {
  const double target = targets_[reached_];
  const bool passes_limit = limit < target - slack();
  if (control_ || (!passes_limit && !off_plan_) || std::isinf(limit)) return passes_limit ? limit : target;
  const double end = std::min(limit, targets_[targets_.size() - 1]);
  const double count = std::max(1.0, std::ceil((end - state.t) / model_.simulation.step - kOneInstant));
  return count > 1 ? state.t + (end - state.t) / count : end;
}

// The first instant after t at which fixed steps start afresh before the next target; infinite where there is none.
// Steps whose error is controlled have these instants among their targets.
double TimeStepper::bend_before(double target, double t) const {
  const auto next = std::upper_bound(bends_.begin(), bends_.end(), t + slack());
  const bool is_before = !control_ && next != bends_.end() && *next < target - slack();
  return is_before ? *next : std::numeric_limits<double>::infinity();
}

bool TimeStepper::is_bend(double t) const {
  const double off = control_ ? 0 : slack();
  const auto next = std::lower_bound(bends_.begin(), bends_.end(), t - off);
  return next != bends_.end() && *next <= t + off;
}

void TimeStepper::pass_targets(double t) {
  off_plan_ = true;
  for (; !is_at_end() && targets_[reached_] <= t + slack(); ++reached_) off_plan_ = targets_[reached_] < t - slack();
}

void TimeStepper::take_jump(solver::State& state, bool moves) {
  if (moves)
    restart(state);
  else
    start_afresh(state);
  energy_.begin(state);
  trial_ = std::numeric_limits<double>::infinity();
}

TimeStep TimeStepper::take(solver::State& state, double limit) {
  const model::Simulation& plan = model_.simulation;
  const double planned = targets_[reached_];
  const double target = next_stop(state, std::min(limit, bend_before(planned, state.t)));
  if (at_bend_) start_afresh(state);
  at_bend_ = false;
  TimeStep step = plan.analysis == model::Analysis::kinematics ? follow_drives(state, target)
                  : control_                                   ? take_controlled(state, target)
                                                               : take_fixed(state, target);
  if (!step.solved()) return step;
  energy_.accept();
  last_dt_ = step.dt;
  const double scale = control_ ? std::max(std::abs(target), plan.error_control->largest) : plan.step;
  if (target - state.t > 1e-12 * scale) return step;
  if (target == planned) {
    ++reached_;
    off_plan_ = false;
  } else {
    pass_targets(state.t);
  }
  trial_ = std::numeric_limits<double>::infinity();
  at_bend_ = is_bend(target);
  return step;
}

// Beyond a kink of a drive's speed its acceleration is another one: the method's history would ring on it.
void TimeStepper::start_afresh(solver::State& state) {
  if (solver::solve_accelerations(*machine_.mechanism, state, last_dt_)) integrator_->reset();
  energy_.begin(state);
}

// Steps much shorter than the last one would have to remove at once the velocities that it left across the constraints,
// which is harder the shorter they are. They begin from velocities that the constraints allow.
void TimeStepper::restart(solver::State& state) {
  if (!solver::restart(*machine_.mechanism, state, last_dt_)) return;
  integrator_->reset();
  energy_.begin(state);
}

// Nothing is integrated: Newton's method begins at the extrapolation of the last step.
TimeStep TimeStepper::follow_drives(solver::State& state, double target) {
  TimeStep step;
  step.dt = target - state.t;
  const Eigen::VectorXd guess = step.dt * state.v + 0.5 * step.dt * step.dt * state.vdot;
  solver::State next = state;
  machine_.mechanism->retract(state.q, guess, next.q);
  next.t = target;
  const solver::KinematicsSummary solved = solver::solve_kinematics(*machine_.mechanism, next);
  step.solution.iterations = solved.iterations;
  if (!solved.solved()) {
    step.fail(solved.message);
    return step;
  }
  energy_.follow(next);
  state = next;
  step.set_solved(true);
  return step;
}

// No step is short enough where longer ones before it have left velocities that no motion of the machine has.
std::string TimeStepper::advice(const solver::StepSummary& solution) const {
  if (solution.status == solver::StepStatus::domain_error) return {};
  const model::Simulation& plan = model_.simulation;
  std::string text = fmt::format(
      "; steps of {:.3g} s have led here: if they are too long for the motion, give a shorter `simulation.step`, or "
      "`step: {{tolerance: 1e-4}}`, which chooses them",
      plan.step);
  if (plan.spectral_radius > 0.8)
    text += fmt::format(", or a `spectral_radius` of 0.8 in place of {:.3g}, which damps their errors",
                        plan.spectral_radius);
  return text;
}

// A step whose own error estimate shows that its end is meaningless is not accepted, although Newton's method
// converged: such steps lead a machine onto motions that it never leaves.
TimeStep TimeStepper::take_fixed(solver::State& state, double target) {
  TimeStep step;
  int failures = 0;
  for (;;) {
    step.dt = std::min(trial_, target - state.t);
    const bool may_be_cut = has_smooth_motion_ && step.dt > kShortest * model_.simulation.step;
    const auto check = [&](const solver::State& end, const Eigen::VectorXd& estimate) {
      // Films or stiffness end some motions within a step, and the estimate extrapolates motions that no longer exist.
      const Eigen::VectorXd way = 0.5 * step.dt * (state.v.cwiseAbs() + end.v.cwiseAbs());
      bounded_ = estimate.cwiseMin(way).cwiseMax(-way);
      (void)step_error_.measure(end, bounded_);
      return (!may_be_cut || step_error_.of_coordinates() <= kMeaningless) && energy_.allows(end);
    };
    energy_.begin_trial();
    step.solution = integrator_->step(*machine_.mechanism, state, step.dt, check);
    if (step.solution.solved()) {
      step.local_error = step_error_.largest();
      if (creeping_ == 0) energy_.count_loss_anew();
      creeping_ = step.dt < kCreeping * model_.simulation.step ? creeping_ + step.dt : 0;
      trial_ = 2 * step.dt;
      step.set_solved(true);
      return step;
    }
    ++rejected_;
    trial_ = step.dt / 2;
    const int enough = step.solution.status == solver::StepStatus::inaccurate ? 1 : 2;
    if (++failures == enough && has_smooth_motion_) restart(state);
    if (const std::string why = end_of_cutting(step); !why.empty()) {
      step.fail(fmt::format("t = {:.6g} s: {}{}", state.t, why, advice(step.solution)));
      return step;
    }
  }
}

// Why a fixed step that has failed is not cut once more; empty where it is.
std::string TimeStepper::end_of_cutting(const TimeStep& step) const {
  const double planned = model_.simulation.step;
  const bool creeps = creeping_ > planned + slack();
  if (creeps && energy_.has_lost_much())
    return fmt::format("steps of {:.2g} s have been needed for longer than one of {:.3g} s, and yet {}", step.dt,
                       planned, energy_.reason_of_loss());
  if (creeps && energy_.has_refused() && trial_ < kCreeping * planned)
    return fmt::format("steps of {:.2g} s have been needed for longer than one of {:.3g} s, and yet {}", step.dt,
                       planned, energy_.reason());
  if (trial_ >= model_.simulation.smallest_step) return {};
  if (energy_.has_refused()) return energy_.reason();
  return fmt::format("no convergence with a step of {:.2g} s: {}", step.dt, step.solution.message);
}

TimeStep TimeStepper::take_controlled(solver::State& state, double target) {
  TimeStep step;
  Eigen::VectorXd errors;
  const auto check = [&](const solver::State& end, const Eigen::VectorXd& estimate) {
    errors = step_error_.measure(end, estimate) / model_.simulation.error_control->tolerance;
    step.error = step_error_.largest() / model_.simulation.error_control->tolerance;
    if (step.error > 1 || energy_.allows(end)) return step.error <= 1;
    step.error = kOfHalvedStep;
    return false;
  };
  for (;;) {
    const double remaining = target - state.t;
    step.dt = control_->proposed(remaining);
    energy_.begin_trial();
    step.solution = integrator_->step(*machine_.mechanism, state, step.dt, check);
    if (step.solution.solved()) {
      if (step.dt == remaining) state.t = target;  // exactly, not as a sum of steps
      step.local_error = step_error_.largest();
      control_->accepted(step.dt, errors);
      step.set_solved(true);
      return step;
    }
    ++rejected_;
    const bool inaccurate = step.solution.status == solver::StepStatus::inaccurate;
    if (inaccurate ? control_->rejected(step.dt, step.error) : control_->failed(step.dt)) continue;
    if (energy_.has_refused()) {
      step.fail(fmt::format("t = {:.6g} s: {}; expected a smaller tolerance than {:.2g} in `step: {{tolerance: ...}}`",
                            state.t, energy_.reason(), model_.simulation.error_control->tolerance));
      return step;
    }
    const std::string reason =
        inaccurate ? fmt::format("the error of {} is {:.2g} times the tolerance", step_error_.worst(), step.error)
                   : step.solution.message;
    const bool is_explicit = model_.simulation.integrator == model::Integrator::dormand_prince;
    step.fail(fmt::format("t = {:.6g} s: {} with the smallest step, {:.2g} s: {}{}", state.t,
                          inaccurate ? "the tolerance is exceeded" : "no convergence", step.dt, reason,
                          is_explicit ? kAdviceToExplicit : ""));
    return step;
  }
}

void TimeStepper::persist_history(Archive& archive, const solver::State& state) {
  integrator_->persist(archive);
  if (archive.restores()) energy_.begin_anew(state);
}

void TimeStepper::persist(Archive& archive) {
  {
    const Archive::Group group(archive, "integrator");
    integrator_->persist(archive);
  }
  const Archive::Group group(archive, "steps");
  archive.io("reached", reached_), archive.io("off_plan", off_plan_), archive.io("at_bend", at_bend_),
      archive.io("trial", trial_), archive.io("creeping", creeping_);
  archive.io("length", last_dt_), archive.io("rejected", rejected_);
  {
    const Archive::Group energy(archive, "energy");
    energy_.persist(archive);
  }
  if (control_) control_->persist(archive);
}

}  // namespace hersey::run
