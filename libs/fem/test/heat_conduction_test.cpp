#include "hersey/fem/heat_conduction.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hersey/fem/load_distributions.h"
#include "ring.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace heat_conduction_test {

using Eigen::VectorXd;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double k = 46;  // W/(m K)

std::vector<int> outer_nodes(const Mesh& mesh) {
  return nodes_on(mesh, outer_faces(mesh, [&] {
                    std::vector<int> all(mesh.nodes.size());
                    for (std::size_t a = 0; a < all.size(); ++a) all[a] = static_cast<int>(a);
                    return all;
                  }()));
}

TEST_CASE("LinearTemperature_IsExactInEveryElement") {
  const Vector3 gradient(3, -2, 5);
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const Mesh mesh = distorted_box(type);
    ThermalSurroundings surroundings;
    for (const int node : outer_nodes(mesh))
      surroundings.prescribed.push_back({{node}, 300 + gradient.dot(mesh.nodes[static_cast<std::size_t>(node)])});
    REQUIRE(surroundings.prescribed.size() < mesh.nodes.size());
    HeatConduction conduction(mesh, {{.conductivity = k}}, surroundings);
    REQUIRE(conduction.factorise().solved());
    const VectorXd T = conduction.temperatures(VectorXd::Zero(static_cast<Eigen::Index>(mesh.nodes.size())));
    double worst = 0;
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      worst = std::max(worst, std::abs(T[static_cast<Eigen::Index>(a)] - 300 - gradient.dot(mesh.nodes[a])));
    CHECK(worst < 1e3 * eps * 300);  // condition number of a few cells: 1e2
  }
}

TEST_CASE("SlabBetweenFluxAndAir_IsExactInEveryElement") {
  const double q = 2e4, alpha = 150, ambient = 293, length = 0.4;
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const Mesh mesh = box_mesh(type, {length, 0.1, 0.2}, {3, 2, 2});
    HeatConduction conduction(mesh, {{.conductivity = k}},
                              {.cooled = {{mesh.surfaces.at("x1"), alpha, ambient}}, .prescribed = {}});
    REQUIRE(conduction.factorise().solved());
    const VectorXd heat = heat_load(mesh, mesh.surfaces.at("x0"), [&](const Vector3&) { return q; });
    CHECK(heat.sum() == doctest::Approx(q * 0.02).epsilon(100 * eps));
    const VectorXd T = conduction.temperatures(heat);
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
      const double exact = ambient + q / alpha + q * (length - mesh.nodes[a].x()) / k;
      // Condition number: 1e2; boxes of pyramids have five times the nodes whose round-off adds up.
      const double round_off = std::max(1e3, 10.0 * static_cast<double>(mesh.nodes.size())) * eps;
      CHECK(T[static_cast<Eigen::Index>(a)] == doctest::Approx(exact).epsilon(round_off));
    }
    CHECK(conduction.cooling(T)[0] == doctest::Approx(q * 0.02).epsilon(1e4 * eps));  // a difference of temperatures
  }
}

// A rod that is thin beside its length is a fin: theta = theta_0 cosh(m (l - x))/cosh(m l), m^2 = alpha P/(k A).
TEST_CASE("ThinRodInAir_IsAFin") {
  const double length = 0.3, side = 0.01, alpha = 40, ambient = 290, hot = 400;
  const double m = std::sqrt(alpha * 4 / (k * side));
  const Mesh mesh = box_mesh(ElementType::hex20, {length, side, side}, {30, 1, 1});
  ThermalSurroundings surroundings;
  for (const char* face : {"y0", "y1", "z0", "z1"})
    surroundings.cooled.push_back({mesh.surfaces.at(face), alpha, ambient});
  surroundings.prescribed.push_back({mesh.node_sets.at("x0"), hot});
  HeatConduction conduction(mesh, {{.conductivity = k}}, surroundings);
  REQUIRE(conduction.factorise().solved());
  const VectorXd none = VectorXd::Zero(static_cast<Eigen::Index>(mesh.nodes.size()));
  const VectorXd T = conduction.temperatures(none);
  const double biot = alpha * side / 2 / k;  // 4e-3: the fin's theory neglects slopes across of this share
  double worst = 0;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const double fin = std::cosh(m * (length - mesh.nodes[a].x())) / std::cosh(m * length);
    worst = std::max(worst, std::abs((T[static_cast<Eigen::Index>(a)] - ambient) / (hot - ambient) - fin));
  }
  CHECK(worst < biot);
  const double through_root = -conduction.reaction_heat(T, none)[0];
  CHECK(through_root ==
        doctest::Approx((hot - ambient) * std::sqrt(alpha * 4 * side * k * side * side) * std::tanh(m * length))
            .epsilon(biot));
  // What comes in at the root leaves to the air, whatever the mesh.
  CHECK(conduction.cooling(T).sum() == doctest::Approx(through_root).epsilon(1e-10));  // condition number: 1e4
}

