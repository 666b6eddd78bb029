#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hersey/core/archive.h"
#include "hersey/core/scalar_function.h"
#include "hersey/fmi/instance.h"
#include "hersey/model/model.h"
#include "observation/fmu_signals.h"
#include "time_stepping/jump.h"

namespace hersey::run {

/// The output of an FMU as a function of time between two exchanges: value + slope (t - start).
class FmuFunction final : public ScalarFunction {
 public:
  [[nodiscard]] double value(std::span<const double> t) const override { return value_ + slope_ * (t[0] - start_); }
  void gradient(std::span<const double> /*t*/, std::span<double> gradient) const override { gradient[0] = slope_; }
  [[nodiscard]] double second_derivative(std::span<const double> /*t*/) const override { return 0; }

  /// The function from an exchange at `start` [s] on.
  void begin_at(double start, double value, double slope) { start_ = start, value_ = value, slope_ = slope; }
  [[nodiscard]] double slope() const { return slope_; }
  [[nodiscard]] double value_at_start() const { return value_; }
  void persist(Archive& archive) {
    archive.io("start", start_), archive.io("value", value_), archive.io("slope", slope_);
  }

 private:
  double start_ = 0, value_ = 0, slope_ = 0;
};

/// Why the state of a run of this model cannot be saved; as "FMU controller cannot save its state"; empty where it
/// can.
[[nodiscard]] std::string why_not_saved(const model::Model& model);

/// The FMUs of one run and what they exchange with the machine (theory manual, integrator.50 and integrator.51): at t_n
/// = start + n H each is given its inputs, which it keeps over the step that follows, while the machine goes on with
/// what the outputs were at t_n. FMUs take their step when the machine has taken its own to t_n+1. Errors are of first
/// order in H, and the loop is stable while that is short, (integrator.52).
/// @verified_by tests/fmu/import_test.py
class FmuExchange {
 public:
  /// Makes an instance of each FMU, with its start values, and begins its initialisation. Functions of the model that
  /// follow outputs have their value then.
  /// @throws InputError at the FMU's file if it has no instance, or refuses a start value
  explicit FmuExchange(const model::Model& given);

  /// The given model, in which the functions that follow outputs are this object's own.
  [[nodiscard]] const model::Model& model() const { return model_; }

  /// Inputs of the next exchange, in SI units, as found at its instant.
  void take_inputs(std::vector<std::vector<double>> values) { pending_ = std::move(values); }
  /// The next instant of an exchange [s].
  [[nodiscard]] double next() const;
  /// True if an FMU exchanges its signals at `t`, to within `slack` [s].
  [[nodiscard]] bool is_due(double t, double slack) const { return t >= next() - slack; }

  /// The first exchange, at the start of the run: ends the initialisation.
  /// @pre take_inputs()
  /// @throws std::runtime_error with the FMU's name
  [[nodiscard]] Jump begin();
  /// The exchange at `t`: steps of FMUs that end here, then new inputs and outputs.
  /// @pre take_inputs(), is_due(t, slack)
  /// @throws std::runtime_error with the FMU's name
  [[nodiscard]] Jump exchange(double t, double slack);

  [[nodiscard]] const std::vector<FmuSignals>& signals() const { return signals_; }

  /// What FMUs have warned of: the first of each, its time, and how many there were; empty if there are none.
  [[nodiscard]] std::string warnings() const;

  /// @throws ArchiveError with why_not_saved()
  void persist(Archive& archive);

 private:
  /// An FMU that runs.
  struct Unit {
    std::unique_ptr<fmi::Instance> instance;
    std::vector<unsigned> inputs, outputs;  ///< value references
    std::size_t exchanges = 0;              ///< number of steps that it has taken
    std::vector<double> before;             ///< outputs at the exchange before the last [SI]
    fmi::Warnings warnings;
    double warned_at = 0;  ///< time of the first warning [s]
  };
  /// A function of the model that follows an output.
  struct Follower {
    std::shared_ptr<FmuFunction> function;
    model::FmuSignal signal;
    Jump of_value, of_slope;  ///< what a jump of them does to the integrator
  };

  void start(const model::Fmu& fmu);
  void follow(model::Function& function, Jump of_value, Jump of_slope);
  void note_warnings(Unit& unit, double t);
  void give_inputs(std::size_t f);
  /// @param is_given  inputs are known: before, an output need not be finite, and is 0 where it is not
  void get_outputs(std::size_t f, bool is_given = true);
  [[nodiscard]] Jump go_on_from(std::size_t f, double t);
  [[nodiscard]] double instant(std::size_t f, std::size_t n) const;

  model::Model model_;
  std::vector<Unit> units_;
  std::vector<FmuSignals> signals_;
  std::vector<Follower> followers_;
  std::vector<std::vector<double>> pending_;
};

}  // namespace hersey::run
