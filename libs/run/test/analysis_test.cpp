#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/bearing/steady_bearing.h"
#include "hersey/core/input_error.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace analysis_test {

constexpr double kRoots = 1e-9;  // round-off of eigenvalues, and of the state they belong to
constexpr double kRest = 1e-9;   // rows at rest within 1e-10 of what they balance

constexpr double kPi = std::numbers::pi;
constexpr double g = 9.81;
const std::string kPoint = "inertia: {xx: 1e-12 kg.m^2, yy: 1e-12 kg.m^2, zz: 1e-12 kg.m^2}";

/// One analysis and what its results file holds.
class Analysed {
 public:
  explicit Analysed(const std::string& text, const std::vector<std::string>& overrides = {})
      : summary(simulate(rig(text, overrides), {.results = scratch_ / "run.h5"})), reader_(summary.results) {
    CAPTURE(summary.message);
  }
  [[nodiscard]] std::vector<double> read(const std::string& path) const { return reader_.read(path).values; }
  [[nodiscard]] std::vector<double> mode(const std::string& what) const { return read("/modes/fields/" + what); }

 private:
  TemporaryDirectory scratch_;

 public:
  Summary summary;

 private:
  results::Reader reader_;
};

std::string pendulums(const std::string& extra, const std::string& simulation) {
  return R"(hersey: 1
parameters: {from: 0 deg}
gravity: 0 -9.81 0 m/s^2
bodies:
  one: {mass: 1 kg, centre_of_mass: 0 -1 0 m, )" +
         kPoint + R"(, frames: {tip: {origin: 0 -1 0 m}}}
)" + extra +
         "simulation: {" + simulation + "}\n";
}

std::string double_pendulum(const std::string& simulation) {
  return pendulums("  two: {mass: 1 kg, centre_of_mass: 0 -1 0 m, " + kPoint + R"(}
joints:
  upper: {type: revolute, between: [ground, one]}
  lower: {type: revolute, between: [one.tip, two]}
)",
                   simulation);
}

TEST_CASE("DoublePendulum_HasItsTwoFrequencies") {
  // omega^2 = (g/L)(2 -+ sqrt 2); the lower bob swings sqrt 2 times as far as the upper, with it or against it.
  const Analysed a(double_pendulum("analysis: modes"));
  REQUIRE(a.summary.status == Status::completed);
  const std::vector<double> f = a.mode("frequency"), damping = a.mode("damping_ratio"), shape = a.mode("shape_real");
  REQUIRE(f.size() == 2);
  CHECK(2 * kPi * f[0] == doctest::Approx(std::sqrt(g * (2 - std::sqrt(2)))).epsilon(kRoots));
  CHECK(2 * kPi * f[1] == doctest::Approx(std::sqrt(g * (2 + std::sqrt(2)))).epsilon(kRoots));
  CHECK(std::abs(damping[0]) < kRoots);
  // Relative angle of the lower joint over the upper's: absolute ratio sqrt 2 less 1.
  // Shapes: vectors of roots that are good to 1e-9.
  CHECK(shape[1] / shape[0] == doctest::Approx(std::sqrt(2) - 1).epsilon(1e-6));
  CHECK(shape[3] / shape[2] == doctest::Approx(-std::sqrt(2) - 1).epsilon(1e-6));
  // Motion of each body: the upper one rotates by its joint, the lower one by both; its origin is the upper's tip, 1 m
  // below.
  const std::vector<double> bodies = a.mode("body_real");
  REQUIRE(bodies.size() == 24);
  // The same numbers: round-off.
  CHECK(bodies[2] == doctest::Approx(shape[0]).epsilon(1e-12));
  CHECK(bodies[8] == doctest::Approx(shape[0] + shape[1]).epsilon(1e-12));
  CHECK(bodies[9] == doctest::Approx(shape[0]).epsilon(1e-12));
}

TEST_CASE("ChainOfMassesAndSprings_HasItsFrequencies") {
  // n equal masses between walls: omega_j = 2 sqrt(k/m) sin(j pi/(2(n + 1))).
  constexpr int n = 4;
  std::string text = "hersey: 1\nbodies:\n  ground: {frames: {end: {origin: 5 0 0 m}}}\n", joints = "joints:\n",
              forces =
                  "forces:\n  s0: {type: spring_damper, between: [ground, m1], stiffness: 300 N/m, free_length: 1 m}\n";
  for (int i = 1; i <= n; ++i) {
    const std::string name = "m" + std::to_string(i);
    text += "  " + name + ": {mass: 3 kg, " + kPoint + "}\n";
    joints += "  j" + std::to_string(i) + ": {type: prismatic, between: [ground, " + name +
              "], axis: x, initial: {translation: " + std::to_string(i) + " m}}\n";
    forces += "  s" + std::to_string(i) + ": {type: spring_damper, between: [" + name + ", " +
              (i < n ? "m" + std::to_string(i + 1) : std::string("ground.end")) +
              "], stiffness: 300 N/m, free_length: 1 m}\n";
  }
  const Analysed a(text + joints + forces + "simulation: {analysis: modes}\n");
  REQUIRE(a.summary.status == Status::completed);
  const std::vector<double> f = a.mode("frequency");
  REQUIRE(f.size() == n);
  for (int j = 1; j <= n; ++j)
    CHECK(2 * kPi * f[static_cast<std::size_t>(j - 1)] ==
          doctest::Approx(2 * 10 * std::sin(j * kPi / (2 * (n + 1)))).epsilon(kRoots));
}

