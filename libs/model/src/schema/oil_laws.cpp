#include "schema/oil_laws.h"

#include "check/members.h"

namespace hersey::model {
namespace {

TypePtr compressibility() { return quantity("1/Pa", "0.6e-9 1/Pa", Range::not_negative()); }

}  // namespace

TypePtr temperature(const std::string& example) { return quantity("K", example, {.low = 150, .high = 1000}); }

const std::vector<Alternative<film::ViscosityLaw>>& viscosity_laws() {
  static const std::vector<Alternative<film::ViscosityLaw>> laws{
      {{"barus",
        "mu = mu0 exp(alpha p)",
        {required("alpha", quantity("1/Pa", "1.28e-10 1/Pa", Range::not_negative()), "Its coefficient.")}},
       [](const Value& law) { return film::Barus{number_of(law, "alpha")}; }},
      {{"roelands",
        "ln mu + 9.67 = (ln mu0 + 9.67) (1 + p/196.2 MPa)^z with mu in Pa.s",
        {required("z", number("0.6", {.low = 0, .high = 2}), "Pressure-viscosity index; mineral oils: 0.5 to 0.7.")}},
       [](const Value& law) { return film::Roelands{number_of(law, "z")}; }},
  };
  return laws;
}

std::vector<Alternative<film::TemperatureLaw>> temperature_laws(double rho15, double expansion) {
  const TypePtr mu = quantity("Pa.s", "27.7 mPa.s", Range::positive());
  const TypePtr nu = quantity("m^2/s", "46 mm^2/s", {.low = 0.5e-6});
  const TypePtr T = temperature("40 degC");
  return {
      {{"exponential",
        "mu = viscosity exp(-coefficient (T - reference))",
        {required("viscosity", mu, "At the reference temperature."), required("reference", T, "That temperature."),
         required("coefficient", quantity("1/K", "0.034 1/K", Range::not_negative()), "Relative fall per kelvin.")}},
       [](const Value& law) {
         return film::ExponentialViscosity{number_of(law, "viscosity"), number_of(law, "reference"),
                                           number_of(law, "coefficient")};
       }},
      {{"vogel",
        "mu = a exp(b/(T - c))",
        {required("a", quantity("Pa.s", "6.35e-5 Pa.s", Range::positive()), "Its limit at high temperatures."),
         required("b", quantity("K", "846 K", Range::not_negative()), "How it rises towards c."),
         required("c", quantity("K", "100 K", Range::not_negative()), "Where it would be infinite.")}},
       [](const Value& law) {
         return film::VogelViscosity{number_of(law, "a"), number_of(law, "b"), number_of(law, "c")};
       }},
      {{"walther",
        "log10 log10 (nu + 0.7) = A - B log10 T, nu in mm^2/s (ASTM D341), and nu times the density at T",
        {required("nu40", nu, "Kinematic viscosity at 40 degC."), required("nu100", nu, "At 100 degC.")}},
       [rho15, expansion](const Value& law) {
         auto walther = film::WaltherViscosity::through(number_of(law, "nu40"), number_of(law, "nu100"), rho15);
         walther.expansion = expansion;
         return walther;
       }},
      {{"table",
        "ln mu is linear in 1/T between given viscosities, and in p, and beyond them as in the interval beside",
        {required("temperatures", list("temperatures", T), "Ascending."),
         optional("pressures", list("pressures", quantity("Pa", "100 MPa", Range::not_negative())),
                  "Ascending from 0, counted from the cavitation pressure.", "`pressure_viscosity` says what p does"),
         required("viscosities",
                  list("viscosities",
                       any_of("a viscosity, or a list of them over pressures", {mu, list("viscosities", mu)})),
                  "One for each temperature, none larger than the last; or a list of one for each pressure.")}},
       [](const Value& law) {
         film::TabledViscosity table;
         for (const Member& item : law.find("temperatures")->members) table.T.push_back(item.value.number);
         table.mu = column_of(law, 0);
         return table;
       }},
  };
}

std::vector<double> column_of(const Value& table, std::size_t k) {
  std::vector<double> column;
  for (const Member& row : table.find("viscosities")->members) {
    const Value& value = row.value.members.front().value;
    column.push_back(value.members.empty() ? value.number : value.members[k].value.number);
  }
  return column;
}

std::vector<Alternative<film::ShearLaw>> shear_laws(double limit) {
  const auto with_limits = [](std::vector<Key> keys) {
    keys.push_back(
        optional("limit_ratio", number("0.6", {.low = 0, .high = 1}), "mu_inf/mu0, what no shear takes.", "0"));
    keys.push_back(optional(
        "limit_viscosity", quantity("Pa.s", "6 mPa.s", Range::positive()),
        "mu_inf instead of its ratio, at the lubricant's `temperature`; at others in the same ratio to mu0.", "0"));
    keys.push_back(optional("critical_shear_rate", quantity("1/s", "1e6 1/s", Range::positive()),
                            "Where it has begun, at every temperature.", "by the stress"));
    keys.push_back(optional("critical_stress", quantity("Pa", "10 kPa", Range::positive()),
                            "That rate times the viscosity at rest: the rate rises as heat thins the oil.",
                            "by the rate"));
    return keys;
  };
  return {
      {{"none", "the same viscosity at every shear rate", {}}, [](const Value&) { return film::Newtonian{}; }},
      {{"cross", "mu = mu_inf + (mu0 - mu_inf)/(1 + x^exponent), x the shear rate over the critical one",
        with_limits({required("exponent", number("0.8", {.low = 0, .high = 10, .low_open = true}),
                              "How soon the oil thins; at most 1, or so that more shear always takes more stress.")})},
       [limit](const Value& law) {
         return film::Cross{limit, number_of(law, "exponent")};
       }},
      {{"carreau", "mu = mu_inf + (mu0 - mu_inf) (1 + x^transition)^((exponent - 1)/transition) (Carreau, Yasuda)",
        with_limits(
            {required("exponent", number("0.7", {.low = 0, .high = 1}),
                      "Power of the rate with which stress grows where mu_inf is nothing; 1: no thinning."),
             defaulted("transition", number("2", Range::positive()), "2", "How suddenly it begins; Carreau's is 2.")})},
       [limit](const Value& law) {
         return film::Carreau{limit, number_of(law, "exponent"), number_of(law, "transition")};
       }},
  };
}

const std::vector<Alternative<film::DensityLaw>>& density_laws() {
  static const std::vector<Alternative<film::DensityLaw>> laws{
      {{"incompressible", "the density does not depend on pressure", {}},
       [](const Value&) { return film::Incompressible{}; }},
      {{"dowson_higginson",
        "rho = rho0 (1 + rise p/(1 + saturation p))",
        {defaulted("rise", compressibility(), "0.6e-9 1/Pa", "Compressibility at p = 0."),
         defaulted("saturation", compressibility(), "1.7e-9 1/Pa", "How soon it wears off.")}},
       [](const Value& law) {
         return film::DowsonHigginson{number_of(law, "rise"), number_of(law, "saturation")};
       }},
      {{"constant_bulk_modulus",
        "rho = rho0 exp(p/bulk_modulus)",
        {required("bulk_modulus", quantity("Pa", "1.5 GPa", {.low = 1e5}),
                  "rho dp/drho, the same at every pressure; oils: about 1.5 GPa.")}},
       [](const Value& law) { return film::ConstantBulkModulus{number_of(law, "bulk_modulus")}; }},
      {{"bubbly",
        "a homogeneous mixture of oil and small gas bubbles, compressed at one temperature: rho = rho0 (1 + r)/(1 + r "
        "P/(P + p)), r = gas_fraction/(1 - gas_fraction); `density` and `viscosity` are those of the mixture at p = 0",
        {required("gas_fraction", number("0.1", {.low = 0, .high = 0.9}),
                  "Of the mixture's volume at the cavitation pressure."),
         defaulted("pressure", quantity("Pa", "1 bar", Range::positive()), "1.01325 bar",
                   "P, the cavitation pressure on the absolute scale.")}},
       [](const Value& law) {
         return film::BubblyOil{number_of(law, "gas_fraction"), number_of(law, "pressure")};
       }},
  };
  return laws;
}

}  // namespace hersey::model
