#include "hersey/model/oil_grades.h"

#include <algorithm>
#include <cmath>

#include "hersey/film/temperature_law.h"

namespace hersey::model {
namespace {

// ISO 3448 fixes the viscosity at 40 degC, SAE J300 limits at 100 degC. What neither says is typical of mineral oils of
// a viscosity index near 100, and of engine oils of the grade: chosen here, and to be overridden by an oil's data
// sheet.
constexpr std::string_view iso =
    "nu40: ISO 3448; nu100, density and points typical of mineral oils of viscosity index 95 to 110";
constexpr std::string_view sae =
    "nu100 within, viscosity at 150 degC and 1e6 1/s above the limits of SAE J300 (2015); the rest typical of the "
    "grade";

// mm^2/s, mm^2/s, kg/m^3, degC, degC, mPa.s
constexpr OilGrade grade(std::string_view name, double nu40, double nu100, double rho15, double pour, double flash,
                         double hths, std::string_view source) {
  return {name, 1e-6 * nu40, 1e-6 * nu100, rho15, pour + 273.15, flash + 273.15, 1e-3 * hths, source};
}

// Data of a typical multigrade oil: its polymers add half of the viscosity; exponent of the shear thinning.
constexpr double typical_limit = 0.5, typical_exponent = 0.8;

}  // namespace

film::ShearThinning OilGrade::shear_thinning() const {
  if (hths == 0) return {};
  const double at_rest = film::viscosity_at(film::WaltherViscosity::through(nu40, nu100, rho15), hths_temperature);
  const double left = hths / at_rest, x = std::pow((1 - left) / (left - typical_limit), 1 / typical_exponent);
  return {film::Cross{typical_limit, typical_exponent}, 0, hths_rate * at_rest / x};
}

const std::vector<OilGrade>& oil_grades() {
  static const std::vector<OilGrade> grades{
      grade("iso_vg_10", 10, 2.6, 848, -30, 160, 0, iso),     grade("iso_vg_15", 15, 3.4, 855, -27, 180, 0, iso),
      grade("iso_vg_22", 22, 4.3, 860, -24, 200, 0, iso),     grade("iso_vg_32", 32, 5.4, 863, -24, 210, 0, iso),
      grade("iso_vg_46", 46, 6.8, 869, -21, 220, 0, iso),     grade("iso_vg_68", 68, 8.7, 874, -21, 230, 0, iso),
      grade("iso_vg_100", 100, 11.3, 880, -18, 240, 0, iso),  grade("iso_vg_150", 150, 14.8, 887, -15, 250, 0, iso),
      grade("iso_vg_220", 220, 19.0, 893, -12, 260, 0, iso),  grade("iso_vg_320", 320, 24.4, 898, -12, 265, 0, iso),
      grade("iso_vg_460", 460, 30.8, 903, -9, 270, 0, iso),   grade("sae_0w16", 33, 7.1, 845, -42, 215, 2.4, sae),
      grade("sae_0w20", 44, 8.4, 846, -42, 220, 2.7, sae),    grade("sae_0w30", 55, 10.3, 848, -42, 220, 3, sae),
      grade("sae_0w40", 75, 13.5, 850, -42, 220, 3.6, sae),   grade("sae_5w20", 48, 8.5, 852, -39, 220, 2.7, sae),
      grade("sae_5w30", 64, 11.0, 855, -39, 220, 3.1, sae),   grade("sae_5w40", 85, 14.0, 857, -39, 220, 3.7, sae),
      grade("sae_10w30", 70, 10.8, 865, -36, 220, 3.1, sae),  grade("sae_10w40", 95, 14.4, 868, -36, 220, 3.8, sae),
      grade("sae_15w40", 108, 14.6, 878, -30, 225, 4, sae),   grade("sae_15w50", 138, 18.8, 880, -30, 225, 4.7, sae),
      grade("sae_20w50", 155, 18.3, 884, -24, 230, 4.6, sae), grade("sae_20", 58, 8.0, 876, -24, 215, 0, sae),
      grade("sae_30", 95, 11.0, 885, -21, 225, 0, sae),       grade("sae_40", 140, 14.6, 890, -18, 235, 0, sae),
      grade("sae_50", 215, 19.3, 895, -15, 240, 0, sae),      grade("sae_60", 320, 24.5, 900, -12, 250, 0, sae),
  };
  return grades;
}

const OilGrade* oil_grade(std::string_view name) {
  const auto& all = oil_grades();
  const auto found = std::find_if(all.begin(), all.end(), [&](const OilGrade& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> oil_grade_names() {
  std::vector<std::string> names;
  for (const OilGrade& one : oil_grades()) names.emplace_back(one.name);
  return names;
}

}  // namespace hersey::model
