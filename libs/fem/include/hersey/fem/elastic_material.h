#pragma once

namespace hersey::fem {

/// Constants of an isotropic, linearly elastic material.
struct ElasticMaterial {
  double youngs_modulus = 0;  ///< E [Pa], > 0
  double poisson_ratio = 0;   ///< nu [-], -1 < nu < 0.5
  double density = 0;         ///< rho [kg/m^3], >= 0; 0 where inertia plays no part
};

/// Composite elastic modulus of two contacting bodies,  1/E = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2.
///
/// @returns E [Pa] of two half-spaces in series; it lies between half of the smaller plane-strain modulus and the whole
/// of it.
/// @throws ContractError if a modulus is not positive or a Poisson ratio lies outside (-1, 0.5).
/// @see Choi (2012), Eq. 27; Johnson (1985), Contact Mechanics, Eq. 4.18 (there E*).
/// @verified_by elastic_material_test.cpp
[[nodiscard]] double composite_modulus(const ElasticMaterial& a, const ElasticMaterial& b);

}  // namespace hersey::fem
