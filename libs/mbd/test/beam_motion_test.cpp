// Beams of large rotation in motion: spin-up, conservation, rotating blades, cost.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <sstream>

#include "beam_cases.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/solver/equilibrium.h"
#include "hersey/solver/linearise.h"
#include "simulate.h"
#include "source_dir.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace beam_motion_test {

using Eigen::VectorXd;

constexpr double kPi = std::numbers::pi;

/// Rotates the beam's root about z of ground.
JointId hub(MechanismBuilder& b, const BeamBodyIds& beam, double rate = 0) {
  return b.add_joint({.name = "hub",
                      .type = JointType::revolute,
                      .inboard = b.frame_of(b.ground()),
                      .outboard = beam.frames[0],
                      .initial = {0.0},
                      .initial_rate = {rate}});
}

/// Simo and Vu-Quoc (1986): theta = 6/15 (t^2/2 + (15/2pi)^2 (cos(2 pi t/15) - 1)) to 15 s, then 6 t - 45.
std::shared_ptr<const ScalarFunction> spin_up_angle() {
  constexpr double w = 2 * kPi / 15;
  return test::time_function(
      [](double t) { return t < 15 ? 0.4 * (t * t / 2 + (std::cos(w * t) - 1) / (w * w)) : 6 * t - 45; },
      [](double t) { return t < 15 ? 0.4 * (t - std::sin(w * t) / w) : 6; },
      [](double t) { return t < 15 ? 0.4 * (1 - std::cos(w * t)) : 0; });
}

const test::StraightBeam spin_up_beam{.length = 10,
                                      .stiffness = {2.8e7, 1e7, 1e7, 1.4e4, 1.4e4, 1.4e4},
                                      .mass_per_length = 1.2,
                                      .inertia_per_length = {1.2e-3, 6e-4, 6e-4}};

/// The tip in the axes that rotate with the drive at t = 0, 0.2, ..., `end` [s]: stretch and deflection.
std::vector<Eigen::Vector2d> spin_up(int elements, double dt, double end) {
  test::StraightBeam beam = spin_up_beam;
  beam.elements = elements;
  MechanismBuilder b;
  const BeamBodyIds ids = beam.add_to(b);
  const auto angle = spin_up_angle();
  b.add_drive({.name = "motor", .coordinate = {hub(b, ids), 0}, .kind = DriveSpec::Kind::position, .function = angle});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  std::vector<Eigen::Vector2d> tip = {{0, 0}};
  const int per_row = static_cast<int>(std::lround(0.2 / dt));
  int step = 0;
  test::run(*m, state, end, static_cast<int>(std::lround(end / dt)), 0.8, [&](const solver::State& s) {
    if (++step % per_row != 0) return;
    const double theta = angle->value({&s.t, 1});
    const Vector3 r = m->frame_motion(s, ids.frames.back()).X_WF.r;
    const Vector3 observation = Eigen::AngleAxisd(-theta, Vector3::UnitZ()) * r;
    tip.emplace_back(observation.x() - beam.length, observation.y());
  });
  return tip;
}

/// Columns tip_axial_rel and tip_trans_rel of spin_up_beam.csv.
std::vector<Eigen::Vector2d> spin_up_reference() {
  std::ifstream file(std::string(hersey::source_dir()) + "/verification/data/spin_up_beam.csv");
  REQUIRE(file);
  std::vector<Eigen::Vector2d> rows;
  std::string line;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#' || line[0] == 't') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    std::vector<double> x;
    for (double value = 0; fields >> value;) x.push_back(value);
    rows.emplace_back(x[9], x[10]);
  }
  return rows;
}

/// Largest deviation of the tip's deflection from the reference [m].
double deviation(const std::vector<Eigen::Vector2d>& tip, const std::vector<Eigen::Vector2d>& reference) {
  double worst = 0;
  for (std::size_t i = 0; i < tip.size(); ++i) worst = std::max(worst, std::abs(tip[i].y() - reference[i].y()));
  return worst;
}

