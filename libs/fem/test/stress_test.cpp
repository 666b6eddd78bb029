#include "hersey/fem/stress.h"

#include <doctest/doctest.h>

#include <limits>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/finite_strain.h"
#include "hersey/fem/load_vectors.h"
#include "hersey/fem/shape_stress.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace stress_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

TEST_CASE("Stress_OfALinearField_IsUniformAndItsEnergyThatOfK") {
  const Matrix3 gradient = 1e-4 * (Matrix3() << 1, 2, 3, -4, 5, 6, 7, -8, 9).finished();
  const Vector6 expected = steel.D * 1e-4 * (Vector6() << 1, 5, 9, -2, -2, 10).finished();
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(distorted_box(type), {steel});
    Eigen::VectorXd u(body.size());
    for (Eigen::Index a = 0; a < body.node_count(); ++a) u.segment<3>(3 * a) = gradient * body.mesh.nodes[a];
    const Stress stress = recover_stress(body, u);
    CHECK((stress.nodal.colwise() - expected).cwiseAbs().maxCoeff() < 1e4 * eps * expected.cwiseAbs().maxCoeff());
    CHECK((stress.element.colwise() - expected).cwiseAbs().maxCoeff() < 1e4 * eps * expected.cwiseAbs().maxCoeff());
    CHECK(stress.nodal_von_mises[1] == doctest::Approx(von_mises(expected)).epsilon(1e4 * eps));
    CHECK(stress.energy == doctest::Approx(0.5 * u.dot(body.K * u)).epsilon(1e4 * eps));
  }
}

TEST_CASE("StressOfFiniteStrain_RotatesWithTheBody") {
  // Stretched by U, then rotated by 1 rad: the stress is that of U alone in axes that rotate, and its energy.
  const Matrix3 R = Eigen::AngleAxisd(1, Vector3(1, 2, -2).normalized()).toRotationMatrix();
  const Matrix3 U = Matrix3::Identity() + 1e-2 * (Matrix3() << 1, 0.5, 0, 0.5, -1, 0.2, 0, 0.2, 2).finished();
  const Matrix3 E = 0.5 * (U * U - Matrix3::Identity());
  const Vector6 S = steel.D * (Vector6() << E.diagonal(), 2 * E(0, 1), 2 * E(1, 2), 2 * E(0, 2)).finished();
  const Matrix3 S_ = (Matrix3() << S[0], S[3], S[5], S[3], S[1], S[4], S[5], S[4], S[2]).finished();
  const Matrix3 sigma = R * U * S_ * U * R.transpose() / U.determinant();
  const Vector6 expected = (Vector6() << sigma.diagonal(), sigma(0, 1), sigma(1, 2), sigma(0, 2)).finished();
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(distorted_box(type), {steel});
    Eigen::VectorXd u(body.size());
    for (Eigen::Index a = 0; a < body.node_count(); ++a)
      u.segment<3>(3 * a) = (R * U - Matrix3::Identity()) * body.mesh.nodes[static_cast<std::size_t>(a)];
    const Stress stress = recover_stress(body.mesh, body.materials, u, Integration::full, StressMeasure::finite);
    CHECK((stress.nodal.colwise() - expected).cwiseAbs().maxCoeff() < 1e6 * eps * expected.cwiseAbs().maxCoeff());
    FiniteStrain strain;
    finite_strain(body, u, strain, false);
    CHECK(stress.energy == doctest::Approx(strain.energy).epsilon(1e4 * eps));
  }
}

TEST_CASE("StrainEnergy_OfAnyField_IsThatOfK") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(distorted_box(type), {steel});
    Eigen::VectorXd u(body.size());
    for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = 1e-3 * std::sin(7.0 * i);
    CHECK(recover_stress(body, u).energy == doctest::Approx(0.5 * u.dot(body.K * u)).epsilon(1e4 * eps));
  }
}

/// Quarter of a ring, r 30 to 45 mm, with 20 MPa in the bore; free ends.
struct Ring {
  ElasticBody body;
  Eigen::VectorXd u;
};

Ring pressed_ring(ElementType type, int radial, int around) {
  Mesh mesh = box_mesh(type, {1, 1, 1}, {radial, around, 2});
  for (Vector3& x : mesh.nodes) {
    const double r = 0.03 + 0.015 * x.x(), phi = std::numbers::pi / 2 * x.y();
    x = {r * std::cos(phi), r * std::sin(phi), 0.02 * x.z()};
  }
  ElasticBody body = assemble(mesh, {steel});
  std::vector<Support> supports;
  const auto hold = [&](const char* set, int axis) {
    for (const int node : mesh.node_sets.at(set)) supports.push_back({3 * node + axis, 0});
  };
  hold("y0", 1);
  hold("y1", 0);
  hold("z0", 2);
  const StaticSolution solution = solve_static(body, supports, pressure_load(mesh, mesh.surfaces.at("x0"), 20e6));
  REQUIRE(solution.solved());
  return {std::move(body), solution.u.col(0)};
}

TEST_CASE("ShapeStress_IsThatOfTheDisplacedBody") {
  for (const ElementType type : {ElementType::hex8, ElementType::hex20}) {
    const Ring ring = pressed_ring(type, 2, 3);
    Eigen::MatrixXd shapes(ring.u.size(), 3);
    for (Eigen::Index k = 0; k < 3; ++k)
      for (Eigen::Index i = 0; i < shapes.rows(); ++i) shapes(i, k) = std::sin(0.7 * static_cast<double>(i + k * k));
    const Eigen::Vector3d q(1e-6, -3e-6, 2e-6);
    const auto by_shapes = ShapeStress(ring.body.mesh, ring.body.materials, shapes).nodal(q);
    const auto at_once = recover_stress(ring.body.mesh, ring.body.materials, shapes * q).nodal;
    CHECK((by_shapes - at_once).norm() < 100 * eps * at_once.norm());
  }
}

TEST_CASE("ThickRing_MeetsLamesStressesAndDisplacement") {
  const Ring ring = pressed_ring(ElementType::hex20, 6, 10);
  const Stress stress = recover_stress(ring.body, ring.u);
  const double r_i = 0.03, r_o = 0.045, p = 20e6, A = p * r_i * r_i / (r_o * r_o - r_i * r_i);
  double worst = 0, radial_at_bore = 0;
  for (std::size_t a = 0; a < ring.body.mesh.nodes.size(); ++a) {
    const Vector3& x = ring.body.mesh.nodes[a];
    const double r = std::hypot(x.x(), x.y()), c = x.x() / r, s = x.y() / r;
    const Vector6 at = stress.nodal.col(static_cast<Eigen::Index>(a));
    const double hoop = s * s * at[0] + c * c * at[1] - 2 * s * c * at[3];
    const double radial = c * c * at[0] + s * s * at[1] + 2 * s * c * at[3];
    worst = std::max(
        {worst, std::abs(hoop - A * (1 + r_o * r_o / (r * r))), std::abs(radial - A * (1 - r_o * r_o / (r * r)))});
    if (r < r_i * (1 + 1e-9)) {  // which nodes they are
      const double u_r = ring.u.segment<3>(3 * a).dot(Vector3(c, s, 0));
      radial_at_bore = std::max(radial_at_bore, std::abs(u_r / 8.285714285714285e-06 - 1));
    }
  }
  CHECK(worst < 0.02 * 52e6);    // 52 MPa at the bore; elements of a twelfth of the radius
  CHECK(radial_at_bore < 1e-4);  // six quadratic elements across
}

}  // namespace stress_test
}  // namespace hersey::fem
