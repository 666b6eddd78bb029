#include "hersey/fem/finite_strain.h"

#include <doctest/doctest.h>

#include <limits>

#include "elastic_large_displacement.h"
#include "hersey/fem/load_vectors.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace finite_strain_test {

constexpr double kDifferences = 1e-8;  // central differences of step 1e-5: h^2, and round-off over h

constexpr double eps = std::numeric_limits<double>::epsilon();
const SolidMaterial rubbery = isotropic({.youngs_modulus = 100, .poisson_ratio = 0.3, .density = 1});

NodeColumns large_displacement(const NodeColumns& x) {
  NodeColumns u(3, x.cols());
  for (Eigen::Index a = 0; a < x.cols(); ++a)
    u.col(a) = 0.2 * Vector3(std::sin(3.0 * a), std::cos(2.0 * a), std::sin(a + 1.0));
  return u;
}

TEST_CASE("FiniteStrainForce_IsTheGradientOfTheEnergy_AndTheTangentThatOfTheForce") {
  const double h = 1e-5;
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const NodeColumns x = distorted_element(type), u = large_displacement(x);
    const FiniteStrainElement here = finite_strain_element(type, x, rubbery, u);
    CHECK((here.tangent - here.tangent.transpose()).norm() < 1000 * eps * here.tangent.norm());
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      NodeColumns plus = u, minus = u;
      plus.data()[i] += h;
      minus.data()[i] -= h;
      const auto p = finite_strain_element(type, x, rubbery, plus), m = finite_strain_element(type, x, rubbery, minus);
      CHECK(std::abs((p.energy - m.energy) / (2 * h) - here.force[i]) < kDifferences * here.force.norm());
      CHECK(((p.force - m.force) / (2 * h) - here.tangent.col(i)).norm() < kDifferences * here.tangent.norm());
    }
  }
}

TEST_CASE("FiniteStrain_AtRestIsTheLinearBody_AndARotationStoresNothing") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(distorted_box(type), {rubbery});
    FiniteStrain strain;
    finite_strain(body, Eigen::VectorXd::Zero(body.size()), strain);
    CHECK(strain.energy == 0);
    CHECK((strain.tangent - body.K).norm() < 1000 * eps * body.K.norm());
    const Matrix3 Q = rotation_exp({1.9, -0.7, 1.2}).toRotationMatrix();
    Eigen::VectorXd u(body.size());
    for (Eigen::Index a = 0; a < body.node_count(); ++a) {
      const Vector3& x = body.mesh.nodes[a];
      u.segment<3>(3 * a) = Q * x - x + Vector3(1, 2, 3);
    }
    finite_strain(body, u, strain);
    CHECK(strain.energy < 1e6 * eps * eps * body.K.norm());
    CHECK(strain.force.norm() < 1e4 * eps * body.K.norm());
  }
}

TEST_CASE("BarPulledFar_CarriesTheForceOfStVenantAndKirchhoff") {
  const SolidMaterial material = isotropic({.youngs_modulus = 100, .poisson_ratio = 0, .density = 1});
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(box_mesh(type, {1, 0.2, 0.3}, {2, 1, 1}), {material});
    std::vector<Support> supports;
    for (int k = 0; k < 3; ++k)
      for (const int node : body.mesh.node_sets.at(std::string(1, static_cast<char>('x' + k)) + "0"))
        supports.push_back({3 * node + k, 0});
    for (const int node : body.mesh.node_sets.at("x1")) supports.push_back({3 * node, 0.5});
    const auto pulled = verification::solve_large_displacement(body, supports, Eigen::VectorXd::Zero(body.size()));
    REQUIRE(pulled.load == 1);
    FiniteStrain strain;
    finite_strain(body, pulled.u, strain);
    double force = 0;
    for (const int node : body.mesh.node_sets.at("x1")) force += strain.force[3 * node];
    // lambda = 1.5: E_xx = (lambda^2 - 1)/2, force = lambda E E_xx A.
    CHECK(force == doctest::Approx(1.5 * 100 * 0.625 * 0.06).epsilon(1e-9));  // Newton's tolerance is 1e-10 of the size
  }
}

TEST_CASE("SlenderBar_BendsLikeTheElastica") {
  // 1 x 0.02 x 0.02, nu = 0, P L^2/(E I) = 5.
  const SolidMaterial material = isotropic({.youngs_modulus = 1e9, .poisson_ratio = 0, .density = 1});
  const double b = 0.02, P = 5 * 1e9 * b * b * b * b / 12;
  for (const ElementType type : {ElementType::hex20, ElementType::hex8}) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(box_mesh(type, {1, b, b}, {40, 1, 1}), {material});
    const Eigen::VectorXd f = traction_load(body.mesh, body.mesh.surfaces.at("x1"),
                                            [&](const Vector3&, const Vector3&) { return Vector3(0, P / (b * b), 0); });
    std::vector<Support> supports;
    for (const int dof : dofs_of(body.mesh.node_sets.at("x0"))) supports.push_back({dof, 0});
    const auto bent = verification::solve_large_displacement(body, supports, f);
    REQUIRE(bent.load == 1);
    double tip = 0;
    const std::vector<int>& end = body.mesh.node_sets.at("x1");
    for (const int node : end) tip += bent.u[3 * node + 1] / static_cast<double>(end.size());
    // Shear and the stretch along the beam, both of the order (b/L)^2, and 40 elements: half a percent.
    CHECK(tip == doctest::Approx(0.7137915236119133).epsilon(0.005).scale(0));
  }
}

TEST_CASE("BodyWithoutSupports_FindsNoLargeDisplacement") {
  const ElasticBody body = assemble(box_mesh(ElementType::hex8, {1, 1, 1}, {1, 1, 1}), {rubbery});
  CHECK(verification::solve_large_displacement(body, {}, gravity_load(body, {0, 0, -1})).load == 0);
}

}  // namespace finite_strain_test
}  // namespace hersey::fem
