#pragma once

#include "hersey/core/spatial.h"
#include "hersey/fem/elastic_material.h"

namespace hersey::fem {

/// Linearly elastic material, sigma = D epsilon, (elastic.3). The components are in the order xx, yy, zz, xy, yz, xz;
/// shear strains are engineering strains, twice the tensor's.
struct SolidMaterial {
  Matrix6 D = Matrix6::Zero();  ///< stiffness [Pa], in the body's axes
  double density = 0;           ///< [kg/m^3]
};

/// Returns D of an isotropic material. @throws ContractError unless E > 0, -1 < nu < 0.5, rho >= 0
[[nodiscard]] SolidMaterial isotropic(const ElasticMaterial& material);

/// Nine constants in the material's own axes 1, 2, 3; nu_ij is the contraction along j under tension along i.
struct OrthotropicMaterial {
  double E_1 = 0, E_2 = 0, E_3 = 0;        ///< [Pa]
  double nu_12 = 0, nu_23 = 0, nu_13 = 0;  ///< [-]
  double G_12 = 0, G_23 = 0, G_13 = 0;     ///< [Pa]
  double density = 0;                      ///< [kg/m^3]
  Matrix3 R = Matrix3::Identity();         ///< the material's axes in those of the body
};

/// True if every strain stores a positive energy; other constants belong to no material.
[[nodiscard]] bool is_stable(const OrthotropicMaterial& material);

/// Returns D of an orthotropic material, (elastic.4). @throws ContractError unless is_stable(material)
[[nodiscard]] SolidMaterial orthotropic(const OrthotropicMaterial& material);

/// Returns the equivalent stress sqrt(3/2 s:s), s the deviator of `stress` [Pa].
[[nodiscard]] double von_mises(const Vector6& stress);

}  // namespace hersey::fem
