#include "gap/flow_factors.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace hersey::film {
namespace flow_factors_test {

constexpr double kRoundOff = 1e-12;    // of exponentials
constexpr double kJump = 1e-7;         // beside a kink, d = 1e-9 away on both sides: slopes up to some 10 times 2 d
constexpr double kJumpOfSlope = 1e-6;  // the same of second derivatives

const std::vector<double> tabulated{1.0 / 9, 1.0 / 6, 1.0 / 3, 1, 3, 6, 9};

/// Mean over Patir and Cheng's nearly Gaussian heights y, density 35/96 (1 - (y/3)^2)^3 for |y| < 3.
double mean_over_heights(const std::function<double(double)>& f) {
  const int n = 20000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * (i + 0.5) / n - 1;
    sum += 35.0 / 32 * std::pow(1 - t * t, 3) * f(3 * t) * 2 / n;
  }
  return sum;
}

// Figures worked from the fits as printed, one on each of them.
TEST_CASE("FlowFactors_HaveTheirPublishedValues") {
  CHECK(PatirCheng(1).pressure(3).value == doctest::Approx(1 - 0.90 * std::exp(-0.56 * 3)).epsilon(kRoundOff));
  // Digits printed.
  CHECK(PatirCheng(1).pressure(3).value == doctest::Approx(0.832).epsilon(1e-3));
  CHECK(PatirCheng(1.0 / 9).pressure(2).value == doctest::Approx(0.361).epsilon(1e-3));
  CHECK(PatirCheng(9).pressure(2).value == doctest::Approx(1.3076).epsilon(1e-4));
  CHECK(PatirCheng(1).shear(1).value == doctest::Approx(1.899 * std::exp(-0.87)).epsilon(kRoundOff));
  CHECK(PatirCheng(1.0 / 3).shear(8).value == doctest::Approx(1.561 * std::exp(-2.0)).epsilon(kRoundOff));
  CHECK(PatirCheng(3).stress(1).value == doctest::Approx(9.8 * std::exp(-2.62)).epsilon(kRoundOff));
  // Both published branches of Phi_s meet at H = 5: a wrong digit in either would show.
  for (const double gamma : tabulated) {
    CHECK(PatirCheng(gamma).shear(5).value ==
          doctest::Approx(std::exp(0.125) * PatirCheng(gamma).shear(5.5).value).epsilon(5e-4));
  }
  // Factors are linear in ln gamma between rows.
  const double between = std::sqrt(3.0);
  CHECK(PatirCheng(between).shear(2).value ==
        doctest::Approx(0.5 * (PatirCheng(1).shear(2).value + PatirCheng(3).shear(2).value)).epsilon(kRoundOff));
  CHECK(PatirCheng(0.11).pressure(2).value == PatirCheng(1.0 / 9).pressure(2).value);  // 1/9 in two digits
  CHECK_THROWS(PatirCheng(10));
  CHECK_THROWS(PatirCheng(0.1));
}