TEST_CASE("DampedPendulum_HasItsDampingRatio") {
  // zeta = d/(2 m L^2 omega_0).
  const Analysed a(
      pendulums("joints:\n  pivot: {type: revolute, between: [ground, one]}\nforces:\n"
                "  oil: {type: torsion_spring, joint: pivot, damping: 0.7 N.m.s/rad}\n",
                "analysis: modes"));
  const double omega = std::sqrt(g), zeta = 0.7 / (2 * omega);
  REQUIRE(a.mode("frequency").size() == 1);
  CHECK(2 * kPi * a.mode("frequency")[0] == doctest::Approx(omega).epsilon(kRoots));
  CHECK(a.mode("damping_ratio")[0] == doctest::Approx(zeta).epsilon(kRoots));
  CHECK(2 * kPi * a.mode("damped_frequency")[0] == doctest::Approx(omega * std::sqrt(1 - zeta * zeta)).epsilon(kRoots));
}

TEST_CASE("UprightPendulum_IsUnstable") {
  const Analysed a(pendulums(
      "joints:\n  pivot: {type: revolute, between: [ground, one], initial: {rotation: 180 deg}}\n", "analysis: modes"));
  // Two real eigenvalues, -+ sqrt(g/L).
  const std::vector<double> real = a.mode("eigenvalue_real");
  REQUIRE(real.size() == 2);
  CHECK(std::max(real[0], real[1]) == doctest::Approx(std::sqrt(g)).epsilon(kRoots));
  CHECK(a.summary.message.find("unstable") != std::string::npos);
}

/// A heavy platform on two parallel cranks of 1 m, a loop: it swings without rotation, as a pendulum of 1 m.
std::string swing(const std::string& simulation) {
  const std::string crank = "{mass: 1e-9 kg, " + kPoint + ", frames: {tip: {origin: 0 -1 0 m}}}\n";
  return R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  ground: {frames: {far: {origin: 0.5 0 0 m}}}
  left: )" +
         crank + "  right: " + crank +
         R"(  platform: {mass: 2 kg, centre_of_mass: 0.2 0.1 0 m, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}, frames: {end: {origin: 0.5 0 0 m}}}
joints:
  a: {type: revolute, between: [ground, left]}
  b: {type: revolute, between: [ground.far, right]}
  c: {type: cylindrical, between: [left.tip, platform]}
  d: {type: spherical, between: [platform.end, right.tip]}
simulation: {)" +
         simulation + "}\n";
}

TEST_CASE("SwingOnTwoCranks_HasTheFrequencyOfAPendulum") {
  // One freedom left by a loop: the geometric stiffness of its multipliers counts.
  const Analysed a(swing("analysis: modes"));
  REQUIRE(a.summary.status == Status::completed);
  REQUIRE(a.mode("frequency").size() == 1);
  // Far above round-off, far below what the multipliers' geometric stiffness gives.
  CHECK(2 * kPi * a.mode("frequency")[0] == doctest::Approx(std::sqrt(g)).epsilon(1e-7));
}

TEST_CASE("PushedPendulum_ComesToRestAtItsAngle") {
  // tan(angle) = F/(m g), whatever angle it starts from; modes about it: omega^2 = sqrt(g^2 + (F/m)^2)/L.
  const std::string text = pendulums(R"(joints:
  pivot: {type: revolute, between: [ground, one], initial: {rotation: "${from}"}}
forces:
  wind: {type: force, body: one.tip, components: [30 N, 0 N, 0 N]}
)",
                                     "analysis: modes, modes_about: equilibrium");
  for (const char* from : {"0 deg", "100 deg", "-170 deg", "179 deg"}) {
    CAPTURE(std::string(from));
    const Analysed a(text, {std::string("from=") + from});
    REQUIRE(a.summary.status == Status::completed);
    const double angle = a.read("/joints/pivot/coordinates").back();
    CHECK(std::remainder(angle - std::atan2(30, g), 2 * kPi) == doctest::Approx(0).epsilon(kRest));
    CHECK(2 * kPi * a.mode("frequency")[0] == doctest::Approx(std::sqrt(std::hypot(g, 30.0))).epsilon(kRest));
    CHECK(a.read("/joints/pivot/rates").back() == 0);
  }
}

