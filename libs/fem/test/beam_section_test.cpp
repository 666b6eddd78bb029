#include "hersey/fem/beam_section.h"

#include <doctest/doctest.h>

#include <numbers>

namespace hersey::fem {
namespace beam_section_test {

constexpr double kRoundOff = 1e-14;   // of a few products
constexpr double kFourDigits = 1e-4;  // of Cowper's table

constexpr double pi = std::numbers::pi;

TEST_CASE("CircularSection_IsThatOfTextbooks") {
  const BeamSection solid = circular_section(2, 0, 0.3);
  CHECK(solid.area == doctest::Approx(pi).epsilon(kRoundOff));
  CHECK(solid.I_y == doctest::Approx(pi / 4).epsilon(kRoundOff));
  CHECK(solid.J == doctest::Approx(pi / 2).epsilon(kRoundOff));
  CHECK(solid.shear_y / solid.area == doctest::Approx(0.8864).epsilon(1e-4));  // Cowper's table, nu = 0.3
  // A thin tube of radius 1 and wall s: 2 pi s, pi s, and for nu = 0.3 a shear coefficient of 0.531.
  const double s = 1e-3;
  const BeamSection tube = circular_section(2 + s, 2 - s, 0.3);
  // (s/diameter)^2 is left out.
  CHECK(tube.area == doctest::Approx(2 * pi * s).epsilon(1e-6));
  CHECK(tube.I_z == doctest::Approx(pi * s).epsilon(1e-6));
  // The thin tube's coefficient is off by the order of s/diameter.
  CHECK(tube.shear_z / tube.area == doctest::Approx(0.5306).epsilon(1e-3));
}

TEST_CASE("RectangularSection_IsThatOfTextbooks") {
  const BeamSection square = rectangular_section(1, 1, 0.3);
  CHECK(square.J == doctest::Approx(0.1405770).epsilon(1e-6));  // Saint-Venant
  CHECK(square.shear_y == doctest::Approx(0.84967).epsilon(kFourDigits));
  const BeamSection flat = rectangular_section(2, 1, 0.3);
  CHECK(flat.J == doctest::Approx(2 * 0.228682).epsilon(1e-5));  // Saint-Venant's series, six digits
  CHECK(flat.I_y == doctest::Approx(2.0 / 12).epsilon(kRoundOff));
  CHECK(flat.I_z == doctest::Approx(8.0 / 12).epsilon(kRoundOff));
  CHECK(rectangular_section(1, 2, 0.3).J == doctest::Approx(flat.J).epsilon(kRoundOff));
}

}  // namespace beam_section_test
}  // namespace hersey::fem
