#include "hersey/bearing/plane_slider.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "hersey/bearing/steady_bearing.h"
#include "relative.h"

// A pad on a runner against closed forms (theory manual, chapter slider), and relations between its figures.
namespace hersey::bearing {
namespace plane_slider_test {

constexpr double B = 0.05, L = 0.04, mu = 0.02, U = 3, h2 = 20e-6;

struct Slider {
  film::FilmModel model;
  std::shared_ptr<const PlaneSlider> kind;
  OperatingPoint point;

  [[nodiscard]] SteadyState solve() const {
    SteadyState state;
    const SteadySummary summary = solve_steady(scaled_for(model, point), point, {.kind = kind}, state);
    REQUIRE_MESSAGE(summary.solved(), summary.message);
    return state;
  }
};

/// A pad of flooded ends and open sides, its smallest gap h2 at the trailing end.
Slider slider(std::vector<PadShape> shapes, int lines, int rows) {
  Slider s{.model = {.surface = film::Plane{}, .R = 1, .L = L, .c = h2, .grid = slider_grid(B, lines, rows)},
           .kind = std::make_shared<PlaneSlider>(B, std::move(shapes)),
           .point = {.journal_speed = U, .e = Coordinates::Constant(1, -h2), .e_rate = Coordinates::Zero(1)}};
  s.model.lubricant.mu0 = mu;
  s.model.edge_left.ambient_fill = s.model.edge_right.ambient_fill = 1;
  s.model.ends = {{.first = {.ambient_fill = 1}, .last = {.ambient_fill = 1}}};
  return s;
}

/// The same between closed sides: nothing varies across.
Slider long_slider(std::vector<PadShape> shapes, int lines) {
  Slider s = slider(std::move(shapes), lines, 3);
  s.model.edge_left.kind = s.model.edge_right.kind = film::EdgeKind::closed;
  return s;
}

double load(const SteadyState& state) { return state.load[0]; }
double drag(const SteadyState& state) { return state.film.wrench_on_shell[4] + state.tilt.x() * load(state); }

double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

// Reynolds' taper between closed sides (slider.8, slider.9): by a ramp of the pad, and by a tilt of the runner.
TEST_CASE("Taper_MeetsTheClosedFormWithOrderTwo") {
  constexpr double K = 1.2;
  const double unit = 6 * mu * U * L * std::pow(B / h2, 2), ln = std::log1p(K);
  const double exact_load = unit * (ln - 2 * K / (K + 2)) / (K * K);
  const double exact_drag = mu * U * L * B / h2 * (4 * ln - 6 * K / (2 + K)) / K;
  const double exact_flow = U * h2 * (1 + K) / (2 + K) * L;
  const double exact_peak = 6 * mu * U * B / (h2 * h2) * K / (4 * (1 + K) * (2 + K));
  // From the leading end: the moment of the same pressure.
  const double exact_centre = B - B * (K * (6 + K) - 2 * (3 + 2 * K) * ln) / (2 * K * ((2 + K) * ln - 2 * K));
  for (const bool is_tilted : {false, true}) {
    CAPTURE(is_tilted);
    std::array<std::array<double, 5>, 2> errors{};
    for (const int k : {0, 1}) {
      Slider s = long_slider(is_tilted ? std::vector<PadShape>{} : std::vector<PadShape>{PadRamp{K * h2, B}},
                             k == 0 ? 41 : 81);
      if (is_tilted) s.point.tilt.x() = K * h2 / B, s.point.e[0] = -h2 * (1 + K / 2);
      const SteadyState state = s.solve();
      const double centre = 0.5 * B - state.film.wrench_on_shell[2] / load(state);
      errors[static_cast<std::size_t>(k)] = {load(state) / exact_load - 1, drag(state) / exact_drag - 1,
                                             state.film.flow_last / exact_flow - 1, state.film.p_max / exact_peak - 1,
                                             centre / exact_centre - 1};
      CHECK(state.film.flow_first == relative(-state.film.flow_last).epsilon(1e-9));  // the film's tolerance
      CHECK(state.film.cavitated_share == 0);                                         // flooded ends are full
      CHECK(std::isnan(state.film.rupture_angle));
    }
    for (std::size_t f = 0; f < errors[0].size(); ++f) {
      CAPTURE(f);
      CHECK(std::abs(errors[1][f]) < 4e-4);  // (1/80)^2 times some two
      if (std::abs(errors[1][f]) > 1e-7)     // what is exact on every grid has no order
        CHECK(order(errors[0][f], errors[1][f]) > 1.8);
    }
  }
}

// On 801 lines the load is that of the closed form to 1e-5.
TEST_CASE("TaperOnAFineGrid_MeetsTheClosedForm") {
  constexpr double K = 1.2;
  const double exact = 6 * mu * U * L * std::pow(B / h2, 2) * (std::log1p(K) - 2 * K / (K + 2)) / (K * K);
  CHECK(load(long_slider({PadRamp{K * h2, B}}, 801).solve()) ==
        relative(exact).epsilon(1e-5));  // (1/800)^2 times some two, doubled
}

// Rayleigh's step (slider.10): of second order where its border lies on a line, as the load is a sum over nodes of a
// pressure with a kink; between lines to a small fraction of a cell.
TEST_CASE("Step_MeetsTheClosedForm") {
  const double depth = 0.866 * h2, h1 = h2 + depth;
  for (const double fraction : {0.72, 0.7183}) {
    for (const int cells : {50, 200}) {
      CAPTURE(fraction);
      CAPTURE(cells);
      const double B1 = fraction * B, B2 = B - B1;
      Slider s = long_slider({}, cells + 1);
      s.model.features = {
          {.name = "step", .phi = 0.5 * (B1 - B), .arc = B1, .length = L, .is_fed = false, .depth = depth}};
      const double exact = 3 * mu * U * L * (h1 - h2) * B * B1 * B2 / (B1 * h2 * h2 * h2 + B2 * h1 * h1 * h1);
      const bool is_on_line = std::abs(fraction * cells - std::round(fraction * cells)) < 1e-9;  // round-off
      CHECK(load(s.solve()) == relative(exact).epsilon(is_on_line ? 1.0 / (cells * cells) : 0.05 / cells));  // as above
    }
  }
}

// Reference: exact solution of the mass-conserving problem, as in the film's own tests.
TEST_CASE("Parabola_MeetsTheExactSolution") {
  constexpr double length = 0.0762, gap = 25.4e-6;
  std::array<double, 2> errors{};
  for (const int k : {0, 1}) {
    Slider s = long_slider({PadCrown{gap}}, k == 0 ? 191 : 381);
    s.kind = std::make_shared<PlaneSlider>(length, std::vector<PadShape>{PadCrown{gap}});
    s.model.grid = slider_grid(length, k == 0 ? 191 : 381, 3);
    s.model.lubricant.mu0 = 0.039;
    s.model.c = gap;
    s.point.journal_speed = 4.57;
    s.point.e[0] = -gap;
    errors[static_cast<std::size_t>(k)] = load(s.solve()) / (101349.50 * L) - 1;
  }
  CHECK(std::abs(errors[1]) < 1e-4);  // (1/380)^2 times some ten: a cavity and a peak
  CHECK(order(errors[0], errors[1]) == doctest::Approx(2).epsilon(0.1));
}

// The film thickness of a load carries that load, from a light one to one near the most that this film bears: the force
// of a ramp of a given rise grows like a logarithm only as the land behind it closes.
TEST_CASE("ThicknessOfALoad_CarriesThatLoad") {
  for (const double tilt : {0.0, 4e-4}) {
    for (const double wanted : {5.0, 500.0, 5e3, 40e3}) {
      CAPTURE(tilt);
      CAPTURE(wanted);
      Slider s = slider({PadRamp{h2, 0.4 * B}, PadBarrel{2e-6}}, 26, 13);
      s.point.tilt = {tilt, -0.2 * tilt};
      s.point.load = Coordinates::Constant(1, wanted);
      const SteadyState found = s.solve();
      CHECK(load(found) == relative(wanted).epsilon(1e-9));  // the search's tolerance of 1e-10
      Slider placed = s;
      placed.point.load.reset();
      placed.point.e = found.e;
      CHECK(load(placed.solve()) == relative(wanted).epsilon(1e-8));  // the same film once more
    }
  }
}

// Stiffness and damping by position and both tilts are differences of forces.
TEST_CASE("Coefficients_MatchDifferences") {
  Slider s = slider({PadRamp{h2, B}}, 21, 9);
  s.point.tilt = {1e-4, 5e-5};
  const SteadyState state = s.solve();
  const auto forces = [](const SteadyState& at) -> Vector3 {
    const Vector6& W = at.film.wrench_on_shell;
    return {W[3], -W[2], W[1]};
  };
  const std::array<double, 3> steps{1e-3 * h2, 1e-3 * h2 / B, 1e-3 * h2 / L};
  const auto moved = [&](int k, double by, bool is_rate) {
    Slider other = s;
    double& value = k == 0 ? (is_rate ? other.point.e_rate[0] : other.point.e[0])
                           : (is_rate ? other.point.tilt_rate : other.point.tilt)[k - 1];
    value += by;
    return forces(other.solve());
  };
  for (int k = 0; k < 3; ++k) {
    CAPTURE(k);
    const double h = steps[static_cast<std::size_t>(k)];
    const Vector3 stiffness = (moved(k, h, false) - moved(k, -h, false)) / (2 * h);
    const Vector3 damping = (moved(k, U * h, true) - moved(k, -U * h, true)) / (2 * U * h);
    constexpr double of_difference = 1e-5;  // the square of the step, times the curvature of a power of the gap
    CHECK((state.coefficients.stiffness.col(k) - stiffness).norm() < of_difference * stiffness.norm());
    CHECK((state.coefficients.damping.col(k) - damping).norm() < of_difference * damping.norm());
  }
}

// A runner that comes from the other side meets the mirrored pad; across, nothing knows left from right.
TEST_CASE("MirroredSliders_AreMirrorImages") {
  Slider s = slider({}, 26, 9);
  s.point.tilt = {6e-4, 1e-4};
  const SteadyState state = s.solve();
  Slider along = s, across = s;
  along.point.journal_speed = -U, along.point.tilt.x() = -6e-4;
  across.point.tilt.y() = -1e-4;
  constexpr double solved = 1e-9;  // residuals of 1e-10
  const SteadyState back = along.solve(), side = across.solve();
  CHECK(load(back) == relative(load(state)).epsilon(solved));
  CHECK(drag(back) == relative(-drag(state)).epsilon(solved));
  CHECK(back.film.flow_first == relative(state.film.flow_last).epsilon(solved));
  CHECK(load(side) == relative(load(state)).epsilon(solved));
  CHECK(side.film.flow_left == relative(state.film.flow_right).epsilon(solved));
  CHECK(side.film.wrench_on_shell[1] == relative(-state.film.wrench_on_shell[1]).epsilon(1e-7));  // a difference
}

// Lengths in the plane doubled and gaps kept: four times the area, and pressures with U B/h^2.
TEST_CASE("LargerSlider_IsTheSameInItsOwnMeasures") {
  const Slider s = slider({PadRamp{h2, B}}, 21, 9);
  Slider large = s;
  large.kind = std::make_shared<PlaneSlider>(2 * B, std::vector<PadShape>{PadRamp{h2, 2 * B}});
  large.model.L *= 2;
  large.model.grid = slider_grid(2 * B, 21, 9);
  const SteadyState a = s.solve(), b = large.solve();
  CHECK(load(b) == relative(8 * load(a)).epsilon(1e-9));  // the film's tolerance
  CHECK(drag(b) == relative(4 * drag(a)).epsilon(1e-9));  // likewise
}

// What drag and load put in is dissipated: of second order, as shear and flow are summed by different rules.
TEST_CASE("PowerOfASlider_IsBalanced") {
  std::array<double, 2> errors{};
  for (const int k : {0, 1}) {
    Slider s = slider({PadRamp{h2, 0.6 * B}}, k == 0 ? 31 : 61, k == 0 ? 17 : 33);
    s.point.tilt = {2e-4, 1e-4};
    s.point.e[0] = -2 * h2;
    s.point.e_rate[0] = 2e-3;
    const SteadyState state = s.solve();
    const double put_in = drag(state) * U + load(state) * s.point.e_rate[0];
    errors[static_cast<std::size_t>(k)] = put_in / state.film.power_taken() - 1;
  }
  CHECK(std::abs(errors[1]) < 1e-3);  // (1/32)^2
  CHECK(order(errors[0], errors[1]) > 1.7);
}

}  // namespace plane_slider_test
}  // namespace hersey::bearing
