#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::run {

/// What decides the results beside the model's dimensions, as name and text: cavitation, supply, gap reading, grid,
/// rheology, contact, compliance, conventions, integrator. The first lines of every report.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> assumptions(const model::Model& model);

/// The same of one bearing, without how it is coupled to bodies.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> bearing_assumptions(const model::Bearing& bearing);

/// What is known of an oil, as name and text: viscosity over temperature, pressure and shear rate, density.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> oil_assumptions(const film::Lubricant& oil);

}  // namespace hersey::run
