#include "hersey/fem/elastic_body.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "hersey/core/input_error.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace elastic_body_test {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Holds the nodes where `outer` says so in the field of the patch test, solves for the others and compares.
void check_patch(const Mesh& mesh, const std::function<bool(const Vector3&)>& outer, Integration integration) {
  const SolidMaterial material = isotropic({.youngs_modulus = 1e6, .poisson_ratio = 0.25, .density = 1});
  const ElasticBody body = assemble(mesh, {material}, integration);
  const Matrix3 gradient = 0.5e-3 * (Matrix3() << 2, 1, 1, 1, 2, 1, 1, 1, 2).finished();
  Eigen::VectorXd exact(body.size());
  std::vector<char> fixed(static_cast<std::size_t>(body.size()), 0);
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    exact.segment<3>(3 * a) = gradient * mesh.nodes[a];
    for (int i = 0; i < 3; ++i) fixed[3 * a + i] = outer(mesh.nodes[a]);
  }
  REQUIRE(std::count(fixed.begin(), fixed.end(), 0) > 0);
  const Eigen::VectorXd u = solve_dense(Eigen::MatrixXd(body.K), Eigen::VectorXd::Zero(body.size()), fixed, exact);
  CHECK((u - exact).cwiseAbs().maxCoeff() < 1e4 * eps * exact.cwiseAbs().maxCoeff());  // condition number of K: 1e3
  const Vector6 stress = (Vector6() << 2000, 2000, 2000, 400, 400, 400).finished();
  for (const Element& e : mesh.elements) {
    NodeColumns of_element(3, node_count(e.type));
    for (int a = 0; a < node_count(e.type); ++a) of_element.col(a) = u.segment<3>(3 * mesh.nodes_of(e)[a]);
    for (const auto& [xi, w] : stiffness_points(e.type, integration)) {
      const Vector6 strain = element_strain(e.type, body.positions_of(e), material, of_element, {xi});
      CHECK((material.D * strain - stress).cwiseAbs().maxCoeff() < 1e5 * eps * 2000);
    }
  }
}

bool on_unit_cube(const Vector3& x) { return (x.array() - 0.5).abs().maxCoeff() > 0.5 - 1e-9; }

TEST_CASE("PatchTest_OfMacNealAndHarder_IsPassedToRoundOff") {
  check_patch(macneal_harder(ElementType::hex8), on_unit_cube, Integration::full);
  check_patch(macneal_harder(ElementType::hex20), on_unit_cube, Integration::full);
  check_patch(macneal_harder(ElementType::hex20), on_unit_cube, Integration::reduced);
}

TEST_CASE("PatchTest_OnADistortedBox_IsPassedByEveryElement") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const Mesh straight = box_mesh(type, {1, 0.8, 1.3}, {2, 2, 2});
    const Mesh mesh = distorted_box(type);
    const Vector3 middle = 0.5 * Vector3(1, 0.8, 1.3);
    // Nodes inside the straight box are free; both meshes number alike.
    std::map<std::array<double, 3>, bool> is_outer;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      const Vector3 relative = (straight.nodes[a] - middle).cwiseQuotient(middle);
      is_outer[{mesh.nodes[a][0], mesh.nodes[a][1], mesh.nodes[a][2]}] = relative.cwiseAbs().maxCoeff() > 1 - 1e-9;
    }
    check_patch(
        mesh,
        [&](const Vector3& x) {
          return is_outer.at({x[0], x[1], x[2]});
        },
        Integration::full);
  }
}

TEST_CASE("RigidMotions_NeedNoForce") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(distorted_box(type), {steel});
    const Eigen::MatrixXd rigid = rigid_motions(body.mesh, {0.3, -0.2, 0.1});
    CHECK((body.K * rigid).cwiseAbs().maxCoeff() < 1000 * eps * body.K.coeffs().maxCoeff());
    CHECK((Eigen::MatrixXd(body.K) - Eigen::MatrixXd(body.K).transpose()).norm() < 100 * eps * body.K.norm());
  }
}

