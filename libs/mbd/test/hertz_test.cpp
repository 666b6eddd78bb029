#include "hersey/mbd/hertz.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey::mbd {
namespace hertz_test {

TEST_CASE("HertzStiffness_OfRoundContactIsClosedForm") {
  CHECK(hertz_stiffness(2e11, {0.01, 0.01}) == doctest::Approx(4.0 / 3.0 * 2e11 * 0.1).epsilon(1e-14));  // round-off
  // Just beside the round contact the ellipse's formulas take over without a jump.
  // Second order in the 0.2 % between both radii.
  CHECK(hertz_stiffness(2e11, {0.01 * 1.001, 0.01 / 1.001}) ==
        doctest::Approx(hertz_stiffness(2e11, {0.01, 0.01})).epsilon(1e-6));
}

/// Displacement at x on the long axis of an ellipse with semi-axes a, b under the pressure sqrt(1 - x^2/a^2 - y^2/b^2),
/// by direct integration of Boussinesq's solution around x in polar coordinates: u = 1/(pi E*) int int p dr dphi, E*
/// = 1.
double displacement(double a, double b, double x) {
  constexpr int n = 4000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double phi = (i + 0.5) * 2 * std::numbers::pi / n;
    // Along the ray 1 - p^2 = A r^2 + 2 B r + C: int_0^r1 sqrt(..) dr in closed form.
    const double A = std::pow(std::cos(phi) / a, 2) + std::pow(std::sin(phi) / b, 2);
    const double B = x * std::cos(phi) / (a * a), C = 1 - x * x / (a * a);
    const double h2 = C + B * B / A, start = B / std::sqrt(A * h2);
    sum += 0.5 * h2 / std::sqrt(A) * (std::numbers::pi / 2 - std::asin(start) - start * std::sqrt(1 - start * start));
  }
  return sum * 2 * std::numbers::pi / n / std::numbers::pi;
}

TEST_CASE("HertzStiffness_OfAnEllipseSolvesTheContactProblem") {
  // For semi-axes 1 and b the surface under Hertz's pressure is delta - x^2/(2R') - y^2/(2R''), which gives R', R''.
  for (const double b : {0.9, 0.5, 0.2, 0.05}) {
    const double delta = displacement(1, b, 0);
    const double R1 = 0.125 / (delta - displacement(1, b, 0.5)),
                 R2 = 0.125 * b * b / (delta - displacement(b, 1, 0.5 * b));
    const double force = 2.0 / 3.0 * std::numbers::pi * b;  // volume under the pressure
    CAPTURE(b);
    // Quadrature of the reference.
    CHECK(hertz_stiffness(1, {R1, R2}) == doctest::Approx(force / std::pow(delta, 1.5)).epsilon(1e-6));
  }
}

TEST_CASE("RelativeRadii_FollowTheShapes") {
  const Sphere ball{Vector3::Zero(), 2};
  using Radii = std::array<double, 2>;
  CHECK(*relative_radii(ball, HalfSpace{}) == Radii{2, 2});
  CHECK(*relative_radii(Sphere{Vector3::Zero(), 2}, Sphere{Vector3::Zero(), 2}) == Radii{1, 1});
  CHECK(*relative_radii(Cylinder{Vector3::Zero(), {0, 0, 1}, 2}, ball) == Radii{2, 1});
  CHECK(*relative_radii(HalfSpace{}, Capsule{Vector3::Zero(), {0, 0, 1}, 3}) == Radii{3, 3});
  CHECK_FALSE(relative_radii(HalfSpace{}, Cylinder{Vector3::Zero(), {0, 0, 1}, 3}).has_value());
  CHECK_FALSE(
      relative_radii(Capsule{Vector3::Zero(), {0, 0, 1}, 3}, Capsule{Vector3::Zero(), {0, 0, 1}, 3}).has_value());
  CHECK_THROWS_AS((void)hertz_stiffness(0, {1, 1}), ContractError);
}

}  // namespace hertz_test
}  // namespace hersey::mbd
