#include "hersey/fem/elastic_material.h"

#include "hersey/core/contract.h"

namespace hersey::fem {
namespace {

/// (1 - nu^2)/E: compliance in plane strain [1/Pa].
double plane_strain_compliance(const ElasticMaterial& material) {
  const double nu = material.poisson_ratio;
  HERSEY_REQUIRE(material.youngs_modulus > 0, "a solid resists stretching");
  HERSEY_REQUIRE(-1 < nu && nu < 0.5, "an isotropic solid resists shear and compression");
  return (1 - nu * nu) / material.youngs_modulus;
}

}  // namespace

double composite_modulus(const ElasticMaterial& a, const ElasticMaterial& b) {
  return 1 / (plane_strain_compliance(a) + plane_strain_compliance(b));
}

}  // namespace hersey::fem
