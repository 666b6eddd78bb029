#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hersey/film/shear_law.h"

namespace hersey::model {

/// An oil one can buy, by its grade; SI units.
struct OilGrade {
  std::string_view name;       ///< as in the model file
  double nu40 = 0, nu100 = 0;  ///< kinematic viscosities at 40 and 100 degC [m^2/s]
  double rho15 = 0;            ///< density at 15 degC [kg/m^3]
  double pour_point = 0;       ///< [K]
  double flash_point = 0;      ///< [K]
  double hths = 0;             ///< viscosity at 150 degC and 1e6 1/s [Pa s]; 0: it does not thin by shear
  std::string_view source;     ///< of these numbers

  /// Cross' law through `hths`, with the exponent and the limit of a typical multigrade oil.
  [[nodiscard]] film::ShearThinning shear_thinning() const;
};

/// conditions at which the high-shear viscosity of multigrade oils is specified [K, 1/s]
inline constexpr double hths_temperature = 423.15, hths_rate = 1e6;

/// All grades, from thin to thick.
[[nodiscard]] const std::vector<OilGrade>& oil_grades();

/// The grade of that name; null if there is none.
[[nodiscard]] const OilGrade* oil_grade(std::string_view name);

/// Their names.
[[nodiscard]] std::vector<std::string> oil_grade_names();

}  // namespace hersey::model
