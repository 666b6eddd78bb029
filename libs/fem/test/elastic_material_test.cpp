#include "hersey/fem/elastic_material.h"

#include <doctest/doctest.h>

#include <limits>

#include "hersey/core/contract.h"

namespace hersey::fem {
namespace elastic_material_test {

constexpr double round_off = 4 * std::numeric_limits<double>::epsilon();  // four roundings lie in the formula

TEST_CASE("CompositeModulus_OfEqualBodies_IsHalfThePlaneStrainModulus") {
  const ElasticMaterial steel{.youngs_modulus = 210e9, .poisson_ratio = 0.3};
  CHECK(composite_modulus(steel, steel) == doctest::Approx(210e9 / (2 * 0.91)).epsilon(round_off));
}

TEST_CASE("CompositeModulus_OfSoftOnRigid_IsThePlaneStrainModulusOfTheSoft") {
  const ElasticMaterial soft{.youngs_modulus = 57e9, .poisson_ratio = 0.25};
  const ElasticMaterial rigid{.youngs_modulus = 57e9 * 1e18, .poisson_ratio = 0.25};
  CHECK(composite_modulus(soft, rigid) == doctest::Approx(57e9 / (1 - 0.0625)).epsilon(round_off));
  CHECK(composite_modulus(rigid, soft) == composite_modulus(soft, rigid));
}

TEST_CASE("CompositeModulus_OfImpossibleMaterials_IsRejected") {
  const ElasticMaterial steel{.youngs_modulus = 210e9, .poisson_ratio = 0.3};
  CHECK_THROWS_AS((void)composite_modulus(steel, {.youngs_modulus = 0, .poisson_ratio = 0.3}), ContractError);
  CHECK_THROWS_AS((void)composite_modulus(steel, {.youngs_modulus = 1e9, .poisson_ratio = 0.5}), ContractError);
  CHECK_THROWS_AS((void)composite_modulus({.youngs_modulus = 1e9, .poisson_ratio = -1}, steel), ContractError);
}

}  // namespace elastic_material_test
}  // namespace hersey::fem
