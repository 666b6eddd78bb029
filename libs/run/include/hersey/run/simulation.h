#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/core/outcome.h"
#include "hersey/model/model.h"
#include "hersey/run/options.h"
#include "hersey/run/port_info.h"
#include "hersey/run/summary.h"

namespace hersey::run {

/// Outcome of an advance.
enum class AdvanceStatus {
  failed,    ///< without an answer; time() is that of the last good step, and the results up to it are intact
  advanced,  ///< the requested time was reached
  ended,     ///< before that, in order: the end of simulation.duration, a run that has settled or repeats itself
};

/// Outcome of an advance, solved unless it failed. The message gives the reason why it ended early or failed.
struct [[nodiscard]] Advance : OutcomeOf<AdvanceStatus, AdvanceStatus::advanced, AdvanceStatus::ended> {
  using Status = AdvanceStatus;
};

/// Why outputs of a model have no derivatives with respect to its inputs: steps chosen by their error, or methods
/// without an exact tangent. Empty where they have.
[[nodiscard]] std::string why_no_derivatives(const model::Model& model);

/// One machine, stepped from outside: for control, co-simulation, and programs that decide during the run.
///
/// It takes the steps of `hersey run`: simulate() is a loop over the same class of steps. Stepped to the end by step(),
/// or by advance_to() with multiples of the fixed step, it yields the same numbers to the last bit. Any other instant
/// is hit exactly, too: on the way to it fixed steps are equal and at most as long as simulation.step.
///
/// Inputs are the loads, drives and supply pressures that the model gives as a number or as a function. An input that
/// is never set keeps the model's value; once set it keeps the new value until it is set again. A changed force or
/// speed is a jump: the integrator's history ends there, accelerations and constraint forces are computed anew, and
/// with a jump of a prescribed speed the machine's velocities follow at once, as by an impulse. A changed supply
/// pressure acts from the next step on.
///
/// Objects are independent of each other; several may exist at once. One object must not be used from two threads at
/// once.
/// @verified_by simulation_test.cpp
class Simulation {
 public:
  /// Builds the machine and finds its start. With options.results a results file is written as the steps go;
  /// options.step_error, resume and stop are for simulate().
  /// @throws InputError where the model cannot start, or computes no motion over time; results::FileExists, FileBusy.
  explicit Simulation(model::Model model, Options options = {});
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  /// Closes the results as stopped where finish() has not been called.
  ~Simulation();

  /// The given model; its functions are those that the inputs set.
  [[nodiscard]] const model::Model& model() const;
  [[nodiscard]] double time() const;   ///< of the last accepted step [s]
  [[nodiscard]] double start() const;  ///< [s]
  [[nodiscard]] double end() const;    ///< start plus simulation.duration [s]

  /// One step of the solver.
  Advance step();
  /// Takes the steps needed to reach `t`, within a millionth of a step.
  /// @pre finite
  /// @throws InputError if t is before time()
  /// @param until  called after each of them, for where the advance is to end from there on: t, or an earlier instant,
  ///        at most time() to end at once. It may read outputs and must change nothing.
  Advance advance_to(double t, const std::function<double()>& until = {});

  /// All inputs of this model.
  [[nodiscard]] const std::vector<InputInfo>& inputs() const;
  /// Fixes an input at `value` [SI] from now on. Setting the value it already has changes no bit of the results.
  /// @throws InputError naming the nearest input if there is none of that name, or a value that is not finite
  void set(const std::string& input, double value);
  /// Gives an input back to the model.
  void release(const std::string& input);
  /// Current value of an input [SI]; not a number for a function of the motion that has not been set.
  [[nodiscard]] double input(const std::string& name) const;

  /// All quantities of results that grow row by row, but for fields over a film.
  [[nodiscard]] const std::vector<OutputInfo>& outputs() const;
  /// Value of an output at time(), row-major [SI].
  /// @throws InputError naming the nearest output if there is none
  [[nodiscard]] const std::vector<double>& output(const std::string& name) const;
  /// Value of an output by its index in outputs().
  [[nodiscard]] const std::vector<double>& output(std::size_t index) const;

  /// True: each advance keeps the state it begins from, which derivative() needs. Costs a save() for each.
  /// @throws InputError with why_no_derivatives() where it says anything
  void keep_starts(bool is_on);
  /// Derivatives of all outputs at time() with respect to an input fixed over the last advance, in the order of
  /// outputs(): (integrator.46). Inputs that were functions of time keep their value at its start in place of them. The
  /// advance begins with a jump of this input, also where it was not changed. Nothing that follows changes by a bit.
  /// @cost about four times that of the advance for the first time, nothing for a second one
  /// @pre  keep_starts(true) before an advance
  /// @throws InputError if there is no such input, it cannot be set, or no advance has begun since the last restore()
  /// @throws std::runtime_error where the neighbours of the advance have no answer
  /// @verified_by step_derivatives_test.cpp
  [[nodiscard]] const std::vector<std::vector<double>>& derivative(const std::string& input);

  /// State and inputs, in memory: going on from it gives the same bits. Of this model and version of the program.
  [[nodiscard]] Archive::Content save();
  /// Restores a state that save() returned, earlier or later than the present one, also from another object of the same
  /// model. Only without a results file, because such a file cannot go backwards.
  /// @throws ArchiveError if the state does not fit
  void restore(Archive::Content saved);

  /// Extremes and balances of all steps so far.
  [[nodiscard]] Summary summary() const;
  /// Closes the results file; no step follows. @throws std::runtime_error where it cannot be written
  Summary finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hersey::run