TEST_CASE("SpinUpBeam_OfSimoAndVuQuoc_ConvergesWithOrderTwo") {
  const auto reference = spin_up_reference();
  const auto coarse = spin_up(8, 0.01, 10), fine = spin_up(16, 0.01, 10);
  const double error = deviation(fine, reference), order = std::log2(deviation(coarse, reference) / error);
  MESSAGE("deflection off by up to ", error, " m, order ", order, ", at 6.8 s ", fine[34].y(), " m");
  CHECK(error < 3e-4);
  CHECK(order == doctest::Approx(2).epsilon(0.05));
  CHECK(fine[34].y() + (fine[34].y() - coarse[34].y()) / 3 == doctest::Approx(-0.573761).epsilon(5e-5));
  // In steady rotation it keeps the stretch of a rod in its own centrifugal field.
  const auto steady = spin_up(8, 0.02, 20);
  CHECK(steady.back().x() == doctest::Approx(5.1453e-4).epsilon(1e-3));  // stretch of eight elements: second order
}

struct Losses {
  double strain = 0;  ///< largest, over the kinetic energy at the start
  double energy = 0, momentum = 0, spin = 0;
};

/// A soft beam thrown through space, tumbling and bending, in equal steps.
Losses tumble(int steps) {
  test::StraightBeam beam{.length = 1,
                          .elements = 5,
                          .stiffness = {3e3, 1e3, 1e3, 1.5, 2, 2.5},
                          .mass_per_length = 0.8,
                          .inertia_per_length = {2e-3, 1e-3, 1e-3}};
  MechanismBuilder b;
  const BeamBodyIds ids = beam.add_to(b);
  b.add_joint({.name = "free",
               .type = JointType::free,
               .inboard = b.frame_of(b.ground()),
               .outboard = ids.frames[0],
               .initial = std::vector<double>(6, 0.0),
               .initial_rate = {0, -2.5, 0, 3, 0.5, 8}});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  const auto total = [&](const solver::State& s) {
    ElasticEnergy sum;
    for (const ElasticObservation& segment : m->observe(s).elastics) {
      sum.kinetic += segment.energy.kinetic;
      sum.strain += segment.energy.strain;
      sum.momentum += segment.energy.momentum;
      sum.angular_momentum += segment.energy.angular_momentum;
    }
    return sum;
  };
  const ElasticEnergy first = total(state);
  Losses losses;
  test::run(*m, state, 1, steps, 1.0, [&](const solver::State& s) {
    const ElasticEnergy now = total(s);
    const double change = now.kinetic + now.strain - first.kinetic - first.strain;
    const Vector3 lost = now.momentum - first.momentum, spin = now.angular_momentum - first.angular_momentum;
    losses.strain = std::max(losses.strain, now.strain / first.kinetic);
    losses.energy = std::max(losses.energy, std::abs(change) / first.kinetic);
    losses.momentum = std::max(losses.momentum, lost.norm() / first.momentum.norm());
    losses.spin = std::max(losses.spin, spin.norm() / first.angular_momentum.norm());
  });
  return losses;
}

TEST_CASE("TumblingBeam_LosesNothingBeyondTheErrorOfTheSteps") {
  // The loss decreases with the square of the step: the equations themselves conserve energy.
  const Losses coarse = tumble(1000), fine = tumble(2000);
  MESSAGE("strain energy up to ", fine.strain, " of the kinetic, energy off by ", fine.energy, ", momentum by ",
          fine.momentum, ", angular momentum by ", fine.spin);
  CHECK(fine.strain > 1e-3);
  CHECK(coarse.energy / fine.energy == doctest::Approx(4).epsilon(0.1));
  CHECK(coarse.momentum / fine.momentum == doctest::Approx(4).epsilon(0.1));
  CHECK(coarse.spin / fine.spin == doctest::Approx(4).epsilon(0.1));
}

/// Flap and lag frequencies of a slender blade that rotates at `gamma`, both over sqrt(EI/(rho A L^4)).
std::vector<double> blade_frequencies(int elements, double gamma) {
  test::StraightBeam blade{.length = 1,
                           .elements = elements,
                           .stiffness = {1e6, 1e5, 1e5, 1, 1, 1},
                           .mass_per_length = 1,
                           .inertia_per_length = {2e-5, 1e-5, 1e-5}};
  MechanismBuilder b;
  const BeamBodyIds ids = blade.add_to(b);
  const JointId root = hub(b, ids);
  b.add_drive(
      {.name = "motor", .coordinate = {root, 0}, .kind = DriveSpec::Kind::speed, .function = test::constant(gamma)});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  const solver::EquilibriumSummary steady = solver::find_equilibrium(*m, state, {.steady_motion = true});
  INFO(steady.message);
  REQUIRE(steady.solved());
  const double stretch = m->frame_motion(state, ids.frames.back()).X_WF.r.norm() - 1;
  CHECK(stretch == doctest::Approx(gamma * gamma / 3 / 1e6).epsilon(5e-3).scale(1e-9));
  std::vector<double> found;
  for (const solver::Mode& mode : solver::find_modes(solver::linearise(*m, state, 0)).modes)
    found.push_back(2 * kPi * mode.frequency);
  return found;
}

