#include "hersey/fem/thermal_expansion.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/heat_conduction.h"
#include "hersey/fem/stress.h"
#include "ring.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace thermal_expansion_test {

using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double alpha = 12e-6, E = 2.1e11, nu = 0.3;  // those of `steel`
const std::vector<ThermalMaterial> expands = {{.conductivity = 46, .expansion = alpha}};

/// Six degrees of freedom at three corners, as many as hold the body and no more.
std::vector<Support> statically(const Mesh& mesh) {
  const std::vector<int> corners = {0, mesh.node_sets.at("x1").front(), mesh.node_sets.at("y1").front()};
  Eigen::MatrixXd supported(9, 6);
  const Eigen::MatrixXd motions = rigid_motions(mesh, mesh.nodes[0]);
  for (int c = 0; c < 3; ++c)
    supported.middleRows<3>(3 * c) = motions.middleRows<3>(3 * corners[static_cast<std::size_t>(c)]);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(supported.transpose());
  std::vector<Support> supports;
  for (int i = 0; i < 6; ++i) {
    const int row = qr.colsPermutation().indices()[i];
    supports.push_back({3 * corners[static_cast<std::size_t>(row / 3)] + row % 3, 0});
  }
  return supports;
}

VectorXd rises_of(const Mesh& mesh, double constant, const Vector3& gradient) {
  VectorXd rise(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (Eigen::Index a = 0; a < rise.size(); ++a)
    rise[a] = constant + gradient.dot(mesh.nodes[static_cast<std::size_t>(a)]);
  return rise;
}

double largest_stress(const ElasticBody& body, const VectorXd& rise) {
  const StaticSolution solution = solve_static(body, statically(body.mesh), expansion_load(body, expands, rise));
  REQUIRE(solution.solved());
  return recover_stress(body, solution.u.col(0), expands, rise).nodal.cwiseAbs().maxCoeff();
}

TEST_CASE("BodyThatIsFree_GrowsWithoutStress") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(distorted_box(type), {steel});
    const VectorXd rise = rises_of(body.mesh, 60, Vector3::Zero());
    const StaticSolution solution = solve_static(body, statically(body.mesh), expansion_load(body, expands, rise));
    REQUIRE(solution.solved());
    CHECK(solution.reaction.cwiseAbs().maxCoeff() < 1e4 * eps * E * alpha * 60);
    double change = 0;  // of distances from node 0
    for (std::size_t a = 1; a < body.mesh.nodes.size(); ++a) {
      const Vector3 r = body.mesh.nodes[a] - body.mesh.nodes[0];
      const Vector3 u = (solution.u.col(0).segment<3>(3 * static_cast<Eigen::Index>(a)) - solution.u.col(0).head<3>());
      change = std::max(change, std::abs(r.dot(u) / r.squaredNorm() - alpha * 60));
    }
    CHECK(change < 1e5 * eps * alpha * 60);
    const Stress stress = recover_stress(body, solution.u.col(0), expands, rise);
    CHECK(stress.nodal.cwiseAbs().maxCoeff() < 1e5 * eps * E * alpha * 60);
    CHECK(stress.energy < 1e5 * eps * E * std::pow(alpha * 60, 2));
  }
}

// A linear temperature bends a free body without stress; it takes quadratic displacements, as hex8 has them with its
// incompatible modes where it is straight.
TEST_CASE("LinearTemperature_BendsWithoutStress") {
  for (const ElementType type : {ElementType::tet10, ElementType::wedge15, ElementType::hex8, ElementType::hex20}) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(box_mesh(type, {1, 0.8, 1.3}, {2, 2, 2}), {steel});
    const VectorXd rise = rises_of(body.mesh, 10, {30, -20, 15});
    CHECK(largest_stress(body, rise) < 1e6 * eps * E * alpha * 50);  // condition number of K: 1e3 to 1e4
  }
}

TEST_CASE("ExpansionLoad_IsInBalanceWhateverTheTemperature") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(distorted_box(type), {steel});
    VectorXd rise(body.node_count());
    for (Eigen::Index a = 0; a < rise.size(); ++a) rise[a] = 50 * std::sin(3.0 * static_cast<double>(a));
    const VectorXd f = expansion_load(body, expands, rise);
    CHECK((rigid_motions(body.mesh, body.centre).transpose() * f).cwiseAbs().maxCoeff() <
          1e3 * eps * f.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("BodyFixedEverywhere_BearsAllOfItsExpansionAsPressure") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const ElasticBody body = assemble(distorted_box(type), {steel});
    const VectorXd rise = rises_of(body.mesh, 40, Vector3::Zero());
    const Stress stress = recover_stress(body, VectorXd::Zero(body.size()), expands, rise);
    const double pressure = E * alpha * 40 / (1 - 2 * nu);
    const Vector6 expected = (Vector6() << -pressure, -pressure, -pressure, 0, 0, 0).finished();
    CHECK((stress.nodal.colwise() - expected).cwiseAbs().maxCoeff() < 1e3 * eps * pressure);
    CHECK(stress.energy == doctest::Approx(1.5 * pressure * alpha * 40 * body.mass / 7850).epsilon(1e3 * eps));
  }
}

