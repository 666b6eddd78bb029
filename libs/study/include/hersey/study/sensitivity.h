#pragma once

#include <string>
#include <vector>

#include "hersey/study/bearing_study.h"

namespace hersey::study {

/// Derivatives of every figure of a bearing's solution by one key of the model file. Unsolved, `slopes` is empty.
struct [[nodiscard]] Sensitivity : Outcome {
  std::string parameter;  ///< key path
  double value = 0;       ///< [unit]
  std::string unit;       ///< SI
  double size = 1;        ///< of the unit in the file, in `unit`
  bool exact = true;      ///< by the Jacobian of the solution; else by the difference of two solutions
  /// Derivative of each of figures_of(solution), SI over SI; not a number if a figure has none.
  std::vector<double> slopes;
};

/// Returns the keys that decide about a bearing and are numbers in the file: speeds, load or position, size, clearance,
/// viscosity, pressures and temperatures of supplies.
/// @throws InputError for a file that cannot be read.
[[nodiscard]] std::vector<std::string> usual_parameters(const std::string& path,
                                                        const std::vector<std::string>& overrides,
                                                        const std::string& bearing);

/// Returns the same keys for the text of a model; `file` names it in faults.
[[nodiscard]] std::vector<std::string> usual_parameters(const std::string& text, const std::string& file,
                                                        const std::vector<std::string>& overrides,
                                                        const std::string& bearing);

/// True if the sensitivities of a solution are exact: between rigid surfaces with one given temperature.
[[nodiscard]] bool are_sensitivities_exact(const BearingSolution& solution);

/// Returns the sensitivities of `solution`, found for the model file at `path` with solution.run.overrides. Between
/// rigid surfaces with one temperature they come from bearing::SteadyDerivative, a linear solution for each parameter;
/// where film and heat or surfaces are coupled, from solutions of the bearing on both sides.
/// @param parameters  key paths, or parameters of the model.
/// @throws InputError if one is not a number of the file.
/// @verified_by sensitivity_test.cpp
[[nodiscard]] std::vector<Sensitivity> sensitivities(const std::string& path, const BearingSolution& solution,
                                                     const BearingStudyOptions& options,
                                                     const std::vector<std::string>& parameters);
/// Returns the sensitivities for the text of a model; `file` names it in faults.
[[nodiscard]] std::vector<Sensitivity> sensitivities(const std::string& text, const std::string& file,
                                                     const BearingSolution& solution,
                                                     const BearingStudyOptions& options,
                                                     const std::vector<std::string>& parameters);

}  // namespace hersey::study