TEST_CASE("RotatingBlade_HasTheFrequenciesOfTheClosedForm") {
  // Slender beams that rotate at 0, 3 and 12, no hub: flap and lag of the first two modes.
  const std::pair<double, std::vector<double>> exact[] = {
      {0, {3.516015268404576, 3.516015268404576, 22.034491562950702, 22.034491562950702}},
      {3, {3.743511896284581, 4.797278532420666, 23.126493419625884, 23.320263675353228}},
      {12, {5.427049277730245, 13.17015048748162, 35.63697597959464, 37.60311233089896}}};
  for (const auto& [gamma, frequencies] : exact) {
    const std::vector<double> coarse = blade_frequencies(8, gamma), fine = blade_frequencies(16, gamma);
    for (std::size_t i = 0; i < 4; ++i) {
      const double speed = gamma;  // clang 14 captures no structured binding
      CAPTURE(speed);
      CAPTURE(i);
      CHECK(fine[i] == doctest::Approx(frequencies[i]).epsilon(2e-2));
      // Extrapolated from 8 and 16 elements.
      CHECK(fine[i] + (fine[i] - coarse[i]) / 3 == doctest::Approx(frequencies[i]).epsilon(1e-3));
    }
  }
}

TEST_CASE("OverhungRotor_WhirlsAsInTheClosedForm") {
  // A disc (m, I_d across, I_p along) at the end of a massless shaft that rotates at W: with deflection and slope as
  // unknowns, (K - w^2 diag(m, I_d) + w W diag(0, I_p)) x = 0 for whirl at w, forward where w has W's sign. In the
  // rotating axes its frequency is |w - W|.
  constexpr double L = 0.5, EI = 400, m = 2, I_d = 0.012, I_p = 0.022, W = 150, e = 1e-5;
  test::StraightBeam shaft{.length = L,
                           .elements = 20,
                           .stiffness = {1e8, 1e8, 1e8, 1e3, EI, EI},
                           .mass_per_length = 1e-3,
                           .inertia_per_length = {2e-7, 1e-7, 1e-7}};
  MechanismBuilder b;
  const BeamBodyIds ids = shaft.add_to(b);
  const BodyId disc =
      b.add_body({.name = "disc", .mass = m, .com = {0, e, 0}, .inertia = Vector3(I_p, I_d, I_d).asDiagonal()});
  b.add_joint({.name = "fit", .type = JointType::fixed, .inboard = ids.frames.back(), .outboard = b.frame_of(disc)});
  const JointId motor = b.add_joint({.name = "motor",
                                     .type = JointType::revolute,
                                     .inboard = b.frame_of(b.ground()),
                                     .outboard = ids.frames[0],
                                     .axis = {1, 0, 0}});
  b.add_drive(
      {.name = "drive", .coordinate = {motor, 0}, .kind = DriveSpec::Kind::speed, .function = test::constant(W)});
  const auto mechanism = b.finalise();
  solver::State state = test::start(*mechanism);
  const solver::EquilibriumSummary steady = solver::find_equilibrium(*mechanism, state, {.steady_motion = true});
  INFO(steady.message);
  REQUIRE(steady.solved());

  const Eigen::Matrix2d compliance = (Eigen::Matrix2d() << L * L * L / 3, L * L / 2, L * L / 2, L).finished() / EI;
  // Off its axis by e the disc bows the shaft as (K - W^2 diag(m, I_d - I_p)) x = (m W^2 e, 0): above the critical
  // speed, its centre of mass on the inner side.
  const Eigen::Matrix2d dynamic =
      compliance.inverse() - W * W * Eigen::Matrix2d(Eigen::Vector2d(m, I_d - I_p).asDiagonal());
  const Eigen::Vector2d bow = dynamic.inverse() * Eigen::Vector2d(m * W * W * e, 0);
  CHECK(bow[0] < 0);
  CHECK(mechanism->frame_motion(state, ids.frames.back()).X_WF.r.y() == doctest::Approx(bow[0]).epsilon(5e-3));
  const Eigen::Vector2d inertia(m, I_d);
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.topRightCorner<2, 2>().setIdentity();
  companion.bottomLeftCorner<2, 2>() = inertia.cwiseInverse().asDiagonal() * compliance.inverse();
  companion(3, 3) = W * I_p / I_d;
  const Eigen::Vector4cd whirl = companion.eigenvalues();
  std::vector<double> expected;
  for (const std::complex<double>& w : whirl) {
    CHECK(std::abs(w.imag()) < 1e-6 * std::abs(w));  // real roots: round-off
    expected.push_back(std::abs(w.real() - W));
  }
  std::sort(expected.begin(), expected.end());
  std::vector<double> found;
  for (const solver::Mode& mode : solver::find_modes(solver::linearise(*mechanism, state, 0)).modes)
    found.push_back(2 * kPi * mode.frequency);
  // The disc's twist against the driven root lies between them.
  const double twist = std::sqrt(1e3 / L / I_p);
  expected.push_back(twist);
  std::sort(expected.begin(), expected.end());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(found[i] == doctest::Approx(expected[i]).epsilon(2e-3));
}

