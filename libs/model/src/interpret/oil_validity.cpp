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
    return {.T_low = law.c + above_vogels_pole, .low = "20 K above the pole of Vogel's law"};
  }
  OilValidity operator()(const film::WaltherViscosity& law) const {
    double cold = film::zero_celsius, hot = 1000;
    if (law.kinematic(hot).value > least_walther || law.kinematic(cold).value < least_walther) return {};
    for (int k = 0; k < 60; ++k) {  // halvings of the interval to round-off
      const double T = 0.5 * (cold + hot);
      (law.kinematic(T).value > least_walther ? cold : hot) = T;
    }
    return {.T_high = hot, .high = "where ASTM D341 in its simple form ends, 2 mm^2/s"};
  }
  OilValidity operator()(const film::TabledViscosity& law) const {
    const std::string end = "the end of its table: viscosities are extrapolated";
    return {.T_low = law.T.front(), .T_high = law.T.back(), .low = end, .high = end};
  }
};

}  // namespace

OilValidity validity_of(const film::Lubricant& oil, const OilGrade* grade) {
  OilValidity validity = std::visit(EndsOfLaw{}, oil.temperature_law);
  if (const auto* table = std::get_if<film::TabledPressure>(&oil.viscosity_law)) validity.p_high = table->p.back();
  if (grade == nullptr) return validity;
  const std::string typical = " typical of " + std::string(grade->name);
  if (grade->pour_point > validity.T_low) validity.T_low = grade->pour_point, validity.low = "the pour point" + typical;
  if (grade->flash_point < validity.T_high)
    validity.T_high = grade->flash_point, validity.high = "the flash point" + typical;
  return validity;
}

std::string doubt_at(const OilValidity& validity, double T) {
  if (T < validity.T_low)
    return fmt::format("{:.4g} degC is below {:.4g} degC, {}", celsius(T), celsius(validity.T_low), validity.low);
  if (T > validity.T_high)
    return fmt::format("{:.4g} degC is above {:.4g} degC, {}", celsius(T), celsius(validity.T_high), validity.high);
  return {};
}

std::vector<std::string> doubts_of_film(const OilValidity& validity, double T, double p) {
  std::vector<std::string> doubts;
  if (const std::string hot = doubt_at(validity, T); !hot.empty()) doubts.push_back("its hottest oil: " + hot);
  if (p > validity.p_high)
    doubts.push_back(fmt::format("its largest pressure: {:.4g} MPa is above {:.4g} MPa, the end of the oil's table: "
                                 "viscosities are extrapolated",
                                 1e-6 * p, 1e-6 * validity.p_high));
  return doubts;
}

}  // namespace hersey::model
