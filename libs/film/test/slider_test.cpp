#include <doctest/doctest.h>

#include <array>

#include "film_closed_forms.h"
#include "plane_slider.h"
#include "relative.h"

// Plane sliders against closed forms and exact solutions.
namespace hersey::film {
namespace slider_test {

double order(double coarse, double fine, double refinement = 2) {
  return std::log(std::abs(coarse / fine)) / std::log(refinement);
}

// Reynolds' slider at its optimum inclination, Lamb's closed form.
TEST_CASE("LongSlider_ConvergesToTheClosedFormWithOrderTwo") {
  const double K = 1.18870, exact = verification::LongSlider{K}.load();
  CHECK(exact == relative(0.0267072).epsilon(2e-6));
  const Slider slider{0.05, 3, 0.02, 0, [&](double x) { return 2e-5 * (1 + K * (1 - x / 0.05)); }};
  const double unit = 6 * slider.mu * slider.U * std::pow(slider.length / 2e-5, 2);
  std::array<double, 2> error{};
  for (int k = 0; k < 2; ++k) error[k] = solve(slider, k == 0 ? 50 : 100).load / unit / exact - 1;
  CHECK(std::abs(error[1]) < 2e-4);
  CHECK(order(error[0], error[1]) == doctest::Approx(2).epsilon(0.02));
}

// Rayleigh's step at its optimum. A jump of the gap between two nodes is resolved as a ramp over that cell.
TEST_CASE("RayleighStep_MatchesTheClosedForm") {
  const double inlet = 0.71823, ratio = 1 + 0.5 * std::sqrt(3);
  const auto gap = [](double) { return 2e-5; };
  const Slider slider{0.05, 3, 0.02, 0, gap, 0, inlet * 0.05, 2e-5 * (ratio - 1)};
  const double unit = 6 * slider.mu * slider.U * std::pow(slider.length / 2e-5, 2);
  for (const int n : {100, 103, 400, 1600}) {
    CAPTURE(n);
    const SolvedSlider s = solve(slider, n);
    CHECK(std::abs(s.load / unit / 0.0343779 - 1) < 0.01 / n + 2e-6);  // the reference has six digits
  }
}

// Parabolic slider between ends at the cavitation pressure (reference: exact solution of the mass-conserving problem).
TEST_CASE("ParabolicSlider_ConvergesToTheExactSolutionWithOrderTwo") {
  const double length = 0.0762;
  const Slider slider{length, 4.57, 0.039, 0,
                      [&](double x) { return 25.4e-6 * (1 + std::pow(2 * x / length - 1, 2)); }};
  std::array<double, 2> load_error{}, peak_error{};
  for (int k = 0; k < 2; ++k) {
    const SolvedSlider s = solve(slider, k == 0 ? 190 : 380);
    load_error[k] = s.load / 101349.50 - 1;
    peak_error[k] = s.film.observed.p_max / 3.591787e6 - 1;
    int last = 0;
    for (int i = 0; i <= s.n; ++i) {
      if (s.p[i] > 0) last = i;
    }
    CHECK(std::abs((last + 0.5) * s.dx - 0.05173480) < s.dx);
  }
  CHECK(std::abs(load_error[1]) < 2e-4);
  CHECK(std::abs(peak_error[1]) < 2e-4);
  CHECK(order(load_error[0], load_error[1]) == doctest::Approx(2).epsilon(0.05));
  CHECK(order(peak_error[0], peak_error[1]) == doctest::Approx(2).epsilon(0.05));
}

struct PocketErrors {
  double flow = 0, front = 0, peak = 0;  // of the flow, reformation [cells] and peak pressure
};

// A slider with a pocket (Fowell et al. 2007; Giacopini et al. 2010): the film cavitates at the pocket's leading edge
// and re-forms within it.
PocketErrors pocket(int n) {
  const auto gap = [](double x) { return 1.05e-6 - 5e-6 * x; };
  const SolvedSlider s = solve({10e-3, 1, 0.01, 1e5, gap, 2e-3, 5e-3, 1e-6}, n);
  int last = 0, first = n;
  for (int k = 0; k <= n; ++k) {
    if (s.theta[k] < 1 - 1e-9) last = k, first = std::min(first, k);  // full but for round-off
  }
  CHECK(std::abs(first * s.dx - 2e-3) <= s.dx);
  // The front's own node is partly full: its fill fraction in excess of the one before gives the position of the front
  // in the cell.
  const double before = s.theta[last - 1], fraction = (s.theta[last] - before) / (1 - before);
  return {s.flow / 5.229635e-7 - 1, ((last + 1 - fraction) * s.dx - 3.611263e-3) / s.dx,
          (s.film.fields.p.maxCoeff()) / 9.808819e6 - 1};
}

TEST_CASE("PocketSlider_RupturesAndReforms") {
  // Both steps on nodes: as exact as the reference's digits.
  for (const int n : {100, 200}) {
    CAPTURE(n);
    const PocketErrors e = pocket(n);
    CHECK(std::abs(e.flow) < 2e-7);
    CHECK(std::abs(e.front) < 0.5);
    CHECK(std::abs(e.peak) < 4e-7);
  }
  // Steps lie between nodes, at the same position in their cells on both grids: order one.
  const PocketErrors coarse = pocket(101), fine = pocket(1111);
  CHECK(std::abs(coarse.flow) < 5e-4);
  CHECK(std::abs(coarse.front) < 1);
  CHECK(std::abs(fine.front) < 1);
  CHECK(order(coarse.flow, fine.flow, 11) == doctest::Approx(1).epsilon(0.05));
  CHECK(order(coarse.peak, fine.peak, 11) == doctest::Approx(1).epsilon(0.1));
}

}  // namespace slider_test
}  // namespace hersey::film
