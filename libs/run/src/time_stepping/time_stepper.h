#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/core/outcome.h"
#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/integrator.h"
#include "hersey/solver/step_control.h"
#include "time_stepping/energy_monitor.h"
#include "time_stepping/step_error.h"
#include "time_stepping/target_instants.h"

namespace hersey::run {

/// Outcome of one step of a run; if none could be taken, the reason and the time.
struct [[nodiscard]] TimeStep : Outcome {
  double dt = 0;  ///< [s]
  solver::StepSummary solution;
  double error = 0;        ///< estimated, over the tolerance; 0 where it is not controlled
  double local_error = 0;  ///< estimated, StepError::largest; 0 if nothing is integrated
};

/// Steps a machine through the instants that its run has to hit: by a fixed step that is halved where Newton's method
/// does not converge, by a controlled error, or from instant to instant with drives alone (kinematics).
class TimeStepper {
 public:
  TimeStepper(const model::Model& model, model::Machine& machine);

  /// Chooses the instants, and the first step, from the state at the start of the run. Before the first step, and
  /// before restoring.
  void plan(const solver::State& state, const mbd::Observation& start);

  [[nodiscard]] bool is_at_end() const { return reached_ == targets_.size(); }

  /// Advances `state` by one accepted step; leaves it unchanged if there is none.
  /// @param limit  an instant besides the planned ones that steps do not pass [s]. Between two instants that are not
  ///         planned, fixed steps are equal and at most as long as planned.
  /// @pre planned, not at the end; state.t < limit
  [[nodiscard]] TimeStep take(solver::State& state, double limit = std::numeric_limits<double>::infinity());

  /// Distance below which two instants count as one [s].
  [[nodiscard]] double slack() const;

  /// Restarts the integrator after a jump of what acts on the machine. Its history ends here, and the next step begins
  /// with the accelerations that follow from what acts now.
  /// @param moves  prescribed velocities have jumped too: the machine's velocities follow, as by an impulse
  void take_jump(solver::State& state, bool moves);

  /// True: steps are solved beyond their tolerance, down to round-off; solver::Integrator::solve_to_round_off.
  void solve_to_round_off(bool is_on) { integrator_->solve_to_round_off(is_on); }

  [[nodiscard]] const solver::Integrator& integrator() const { return *integrator_; }
  /// Length of the last step; 0 before the first [s].
  [[nodiscard]] double last_dt() const { return last_dt_; }
  /// The monitor of the energy of the steps.
  [[nodiscard]] const EnergyMonitor& energy() const { return energy_; }
  /// Tried in vain since the start of the run.
  [[nodiscard]] int rejected_steps() const { return rejected_; }

  void persist(Archive& archive);
  /// Saves or restores the method's history alone; with one that has been restored, steps go on from `state`, to which
  /// no step has led.
  void persist_history(Archive& archive, const solver::State& state);

 private:
  [[nodiscard]] TimeStep follow_drives(solver::State& state, double target);
  [[nodiscard]] TimeStep take_fixed(solver::State& state, double target);
  [[nodiscard]] std::string end_of_cutting(const TimeStep& step) const;
  [[nodiscard]] std::string advice(const solver::StepSummary& solution) const;
  [[nodiscard]] TimeStep take_controlled(solver::State& state, double target);
  [[nodiscard]] double unit_of_steps() const;
  [[nodiscard]] double bend_before(double target, double t) const;
  [[nodiscard]] bool is_bend(double t) const;
  [[nodiscard]] double next_stop(const solver::State& state, double limit);
  void pass_targets(double t);
  void start_afresh(solver::State& state);
  void restart(solver::State& state);

  const model::Model& model_;
  model::Machine& machine_;
  std::unique_ptr<solver::Integrator> integrator_;
  StepError step_error_;
  EnergyMonitor energy_;
  /// Neither films nor deformations, whose fast motions the error's estimate takes for errors.
  bool has_smooth_motion_;
  Eigen::VectorXd bounded_;    ///< a fixed step's estimated error, of no coordinate more than its way
  std::vector<double> bends_;  ///< where steps start afresh: the jumps, and under error control all kinks
  TargetInstants targets_;
  std::optional<solver::StepControl> control_;  ///< under error control
  std::size_t reached_ = 0;                     ///< number of targets reached
  bool off_plan_ = false;                       ///< the last step ended between the targets
  bool at_bend_ = false;                        ///< the next step starts where a table bends or a force begins
  double trial_ = std::numeric_limits<double>::infinity();  ///< longest fixed step to try after a failure [s]
  double creeping_ = 0;  ///< time covered by fixed steps much shorter than planned, without a longer one [s]
  double last_dt_ = 0;
  int rejected_ = 0;
};

}  // namespace hersey::run
