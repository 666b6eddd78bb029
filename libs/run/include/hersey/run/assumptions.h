#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::run {

/// Returns, as name and text, the assumptions that decide the results beside the model's dimensions: cavitation,
/// supply, gap reading, grid, rheology, contact, compliance, conventions, integrator. They are the first lines of every
/// report.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> assumptions(const model::Model& model);

/// Returns the assumptions of one bearing, without those of its coupling to bodies.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> bearing_assumptions(const model::Bearing& bearing);

/// Returns the laws of an oil, as name and text: viscosity over temperature, pressure and shear rate, and density.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> oil_assumptions(const film::Lubricant& oil);

}  // namespace hersey::run
