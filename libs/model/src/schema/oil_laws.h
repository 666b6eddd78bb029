#pragma once

#include "check/vocabulary.h"
#include "hersey/film/density_law.h"
#include "hersey/film/shear_law.h"
#include "hersey/film/temperature_law.h"
#include "hersey/film/viscosity_law.h"

namespace hersey::model {

/// A temperature of oils and machines.
[[nodiscard]] TypePtr temperature(const std::string& example);

/// Laws of viscosity against pressure: the only definition of their formats in the model file.
[[nodiscard]] const std::vector<Alternative<film::ViscosityLaw>>& viscosity_laws();

/// Laws of viscosity against temperature. @param rho15  density at 15 degC, of laws for kinematic viscosities [kg/m^3]
/// @param expansion  by which that falls [1/K]
[[nodiscard]] std::vector<Alternative<film::TemperatureLaw>> temperature_laws(double rho15, double expansion);

/// Viscosities of a table over temperature in the column `k` of its pressures [Pa s].
[[nodiscard]] std::vector<double> column_of(const Value& table, std::size_t k);

/// Laws of viscosity against shear rate. @param limit  mu_inf over the viscosity at rest [-]
[[nodiscard]] std::vector<Alternative<film::ShearLaw>> shear_laws(double limit);

/// Laws of density against pressure.
[[nodiscard]] const std::vector<Alternative<film::DensityLaw>>& density_laws();

}  // namespace hersey::model
