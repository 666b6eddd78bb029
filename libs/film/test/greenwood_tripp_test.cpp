#include "hersey/film/greenwood_tripp.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace hersey::film {
namespace greenwood_tripp_test {

TEST_CASE("GreenwoodTrippExact_MatchesTheTabulatedIntegral") {
  // Six digits are tabulated; F_{5/2}(0) is also Gamma(7/4) 2^{1/4} / sqrt(pi).
  const std::array<double, 4> table{0.616634, 0.0805623, 0.00542371, 1.70873e-4};
  for (int H = 0; H < 4; ++H) CHECK(greenwood_tripp_exact(H).value == doctest::Approx(table[H]).epsilon(2e-6));
  const double at_zero = std::tgamma(1.75) * std::pow(2.0, 0.25) / std::sqrt(std::numbers::pi);
  CHECK(greenwood_tripp_exact(0).value == doctest::Approx(at_zero).epsilon(1e-12));  // promised by the header
}

TEST_CASE("GreenwoodTrippExact_HasTheSlopeItClaims") {
  constexpr double d = 1e-4;  // differences of fourth order: error d^4 plus round-off over d
  for (double H = -2; H < 7; H += 0.37) {
    CAPTURE(H);
    const auto F = [](double x) { return greenwood_tripp_exact(x).value; };
    const double slope = (8 * (F(H + d) - F(H - d)) - (F(H + 2 * d) - F(H - 2 * d))) / (12 * d);
    // d^4 is 1e-16, round-off over d 1e-12 of F, which falls faster than its slope.
    CHECK(greenwood_tripp_exact(H).slope == doctest::Approx(slope).epsilon(1e-9));
  }
}

TEST_CASE("GreenwoodTrippFit_IsOffByItsKnownError") {
  const std::array<double, 4> percent{-10.7, -3.5, -9.2, -74};
  for (int H = 0; H < 4; ++H) {
    const double off = 100 * (greenwood_tripp_fit(H).value / greenwood_tripp_exact(H).value - 1);
    CHECK(std::abs(off - percent[H]) < (H < 3 ? 0.06 : 0.6));  // half of the last digit given
  }
  CHECK(greenwood_tripp_fit(4).value == 0);
  CHECK(greenwood_tripp_fit(7).value == 0);
  constexpr double d = 1e-6;
  const double slope = (greenwood_tripp_fit(2 + d).value - greenwood_tripp_fit(2 - d).value) / (2 * d);
  CHECK(greenwood_tripp_fit(2).slope == doctest::Approx(slope).epsilon(1e-8));  // d^2, and round-off over d
}

}  // namespace greenwood_tripp_test
}  // namespace hersey::film