TEST_CASE("MassCentreAndInertia_OfABoxAreExact") {
  const Vector3 size(0.3, 0.2, 0.5);
  const double mass = 7850 * size.prod();
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(box_mesh(type, size, {2, 1, 3}), {steel});
    CHECK(body.mass == doctest::Approx(mass).epsilon(1000 * eps));
    CHECK((body.centre - size / 2).norm() < 1000 * eps);
    for (int k = 0; k < 3; ++k)
      CHECK(body.inertia(k, k) ==
            doctest::Approx(mass / 12 * (size.squaredNorm() - size[k] * size[k])).epsilon(1000 * eps));
    CHECK((body.inertia - Matrix3(body.inertia.diagonal().asDiagonal())).norm() < 1000 * eps * body.inertia.norm());
    // The mass matrix gives the same: M of rigid motions about the centre.
    const Eigen::MatrixXd rigid = rigid_motions(body.mesh, body.centre);
    const Matrix6 M = rigid.transpose() * mass_times(body.m, rigid);
    CHECK((M.topLeftCorner<3, 3>() - body.inertia).norm() < 1000 * eps * body.inertia.norm());
    CHECK((M.bottomRightCorner<3, 3>() - mass * Matrix3::Identity()).norm() < 1000 * eps * mass);
  }
}

/// Tip deflection of a clamped bar 10 x 1 x 1 with one layer of `type` under a pure end moment, over that of the beam
/// theory (nu = 0).
double bending_ratio(ElementType type, double skew_by) {
  Mesh mesh = box_mesh(type, {10, 1, 1}, {6, 1, 1});
  for (Vector3& x : mesh.nodes) x.x() += skew_by * (x.z() - 0.5) * std::sin(std::numbers::pi * x.x() / 10);
  straighten(mesh);
  const ElasticBody body = assemble(mesh, {isotropic({.youngs_modulus = 1e7, .poisson_ratio = 0, .density = 1})});
  Eigen::VectorXd f = Eigen::VectorXd::Zero(body.size());
  // A linear traction -2 (z - 1/2) on the end: nodal forces of the bilinear quad.
  for (const int a : mesh.node_sets.at("x1")) f[3 * a] = mesh.nodes[a].z() > 0.5 ? -1.0 / 12 * 2 : 1.0 / 12 * 2;
  std::vector<char> fixed(static_cast<std::size_t>(body.size()), 0);
  // Which node it is.
  for (const int a : mesh.node_sets.at("x0"))
    for (int i = 0; i < 3; ++i)
      fixed[3 * a + i] = i == 0 || mesh.nodes[a].norm() < 1e-9 || (i == 2 && mesh.nodes[a].z() == 0);
  const Eigen::VectorXd u = solve_dense(Eigen::MatrixXd(body.K), f, fixed, Eigen::VectorXd::Zero(body.size()));
  double tip = 0;
  for (const int a : mesh.node_sets.at("x1")) tip += u[3 * a + 2] / 4;
  const double moment = 2.0 / 12 * 2, curvature = moment / (1e7 / 12);
  return tip / (curvature * 100 / 2);
}

TEST_CASE("Hex8_InBending_DoesNotLock") {
  CHECK(bending_ratio(ElementType::hex8, 0) == doctest::Approx(1).epsilon(1e-9));  // exact for rectangular elements
  CHECK(bending_ratio(ElementType::hex8, 0.5) > 0.9);                              // skewed by up to 27 degrees
  CHECK(bending_ratio(ElementType::tet4, 0) < 0.3);                                // what locking looks like
}

TEST_CASE("MeshesThatAreNoBody_AreReportedByLabel") {
  const auto fault = [](const Mesh& mesh) -> std::string {
    try {
      (void)assemble(mesh, {steel});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  Mesh folded = box_mesh(ElementType::hex8, {1, 1, 1}, {2, 1, 1});
  std::swap(folded.connectivity[8], folded.connectivity[12]);
  CHECK(fault(folded).find("elements 2 are folded or inside out") != std::string::npos);
  Mesh loose = box_mesh(ElementType::tet4, {1, 1, 1}, {1, 1, 1});
  loose.nodes.emplace_back(2, 2, 2);
  loose.node_labels.push_back(77);
  CHECK(fault(loose).find("nodes 77 belong to no element") != std::string::npos);
  Mesh beam = box_mesh(ElementType::tet4, {1, 1, 1}, {1, 1, 1});
  beam.elements.push_back({.type = ElementType::beam2, .label = 9, .first = 0});
  CHECK(fault(beam).find("elements 9 are beams") != std::string::npos);
  CHECK(fault(Mesh{}).find("without elements") != std::string::npos);
}

}  // namespace elastic_body_test
}  // namespace hersey::fem
