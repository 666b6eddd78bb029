#include <fmt/format.h>

#include "hersey/model/oil_grades.h"
#include "schema/format.h"
#include "schema/oil_laws.h"

namespace hersey::model {
namespace {

TypePtr pressure_viscosity_format() {
  const TypePtr alpha = quantity("1/Pa", "1.28e-10 1/Pa", Range::not_negative());
  return any_of("a coefficient such as 1.28e-10 1/Pa, or {law, ...}",
                {alpha, variant("a pressure-viscosity law", "law", {}, variants_of(viscosity_laws()))});
}

TypePtr viscosity_format() {
  return any_of("a viscosity such as 15 mPa.s, or {law, ...}",
                {quantity("Pa.s", "15 mPa.s", Range::positive()),
                 variant("viscosity over temperature", "law", {}, variants_of(temperature_laws(0, 0)))});
}

std::vector<Word> grade_words() {
  std::vector<Word> words;
  for (const OilGrade& grade : oil_grades()) {
    words.push_back({std::string(grade.name), fmt::format("{:.4g} and {:.3g} mm^2/s at 40 and 100 degC, {:.0f} kg/m^3",
                                                          1e6 * grade.nu40, 1e6 * grade.nu100, grade.rho15)});
  }
  return words;
}

TypePtr shear_thinning_format() {
  return with_exactly_one(variant("a law of shear thinning", "law", {}, variants_of(shear_laws(0))),
                          {"critical_shear_rate", "critical_stress"});
}

TypePtr compressibility_format() { return variant("a density law", "law", {}, variants_of(density_laws())); }

}  // namespace

TypePtr lubricants_format() {
  const TypePtr lubricant =
      object("a lubricant",
             {
                 optional("grade", choice(grade_words()),
                          "An oil by its grade: viscosity and density, which other keys override.", "its own numbers"),
                 optional("viscosity", viscosity_format(),
                          "Dynamic viscosity mu0 at ambient pressure, or how it falls with temperature.",
                          "that of the grade, which is then required"),
                 optional("temperature", temperature("90 degC"),
                          "Of the oil in bearings that have no temperature of their own (`thermal`).",
                          "**required** there, where the viscosity falls with temperature"),
                 defaulted("pressure_viscosity", pressure_viscosity_format(), "0",
                           "How the viscosity rises with pressure: alpha in mu = mu0 exp(alpha p) (Barus), or "
                           "a law. p counts from the cavitation pressure."),
                 optional("shear_thinning", shear_thinning_format(),
                          "How the viscosity falls with the shear rate: with `thermal: {model: film}` that in each "
                          "layer, else that of sliding, speed over film thickness.",
                          "`none`, or what is typical of the grade"),
                 optional("density", quantity("kg/m^3", "850 kg/m^3", Range::positive()),
                          "Density of the liquid at ambient pressure; with a grade or `law: walther`, at 15 degC.",
                          "850 kg/m^3, or that of the grade"),
                 optional("thermal_expansion", quantity("1/K", "0.65e-3 1/K", Range::not_negative()),
                          "By which the oil grows per kelvin: `density` is then that at 15 degC, and falls from there. "
                          "In a film volumes are conserved, with the density at the temperature of its supply.",
                          "0.65e-3 1/K with a grade or `law: walther`, else 0"),
                 defaulted("specific_heat", quantity("J/kg/K", "2000 J/kg/K", Range::positive()), "2000 J/kg/K",
                           "Heat that warms it, of films with a temperature."),
                 defaulted("conductivity", quantity("W/m/K", "0.13 W/m/K", Range::not_negative()), "0.13 W/m/K",
                           "Of heat, of films with a temperature."),
                 defaulted("compressibility", compressibility_format(), "incompressible",
                           "How the density rises with pressure."),
             });
  return named("a mapping from names to lubricants", lubricant);
}

}  // namespace hersey::model