// Heat Q' per length through a ring: T(r) = T_inf + Q'/(2 pi) [ln(b/r)/k + 1/(alpha b)].
double ring_error(ElementType type, int fineness) {
  const Ring ring{.inner = 0.02, .outer = 0.06, .width = 0.02, .cells = {fineness, 8 * fineness, 1}};
  const Mesh mesh = ring_mesh(type, ring);
  const double alpha = 500, ambient = 293, heat = 4e4;  // W/m
  HeatConduction conduction(mesh, {{.conductivity = k}},
                            {.cooled = {{mesh.surfaces.at("outside"), alpha, ambient}}, .prescribed = {}});
  REQUIRE(conduction.factorise().solved());
  const double two_pi = 2 * std::numbers::pi;
  const VectorXd T = conduction.temperatures(heat_load(
      mesh, mesh.surfaces.at("bore"), [&](const Vector3& x) { return heat / two_pi / std::hypot(x.x(), x.y()); }));
  double worst = 0;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a) {
    const double r = std::hypot(mesh.nodes[a].x(), mesh.nodes[a].y());
    const double exact = ambient + heat / two_pi * (std::log(ring.outer / r) / k + 1 / (alpha * ring.outer));
    worst = std::max(worst, std::abs(T[static_cast<Eigen::Index>(a)] - exact));
  }
  return worst / (heat / two_pi * std::log(ring.outer / ring.inner) / k);
}

TEST_CASE("Ring_ConvergesToTheLogarithm") {
  const double linear = std::log2(ring_error(ElementType::hex8, 4) / ring_error(ElementType::hex8, 8));
  CHECK(linear == doctest::Approx(2).epsilon(0.1));
  // Serendipity elements on arcs: between the 3 of their polynomials and the 4 at the nodes of a straight line.
  const double quadratic = std::log2(ring_error(ElementType::hex20, 3) / ring_error(ElementType::hex20, 6));
  CHECK(quadratic > 2.9);
  CHECK(quadratic < 4.2);
  CHECK(ring_error(ElementType::hex20, 6) < 2e-4);
}

TEST_CASE("RiseAtOneAngleByHeatAtAnother_IsReciprocal") {
  const Mesh mesh = distorted_box(ElementType::tet10);
  HeatConduction conduction(
      mesh, {{.conductivity = k}},
      {.cooled = {{mesh.surfaces.at("x1"), 30, 293}}, .prescribed = {{mesh.node_sets.at("y0"), 310}}});
  REQUIRE(conduction.factorise().solved());
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  const Eigen::MatrixXd rises = conduction.rises(Eigen::MatrixXd::Identity(n, n));
  CHECK((rises - rises.transpose()).cwiseAbs().maxCoeff() < 1e3 * eps * rises.maxCoeff());
  CHECK(rises.col(mesh.node_sets.at("y0").front()).isZero(0));
}

TEST_CASE("HeatThatHasNowhereToGo_IsReported") {
  const Mesh mesh = box_mesh(ElementType::hex8, {1, 1, 1}, {2, 2, 2});
  HeatConduction insulated(mesh, {{.conductivity = k}}, {});
  const solver::FactorSummary summary = insulated.factorise();
  CHECK(summary.status == solver::FactorStatus::singular);
  CHECK(summary.message.find("nowhere to go") != std::string::npos);
}

}  // namespace heat_conduction_test
}  // namespace hersey::fem
