// Whoever carries whom: the same motion, the same coordinates of joints, the same reactions.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "../src/tree/tree_builder.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/mbd/spring_damper.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace roots_test {

/// Draws machines without loops: heavy and light bodies, joints either way round, springs, forces, weights, with and
/// without a joint to ground.
class Drawn {
 public:
  Drawn(unsigned seed, bool in_plane) : random_(seed), in_plane_(in_plane) {}

  std::unique_ptr<Mechanism> machine(bool chooses_roots) {
    MechanismBuilder b;
    if (chooses_roots) b.choose_roots();
    b.set_gravity(in_plane_ ? Vector3(1, -9, 2) : Vector3(1, -4, -8));
    const int count = 3 + pick(3);
    std::vector<BodyId> bodies{b.ground()};
    for (int i = 0; i < count; ++i) bodies.push_back(body(b, i));
    const bool floats = pick(5) == 0;
    for (int i = floats ? 2 : 1; i <= count; ++i) connect(b, bodies, i, floats ? 1 : 0);
    const auto frame = [&](BodyId body) {
      return b.add_frame({.name = "f", .body = body, .X_BF = {Matrix3::Identity(), vector(1)}});
    };
    for (int i = 1; i < count; i += 2)
      b.add_force("spring", frame(bodies[i]), frame(bodies[i + 1]), std::make_shared<SpringDamper>(30, 0.5, 1));
    b.add_load({.name = "push",
                .frame = frame(bodies.back()),
                .terms = {{(Vector6() << 1, 2, 3, 4, 5, 6).finished(), test::constant(1), {}}}});
    return b.finalise();
  }

 private:
  int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  double number() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
  Vector3 vector(double size) { return {size * number(), size * number(), size * number()}; }

  BodyId body(MechanismBuilder& b, int i) {
    const double size = std::pow(10.0, -pick(4));
    return b.add_body({.name = "body " + std::to_string(i),
                       .mass = size,
                       .com = vector(0.3),
                       .inertia = size * Vector3(0.1, 0.12, 0.15).asDiagonal()});
  }

  void connect(MechanismBuilder& b, const std::vector<BodyId>& bodies, int i, int first) {
    using enum JointType;
    const JointType in_space[] = {free,      free,        free,  spherical, revolute,
                                  universal, cylindrical, fixed, planar,    prismatic};
    const JointType plane[] = {planar, planar, planar, revolute, prismatic, fixed};
    JointSpec joint{.name = "joint " + std::to_string(i), .type = in_plane_ ? plane[pick(6)] : in_space[pick(10)]};
    const auto frame = [&](BodyId body) {
      const Vector3 rotation = in_plane_ ? Vector3(0, 0, 3 * number()) : vector(1);
      return b.add_frame({.name = "at " + joint.name, .body = body, .X_BF = test::pose(rotation, vector(0.5))});
    };
    if (in_plane_ && joint.type == prismatic) joint.axis = Vector3::UnitX();
    joint.inboard = frame(bodies[first + pick(i - first)]);
    joint.outboard = frame(bodies[i]);
    const bool is_reversed = pick(2) == 0;
    if (is_reversed) std::swap(joint.inboard, joint.outboard);
    for (int k = degrees_of_freedom(joint.type); k-- > 0;) {
      joint.initial.push_back(number());
      joint.initial_rate.push_back(2 * number());
    }
    // Several revolutions are counted.
    if (joint.type == planar || joint.type == revolute) joint.initial.back() *= 20;
    if (pick(4) == 0) joint.initial.clear();
    if (pick(4) == 0) joint.initial_rate.clear();
    const JointId id = b.add_joint(joint);
    if ((joint.type == revolute || joint.type == planar) && pick(2) == 0)
      b.add_spring({.name = "spring", .coordinate = {id, 0}, .stiffness = 30, .damping = 0.2, .free_position = 0.5});
  }

  std::mt19937 random_{1};
  bool in_plane_;
};

/// Returns all observed quantities of a machine in one vector.
Eigen::VectorXd observation_of(Mechanism& m, const solver::State& state) {
  const Observation observation = m.observe(state);
  std::vector<double> all{observation.kinetic_energy, observation.potential_energy, observation.spring_energy,
                          observation.damper_power};
  const auto add = [&](const auto& values) { all.insert(all.end(), values.data(), values.data() + values.size()); };
  for (const FrameMotion& body : observation.bodies) {
    add(body.X_WF.r), add(body.X_WF.R), add(body.v), add(body.omega);
    add(body.a), add(body.alpha);
  }
  for (const JointObservation& joint : observation.joints) {
    add(joint.position), add(joint.rate);
    add(joint.force), add(joint.torque);
  }
  return Eigen::VectorXd::Map(all.data(), static_cast<Eigen::Index>(all.size()));
}