TEST_CASE("RotatingBladeInGravityAcross_HasNoSteadyMotion") {
  test::StraightBeam blade{.length = 1,
                           .elements = 4,
                           .stiffness = {1e6, 1e5, 1e5, 1, 1, 1},
                           .mass_per_length = 1,
                           .inertia_per_length = {2e-5, 1e-5, 1e-5}};
  for (const bool across : {false, true}) {
    CAPTURE(across);
    MechanismBuilder b;
    b.set_gravity(across ? Vector3(0, 1e-3, 0) : Vector3(0, 0, 1e-3));
    const BeamBodyIds ids = blade.add_to(b);
    b.add_drive({.name = "motor",
                 .coordinate = {hub(b, ids), 0},
                 .kind = DriveSpec::Kind::speed,
                 .function = test::constant(3)});
    const auto m = b.finalise();
    solver::State state = test::start(*m);
    const solver::EquilibriumSummary steady = solver::find_equilibrium(*m, state, {.steady_motion = true});
    CAPTURE(steady.message);
    CHECK(steady.solved() == !across);
    CHECK((steady.message.find("no steady motion: joint beam.4, ") == 0) == across);
  }
}

TEST_CASE("BeamUnderItsWeight_SagsLikeASlenderBeam") {
  test::StraightBeam beam{.length = 2,
                          .elements = 10,
                          .stiffness = {1e8, 1e8, 1e8, 1e4, 1e4, 2e4},
                          .mass_per_length = 3,
                          .inertia_per_length = {2e-4, 1e-4, 1e-4},
                          .damping = 1e-3};
  MechanismBuilder b;
  b.set_gravity({0, 0, -9.81});
  const BeamBodyIds ids = beam.add_to(b);
  b.add_joint(
      {.name = "clamp", .type = JointType::fixed, .inboard = b.frame_of(b.ground()), .outboard = ids.frames[0]});
  const auto m = b.finalise();
  solver::State state = test::start(*m);
  const solver::EquilibriumSummary rest = solver::find_equilibrium(*m, state);
  INFO(rest.message);
  REQUIRE(rest.solved());
  CHECK(rest.kind == solver::EquilibriumKind::stable);
  const double sag = 3 * 9.81 * 16 / (8 * 1e4);
  CHECK(m->frame_motion(state, ids.frames.back()).X_WF.r.z() == doctest::Approx(-sag).epsilon(5e-3));
  const JointObservation clamp = m->observe(state).joints.back();
  CHECK(clamp.force.z() == doctest::Approx(3 * 2 * 9.81).epsilon(1e-9));  // out of balance by 1e-10
}

TEST_CASE("BeamsTangent_GrowsInProportionToItsElements") {
  const auto entries = [](int elements) {
    test::StraightBeam beam = spin_up_beam;
    beam.elements = elements;
    MechanismBuilder b;
    const BeamBodyIds ids = beam.add_to(b);
    (void)hub(b, ids);
    const auto m = b.finalise();
    solver::Equations::SparseMatrix tangent;
    VectorXd residual, scale;
    m->assemble(m->initial_state(), {}, residual, scale, &tangent);
    return static_cast<double>(tangent.nonZeros());
  };
  CHECK(entries(40) / entries(20) < 2.1);
}

}  // namespace beam_motion_test
}  // namespace hersey::mbd
