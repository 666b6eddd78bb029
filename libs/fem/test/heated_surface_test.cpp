#include "hersey/fem/heated_surface.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "ring.h"
#include "small_bodies.h"

namespace hersey::fem {
namespace heated_surface_test {

using Eigen::VectorXd;

constexpr double two_pi = 2 * std::numbers::pi, k = 46, alpha = 12e-6, transfer = 300, ambient = 310;
const std::vector<ThermalMaterial> steel_of_heat = {{.conductivity = k, .expansion = alpha}};

std::vector<double> even_angles(int n) {
  std::vector<double> angles;
  for (int i = 0; i < n; ++i) angles.push_back(two_pi * i / n);
  return angles;
}

FilmSurface bore_of_ring(const Mesh& mesh, const Ring& ring) {
  const FilmCylinder cylinder = film_of(ring);
  const FilmSurfaceResult result =
      film_surface(mesh, mesh.surfaces.at("bore"), cylinder, {16, 3, cylinder.L}, 1e-3 * ring.inner);
  REQUIRE(result.solved());
  return *result.surface;
}

/// Temperature of the bore by heat that goes around as cos(n phi), over that heat per area; air outside.
double closed_form(const Ring& ring, int n) {
  const double a = ring.inner, b = ring.outer, Bi = transfer * b / k;
  if (n == 0) return a / k * (std::log(b / a) + 1 / Bi);
  // r^n + s r^-n with k dT/dr + transfer T = 0 at b.
  const double s = std::pow(b, 2 * n) * (n + Bi) / (n - Bi);
  return (std::pow(a, n) + s * std::pow(a, -n)) / (-k * n * (std::pow(a, n - 1) - s * std::pow(a, -n - 1)));
}

TEST_CASE("HeatAroundARing_WarmsItsBoreAsTheClosedForm") {
  const Ring ring{.inner = 0.05, .outer = 0.1, .width = 0.08, .cells = {8, 64, 1}};
  const ElasticBody body = assemble(ring_mesh(ElementType::hex20, ring), {steel});
  const FilmSurface surface = bore_of_ring(body.mesh, ring);
  const int angles = 60;
  const HeatedSurface heated = heated_surface(
      body, steel_of_heat, {.cooled = {{body.mesh.surfaces.at("outside"), transfer, ambient}}, .prescribed = {}},
      surface, {.angles = even_angles(angles), .T_reference = ambient});
  REQUIRE(heated.solved());
  CHECK((heated.T0.array() - ambient).abs().maxCoeff() < 1e-9);  // round-off of 310 K by a condition number of 1e4
  CHECK((heated.rise - heated.rise.transpose()).cwiseAbs().maxCoeff() < 1e-10 * heated.rise.maxCoeff());  // as well
  const double area = ring.inner * two_pi / angles * ring.width;
  for (const int n : {0, 1, 2, 3}) {
    VectorXd heat(angles);
    for (int i = 0; i < angles; ++i) heat[i] = 1e4 * area * std::cos(n * two_pi * i / angles);
    const VectorXd T = heated.rise * heat;
    // Weights that fall to both neighbours take 1 - (n dphi)^2/12 of a cosine, coming and going.
    const double weights = std::pow(1 - std::pow(n * two_pi / angles, 2) / 12, 2);
    CHECK(T[0] == doctest::Approx(1e4 * closed_form(ring, n) * weights).epsilon(1e-3));  // eight elements across
    constexpr double elements = 1e-3;                                                    // eight across the wall
    CHECK(T[angles / 4] == doctest::Approx(T[0] * std::cos(n * two_pi / 4)).epsilon(elements).scale(T[0]));
  }
}

// All of a body equally warmer: every length of it grows, a bore as if it were full.
TEST_CASE("BoreOfAWarmBody_WidensAsIfItWereFull") {
  const Ring ring{.inner = 0.03, .outer = 0.05, .width = 0.02, .cells = {2, 24, 2}};
  Mesh mesh = ring_mesh(ElementType::hex8, ring);
  for (Vector3& x : mesh.nodes)
    if (x.x() > 0.04) x.x() += 0.01;  // not round outside
  const ElasticBody body = assemble(mesh, {steel});
  const FilmSurface surface = bore_of_ring(body.mesh, ring);
  const HeatedSurface heated = heated_surface(
      body, steel_of_heat, {.cooled = {{body.mesh.surfaces.at("outside"), transfer, ambient}}, .prescribed = {}},
      surface, {.angles = even_angles(24), .T_reference = ambient - 50});
  REQUIRE(heated.solved());
  // Without heat from the film all of it is as warm as what is around. Flat faces between nodes: 1 - cos(7.5 deg)/...
  // of the radius; the splines take displacements at angles between them.
  const double radius = ring.inner * 0.5 * (1 + std::cos(two_pi / 48));
  CHECK((heated.shape_by_rise.array() - alpha * radius).abs().maxCoeff() < 5e-3 * alpha * radius);
  CHECK((heated.shape0 - 50 * heated.shape_by_rise).cwiseAbs().maxCoeff() < 1e-6 * 50 * alpha * radius);  // 1e4 eps, K
}

// Heat on one side bends and moves the ring; what is left of its shape knows no rigid motion.
TEST_CASE("ShapeByHeat_HasNoRigidMotion_AndIsThatOfThermalStrains") {
  const Ring ring{.inner = 0.05, .outer = 0.1, .width = 0.08, .cells = {6, 32, 2}};
  const ElasticBody body = assemble(ring_mesh(ElementType::hex20, ring), {steel});
  const FilmSurface surface = bore_of_ring(body.mesh, ring);
  const HeatedSurface heated = heated_surface(
      body, steel_of_heat, {.cooled = {{body.mesh.surfaces.at("outside"), transfer, ambient}}, .prescribed = {}},
      surface, {.angles = even_angles(48), .T_reference = ambient});
  REQUIRE(heated.solved());
  const VectorXd cosine = surface.G * cosine_on(surface.functions);
  for (int i = 0; i < 48; ++i)
    CHECK(std::abs(cosine.dot(heated.shape_by_heat.col(i))) <
          1e-3 * cosine.cwiseAbs().dot(heated.shape_by_heat.col(i).cwiseAbs()));  // a spline's cosine is one to 1e-4
  // Even heat: Timoshenko's ring of free ends, u(a) = alpha a times the mean of the temperature over its area.
  const double a = ring.inner, b = ring.outer, flux = 1e4;
  const VectorXd even = VectorXd::Constant(48, flux * two_pi * a * ring.width / 48);
  const double outside = flux * a / b / transfer, slope = flux * a / k;
  // int r slope ln(b/r) dr from a to b
  const double integral = slope * ((b * b - a * a) / 4 - a * a / 2 * std::log(b / a));
  const double mean = outside + 2 * integral / (b * b - a * a);
  const VectorXd shape = heated.shape_by_heat * even;
  CHECK(shape.mean() == doctest::Approx(alpha * a * mean).epsilon(5e-3));  // ends are free, not plane
}

TEST_CASE("StaticallyDeterminateSupports_HoldWithoutReaction") {
  for (const ElementType type : solids) {
    CAPTURE(name_of(type));
    const Mesh mesh = distorted_box(type);
    const std::vector<int> fixed = statically_determinate(mesh);
    const Eigen::MatrixXd motions = rigid_motions(mesh, mesh.nodes.front());
    const Eigen::MatrixXd supported = motions(fixed, Eigen::all);
    CHECK(std::abs(supported.determinant()) > 0.05);  // a box of about 1 m: its six supports resist every motion
  }
}

TEST_CASE("HeatedSurface_ThatNothingCools_IsReported") {
  const Ring ring;
  const ElasticBody body = assemble(ring_mesh(ElementType::hex8, ring), {steel});
  const HeatedSurface heated = heated_surface(body, steel_of_heat, {}, bore_of_ring(body.mesh, ring),
                                              {.angles = even_angles(24), .expands = false});
  CHECK_FALSE(heated.solved());
  CHECK(heated.message.find("nowhere to go") != std::string::npos);
}

}  // namespace heated_surface_test
}  // namespace hersey::fem