TEST_CASE("OtherRootOfTheTree_GivesTheSameMotion") {
  int chosen = 0, of_planes = 0;
  for (const bool in_plane : {false, true})
    for (unsigned seed = 1; seed <= 60; ++seed) {
      CAPTURE(seed);
      CAPTURE(in_plane);
      const auto as_declared = Drawn(seed, in_plane).machine(false), by_inertia = Drawn(seed, in_plane).machine(true);
      const Tree tree = build_tree(by_inertia->spec());
      if (tree.own_motions.empty()) continue;
      ++chosen;
      for (const OwnMotion& own : tree.own_motions)
        if (!own.weights.empty()) ++of_planes;
      CHECK(by_inertia->nv() == as_declared->nv());
      solver::State a = test::start(*as_declared), b = test::start(*by_inertia);
      const Eigen::VectorXd from = observation_of(*as_declared, a);
      // Accelerations by matrices whose entries span four decades of mass and one of length.
      CHECK((from - observation_of(*by_inertia, b)).lpNorm<Eigen::Infinity>() < 1e-9 * from.lpNorm<Eigen::Infinity>());
    }
  CHECK(chosen > 30);
  CHECK(of_planes > 10);
}

TEST_CASE("OtherRootOfTheTree_ContinuesTheSameMotion") {
  // Both follow one motion, each with the error of its own steps, which falls with their square.
  for (const bool in_plane : {false, true}) {
    int compared = 0;
    for (unsigned seed = 1; compared < 4; ++seed) {
      CAPTURE(seed);
      CAPTURE(in_plane);
      if (build_tree(Drawn(seed, in_plane).machine(true)->spec()).own_motions.empty()) continue;
      ++compared;
      double apart[2] = {};
      for (const int steps : {50, 100}) {
        Eigen::VectorXd ends[2];
        for (const bool chooses : {false, true}) {
          const auto m = Drawn(seed, in_plane).machine(chooses);
          solver::State state = test::start(*m);
          test::run(*m, state, 0.005, steps, 0.9);
          const Observation observation = m->observe(state);
          Eigen::VectorXd& end = ends[chooses ? 1 : 0];
          end.resize(0);
          for (const FrameMotion& body : observation.bodies) {
            end.conservativeResize(end.size() + 3);
            end.tail<3>() = body.X_WF.r;
          }
          for (const JointObservation& joint : observation.joints) {
            end.conservativeResize(end.size() + joint.position.size());
            end.tail(joint.position.size()) = Eigen::VectorXd(joint.position);
          }
        }
        apart[steps == 50 ? 0 : 1] = (ends[0] - ends[1]).lpNorm<Eigen::Infinity>();
      }
      CAPTURE(apart[0]);
      CAPTURE(apart[1]);
      CHECK(apart[0] < 1e-4);                    // of a metre, a radian
      CHECK(apart[1] < 0.3 * apart[0] + 1e-11);  // round-off and Newton's tolerance
    }
  }
}

// Bodies fixed to each other count as one: the lighter of two such groups carries nothing.
TEST_CASE("LightPieceThatIsFixedToAHeavyOne_IsNotTooLight") {
  for (const bool light_is_first : {true, false}) {
    CAPTURE(light_is_first);
    MechanismBuilder b;
    b.choose_roots();
    const auto piece = [&](const char* name, double size) {
      return b.add_body({.name = name, .mass = size, .inertia = size * Vector3(0.1, 0.12, 0.15).asDiagonal()});
    };
    BodyId light, heavy;
    if (light_is_first) light = piece("light", 1e-3);
    heavy = piece("heavy", 1);
    if (!light_is_first) light = piece("light", 1e-3);
    b.add_joint({.type = JointType::free, .inboard = b.frame_of(b.ground()), .outboard = b.frame_of(light)});
    b.add_joint({.type = JointType::fixed, .inboard = b.frame_of(light), .outboard = b.frame_of(heavy)});
    CHECK(build_tree(b.finalise()->spec()).own_motions.empty());
  }
}

TEST_CASE("FreeBody_KeepsItsEnergyAtAnyOrigin") {
  // With coordinates at a point off the centre of mass the energy of a tumbling bar increased by 6 % a second.
  for (const Vector3& origin : {Vector3(0, 0, 0), Vector3(0.06, 0, 0), Vector3(-0.02, 0.3, 0.1)})
    for (const bool has_joint : {true, false}) {
      CAPTURE(origin.transpose());
      CAPTURE(has_joint);
      MechanismBuilder b;
      b.choose_roots();
      const BodyId bar = b.add_body(
          {.name = "bar", .mass = 0.0144, .com = origin, .inertia = Vector3(2.4e-7, 1.74e-5, 1.74e-5).asDiagonal()});
      if (has_joint)
        b.add_joint({.name = "flight",
                     .type = JointType::free,
                     .inboard = b.frame_of(b.ground()),
                     .outboard = b.frame_of(bar),
                     .initial_rate = {0, -3, 0, 20, -30, 60}});
      else
        b.add_load({.name = "kick",
                    .frame = b.frame_of(bar),
                    .axes = LoadAxes::ground,
                    .terms = {{(Vector6() << 1e-4, -2e-4, 4e-4, 0, 0.01, 0).finished(),
                               test::time_function([](double t) { return t < 0.15 ? 1.0 : 0.0; },
                                                   [](double) { return 0.0; }, [](double) { return 0.0; }),
                               {{}}}}});
      const auto m = b.finalise();
      solver::State state = test::start(*m);
      if (!has_joint) test::run(*m, state, 0.2, 100, 1);
      const double before = m->observe(state).kinetic_energy;
      test::run(*m, state, 0.7, 100, 1);
      CHECK(before > 1e-5);
      CHECK(m->observe(state).kinetic_energy == doctest::Approx(before).epsilon(1e-9));  // Newton's tolerance
    }
}

}  // namespace roots_test
}  // namespace hersey::mbd
