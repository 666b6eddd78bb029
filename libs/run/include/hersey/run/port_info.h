#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hersey::run {

/// A variable that can be set from outside between two steps.
struct InputInfo {
  std::string name;  ///< its key path in the model file, "forces.gas.magnitude", "forces.load.force.x"
  std::string unit;  ///< SI
  std::string text;  ///< description
  double start = 0;  ///< its value at the start of the run
};

/// A variable that can be read at every step.
struct OutputInfo {
  std::string name;                     ///< its path in the results file, with dots: "bearings.big_end.h_min"
  std::string unit;                     ///< SI, "1" for a pure number
  std::string text;                     ///< description
  std::vector<std::size_t> shape;       ///< empty: one number
  std::vector<std::string> components;  ///< of one dimension: "x", "y", "z", or the names of what its numbers belong to
};

}  // namespace hersey::run