// All seven ratios of Patir and Cheng (1978, table 1; 1979, tables 1 and 2), from the tables as printed by a program of
// its own. Each constant of a row affects one of these: a unit of its last digit changes it by more than 1e-5.
TEST_CASE("FlowFactors_OfEveryRatioAreThosePublished") {
  struct Row {
    std::array<double, 2> pressure;  // at H = 1.5, 4
    std::array<double, 5> shear;     // at H = 0.5, 1, 2, 4, 6: the last of the second branch
    std::array<double, 4> stress;    // at H = 0.5, 1, 2, 4
  };
  const std::array<Row, 7> published{
      {{{0.21176, 0.72417}, {0.64215, 0.96646, 1.05360, 0.68972, 0.41413}, {0.83775, 1.56232, 1.15533, 0.21068}},
       {{0.26502, 0.74280}, {0.63627, 0.93610, 1.00257, 0.65127, 0.39137}, {0.81289, 1.48476, 1.07538, 0.19207}},
       {{0.37154, 0.78008}, {0.63567, 0.89539, 0.92273, 0.58255, 0.34831}, {0.79971, 1.36288, 0.92100, 0.15348}},
       {{0.61146, 0.90419}, {0.61542, 0.79559, 0.72659, 0.41474, 0.25124}, {0.69997, 1.14677, 0.73207, 0.11640}},
       {{1.12247, 1.02812}, {0.50183, 0.54590, 0.40408, 0.19850, 0.12406}, {0.53142, 0.71347, 0.35415, 0.05402}},
       {{1.28305, 1.06500}, {0.49653, 0.46984, 0.30863, 0.14004, 0.08657}, {0.52098, 0.66534, 0.29883, 0.03732}},
       {{1.47357, 1.10875}, {0.41546, 0.37566, 0.23817, 0.10641, 0.06582}, {0.46443, 0.53436, 0.20879, 0.02115}}}};
  constexpr double half_a_digit = 0.5001e-5;  // of the last one above
  constexpr std::array<double, 2> pressure_at{1.5, 4};
  constexpr std::array<double, 5> at{0.5, 1, 2, 4, 6};
  for (std::size_t row = 0; row < published.size(); ++row) {
    CAPTURE(tabulated[row]);
    const PatirCheng law(tabulated[row]);
    for (std::size_t k = 0; k < pressure_at.size(); ++k)
      CHECK(std::abs(law.pressure(pressure_at[k]).value - published[row].pressure[k]) < half_a_digit);
    for (std::size_t k = 0; k < at.size(); ++k) {
      CAPTURE(at[k]);
      CHECK(std::abs(law.shear(at[k]).value - published[row].shear[k]) < half_a_digit);
      if (k < 4) CHECK(std::abs(law.stress(at[k]).value - published[row].stress[k]) < half_a_digit);
    }
  }
}

TEST_CASE("FlowFactors_HaveTheSlopesTheyClaim") {
  constexpr double d = 1e-5;  // differences of fourth order; kinks of the second derivative cost d
  for (const double gamma : {1.0 / 9, 0.2, 1.0, 2.0, 9.0}) {
    CAPTURE(gamma);
    const PatirCheng law(gamma);
    for (double H = 0.05; H < 12; H += 0.0773) {
      CAPTURE(H);
      const auto check = [&](const auto& f) {
        const double slope =
            (8 * (f(H + d).value - f(H - d).value) - (f(H + 2 * d).value - f(H - 2 * d).value)) / (12 * d);
        // A kink of the second derivative costs d = 1e-5 of it, smooth regions d^4.
        CHECK(f(H).slope == doctest::Approx(slope).epsilon(1e-6).scale(1));
      };
      check([&](double x) { return law.pressure(x); });
      check([&](double x) { return law.shear(x); });
      check([&](double x) { return law.stress(x); });
      check([](double x) { return couette_stress_factor(x); });
      check([](double x) { return ValueAndSlope{mean_gap(x).value, mean_gap(x).slope}; });
      check([](double x) { return ValueAndSlope{mean_gap(x).slope, mean_gap(x).curvature}; });
    }
  }
}

// No jump of value or slope at the ends of the fits' ranges, nor at tabulated ratios.
TEST_CASE("FlowFactors_AreContinuous") {
  constexpr double d = 1e-9;
  for (const double gamma : tabulated) {
    CAPTURE(gamma);
    const PatirCheng law(gamma);
    for (const double H : {0.5, 0.75, 1.0, 4.5, 5.0, 5.5, 6.0, 7.0}) {
      CAPTURE(H);
      const auto check = [&](const ValueAndSlope& below, const ValueAndSlope& above) {
        CHECK(std::abs(below.value - above.value) < kJump);
        CHECK(std::abs(below.slope - above.slope) < kJumpOfSlope);
      };
      check(law.pressure(H - d), law.pressure(H + d));
      check(law.shear(H - d), law.shear(H + d));
      check(law.stress(H - d), law.stress(H + d));
    }
    for (const double H : {3.0, 6.0}) {
      CHECK(std::abs(couette_stress_factor(H - d).value - couette_stress_factor(H + d).value) < kJump);
      CHECK(std::abs(couette_stress_factor(H - d).slope - couette_stress_factor(H + d).slope) < kJumpOfSlope);
    }
    if (gamma < 9 && gamma > 1.0 / 9) {
      CHECK(std::abs(PatirCheng(gamma * (1 - d)).pressure(1.7).value -
                     PatirCheng(gamma * (1 + d)).pressure(1.7).value) < kJump);
    }
  }
}

