// Bodies in contact, moved in time, against closed forms.
#include <cmath>
#include <functional>
#include <numbers>

#include "contact_cases.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/mbd/restitution.h"
#include "simulate.h"

namespace hersey::mbd {
namespace contact_motion_test {

constexpr double g = 9.81;

struct Rig {
  std::unique_ptr<Mechanism> mechanism;
  std::vector<std::shared_ptr<Contact>> contacts;

  [[nodiscard]] ContactObservation observe(const solver::State& state, int i = 0) {
    return contacts[i]->observe(mechanism->relative_motion(state, {i}));
  }
};

BodySpec solid_ball(const std::string& name, double mass, double radius) {
  return {.name = name, .mass = mass, .inertia = Matrix3::Identity() * (0.4 * mass * radius * radius)};
}

/// A free ball above the floor z = 0, at `start`, moving at `velocity`.
Rig ball_on_floor(double mass, double radius, const ContactLaw& law, const Vector3& gravity, const Vector3& start,
                  const Vector3& velocity, std::shared_ptr<const TriangleMesh> surface = nullptr) {
  Rig rig;
  MechanismBuilder builder;
  builder.set_gravity(gravity);
  const BodyId ball = builder.add_body(solid_ball("ball", mass, radius));
  const FrameId ground = builder.frame_of(builder.ground()), frame = builder.frame_of(ball);
  builder.add_joint({.name = "free",
                     .type = JointType::free,
                     .inboard = ground,
                     .outboard = frame,
                     .initial = {start[0], start[1], start[2], 0, 0, 0},
                     .initial_rate = {velocity[0], velocity[1], velocity[2], 0, 0, 0}});
  const ShapeGeometry shape = surface ? ShapeGeometry(surface) : ShapeGeometry(Sphere{Vector3::Zero(), radius});
  rig.contacts.push_back(std::make_shared<Contact>(HalfSpace{}, shape, law));
  builder.add_force("contact", ground, frame, rig.contacts.back());
  rig.mechanism = builder.finalise();
  return rig;
}

struct Impact {
  double largest_force = 0, duration = 0, speed_after = 0;
};

/// A ball of 0.1 kg without weight hits the floor at 1 m/s; `steps` per duration of an undamped impact.
Impact impact(const ContactLaw& law, int steps) {
  const double mass = 0.1, radius = 0.01, speed = 1;
  const double n = law.exponent + 1;
  const double depth = std::pow(0.5 * n * mass * speed * speed / law.stiffness, 1 / n),
               duration = 2.9432 * depth / speed;
  Rig rig = ball_on_floor(mass, radius, law, Vector3::Zero(), {0, 0, radius}, {0, 0, -speed});
  solver::State state = test::start(*rig.mechanism);
  Impact observation;
  double before = 0, t_before = 0;
  // The largest force lies between steps: the parabola through the three around it.
  std::vector<double> force{0};
  const double dt = duration / steps;
  const auto look = [&](const solver::State& s) {
    const double f = rig.observe(s).normal_force;
    const double height = s.q[2] - radius;
    if (observation.duration == 0 && height > 0) {  // left the floor: linear between steps
      observation.duration = t_before + (s.t - t_before) * before / (before - height);
      observation.speed_after = s.v[2];
    }
    before = height, t_before = s.t;
    force.push_back(f);
  };
  test::run(*rig.mechanism, state, 3 * duration, static_cast<int>(std::lround(3 * duration / dt)), 1.0, look);
  for (std::size_t i = 1; i + 1 < force.size(); ++i) {
    if (force[i] < force[i - 1] || force[i] < force[i + 1]) continue;
    const double bend = force[i - 1] - 2 * force[i] + force[i + 1], slope = 0.5 * (force[i + 1] - force[i - 1]);
    if (bend < 0)
      observation.largest_force = std::max(observation.largest_force, force[i] - 0.5 * slope * slope / bend);
  }
  return observation;
}

TEST_CASE("BallDrop_MatchesHertzForceAndDuration") {
  // delta_max = (5 m v^2/(4 k))^(2/5), F = k delta_max^(3/2), T = 2.9432 delta_max/v (Hertz; Johnson 1985, Sec.
  // 11.4): (contact.13).
  const ContactLaw law{.stiffness = 1e9};
  const double depth = std::pow(1.25 * 0.1 / law.stiffness, 0.4);
  const double force = law.stiffness * std::pow(depth, 1.5), duration = 2.943275 * depth;
  std::array<double, 3> force_error{}, duration_error{};
  for (int i = 0; i < 3; ++i) {
    const Impact observation = impact(law, 20 << i);
    force_error[i] = std::abs(observation.largest_force / force - 1);
    duration_error[i] = std::abs(observation.duration / duration - 1);
    CAPTURE(i);
    CAPTURE(force_error[i]);
    CAPTURE(duration_error[i]);
    CHECK(force_error[i] < 0.005 / std::pow(4, i));
    CHECK(duration_error[i] < 0.005 / std::pow(4, i));
    // Without damping the ball leaves with the speed of its arrival.
    CHECK(std::abs(observation.speed_after - 1) < 1e-4 / std::pow(4, i));  // second order
  }
  CHECK(force_error[2] > force_error[0] / 32);  // and not by chance: order two from both sides
}

TEST_CASE("Restitution_IsThatOfHuntAndCrossley") {
  // Integrating m du/dt = -k delta^n (1 + a u): with d = a v, d (1 + e) = ln((1 + d)/(1 - e d)), whatever k, m and n.
  for (const double damping : {0.1, 0.5, 2.0}) {
    CAPTURE(damping);
    const double exact = restitution(damping, 1.0);
    // Round-off of an iteration to the last digits.
    CHECK(damping * (1 + exact) == doctest::Approx(std::log((1 + damping) / (1 - exact * damping))).epsilon(1e-12));
    for (const double exponent : {1.5, 2.0}) {
      const double stiffness = exponent == 1.5 ? 1e9 : 1e11;
      const Impact observation =
          impact({.stiffness = stiffness, .exponent = exponent, .damping = damping}, exponent == 1.5 ? 160 : 320);
      CHECK(observation.speed_after == doctest::Approx(exact).epsilon(2e-3));
    }
    // Round-off of an iteration to the last digits.
    CHECK(damping_of_restitution(exact, 1.0) == doctest::Approx(damping).epsilon(1e-9));
    CHECK(damping_of_restitution(exact, 2.0) == doctest::Approx(0.5 * damping).epsilon(1e-9));
  }
}

/// Acceleration and spin of a ball on an incline after it has moved for a while.
struct Incline {
  double acceleration, spin_acceleration;
};

Incline roll_down(double angle, double friction) {
  const double mass = 0.5, radius = 0.02;
  const ContactLaw law{.stiffness = 1e8, .damping = 1, .friction = friction, .slip_speed = 1e-4};
  const double sunk = std::pow(mass * g * std::cos(angle) / law.stiffness, 2.0 / 3.0);
  Rig rig = ball_on_floor(mass, radius, law, g * Vector3(std::sin(angle), 0, -std::cos(angle)), {0, 0, radius - sunk},
                          Vector3::Zero());
  solver::State state = test::start(*rig.mechanism);
  test::run(*rig.mechanism, state, 0.1, 500);
  const solver::State first = state;
  test::run(*rig.mechanism, state, 0.3, 1000);
  // The rate of the orientation is the angular velocity in the ball's axes, which only rotate about y.
  return {(state.v[0] - first.v[0]) / 0.2, (state.v[4] - first.v[4]) / 0.2};
}

TEST_CASE("BallOnAnIncline_RollsOrSlides") {
  const double angle = 0.4, radius = 0.02;
  // Rolling needs friction of 2/7 tan(angle) = 0.121.
  const Incline rolls = roll_down(angle, 0.2);
  // Creep and slip are regularised.
  CHECK(rolls.acceleration == doctest::Approx(5.0 / 7.0 * g * std::sin(angle)).epsilon(1e-3));
  CHECK(rolls.spin_acceleration * radius == doctest::Approx(rolls.acceleration).epsilon(1e-3));
  const double mu = 0.06;
  const Incline slides = roll_down(angle, mu);
  // Friction is short of Coulomb's by (v_s/v)^2/2.
  CHECK(slides.acceleration == doctest::Approx(g * (std::sin(angle) - mu * std::cos(angle))).epsilon(1e-4));
  // Creep and slip are regularised.
  CHECK(slides.spin_acceleration * radius == doctest::Approx(2.5 * mu * g * std::cos(angle)).epsilon(1e-3));
}

TEST_CASE("BlockSlides_ItsStoppingDistance") {
  const double mu = 0.3, v = 1, slip = 0.01, stiffness = 1e6;
  const Box block{{}, {0.2, 0.1, 0.05}};
  MechanismBuilder builder;
  builder.set_gravity({0, 0, -g});
  const BodyId body = builder.add_body({.name = "block", .mass = 2, .inertia = 0.01 * Matrix3::Identity()});
  const FrameId ground = builder.frame_of(builder.ground()), frame = builder.frame_of(body);
  const double sunk = 2 * g / 4 / stiffness;
  builder.add_joint({.name = "free",
                     .type = JointType::free,
                     .inboard = ground,
                     .outboard = frame,
                     .initial = {0, 0, 0.025 - sunk, 0, 0, 0},
                     .initial_rate = {v, 0, 0, 0, 0, 0}});
  auto contact = std::make_shared<Contact>(
      HalfSpace{}, block,
      ContactLaw{.stiffness = stiffness, .exponent = 1, .damping = 5, .friction = mu, .slip_speed = slip});
  builder.add_force("contact", ground, frame, contact);
  const auto mechanism = builder.finalise();
  solver::State state = test::start(*mechanism);
  test::run(*mechanism, state, 0.6, 3000);
  // x = int v sqrt(v^2 + s^2)/(mu g v) dv: v^2/(2 mu g), and a little for the regularisation. The block tips forward by
  // the friction's moment, which lowers nothing here: the sum of its corners' forces is its weight.
  const double exact = (v * std::sqrt(v * v + slip * slip) + slip * slip * std::asinh(v / slip)) / (2 * mu * g);
  CHECK(state.q[0] == doctest::Approx(exact).epsilon(2e-3));
  CHECK(std::abs(state.v[0]) < 1e-4);  // m/s: creeping to rest
  const ContactObservation observation = contact->observe(mechanism->relative_motion(state, {0}));
  CHECK(observation.spots == 4);
  CHECK(observation.normal_force == doctest::Approx(2 * g).epsilon(1e-4));  // what still bounces
}

TEST_CASE("TwoBalls_ExchangeTheirVelocities") {
  const double radius = 0.01, mass = 0.05;
  MechanismBuilder builder;
  const FrameId ground = builder.frame_of(builder.ground());
  std::array<FrameId, 2> frames;
  for (int i = 0; i < 2; ++i) {
    const BodyId ball = builder.add_body(solid_ball(i == 0 ? "left" : "right", mass, radius));
    frames[i] = builder.frame_of(ball);
    builder.add_joint({.name = i == 0 ? "one" : "two",
                       .type = JointType::free,
                       .inboard = ground,
                       .outboard = frames[i],
                       .initial = {i * 2.01 * radius, 0, 0, 0, 0, 0},
                       .initial_rate = {i == 0 ? 1.0 : 0.0, 0, 0, 0, 0, 0}});
  }
  auto contact = std::make_shared<Contact>(Sphere{Vector3::Zero(), radius}, Sphere{Vector3::Zero(), radius},
                                           ContactLaw{.stiffness = 1e9});
  builder.add_force("contact", frames[0], frames[1], contact);
  const auto mechanism = builder.finalise();
  solver::State state = test::start(*mechanism);
  double worst = 0;
  test::run(*mechanism, state, 4e-4, 800, 1.0,
            [&](const solver::State& s) { worst = std::max(worst, std::abs(s.v[0] + s.v[6] - 1)); });
  CHECK(worst < 1e-9);  // momentum, at every step
  // 800 steps, second order.
  CHECK(state.v[6] == doctest::Approx(1).epsilon(1e-4));
  CHECK(std::abs(state.v[0]) < 1e-4);
}

TEST_CASE("GlancingBlow_ConservesMomentumAndBalancesEnergy") {
  const double radius = 0.01, mass = 0.05;
  MechanismBuilder builder;
  const FrameId ground = builder.frame_of(builder.ground());
  std::array<FrameId, 2> frames;
  for (int i = 0; i < 2; ++i) {
    const BodyId ball = builder.add_body(solid_ball(i == 0 ? "left" : "right", mass * (1 + i), radius));
    frames[i] = builder.frame_of(ball);
    builder.add_joint({.name = i == 0 ? "one" : "two",
                       .type = JointType::free,
                       .inboard = ground,
                       .outboard = frames[i],
                       .initial = {i * 2.01 * radius, i * 0.5 * radius, 0, 0, 0, 0},
                       .initial_rate = {i == 0 ? 1.0 : -0.2, 0, 0.1, 3, -2, 50}});
  }
  auto contact =
      std::make_shared<Contact>(Sphere{Vector3::Zero(), radius}, Sphere{Vector3::Zero(), radius},
                                ContactLaw{.stiffness = 1e8, .damping = 0.3, .friction = 0.2, .slip_speed = 0.01});
  builder.add_force("contact", frames[0], frames[1], contact);
  const auto mechanism = builder.finalise();
  const auto momentum = [&](const solver::State& s) {
    Vector6 sum = Vector6::Zero();
    for (int i = 0; i < 2; ++i) {
      const FrameMotion motion = mechanism->frame_motion(s, frames[i]);
      const double m = mass * (1 + i);
      sum.tail<3>() += m * motion.v;
      sum.head<3>() += 0.4 * m * radius * radius * motion.omega + motion.X_WF.r.cross(m * motion.v);
    }
    return sum;
  };
  std::array<double, 2> error{};
  for (int k = 0; k < 2; ++k) {
    solver::State state = test::start(*mechanism);
    const Vector6 before = momentum(state);
    const double energy_before = mechanism->observe(state).kinetic_energy;
    double lost = 0, worst = 0, last = 0;
    const int steps = 2000 << k;
    test::run(*mechanism, state, 1.5e-3, steps, 1.0, [&](const solver::State& s) {
      const ContactObservation observation = contact->observe(mechanism->relative_motion(s, {0}));
      const double power = observation.damping_power + observation.friction_power;
      lost += 0.5 * (power + last) * 1.5e-3 / steps;
      last = power;
      worst = std::max(worst, (momentum(s) - before).tail<3>().norm() / before.tail<3>().norm());
    });
    CHECK(worst < 1e-8);  // Newton's tolerance is 1e-9 of the forces
    CHECK((momentum(state) - before).head<3>().norm() < 2e-4 * before.head<3>().norm() / (1 << 2 * k));
    const double energy = mechanism->observe(state).kinetic_energy;
    CHECK(lost > 0.02 * energy_before);
    error[k] = std::abs(energy + lost - energy_before) / energy_before;
    CAPTURE(error[k]);
    CHECK(error[k] < 1e-4 / (1 << 2 * k));  // second order
  }
}

TEST_CASE("MeshBall_BouncesLikeTheBall") {
  // Pressure K delta on the mesh's corners is pi K R delta^2 on the ball.
  const double mass = 0.1, radius = 0.01, K = 3e12;
  const auto height_after = [&](const ContactLaw& law, std::shared_ptr<const TriangleMesh> mesh) {
    Rig rig = ball_on_floor(mass, radius, law, {0, 0, -g}, {0, 0, 1.2 * radius}, {0, 0, -1}, std::move(mesh));
    solver::State state = test::start(*rig.mechanism);
    double largest = 0;
    test::run(*rig.mechanism, state, 5e-3, 2500, 0.8,
              [&](const solver::State& s) { largest = std::max(largest, rig.observe(s).normal_force); });
    return std::array<double, 3>{largest, state.v[2], state.q[2]};
  };
  const auto exact = height_after({.stiffness = std::numbers::pi * K * radius, .exponent = 2, .damping = 0.2}, nullptr);
  const auto mesh = height_after({.stiffness = K, .exponent = 1, .damping = 0.2}, test::ball_mesh(radius, 5));
  CAPTURE(exact[0]);
  CAPTURE(mesh[0]);
  CHECK(exact[1] > 0.5);  // it has bounced
  CHECK(mesh[0] == doctest::Approx(exact[0]).epsilon(0.05));
  CHECK(mesh[1] == doctest::Approx(exact[1]).epsilon(0.01));
}

}  // namespace contact_motion_test
}  // namespace hersey::mbd