TEST_CASE("DoublePendulum_ComesToRestHanging") {
  const Analysed a(double_pendulum("analysis: static"),
                   {"joints.upper.initial={rotation: 120 deg}", "joints.lower.initial={rotation: -70 deg}"});
  REQUIRE(a.summary.status == Status::completed);
  CHECK(a.summary.message.empty());
  CHECK(std::abs(std::remainder(a.read("/joints/upper/coordinates").back(), 2 * kPi)) < kRest);
  CHECK(std::abs(std::remainder(a.read("/joints/lower/coordinates").back(), 2 * kPi)) < kRest);
  // One instant, and the upper joint carries both weights.
  const std::vector<double> force = a.read("/joints/upper/reaction_force");
  REQUIRE(force.size() == 3);
  CHECK(force[1] == doctest::Approx(2 * g).epsilon(kRest));
}

TEST_CASE("Swing_ComesToRestInItsLoop") {
  const Analysed a(swing("analysis: static"), {"joints.a.initial={rotation: 60 deg}"});
  CAPTURE(a.summary.message);
  REQUIRE(a.summary.status == Status::completed);
  CHECK(std::abs(a.read("/joints/a/coordinates").back()) < 1e-8);  // rad: flat at rest in its loop
  CHECK(a.summary.worst_constraint_drift < 1e-9);                  // closed to 1e-12, then at rest to 1e-10
}

TEST_CASE("UnstableAndIndifferentRest_AreSaid") {
  const Analysed upright(
      pendulums("joints:\n  pivot: {type: revolute, between: [ground, one], initial: {rotation: 180 deg}}\n",
                "analysis: static"));
  // sin(180 deg) is 1e-16, not 0: within the tolerance of rest.
  CHECK(upright.summary.message.find("unstable") != std::string::npos);
  CHECK(upright.summary.message.find("joint pivot") != std::string::npos);
  const Analysed sliding(
      pendulums("joints:\n  rail: {type: prismatic, between: [ground, one], axis: x}\n", "analysis: static"));
  CHECK(sliding.summary.message.find("indifferent") != std::string::npos);
}

TEST_CASE("FallingBody_HasNoRest") {
  const Analysed a(
      pendulums("joints:\n  rail: {type: prismatic, between: [ground, one], axis: y}\n", "analysis: static"));
  CHECK(a.summary.status == Status::failed);
  CHECK(a.summary.message.find("joint rail") != std::string::npos);
}

/// Crank r = 0.1 m, rod 0.3 m, slider.
std::string slider_crank(const std::string& drive, const std::string& simulation) {
  return R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  crank: {mass: 1 kg, inertia: {xx: 0.01 kg.m^2, yy: 0.01 kg.m^2, zz: 0.01 kg.m^2}, frames: {pin: {origin: 0.1 0 0 m}}}
  rod: {mass: 0.7 kg, centre_of_mass: 0.1 0 0 m, inertia: {xx: 0.02 kg.m^2, yy: 0.02 kg.m^2, zz: 0.02 kg.m^2}, frames: {end: {origin: 0.3 0 0 m}}}
  slider: {mass: 0.5 kg, inertia: {xx: 0.02 kg.m^2, yy: 0.02 kg.m^2, zz: 0.02 kg.m^2}}
joints:
  main: {type: revolute, between: [ground, crank], initial: {rotation: 0 rad}}
  pin: {type: cylindrical, between: [crank.pin, rod]}
  rail: {type: prismatic, between: [ground, slider], axis: x, initial: {translation: 0.4 m}}
  end: {type: spherical, between: [rod.end, slider]}
)" + drive +
         "simulation: {" + simulation + "}\n";
}

const std::string kMotor = "drives:\n  motor: {joint: main, coordinate: rotation, speed: 3000 rpm}\n";

TEST_CASE("Kinematics_FollowsTheClosedFormAndBalancesPower") {
  const Analysed a(slider_crank(kMotor, "analysis: kinematics, duration: 40 ms, step: 1 ms"));
  CAPTURE(a.summary.message);
  REQUIRE(a.summary.status == Status::completed);
  const std::vector<double> t = a.read("/time"), x = a.read("/joints/rail/coordinates"),
                            v = a.read("/joints/rail/rates"), acceleration = a.read("/bodies/slider/acceleration");
  REQUIRE(t.size() == 41);
  const double omega = 100 * kPi, r = 0.1, l = 0.3;
  for (std::size_t i = 0; i < t.size(); ++i) {
    CAPTURE(t[i]);
    const double s = std::sin(omega * t[i]), c = std::cos(omega * t[i]), w = std::sqrt(l * l - r * r * s * s);
    // Prescribed: positions closed to 1e-13, rates by the inverse of the constraints.
    CHECK(x[i] == doctest::Approx(r * c + w).epsilon(1e-11));
    CHECK(std::abs(v[i] + r * omega * s + r * r * omega * s * c / w) < 1e-9 * r * omega);
    const double a_exact =
        -r * omega * omega * c - r * r * omega * omega * ((c * c - s * s) / w + r * r * s * s * c * c / (w * w * w));
    // Prescribed: positions closed to 1e-13, rates by the inverse of the constraints.
    CHECK(std::abs(acceleration[3 * i] - a_exact) < 1e-9 * r * omega * omega);
  }
  // Inverse dynamics: the drive's power is the rate of the energy.
  CHECK(a.summary.worst_power_balance < 1e-10);  // round-off
}

