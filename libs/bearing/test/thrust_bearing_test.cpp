#include "hersey/bearing/thrust_bearing.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <vector>

#include "hersey/bearing/plane_slider.h"
#include "hersey/bearing/steady_bearing.h"
#include "relative.h"

// Thrust bearings against independent solutions (theory manual, chapter thrust), and relations between their figures.
namespace hersey::bearing {
namespace thrust_bearing_test {

constexpr double r_o = 0.1, r_i = 0.05, mu = 0.02, omega = 300, h_2 = 20e-6;
constexpr double degree = std::numbers::pi / 180;

struct Thrust {
  film::FilmModel model;
  std::shared_ptr<const ThrustBearing> kind;
  OperatingPoint point;

  [[nodiscard]] SteadyState solve() const {
    SteadyState state;
    const SteadySummary summary = solve_steady(scaled_for(model, point), point, {.kind = kind}, state);
    REQUIRE_MESSAGE(summary.solved(), summary.message);
    return state;
  }
};

/// Flooded pads whose plane the runner passes at the distance h_2.
Thrust thrust(std::vector<SectorPad> pads, std::vector<SectorShape> shapes, int lines, int rows,
              bool is_forward = true) {
  Thrust t{.model = {.surface = film::Annulus{},
                     .R = 0.5 * (r_i + r_o),
                     .L = r_o - r_i,
                     .c = h_2,
                     .grid = thrust_grid(pads, lines, rows)},
           .kind = std::make_shared<ThrustBearing>(pads, std::move(shapes), is_forward),
           .point = {.journal_speed = is_forward ? omega : -omega,
                     .e = Coordinates::Constant(1, h_2),
                     .e_rate = Coordinates::Zero(1)}};
  t.model.lubricant.mu0 = mu;
  t.model.edge_left.ambient_fill = t.model.edge_right.ambient_fill = 1;
  t.model.ends.assign(pads.size(), {.first = {.ambient_fill = 1}, .last = {.ambient_fill = 1}});
  return t;
}

std::vector<SectorPad> equal_pads(int count, double arc, double first = 0) {
  std::vector<SectorPad> pads;
  for (int k = 0; k < count; ++k) {
    const double from = first + 2 * std::numbers::pi * k / count;
    pads.push_back({std::to_string(k + 1), from, from + arc});
  }
  return pads;
}

double load(const SteadyState& state) { return -state.load[0]; }

double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

constexpr double unit_load = mu * omega * r_o * r_o * r_o * r_o / (h_2 * h_2), unit_flow = omega * r_o * r_o * h_2,
                 unit_power = mu * omega * omega * r_o * r_o * r_o * r_o / h_2;

/// Figures of one pad, in the measures above: load, radius and angle of its centre [deg], power, flows, k h/W,
/// c omega h/W.
using PadFigures = std::array<double, 9>;

PadFigures pad_figures(const Thrust& t) {
  const SteadyState state = t.solve();
  const film::FilmObservables& o = state.film;
  const double x = o.wrench_on_shell[1] / load(state), y = -o.wrench_on_shell[0] / load(state);
  return {load(state) / unit_load,
          std::hypot(x, y) / r_o,
          std::atan2(y, x) / degree,
          -o.torque_journal * omega / unit_power,
          -o.flow_first / unit_flow,
          o.flow_right / unit_flow,
          o.flow_left / unit_flow,
          state.coefficients.stiffness(0, 0) * h_2 / load(state),
          state.coefficients.damping(0, 0) * omega * h_2 / load(state)};
}

// One of six pads of 50 degrees, ri = ro/2, by a program of its own, extrapolated from three grids to 1e-4 and better.
TEST_CASE("SectorPads_MeetIndependentSolutionsWithOrderTwo") {
  struct Case {
    const char* name;
    SectorRamp ramp;
    PadFigures exact;
  };
  const double arc = 50 * degree;
  for (const Case& c :
       {Case{"taper",
             {h_2, arc},
             {0.00828283, 0.753167, 29.49192, 0.146516, 0.329086, 0.0733648, 0.0389093, 2.161545, 1.745329}},
        Case{"taper and land",
             {1.5 * h_2, 40 * degree},
             {0.01093984, 0.755817, 28.97571, 0.150917, 0.375526, 0.1135135, 0.0597070, 2.051828, 1.240498}}}) {
    CAPTURE(c.name);
    const PadFigures coarse = pad_figures(thrust({{"1", 0, arc}}, {c.ramp}, 26, 21)),
                     fine = pad_figures(thrust({{"1", 0, arc}}, {c.ramp}, 51, 41));
    // (1/50)^2 times some two to five; an edge's flow is a slope of the pressure there.
    constexpr std::array<double, 9> bars{2e-3, 1e-3, 1e-3, 2e-3, 2e-3, 1e-2, 1e-2, 2e-3, 2e-3};
    for (std::size_t f = 0; f < fine.size(); ++f) {
      CAPTURE(f);
      CHECK(std::abs(fine[f] / c.exact[f] - 1) < bars[f]);
    }
    CHECK(order(coarse[0] / c.exact[0] - 1, fine[0] / c.exact[0] - 1) == doctest::Approx(2).epsilon(0.15));
  }
}

// A flat pad that leans as on a pivot 30 degrees behind its leading edge at 0.76 r_o, film h_2 there. Its own stiffness
// and damping by film at the pivot and both tilts, and of the pad that follows the runner at rest (2 by similarity) and
// at the frequency of the rotation, by the same program.
TEST_CASE("CoefficientsOfAPadOnAPivot_MeetAnIndependentSolution") {
  constexpr double r_p = 0.76 * r_o, onwards = 1.1160867 * h_2 / r_o, outwards = 0.0762492 * h_2 / r_o;
  Thrust t = thrust({{"1", -30 * degree, 20 * degree}}, {}, 61, 49);
  t.point.tilt = {-outwards, onwards};
  t.point.e[0] = h_2 - outwards * r_p;
  const SteadyState state = t.solve();
  const double W = load(state);
  CHECK(W / unit_load == relative(0.01678395).epsilon(1e-3));  // (1/48)^2 times some two
  // Position and slopes of the runner's axis by the film at the pivot and both tilts.
  Matrix3 by_pad;
  by_pad << 1, 0, -r_p, 0, 0, -1, 0, 1, 0;
  const Vector3 lengths(1, 1 / r_o, 1 / r_o);
  const auto of_pad = [&](const DynamicCoefficients::Matrix& m) -> Matrix3 {
    return lengths.asDiagonal() * (by_pad.transpose() * Matrix3(m) * by_pad) * lengths.asDiagonal() * (h_2 / W);
  };
  const Matrix3 K = of_pad(state.coefficients.stiffness), C = omega * of_pad(state.coefficients.damping);
  Matrix3 exact_K, exact_C;
  exact_K << 3.059709, -0.951194, 0.025008, -0.062675, 0.055474, 0.009983, 0.005901, -0.007043, 0.025697;
  exact_C << 2.383859, 0.008432, -0.019183, 0.008432, 0.034155, -0.004075, -0.019183, -0.004075, 0.014301;
  CHECK((K - exact_K).norm() < 5e-4 * exact_K.norm());  // (1/48)^2
  CHECK((C - exact_C).norm() < 5e-4 * exact_C.norm());  // likewise
  const auto following = [&](double nu) {
    const Eigen::Matrix3cd Z = K.cast<std::complex<double>>() + std::complex<double>(0, nu) * C;
    const Eigen::Vector2cd answer = Z.bottomRightCorner<2, 2>().inverse() * Z.block<2, 1>(1, 0);
    return Z(0, 0) - (Z.block<1, 2>(0, 1) * answer)(0, 0);
  };
  CHECK(following(0).real() == relative(2.0).epsilon(1e-3));       // (1/48)^2 times some two
  CHECK(following(1).real() == relative(2.461597).epsilon(1e-3));  // likewise
  CHECK(following(1).imag() == relative(2.985266).epsilon(1e-3));  // likewise
}

// A tilted even washer, ri = ro/2, its film 1 - cos(phi)/2 from thin to wide, at a pressure of 0.05 on both edges; oil
// by an independent solution that conserves it.
TEST_CASE("TiltedWasher_MeetsAnIndependentSolution") {
  Thrust t = thrust({}, {}, 180, 41);
  const double p_edge = 0.05 * mu * omega * r_o * r_o / (h_2 * h_2);
  t.model.edge_left.pressure = t.model.edge_right.pressure = p_edge;
  t.point.tilt = {-0.5 * h_2 / r_o, 0};  // the gap is widest at phi = 0
  const SteadyState state = t.solve();
  const Vector6& W = state.film.wrench_on_shell;
  CHECK(load(state) / unit_load == relative(0.130208).epsilon(3e-3));                // (1/40)^2 times some five
  CHECK(-W[0] / (unit_load * r_o) == relative(0.0459537).epsilon(6e-3));             // likewise, of the moment
  CHECK(W[1] / (unit_load * r_o) == relative(-0.0095030).epsilon(2e-2));             // a difference of two halves
  CHECK(state.film.flow_right / unit_flow == relative(-0.0021655).epsilon(2e-2));    // the reference's first order
  CHECK(std::abs(state.film.flow_left + state.film.flow_right) < 1e-9 * unit_flow);  // the film's tolerance
  CHECK(state.film.cavitated_share == relative(0.10635).epsilon(5e-2));              // a share of nodes
}

// Far from the axis a sector is a rectangle: the deviation falls with width over radius, squared.
TEST_CASE("SectorFarFromTheAxis_IsAPlaneSlider") {
  constexpr double B = 0.05, L = 0.04, U = 3;
  film::FilmModel plane{.surface = film::Plane{}, .R = 1, .L = L, .c = h_2, .grid = slider_grid(B, 21, 13)};
  plane.lubricant.mu0 = mu;
  plane.edge_left.ambient_fill = plane.edge_right.ambient_fill = 1;
  plane.ends = {{.first = {.ambient_fill = 1}, .last = {.ambient_fill = 1}}};
  const OperatingPoint slides{.journal_speed = U, .e = Coordinates::Constant(1, -h_2), .e_rate = Coordinates::Zero(1)};
  SteadyState slider;
  REQUIRE(solve_steady(scaled_for(plane, slides), slides,
                       {.kind = std::make_shared<PlaneSlider>(B, std::vector<PadShape>{PadRamp{h_2, B}})}, slider)
              .solved());
  std::array<double, 2> deviation{};
  for (const int k : {0, 1}) {
    const double R = k == 0 ? 2 : 4;
    Thrust t = thrust({{"1", 0, B / R}}, {SectorRamp{h_2, B / R}}, 21, 13);
    t.model.R = R, t.model.L = L;
    t.point.journal_speed = U / R;
    const SteadyState state = t.solve();
    deviation[static_cast<std::size_t>(k)] = load(state) / slider.load[0] - 1;
    CHECK(state.film.p_max == relative(slider.film.p_max).epsilon(1e-2));  // of first order in L/R
    CHECK(-state.film.torque_journal / R == relative(slider.film.wrench_on_shell[4]).epsilon(1e-3));  // (L/R)^2
    CHECK(state.film.flow_first == relative(slider.film.flow_first).epsilon(1e-3));                   // likewise
    CHECK(state.film.flow_sides() == relative(slider.film.flow_sides()).epsilon(1e-3));               // likewise
    CHECK(state.coefficients.stiffness(0, 0) ==
          relative(slider.coefficients.stiffness(0, 0)).epsilon(1e-3));                                    // likewise
    CHECK(state.coefficients.damping(0, 0) == relative(slider.coefficients.damping(0, 0)).epsilon(1e-3));  // likewise
  }
  CHECK(std::abs(deviation[1]) < 1e-4);  // (L/R)^2 = 1e-4
  CHECK(order(deviation[0], deviation[1]) == doctest::Approx(2).epsilon(0.1));
}

/// Moment on the stator across its axis.
Eigen::Vector2d moment(const SteadyState& state) { return state.film.wrench_on_shell.head<2>(); }

constexpr double solved = 1e-8;  // residuals of 1e-10, in sums

// Turned about the axis with its runner's tilt, a bearing is the same; all but its vectors, which turn with it.
TEST_CASE("TurnedThrustBearing_IsTheSame") {
  const std::vector<SectorShape> shapes{SectorRamp{h_2, 0.5}, SectorBarrel{2e-6}};
  const double angle = 1.234;
  Thrust a = thrust(equal_pads(3, 1.4), shapes, 13, 9), b = thrust(equal_pads(3, 1.4, angle), shapes, 13, 9);
  const Eigen::Rotation2Dd turn(angle);
  a.point.tilt = {6e-5, -3e-5};
  b.point.tilt = turn * a.point.tilt;
  const SteadyState here = a.solve(), there = b.solve();
  CHECK(load(there) == relative(load(here)).epsilon(solved));
  CHECK(there.film.torque_journal == relative(here.film.torque_journal).epsilon(solved));
  CHECK((moment(there) - turn * moment(here)).norm() < solved * moment(here).norm());
  const auto turned = [&](const DynamicCoefficients::Matrix& m) {
    Matrix3 Q = Matrix3::Identity();
    Q.bottomRightCorner<2, 2>() = turn.toRotationMatrix();
    return Matrix3(Q * m * Q.transpose());
  };
  CHECK((there.coefficients.stiffness - turned(here.coefficients.stiffness)).norm() <
        1e-6 * here.coefficients.stiffness.norm());  // derivatives, of mixed units
  CHECK((there.coefficients.damping - turned(here.coefficients.damping)).norm() <
        1e-6 * here.coefficients.damping.norm());  // likewise
}

// Pads for the other sense are the mirror image below a runner that turns the other way.
TEST_CASE("PadsForTheOtherSense_AreMirrorImages") {
  const std::vector<SectorShape> shapes{SectorRamp{h_2, 0.5}, SectorIncline{1e-4, 5e-5}};
  Thrust a = thrust({{"1", 0.2, 1.1}}, shapes, 21, 9), b = thrust({{"1", -1.1, -0.2}}, shapes, 21, 9, false);
  a.point.tilt = {6e-5, -3e-5};
  b.point.tilt = {6e-5, 3e-5};
  const SteadyState here = a.solve(), there = b.solve();
  CHECK(load(there) == relative(load(here)).epsilon(solved));
  CHECK(there.film.torque_journal == relative(-here.film.torque_journal).epsilon(solved));
  CHECK(there.film.torque_shell == relative(-here.film.torque_shell).epsilon(solved));
  CHECK(there.film.flow_last == relative(here.film.flow_first).epsilon(solved));
  CHECK(there.film.flow_right == relative(here.film.flow_right).epsilon(solved));
  CHECK(there.film.wrench_on_shell[1] == relative(here.film.wrench_on_shell[1]).epsilon(solved));
  CHECK(there.film.wrench_on_shell[0] == relative(-here.film.wrench_on_shell[0]).epsilon(solved));
}

// All lengths in the plane doubled: pressures with r^2, loads with r^4.
TEST_CASE("LargerThrustBearing_IsTheSameInItsOwnMeasures") {
  const Thrust small = thrust(equal_pads(2, 2), {SectorRamp{h_2, 1.5}, SectorCone{3e-6}}, 17, 9);
  Thrust large = small;
  large.model.R *= 2, large.model.L *= 2;
  const SteadyState a = small.solve(), b = large.solve();
  CHECK(load(b) == relative(16 * load(a)).epsilon(solved));
  CHECK(b.film.torque_journal == relative(16 * a.film.torque_journal).epsilon(solved));
  CHECK(b.film.flow_right == relative(4 * a.film.flow_right).epsilon(solved));
}

// Pads between grooves are a washer with radial grooves of the same pressure, their borders on lines of its grid.
TEST_CASE("PadsBetweenGrooves_AreAWasherWithThem") {
  constexpr double p = 2e5;
  constexpr int lines = 72, pads = 4, on_pad = 15;  // 14 cells of 5 degrees on each pad, 4 of each groove
  const double cell = 2 * std::numbers::pi / lines;
  Thrust sectors = thrust(equal_pads(pads, 14 * cell), {}, on_pad, 13), washer = thrust({}, {}, lines, 13);
  for (film::PatchEnds& ends : sectors.model.ends) ends.first.pressure = ends.last.pressure = p;
  for (film::FilmModel* model : {&sectors.model, &washer.model})
    model->edge_left.pressure = model->edge_right.pressure = p;
  for (int k = 0; k < pads; ++k)
    washer.model.features.push_back({.name = std::to_string(k),
                                     .phi = (18 * k + 16) * cell,
                                     .arc = 4 * cell * (1 + 1e-9),
                                     .length = 2 * washer.model.L,
                                     .pressure = p});
  for (Thrust* t : {&sectors, &washer}) t->point.tilt = {1e-4, 5e-5};
  const SteadyState a = sectors.solve(), b = washer.solve();
  // The grooves bear their own pressure, too, and are sheared.
  double largest = 0;
  for (int i = 0; i < pads * on_pad; ++i) {
    for (int j = 0; j < 13; ++j) {
      const int line = 18 * (i / on_pad) + i % on_pad;
      largest = std::max(largest, std::abs(a.u[13 * i + j] - b.u[13 * line + j]));
    }
  }
  CHECK(largest < 1e-7 * a.film.p_max);                         // the film's tolerance
  CHECK(a.film.p_max == relative(b.film.p_max).epsilon(1e-7));  // likewise
  CHECK(a.film.flow_right > 0);
}

// Stiffness and damping by distance and both tilts are differences of forces.
TEST_CASE("ThrustCoefficients_MatchDifferences") {
  Thrust t = thrust({{"1", 0.3, 1.4}}, {SectorRamp{h_2, 1.1}}, 21, 9);
  t.point.tilt = {1e-4, 5e-5};
  const SteadyState state = t.solve();
  const auto forces = [](const SteadyState& at) -> Vector3 {
    const Vector6& W = at.film.wrench_on_shell;
    return {W[5], W[1], -W[0]};
  };
  const std::array<double, 3> steps{1e-3 * h_2, 1e-3 * h_2 / r_o, 1e-3 * h_2 / r_o};
  const auto moved = [&](int k, double by, bool is_rate) {
    Thrust other = t;
    double& value = k == 0 ? (is_rate ? other.point.e_rate[0] : other.point.e[0])
                           : (is_rate ? other.point.tilt_rate : other.point.tilt)[k - 1];
    value += by;
    return forces(other.solve());
  };
  for (int k = 0; k < 3; ++k) {
    CAPTURE(k);
    const double h = steps[static_cast<std::size_t>(k)];
    const Vector3 stiffness = (moved(k, h, false) - moved(k, -h, false)) / (2 * h);
    const Vector3 damping = (moved(k, omega * h, true) - moved(k, -omega * h, true)) / (2 * omega * h);
    constexpr double of_difference = 1e-5;  // the square of the step, times the curvature of a power of the gap
    CHECK((state.coefficients.stiffness.col(k) - stiffness).norm() < of_difference * stiffness.norm());
    CHECK((state.coefficients.damping.col(k) - damping).norm() < of_difference * damping.norm());
  }
}

// What torque and load put in is dissipated: of second order, as shear and flow are summed by different rules.
TEST_CASE("PowerOfTaperedPads_IsBalanced") {
  std::array<double, 2> errors{};
  for (const int k : {0, 1}) {
    Thrust t = thrust({{"1", 0, 1}}, {SectorRamp{h_2, 0.7}, SectorCone{5e-6}}, k == 0 ? 51 : 101, k == 0 ? 25 : 49);
    t.point.tilt = {1e-4, 5e-5};
    t.point.e[0] = 2 * h_2;
    t.point.e_rate[0] = -2e-3;
    const SteadyState state = t.solve();
    const double put_in = -state.film.torque_journal * omega + state.load[0] * t.point.e_rate[0];
    errors[static_cast<std::size_t>(k)] = put_in / state.film.power_taken() - 1;
  }
  CHECK(std::abs(errors[1]) < 4e-4);  // (1/48)^2
  CHECK(order(errors[0], errors[1]) > 1.7);
}

// The film thickness of a load carries that load, from a light one to a heavy one.
TEST_CASE("ThicknessOfAThrust_CarriesIt") {
  for (const double wanted : {50.0, 5e3, 100e3}) {
    CAPTURE(wanted);
    Thrust t = thrust(equal_pads(6, 0.8), {SectorRamp{h_2, 0.6}}, 13, 9);
    t.point.tilt = {1e-5, 0};
    t.point.load = Coordinates::Constant(1, -wanted);
    const SteadyState found = t.solve();
    CHECK(load(found) == relative(wanted).epsilon(1e-9));  // the search's tolerance of 1e-10
    t.point.load.reset();
    t.point.e = found.e;
    CHECK(load(t.solve()) == relative(wanted).epsilon(1e-8));  // the same film once more
  }
}

}  // namespace thrust_bearing_test
}  // namespace hersey::bearing
