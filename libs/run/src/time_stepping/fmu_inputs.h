#pragma once

#include <cstddef>
#include <vector>

#include "hersey/model/build.h"
#include "hersey/model/model.h"
#include "hersey/solver/equations.h"
#include "observation/power_balance.h"
#include "observation/step_record.h"
#include "record/recorder.h"

namespace hersey::run {

/// Finds what the inputs of FMUs are given: quantities of the results at an accepted step, and functions of time.
class FmuInputs {
 public:
  /// @param model, machine  outlive this
  /// @throws InputError with all inputs whose quantity is not there, is no single number, or does not fit in unit
  FmuInputs(const model::Model& model, const model::Machine& machine, const solver::State& start);

  /// Values in SI units, for each FMU in the order of its inputs.
  [[nodiscard]] std::vector<std::vector<double>> at(const StepRecord& step, const EnergySummary& energy);

 private:
  /// A number of a row, and what leads from the row's unit to SI: value = factor * number + offset.
  struct Column {
    std::size_t row = 0, column = 0;
    double factor = 1, offset = 0;
  };
  [[nodiscard]] Column find(const model::FmuInput& input) const;
  [[nodiscard]] double value_of(const model::Function& function, const mbd::Observation& seen) const;

  const model::Model& model_;
  const model::Machine& machine_;
  Recorder snapshot_;
  std::vector<std::vector<Column>> columns_;  ///< of each input of each FMU; unused where it is a function
  bool reads_rows_ = false;                   ///< there is an input that is none
};

}  // namespace hersey::run
