#include "oil_laws.h"

#include "interpret.h"

namespace hersey::model {
namespace {

TypePtr compressibility() { return quantity("1/Pa", "0.6e-9 1/Pa", Range::not_negative()); }

}  // namespace

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
  };
  return laws;
}

}  // namespace hersey::model
