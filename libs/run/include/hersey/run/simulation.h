#pragma once

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

/// How an advance ended.
enum class AdvanceStatus {
  failed,    ///< without an answer; time() is that of the last good step, and the results up to it are intact
  advanced,  ///< where it was asked to go
  ended,     ///< before that, in order: the end of simulation.duration, a run that has settled or repeats itself
};

/// Outcome of an advance, solved unless it failed. The message tells why it ended, or failed.
struct [[nodiscard]] Advance : OutcomeOf<AdvanceStatus, AdvanceStatus::advanced, AdvanceStatus::ended> {
  using Status = AdvanceStatus;
};

/// One machine, stepped from outside: for control, co-simulation, and programs that decide as they go.
///
/// It takes the steps of `hersey run`: simulate() is a loop over the same class of steps. Stepped to the end by step(),
/// or by advance_to() with multiples of the fixed step, it comes to the same numbers to the last bit. Any other instant
/// is hit exactly, too: on the way to it fixed steps are equal and at most as long as simulation.step.
///
/// Inputs are the loads, drives and supply pressures that the model gives as a number or as a function. One that is
/// never set stays as the model has it; once set it keeps its value until it is set again. A changed force or speed is
/// a jump: the integrator's history ends there, accelerations and constraint forces are found anew, and with a jump of
/// a prescribed speed the machine's velocities follow at once, as by an impulse. A changed supply pressure acts from
/// the next step on.
///
/// Objects know nothing of each other; several may live at once. One object is not for use from two threads at once.
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

  /// As it was given; its functions are those that inputs set.
  [[nodiscard]] const model::Model& model() const;
  [[nodiscard]] double time() const;   ///< of the last accepted step [s]
  [[nodiscard]] double start() const;  ///< [s]
  [[nodiscard]] double end() const;    ///< start plus simulation.duration [s]

  /// One step of the solver.
  Advance step();
  /// As many steps as it takes to be at `t`, to a millionth of a step. @pre finite
  /// @throws InputError where t lies before time()
  Advance advance_to(double t);

  /// All inputs of this model.
  [[nodiscard]] const std::vector<InputInfo>& inputs() const;
  /// Holds an input at `value` [SI] from now on. Setting the value it has changes nothing, not a bit.
  /// @throws InputError naming the nearest input where there is none of that name, or a value not finite
  void set(const std::string& input, double value);
  /// Gives an input back to the model.
  void release(const std::string& input);
  /// Its value now [SI]; of a function of the motion that has not been set: not a number.
  [[nodiscard]] double input(const std::string& name) const;

  /// All quantities of results that grow row by row, but for fields over a film.
  [[nodiscard]] const std::vector<OutputInfo>& outputs() const;
  /// At time(), row-major [SI]. @throws InputError naming the nearest output where there is none
  [[nodiscard]] const std::vector<double>& output(const std::string& name) const;
  /// By its place in outputs().
  [[nodiscard]] const std::vector<double>& output(std::size_t index) const;

  /// State and inputs, in memory: going on from it gives the same bits. Of this model and version of the program.
  [[nodiscard]] Archive::Content save();
  /// Goes back, or on, to what save() gave, also of another object of the same model. Without a results file only: such
  /// a file goes forward. @throws ArchiveError where it does not fit
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
