#include "hersey/fem/solid_material.h"

#include <array>
#include <cmath>

#include "hersey/core/contract.h"

namespace hersey::fem {
namespace {

constexpr std::array<std::array<int, 2>, 6> entries_of_row = {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

/// T with sigma_body = T sigma_material for axes R: sigma_ij = R_ia R_jb sigma_ab.
Matrix6 stress_rotation(const Matrix3& R) {
  Matrix6 T;
  for (int row = 0; row < 6; ++row) {
    const auto [i, j] = entries_of_row[static_cast<std::size_t>(row)];
    for (int column = 0; column < 6; ++column) {
      const auto [a, b] = entries_of_row[static_cast<std::size_t>(column)];
      T(row, column) = R(i, a) * R(j, b) + (a != b ? R(i, b) * R(j, a) : 0);
    }
  }
  return T;
}

Matrix6 compliance(const OrthotropicMaterial& m) {
  Matrix6 C = Matrix6::Zero();
  C.diagonal() << 1 / m.E_1, 1 / m.E_2, 1 / m.E_3, 1 / m.G_12, 1 / m.G_23, 1 / m.G_13;
  C(0, 1) = C(1, 0) = -m.nu_12 / m.E_1;
  C(1, 2) = C(2, 1) = -m.nu_23 / m.E_2;
  C(0, 2) = C(2, 0) = -m.nu_13 / m.E_1;
  return C;
}

}  // namespace

SolidMaterial isotropic(const ElasticMaterial& material) {
  const double E = material.youngs_modulus, nu = material.poisson_ratio;
  HERSEY_REQUIRE(E > 0 && -1 < nu && nu < 0.5, "an isotropic solid resists stretching, shear and compression");
  HERSEY_REQUIRE(material.density >= 0, "mass is not negative");
  const double G = E / (2 * (1 + nu)), lame = E * nu / ((1 + nu) * (1 - 2 * nu));
  SolidMaterial solid{.density = material.density};
  solid.D.topLeftCorner<3, 3>().setConstant(lame);
  solid.D.diagonal() << Vector3::Constant(lame + 2 * G), Vector3::Constant(G);
  return solid;
}

bool is_stable(const OrthotropicMaterial& m) {
  for (const double modulus : {m.E_1, m.E_2, m.E_3, m.G_12, m.G_23, m.G_13})
    if (!(modulus > 0) || !std::isfinite(modulus)) return false;
  // Scaled to ones on the diagonal, so that the answer does not depend on units.
  const Matrix6 C = compliance(m);
  const Vector6 s = C.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Matrix6> cholesky(Matrix6(s.asDiagonal() * C * s.asDiagonal()));
  return cholesky.info() == Eigen::Success;
}

SolidMaterial orthotropic(const OrthotropicMaterial& m) {
  HERSEY_REQUIRE(is_stable(m) && m.density >= 0, "every strain stores energy");
  const Matrix6 T = stress_rotation(m.R);
  const Matrix6 own = compliance(m).inverse();
  return {.D = T * ((own + own.transpose()) / 2) * T.transpose(), .density = m.density};
}

double von_mises(const Vector6& s) {
  const double normal = std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2);
  return std::sqrt(normal / 2 + 3 * s.tail<3>().squaredNorm());
}

}  // namespace hersey::fem