// Ridges across the flow pass the least oil, ridges along it the most; both limits are exact means.
TEST_CASE("PressureFactors_LieBetweenRidgesAcrossAndAlong") {
  for (const double H : {3.5, 4.0, 6.0, 10.0}) {
    CAPTURE(H);
    const double across = 1 / (std::pow(H, 3) * mean_over_heights([H](double y) { return std::pow(H + y, -3); }));
    const double along = 1 + 3 / (H * H);
    double before = across - 0.02;  // the fits' own accuracy
    for (const double gamma : tabulated) {
      CAPTURE(gamma);
      const double factor = PatirCheng(gamma).pressure(H).value;
      CHECK(factor > before);
      before = factor;
    }
    CHECK(before < along + 0.02);
  }
}

// Patir and Cheng fitted the pressure's part in the shear stress, phi_fp = 1 - D exp(-s H), by itself. Reciprocity of
// viscous flow ties it to the shear flow: on the smooth one of two surfaces phi_fp h = h_T - sigma Phi_s (film.46).
TEST_CASE("ShearFlow_IsReciprocalToThePressuresFraction") {
  const std::array<std::array<double, 2>, 7> fits{
      {{1.51, 0.52}, {1.51, 0.54}, {1.47, 0.58}, {1.40, 0.66}, {0.98, 0.79}, {0.97, 0.91}, {0.73, 0.91}}};
  for (std::size_t row = 0; row < fits.size(); ++row) {
    CAPTURE(tabulated[row]);
    for (const double H : {1.0, 2.0, 3.0, 4.0, 6.0}) {
      CAPTURE(H);
      const double published = 1 - fits[row][0] * std::exp(-fits[row][1] * H);
      const double reciprocal = (mean_gap(H).value - PatirCheng(tabulated[row]).shear(H).value) / H;
      CHECK(std::abs(published - reciprocal) < 0.03);
    }
  }
}

TEST_CASE("CouetteFactor_IsTheMeanOverTheHeights") {
  // Exact above H = 3, where no gap closes; below, gaps under sigma/100 count as that.
  for (const double H : {3.2, 4.5, 5.9, 6.1, 10.0, 100.0, 1e4}) {
    CAPTURE(H);
    // Midpoint rule of the reference, 20000 intervals.
    CHECK(couette_stress_factor(H).value ==
          doctest::Approx(mean_over_heights([H](double y) { return H / (H + y); })).epsilon(1e-6));
  }
  for (const double H : {0.5, 1.0, 2.0, 2.8}) {
    CAPTURE(H);
    const double mean = mean_over_heights([H](double y) { return H + y > 0.01 ? H / (H + y) : 0.0; });
    CHECK(couette_stress_factor(H).value == doctest::Approx(mean).epsilon(0.02));
  }
}

TEST_CASE("MeanGap_IsTheGaussianMean") {
  for (const double H : {-2.0, 0.0, 0.7, 3.0}) {
    CAPTURE(H);
    double sum = 0;
    const double step = 1e-3;
    for (double s = -H + step / 2; s < 10; s += step) {
      sum += step * (H + s) * std::exp(-0.5 * s * s) / std::sqrt(2 * std::numbers::pi);
    }
    CHECK(mean_gap(H).value == doctest::Approx(sum).epsilon(1e-6));  // midpoint rule of step 1e-3
  }
  CHECK(mean_gap(9).value == doctest::Approx(9).epsilon(1e-15));  // the tail beyond 9 sigma
}

TEST_CASE("FarFromContact_SurfacesAreSmooth") {
  for (const double gamma : tabulated) {
    const PatirCheng law(gamma);
    CHECK(law.pressure(60).value == doctest::Approx(1).epsilon(2e-3));  // longest tail: 0.87 H^-1.5
    CHECK(law.shear(60).value < 1e-6);                                  // tail at H = 60
    CHECK(law.stress(60).value == 0);
  }
  CHECK(couette_stress_factor(60).value == doctest::Approx(1 + 1.0 / 3600).epsilon(1e-6));  // next: of 60^-4
}

}  // namespace flow_factors_test
}  // namespace hersey::film
