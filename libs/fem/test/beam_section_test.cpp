#include "hersey/fem/beam_section.h"

#include <doctest/doctest.h>

#include <numbers>

namespace hersey::fem {
namespace {

constexpr double pi = std::numbers::pi;

TEST_CASE("CircularSection_IsThatOfTextbooks") {
  const BeamSection solid = circular_section(2, 0, 0.3);
  CHECK(solid.area == doctest::Approx(pi).epsilon(1e-14));
  CHECK(solid.I_y == doctest::Approx(pi / 4).epsilon(1e-14));
  CHECK(solid.J == doctest::Approx(pi / 2).epsilon(1e-14));
  CHECK(solid.shear_y / solid.area == doctest::Approx(0.8864).epsilon(1e-4));  // Cowper's table, nu = 0.3
  // A thin tube of radius 1 and wall s: 2 pi s, pi s, and for nu = 0.3 a shear coefficient of 0.531.
  const double s = 1e-3;
  const BeamSection tube = circular_section(2 + s, 2 - s, 0.3);
  CHECK(tube.area == doctest::Approx(2 * pi * s).epsilon(1e-6));
  CHECK(tube.I_z == doctest::Approx(pi * s).epsilon(1e-6));
  CHECK(tube.shear_z / tube.area == doctest::Approx(0.5306).epsilon(1e-3));
}

TEST_CASE("RectangularSection_IsThatOfTextbooks") {
  const BeamSection square = rectangular_section(1, 1, 0.3);
  CHECK(square.J == doctest::Approx(0.1405770).epsilon(1e-6));  // Saint-Venant
  CHECK(square.shear_y == doctest::Approx(0.84967).epsilon(1e-4));
  const BeamSection flat = rectangular_section(2, 1, 0.3);
  CHECK(flat.J == doctest::Approx(2 * 0.228682).epsilon(1e-5));
  CHECK(flat.I_y == doctest::Approx(2.0 / 12).epsilon(1e-14));
  CHECK(flat.I_z == doctest::Approx(8.0 / 12).epsilon(1e-14));
  CHECK(rectangular_section(1, 2, 0.3).J == doctest::Approx(flat.J).epsilon(1e-14));
}

}  // namespace
}  // namespace hersey::fem
