#include <doctest/doctest.h>

#include <vector>

#include "hot_film.h"
#include "plane_slider.h"
#include "relative.h"

// Oils that thin as they are sheared: laws, sliders of an independent program, and what does not depend on the frame.
namespace hersey::film {
namespace shear_test {

constexpr double round_off = 1e-14;  // of a power

TEST_CASE("LawsOfShear_HaveTheirPublishedValues") {
  // Cross with 10 and 6 mPa.s, 1e6 1/s and 0.8, tabled by an independent program.
  const ShearThinning cross{Cross{.limit = 0.6, .exponent = 0.8}, 1e6, 0};
  const std::vector<std::pair<double, double>> table{
      {1e4, 0.009901986529798656}, {1e5, 0.009452772445587159}, {1e6, 0.008}, {1e7, 0.00654722755441284}};
  for (const auto& [rate, mu] : table) CHECK(0.01 * cross.ratio(rate, 0.01).value == relative(mu).epsilon(round_off));
  // The critical rate of an oil given by its critical stress falls as the viscosity rises.
  const ShearThinning by_stress{Cross{.limit = 0.6, .exponent = 0.8}, 0, 1e4};
  CHECK(by_stress.ratio(1e5, 0.1).value == relative(0.8).epsilon(round_off));
  // Carreau's at x = 1: 2^((n - 1)/2); far beyond it a power; with n = 1 nothing thins.
  const Carreau carreau{.limit = 0, .exponent = 0.6, .transition = 2};
  CHECK(carreau.ratio(1).value == relative(std::pow(2, -0.2)).epsilon(round_off));
  CHECK(carreau.ratio(1e9).value == relative(std::pow(1e9, -0.4)).epsilon(1e-12));  // 1e-18 of the power, and round-off
  CHECK(Carreau{.limit = 0.5, .exponent = 1}.ratio(3).value == 1);
  for (const double x : {0.0, 1e300}) {
    CHECK(std::isfinite(cross.ratio(1e6 * x, 1).tangent().slope));
    CHECK(std::isfinite(carreau.ratio(x).tangent().slope));
  }
  CHECK(cross.ratio(0, 0.01).value == 1);
}

TEST_CASE("SlopesOfShearLaws_MatchFiniteDifferences") {
  const std::vector<ShearLaw> laws{Cross{.limit = 0.3, .exponent = 0.7}, Cross{.limit = 0.6, .exponent = 1.4},
                                   Carreau{.limit = 0.2, .exponent = 0.4, .transition = 1.3}, Carreau{.exponent = 0.8}};
  constexpr double step = 1e-4;
  for (const ShearLaw& law : laws) {
    const auto at = [&](double x) { return std::visit([x](const auto& one) { return one.ratio(x); }, law); };
    for (const double x : {0.03, 0.8, 40.0}) {
      const ShearRatio ahead = at(x * std::exp(step)), behind = at(x * std::exp(-step));
      constexpr double third = 1e-7;  // step squared, and round-off over the step
      CHECK(at(x).slope == relative((ahead.value - behind.value) / (2 * step)).epsilon(third));
      CHECK(std::abs(at(x).bend - (ahead.slope - behind.slope) / (2 * step)) < third);
      CHECK(
          at(x).tangent().value ==
          doctest::Approx((ahead.value * std::exp(step) - behind.value * std::exp(-step)) / (2 * step)).epsilon(third));
    }
  }
}

// A film in which more shear takes less stress has no unique solution: Cross' law with m > 1 and a small limit.
TEST_CASE("FallingStress_IsRecognised") {
  for (const double m : {0.5, 1.0, 1.3, 2.0, 5.0}) {
    for (const double limit : {0.0, 0.02, 0.1, 0.2, 0.4}) {
      const Cross law{.limit = limit, .exponent = m};
      double least = 1;
      for (double x = 1e-3; x < 1e3; x *= 1.01) least = std::min(least, law.ratio(x).tangent().value);
      CAPTURE(m);
      CAPTURE(limit);
      CHECK(law.is_monotone() == (least > 0));
    }
  }
}

/// The slider of an independent program's quadrature through the gap.
Slider reference_slider() {
  Slider slider{0.02, 10, 0.01, 0, [](double x) { return 2e-5 - 1e-5 * x / 0.02; }};
  slider.thinning = {Cross{.limit = 0.6, .exponent = 0.8}, 1e6, 0};
  return slider;
}

// The tangent viscosity acts in the pressure's flow and that of the sliding in the drag.
TEST_CASE("ThinningSlider_IsThatOfTheTangentViscosity") {
  const Slider slider = reference_slider();
  std::vector<double> errors;
  for (const int n : {50, 100}) {
    const SolvedSlider s = solve(slider, n);
    errors.push_back(s.load / 47868.25290460687 - 1);
    CHECK(s.flow == relative(6.696034984279244e-05).epsilon(0.2 / (n * n)));  // second order
    CHECK(s.friction == relative(102.73161678439276).epsilon(1.0 / (n * n)));
  }
  CHECK(std::log2(std::abs(errors[0] / errors[1])) == doctest::Approx(2).epsilon(0.03));
  CHECK(std::abs(4 * errors[1] - errors[0]) < 2e-5);  // both grids extrapolated: what is of third order, at the ends
}

// Each layer has the viscosity of its own shear.
TEST_CASE("ThinningSliderInLayers_IsExact") {
  Slider slider = reference_slider();
  std::vector<double> errors;
  for (const int layers : {2, 4, 8}) {
    slider.layers = layers;
    const SolvedSlider s = solve(slider, 400);
    errors.push_back(s.load / 48235.87850898619 - 1);
    // Two layers are a quarter of the tangent viscosity's error away, more of them by their square.
    CHECK(std::abs(errors.back()) < 0.015 / (layers * layers));
    CHECK(s.flow == relative(6.695049557899059e-05).epsilon(4e-4 / (layers * layers)));
    CHECK(s.friction == relative(101.91157599918117).epsilon(0.0125 / (layers * layers)));
  }
  CHECK(std::log2(errors[1] / errors[2]) == doctest::Approx(2).epsilon(0.06));  // second order, and what the grid adds
}

}  // namespace shear_test
}  // namespace hersey::film