TEST_CASE("Kinematics_GivesTheForcesThatDynamicsTendsTo") {
  const Analysed exact(slider_crank(kMotor, "analysis: kinematics, duration: 7 ms, step: 7 ms"));
  const Analysed run(slider_crank(kMotor, "duration: 7 ms, step: 0.005 ms"));
  const auto torque = [](const Analysed& a) { return a.read("/drives/motor/force_or_torque").back(); };
  CHECK(torque(run) == doctest::Approx(torque(exact)).epsilon(1e-4));  // steps of 5 us, second order
}

TEST_CASE("Kinematics_NamesWhatNothingPrescribes") {
  try {
    check(rig(slider_crank("", "analysis: kinematics, duration: 1 s, step: 1 ms")));
    FAIL("accepted");
  } catch (const InputError& error) {
    CHECK(error.faults().front().found.find("joint main, rotation") != std::string::npos);
    CHECK(error.faults().front().path == "simulation.analysis");
  }
}

TEST_CASE("Kinematics_EndsWhereDrivesCannotBeFollowed") {
  // The slider is driven outwards, beyond the reach of crank and rod at t = 0.1 s.
  const Analysed a(
      slider_crank(
          "drives:\n  pull: {joint: rail, coordinate: translation, position: {expression: '0.3 + t', unit: m}}\n",
          "analysis: kinematics, duration: 1 s, step: 7 ms"),
      {"joints.main.initial={}", "joints.main.guess={rotation: 60 deg}", "joints.rail.initial={translation: 0.3 m}"});
  CHECK(a.summary.status == Status::failed);
  CHECK(a.summary.t_end == doctest::Approx(0.098).epsilon(1e-12));  // round-off of fourteen steps
  CHECK(a.summary.message.find("cannot follow its drives") != std::string::npos);
}

TEST_CASE("RotorOnItsFilm_HasTheEigenvaluesOfTheSteadyCoefficients") {
  // The rod floats on the film; at the end of a settled run its small motions are those of m s^2 + C s + K with the
  // coefficients of the bearing by itself. Films without memory have the same tangent in both.
  const std::string text = rig_with("    supply: {line: widest_gap, pressure: 1 bar}\n",
                                    "    cavitation: {model: guembel, pressure: 0 Pa}\n    edge_pressure: 0 Pa\n");
  const model::Model model = rig(text, {"duration=200 ms", "simulation.analysis=modes", "simulation.modes_about=end"});
  const TemporaryDirectory scratch;
  const Summary summary = simulate(model, {.results = scratch / "run.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(summary.results);
  const std::vector<double> real = reader.read("/modes/fields/eigenvalue_real").values,
                            imaginary = reader.read("/modes/fields/eigenvalue_imaginary").values;

  bearing::SteadyState state;
  bearing::OperatingPoint point;
  point.journal_speed = 100 * kPi;
  point.load = Eigen::Vector2d(0, 500);  // the rod is pushed down, the film pushes the journal up
  REQUIRE(bearing::solve_steady(model.bearings[0].film, point, {}, state).solved());
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A.topRightCorner<2, 2>().setIdentity();
  A.bottomLeftCorner<2, 2>() = -state.coefficients.stiffness.topLeftCorner<2, 2>() / 0.5;
  A.bottomRightCorner<2, 2>() = -state.coefficients.damping.topLeftCorner<2, 2>() / 0.5;
  const Eigen::EigenSolver<Eigen::Matrix4d> eigen(A);
  REQUIRE(real.size() == imaginary.size());
  REQUIRE(!real.empty());
  for (std::size_t i = 0; i < real.size(); ++i) {
    const std::complex<double> s(real[i], imaginary[i]);
    const double nearest = (eigen.eigenvalues().array() - s).abs().minCoeff();
    CAPTURE(real[i]);
    CAPTURE(imaginary[i]);
    CHECK(nearest < 1e-3 * std::abs(s));  // what the end of the run still moves
  }
}

}  // namespace analysis_test
}  // namespace hersey::run
