#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/fem/heated_surface.h"
#include "ring.h"
#include "small_bodies.h"

// Journals in bodies: heat that comes evenly around, by closed forms.
namespace hersey::fem {
namespace heated_journal_test {

using Eigen::VectorXd;

constexpr double two_pi = 2 * std::numbers::pi, k = 46, alpha = 12e-6, transfer = 300, ambient = 310;
const std::vector<ThermalMaterial> steel_of_heat = {{.conductivity = k, .expansion = alpha}};

FilmSurface outside_of_shaft(const Mesh& mesh, const Ring& shaft, double width) {
  FilmCylinder cylinder = film_of(shaft, false);
  cylinder.L = width;
  const FilmSurfaceResult result =
      film_surface(mesh, mesh.surfaces.at("outside"), cylinder, {16, 3, width}, 1e-3 * shaft.outer);
  REQUIRE(result.solved());
  return *result.surface;
}

/// Cooled in its bore.
HeatedSurface hollow_shaft(const Ring& shaft, const ElasticBody& body) {
  return heated_surface(body, steel_of_heat,
                        {.cooled = {{body.mesh.surfaces.at("bore"), transfer, ambient}}, .prescribed = {}},
                        outside_of_shaft(body.mesh, shaft, shaft.width), {.T_reference = ambient - 30});
}

const Ring shaft{.inner = 0.02, .outer = 0.05, .width = 0.08, .cells = {8, 48, 2}};

// Mean temperatures of the surface and of the bore by one watt.
TEST_CASE("EvenHeatIntoAHollowShaft_IsTheLogarithmOfItsRadii") {
  const ElasticBody body = assemble(ring_mesh(ElementType::hex20, shaft), {steel});
  const HeatedSurface heated = hollow_shaft(shaft, body);
  REQUIRE(heated.solved());
  REQUIRE(heated.rise.size() == 1);
  CHECK(std::abs(heated.T0[0] - ambient) < 1e-9);  // round-off of 310 K by a condition number of 1e4
  const double to_oil = 1 / (transfer * two_pi * shaft.inner * shaft.width);
  const double through = std::log(shaft.outer / shaft.inner) / (two_pi * k * shaft.width);
  CHECK(heated.rise(0, 0) == doctest::Approx(through + to_oil).epsilon(1e-4));  // eight elements across
  const int at_bore = body.mesh.node_sets.at("bore").front();
  CHECK(heated.rise_body(at_bore, 0) == doctest::Approx(to_oil).epsilon(1e-4));  // as well
}

// Through a thin tube to both ends, whose temperature is prescribed: conduction along, and no more than a third of the
// wall across.
TEST_CASE("EvenHeatIntoTheMiddleOfATube_LeavesByItsEnds") {
  const Ring tube{.inner = 0.045, .outer = 0.05, .width = 0.2, .cells = {2, 24, 30}};
  const ElasticBody body = assemble(ring_mesh(ElementType::hex20, tube), {steel});
  const double L = 0.08;
  std::vector<int> ends = body.mesh.node_sets.at("bottom");
  const std::vector<int>& top = body.mesh.node_sets.at("top");
  ends.insert(ends.end(), top.begin(), top.end());
  const HeatedSurface heated = heated_surface(body, steel_of_heat, {.cooled = {}, .prescribed = {{ends, ambient}}},
                                              outside_of_shaft(body.mesh, tube, L), {.expands = false});
  REQUIRE(heated.solved());
  const double kS = k * two_pi / 2 * (tube.outer * tube.outer - tube.inner * tube.inner);
  const double along = (L / 12 + (tube.width - L) / 4) / kS;
  const double across = (tube.outer - tube.inner) / (3 * k * two_pi * tube.outer * L);
  CHECK(heated.rise(0, 0) == doctest::Approx(along + across).epsilon(2e-3));  // half of `across`: curvature, edges
  CHECK(heated.shape0.size() == 0);
}

// Free ends: the radius grows by alpha times the mean of the temperature over the section.
TEST_CASE("WarmShaft_GrowsByItsMeanTemperature") {
  const ElasticBody body = assemble(ring_mesh(ElementType::hex20, shaft), {steel});
  const HeatedSurface heated = hollow_shaft(shaft, body);
  REQUIRE(heated.solved());
  const FilmSurface surface = outside_of_shaft(body.mesh, shaft, shaft.width);
  const std::vector<double> z = {-0.04, -0.02, 0, 0.02, 0.04};
  const double a = shaft.inner, b = shaft.outer;
  const Eigen::MatrixXd even = mean_around(surface.functions, heated.shape_by_rise, z);
  const Eigen::MatrixXd cold = mean_around(surface.functions, heated.shape0, z);
  for (int j = 0; j < 5; ++j) {
    CHECK(even(j, 0) == doctest::Approx(alpha * b).epsilon(1e-4));        // splines of its functions, 48 chords of arcs
    CHECK(cold(j, 0) == doctest::Approx(30 * even(j, 0)).epsilon(1e-6));  // round-off by the stiffness' condition
  }
  const double to_oil = 1 / (transfer * two_pi * a * shaft.width), per_log = 1 / (two_pi * k * shaft.width);
  // int r ln(r/a) dr from a to b
  const double integral = b * b / 2 * std::log(b / a) - (b * b - a * a) / 4;
  const double mean = to_oil + 2 * per_log * integral / (b * b - a * a);
  const Eigen::MatrixXd hot = mean_around(surface.functions, heated.shape_by_heat, z);
  CHECK(hot.mean() == doctest::Approx(alpha * b * mean).epsilon(5e-3));  // ends are free, not plane
  CHECK(hot(0, 0) == doctest::Approx(hot(4, 0)).epsilon(1e-6));          // round-off: its middle is a mirror
}

TEST_CASE("MeanAround_IsThatOfTheFunctions") {
  const SurfaceFunctions functions(16, 3, 0.08);
  const VectorXd wave = cosine_on(functions), ones = VectorXd::Ones(functions.count());
  Eigen::MatrixXd shapes(functions.count(), 2);
  shapes << wave + 2 * ones, VectorXd(5 * wave);
  const Eigen::MatrixXd mean = mean_around(functions, shapes, {-0.04, 0.01});
  constexpr double round_off = 1e-14;
  CHECK((mean.col(0).array() - 2).abs().maxCoeff() < round_off);
  CHECK(mean.col(1).cwiseAbs().maxCoeff() < round_off);
}

}  // namespace heated_journal_test
}  // namespace hersey::fem
