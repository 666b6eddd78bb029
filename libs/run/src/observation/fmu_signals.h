#pragma once

#include <vector>

namespace hersey::run {

/// What an FMU was given and has returned at the last exchange, in SI units, in the order of model::Fmu.
struct FmuSignals {
  std::vector<double> inputs, outputs;
};

}  // namespace hersey::run
