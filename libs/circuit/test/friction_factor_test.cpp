#include "hersey/circuit/friction_factor.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

namespace hersey::circuit {
namespace friction_factor_test {

constexpr double kEps = std::numeric_limits<double>::epsilon();

// Colebrook and White's equation, which Moody's chart shows, by its own fixed point: another formula for the same pipe.
double colebrook(double Re, double roughness) {
  double x = 6;  // 1/sqrt(f)
  for (int k = 0; k < 50; ++k) x = -2 * std::log10(roughness / 3.7 + 2.51 / Re * x);
  return 1 / (x * x);
}

TEST_CASE("FrictionFactor_IsThatOfLaminarFlowAtSmallReynoldsNumbers") {
  for (const double Re : {1e-30, 1e-3, 1.0, 100.0, 500.0})                      // without flow, creeping, laminar
    CHECK(friction_ratio(Re, 1e-3).value == doctest::Approx(1).epsilon(1e-6));  // at 500 Churchill's is 64/Re + 6e-8
  CHECK(friction_ratio(0, 0).value == 1);
  CHECK(friction_factor(1000, 0) == doctest::Approx(0.064).epsilon(1e-3));  // what blends into turbulence there
}

TEST_CASE("FrictionFactor_IsThatOfMoodysChartInTurbulentFlow") {
  for (const double Re : {1e4, 1e5, 1e6, 1e7})                // turbulent
    for (const double roughness : {0.0, 1e-5, 1e-3, 1e-2}) {  // smooth to rough
      CAPTURE(Re);
      CAPTURE(roughness);
      // Churchill (1977) claims 3.2 % of the chart's formula at worst
      CHECK(friction_factor(Re, roughness) == doctest::Approx(colebrook(Re, roughness)).epsilon(0.032));
    }
}

// Churchill's formula as it is printed.
TEST_CASE("FrictionFactor_IsChurchillsFormula") {
  for (const double Re : {50.0, 2100.0, 3000.0, 2e4, 3e6})  // of all regimes
    for (const double roughness : {0.0, 2e-4, 0.05}) {      // smooth to rough
      const double A = std::pow(2.457 * std::log(1 / (std::pow(7 / Re, 0.9) + 0.27 * roughness)), 16),
                   B = std::pow(37530 / Re, 16);
      const double printed = 8 * std::pow(std::pow(8 / Re, 12) + 1 / std::pow(A + B, 1.5), 1.0 / 12);
      CHECK(friction_factor(Re, roughness) == doctest::Approx(printed).epsilon(1e3 * kEps));  // powers of 16 in both
    }
}

TEST_CASE("FrictionRatio_HasTheSlopeOfItsDifference") {
  for (const double Re : {10.0, 1800.0, 2500.0, 4000.0, 1e5})  // of all regimes
    for (const double roughness : {0.0, 1e-3, 0.05}) {         // smooth to rough
      const double step = 1e-5;                                // leaves 1e-9 of curvatures below 100
      const double difference = (std::log(friction_ratio(Re * std::exp(step), roughness).value) -
                                 std::log(friction_ratio(Re * std::exp(-step), roughness).value)) /
                                (2 * step);
      CHECK(std::abs(friction_ratio(Re, roughness).slope - difference) < 1e-6);  // as above
    }
}

}  // namespace friction_factor_test
}  // namespace hersey::circuit
