#include "hersey/model/oil_validity.h"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "hersey/model/oil_grades.h"

namespace hersey::model {
namespace {

// Below it the standard adds a term to nu + 0.7 [m^2/s].
constexpr double least_walther = 2e-6;

// Above c, Vogel's law leaves a film no viscosity that anybody has measured [K].
constexpr double above_vogels_pole = 20;

double celsius(double T) { return T - film::zero_celsius; }

/// Ends of each law. A law without ends here does not compile.
struct EndsOfLaw {
  OilValidity operator()(const film::FixedViscosity&) const { return {}; }
  OilValidity operator()(const film::ExponentialViscosity&) const { return {}; }
  OilValidity operator()(const film::VogelViscosity& law) const {
    return {.low = {{law.c + above_vogels_pole, "20 K above the pole of Vogel's law"}}};
  }
  OilValidity operator()(const film::WaltherViscosity& law) const {
    double cold = film::zero_celsius, hot = 1000;
    if (law.kinematic(hot).value > least_walther || law.kinematic(cold).value < least_walther) return {};
    for (int k = 0; k < 60; ++k) {  // halvings of the interval to round-off
      const double T = 0.5 * (cold + hot);
      (law.kinematic(T).value > least_walther ? cold : hot) = T;
    }
    return {.high = {{hot, "where ASTM D341 in its simple form ends, 2 mm^2/s"}}};
  }
  OilValidity operator()(const film::TabledViscosity& law) const {
    const std::string end = "the end of its table: viscosities are extrapolated";
    return {.low = {{law.T.front(), end}}, .high = {{law.T.back(), end}}};
  }
};

}  // namespace

OilValidity validity_of(const film::Lubricant& oil, const OilGrade* grade) {
  OilValidity validity = std::visit(EndsOfLaw{}, oil.temperature_law);
  if (const auto* table = std::get_if<film::TabledPressure>(&oil.viscosity_law)) validity.p_high = table->p.back();
  if (grade == nullptr) return validity;
  const std::string typical = " typical of " + std::string(grade->name);
  validity.low.push_back({grade->pour_point, "the pour point" + typical});
  validity.high.push_back({grade->flash_point, "the flash point" + typical});
  return validity;
}

std::string temperature_warning(const OilValidity& validity, double T) {
  std::string beyond;
  const auto add = [&](const char* side, const OilValidity::End& end) {
    beyond += fmt::format("{} {} {:.4g} degC, {}", beyond.empty() ? "" : " and", side, celsius(end.T), end.what);
  };
  for (const OilValidity::End& end : validity.low)
    if (T < end.T) add("below", end);
  for (const OilValidity::End& end : validity.high)
    if (T > end.T) add("above", end);
  return beyond.empty() ? "" : fmt::format("{:.4g} degC is{}", celsius(T), beyond);
}

std::vector<std::string> film_warnings(const OilValidity& validity, double T, double p) {
  std::vector<std::string> warnings;
  if (const std::string hot = temperature_warning(validity, T); !hot.empty())
    warnings.push_back("its hottest oil: " + hot);
  if (p > validity.p_high)
    warnings.push_back(
        fmt::format("its largest pressure: {:.4g} MPa is above {:.4g} MPa, the end of the oil's table: "
                    "viscosities are extrapolated",
                    1e-6 * p, 1e-6 * validity.p_high));
  return warnings;
}

}  // namespace hersey::model
