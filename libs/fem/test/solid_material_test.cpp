#include "hersey/fem/solid_material.h"

#include <doctest/doctest.h>

#include <limits>

#include "hersey/core/contract.h"

namespace hersey::fem {
namespace solid_material_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

OrthotropicMaterial ply() {
  return {.E_1 = 140e9,
          .E_2 = 10e9,
          .E_3 = 9e9,
          .nu_12 = 0.3,
          .nu_23 = 0.4,
          .nu_13 = 0.28,
          .G_12 = 5e9,
          .G_23 = 3e9,
          .G_13 = 4e9,
          .density = 1600};
}

TEST_CASE("Isotropic_UniaxialStressGivesYoungAndPoisson") {
  const SolidMaterial m = isotropic({.youngs_modulus = 70e9, .poisson_ratio = 0.33, .density = 2700});
  const Vector6 strain = m.D.ldlt().solve(Vector6::Unit(0) * 70e6);
  CHECK(strain[0] == doctest::Approx(1e-3).epsilon(20 * eps));
  CHECK(strain[1] == doctest::Approx(-0.33e-3).epsilon(20 * eps));
  CHECK(m.D(3, 3) == doctest::Approx(70e9 / 2.66).epsilon(20 * eps));
}

TEST_CASE("Orthotropic_WithEqualConstantsIsIsotropicInAnyAxes") {
  const double E = 70e9, nu = 0.33, G = E / (2 * (1 + nu));
  const Matrix3 R = rotation_exp({0.3, -0.7, 1.1}).toRotationMatrix();
  const SolidMaterial rotated = orthotropic({E, E, E, nu, nu, nu, G, G, G, 2700, R});
  const SolidMaterial plain = isotropic({E, nu, 2700});
  CHECK((rotated.D - plain.D).cwiseAbs().maxCoeff() < 100 * eps * plain.D.maxCoeff());
  CHECK(rotated.density == 2700);
}

TEST_CASE("Orthotropic_RotatedByARightAngle_SwapsItsAxes") {
  OrthotropicMaterial m = ply();
  const SolidMaterial straight = orthotropic(m);
  m.R << 0, -1, 0, 1, 0, 0, 0, 0, 1;  // axis 1 along y
  const SolidMaterial rotated = orthotropic(m);
  CHECK(rotated.D(1, 1) == doctest::Approx(straight.D(0, 0)).epsilon(100 * eps));
  CHECK(rotated.D(1, 2) == doctest::Approx(straight.D(0, 2)).epsilon(100 * eps));
  CHECK(rotated.D(4, 4) == doctest::Approx(m.G_13).epsilon(100 * eps));
  const Vector6 strain = rotated.D.ldlt().solve(Vector6::Unit(1));
  CHECK(1 / strain[1] == doctest::Approx(m.E_1).epsilon(1000 * eps));
  CHECK(-strain[0] / strain[1] == doctest::Approx(m.nu_12).epsilon(1000 * eps));
}

TEST_CASE("ImpossibleMaterials_AreRefused") {
  CHECK_THROWS_AS((void)isotropic({.youngs_modulus = 0, .poisson_ratio = 0.3}), ContractError);
  CHECK_THROWS_AS((void)isotropic({.youngs_modulus = 1, .poisson_ratio = 0.5}), ContractError);
  OrthotropicMaterial m = ply();
  CHECK(is_stable(m));
  m.nu_12 = 4;  // beyond sqrt(E_1/E_2) = 3.74
  CHECK_FALSE(is_stable(m));
  CHECK_THROWS_AS((void)orthotropic(m), ContractError);
  m = ply();
  m.G_23 = 0;
  CHECK_FALSE(is_stable(m));
}

TEST_CASE("VonMises_OfUniaxialShearAndHydrostaticStress") {
  CHECK(von_mises((Vector6() << 5, 0, 0, 0, 0, 0).finished()) == doctest::Approx(5));
  CHECK(von_mises((Vector6() << 0, 0, 0, 0, 2, 0).finished()) == doctest::Approx(2 * std::sqrt(3.0)));
  CHECK(von_mises((Vector6() << 7, 7, 7, 0, 0, 0).finished()) == 0);
}

}  // namespace solid_material_test
}  // namespace hersey::fem