// Between rigid ends without friction a ring bears E alpha theta along its axis and grows by (1 + nu) alpha theta r.
TEST_CASE("RingBetweenRigidEnds_MeetsTheClosedForm") {
  const double rise = 80;
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const Ring ring{.inner = 0.03, .outer = 0.045, .width = 0.02, .cells = {2, 16, 2}};
    Mesh mesh = ring_mesh(type, ring);
    straighten(mesh);  // four points integrate no curved tet10 exactly
    const ElasticBody body = assemble(mesh, {steel});
    std::vector<Support> supports;
    for (const char* end : {"bottom", "top"})
      for (const int node : body.mesh.node_sets.at(end)) supports.push_back({3 * node + 2, 0});
    int east = -1, west = -1;  // against turning and moving in the plane
    for (std::size_t a = 0; a < body.mesh.nodes.size(); ++a) {
      constexpr double near = 1e-9;  // which nodes they are
      if ((body.mesh.nodes[a] - Vector3(ring.inner, 0, -ring.width / 2)).norm() < near) east = static_cast<int>(a);
      if ((body.mesh.nodes[a] - Vector3(-ring.inner, 0, -ring.width / 2)).norm() < near) west = static_cast<int>(a);
    }
    const double growth = (1 + nu) * alpha * rise;
    supports.push_back({3 * east, growth * ring.inner});
    supports.push_back({3 * east + 1, 0});
    supports.push_back({3 * west + 1, 0});
    const VectorXd rises = VectorXd::Constant(body.node_count(), rise);
    const StaticSolution solution = solve_static(body, supports, expansion_load(body, expands, rises));
    REQUIRE(solution.solved());
    double worst = 0;
    for (Eigen::Index a = 0; a < body.node_count(); ++a) {
      Vector3 exact = growth * body.mesh.nodes[static_cast<std::size_t>(a)];
      exact.z() = 0;
      worst = std::max(worst, (solution.u.col(0).segment<3>(3 * a) - exact).norm());
    }
    CHECK(worst < 1e6 * eps * growth * ring.outer);  // condition number of K: 1e4
    const Stress stress = recover_stress(body, solution.u.col(0), expands, rises);
    const Vector6 expected = (Vector6() << 0, 0, -E * alpha * rise, 0, 0, 0).finished();
    CHECK((stress.nodal.colwise() - expected).cwiseAbs().maxCoeff() < 1e6 * eps * E * alpha * rise);
  }
}

// Timoshenko and Goodier (1970), Theory of Elasticity, art. 151: hoop stress of a tube whose inside is hotter by dT,
// the temperature falling as the logarithm.
TEST_CASE("TubeHotInside_MeetsTheClosedForm") {
  const double a = 0.03, b = 0.045, dT = 50;
  const auto exact = [&](double r) {
    return E * alpha * dT / (2 * (1 - nu) * std::log(b / a)) *
           (1 - std::log(b / r) - a * a / (b * b - a * a) * (1 + b * b / (r * r)) * std::log(b / a));
  };
  const auto error = [&](int fineness) {
    Mesh mesh = box_mesh(ElementType::hex20, {1, 1, 1}, {fineness, 2 * fineness, 1});
    for (Vector3& x : mesh.nodes) {
      const double r = a + (b - a) * x.x(), phi = std::numbers::pi / 2 * x.y();
      x = {r * std::cos(phi), r * std::sin(phi), 0.005 * x.z()};
    }
    const ElasticBody body = assemble(mesh, {steel});
    HeatConduction conduction(
        mesh, expands, {.cooled = {}, .prescribed = {{mesh.node_sets.at("x0"), dT}, {mesh.node_sets.at("x1"), 0}}});
    REQUIRE(conduction.factorise().solved());
    const VectorXd rise = conduction.temperatures(VectorXd::Zero(body.node_count()));
    std::vector<Support> supports;
    const auto hold = [&](const char* set, int axis) {
      for (const int node : mesh.node_sets.at(set)) supports.push_back({3 * node + axis, 0});
    };
    hold("y0", 1), hold("y1", 0), hold("z0", 2), hold("z1", 2);
    const StaticSolution solution = solve_static(body, supports, expansion_load(body, expands, rise));
    REQUIRE(solution.solved());
    const Stress stress = recover_stress(body, solution.u.col(0), expands, rise);
    double worst = 0;
    for (const int node : mesh.node_sets.at("y0")) {  // y is around there
      const double r = mesh.nodes[static_cast<std::size_t>(node)].x();
      worst = std::max(worst, std::abs(stress.nodal(1, node) - exact(r)));
    }
    return worst / std::abs(exact(a));
  };
  const double coarse = error(6), fine = error(12);
  CHECK(fine < 0.005);
  CHECK(std::log2(coarse / fine) > 1.8);  // linear continuation of stresses to nodes: 2
  CHECK(std::log2(coarse / fine) < 2.2);
}

}  // namespace thermal_expansion_test
}  // namespace hersey::fem
