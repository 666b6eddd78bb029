// Loops with more constraints than motions: constraints that are dropped are satisfied all the same, and reactions are
// shared.
#include "../src/mechanism/redundancy.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "benchmark_mechanisms.h"
#include "hersey/mbd/mechanism_builder.h"
#include "simulate.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace redundancy_test {

constexpr double kPi = std::numbers::pi;

FrameId frame_at(MechanismBuilder& b, BodyId body, const Vector3& r, const Vector3& rotation = Vector3::Zero()) {
  return b.add_frame({.name = "f", .body = body, .X_BF = test::pose(rotation, r)});
}

BodyId rod(MechanismBuilder& b, const std::string& name, double length) {
  return b.add_body({.name = name,
                     .mass = length,
                     .com = {0.5 * length, 0, 0},
                     .inertia = Vector3(1e-3, 1, 1).asDiagonal() * (length * length * length / 12)});
}

/// A plane four-bar of hinges, its coupler joint possibly of another type, tilted about the line of the rods, or moved
/// out of the plane.
std::unique_ptr<Mechanism> four_bar(JointType closing, double tilt = 0, double offset = 0) {
  MechanismBuilder b;
  b.set_gravity({0, -9.81, 0});
  const BodyId crank = rod(b, "crank", 0.4), coupler = rod(b, "coupler", 1.0), rocker = rod(b, "rocker", 0.8);
  const auto hinge = [&](const char* name, FrameId i, FrameId o, std::vector<double> initial) {
    b.add_joint(
        {.name = name, .type = JointType::revolute, .inboard = i, .outboard = o, .initial = std::move(initial)});
  };
  hinge("left", b.frame_of(b.ground()), b.frame_of(crank), {1.2});
  hinge("pin", frame_at(b, crank, {0.4, 0, 0}), b.frame_of(coupler), {-1.0});
  hinge("right", frame_at(b, b.ground(), {1.1, 0, offset}), b.frame_of(rocker), {1.8});
  b.add_joint({.name = "knee",
               .type = closing,
               .inboard = frame_at(b, coupler, {1, 0, 0}),
               .outboard = frame_at(b, rocker, {0.8, 0, 0}, {tilt, 0, 0})});
  return b.finalise();
}

TEST_CASE("DependentRows_LeaveAnIndependentSet") {
  Eigen::MatrixXd G(5, 4);
  G << 1, 2, 0, 0,  //
      0, 1, 1, 0,   //
      2, 4, 0, 0,   // twice the first
      1, 3, 1, 0,   // the sum of the first two
      0, 0, 0, 3;
  const Eigen::SparseMatrix<double, Eigen::RowMajor> sparse = G.sparseView();
  CHECK(dependent_rows(sparse, 1e-6) == std::vector<int>{2, 3});
  // A row that barely differs is taken after those that are clearly independent: here the last replaces the third.
  Eigen::MatrixXd near(3, 2);
  near << 1, 0, 1, 1e-5, 0, 1;
  const Eigen::SparseMatrix<double, Eigen::RowMajor> near_rows = near.sparseView();
  CHECK(dependent_rows(near_rows, 1e-6) == std::vector<int>{1});
}

TEST_CASE("PlaneLoopOfHinges_IsNamedAndRuns") {
  const auto m = four_bar(JointType::revolute);
  REQUIRE(m->redundancies().size() == 1);
  const Redundancy& redundancy = m->redundancies()[0];
  CHECK(m->spec().joints[redundancy.joint.index].name == "knee");
  CHECK(redundancy.loop.size() == 4);
  CHECK(redundancy.positions == 1);     // across the plane
  CHECK(redundancy.orientations == 2);  // both tilts
  CHECK(m->nlambda() == 2);

  // The motion and the forces in the plane are those of a loop without redundancy.
  const auto free = four_bar(JointType::spherical);
  CHECK(free->redundancies().size() == 1);  // the ball's constraint keeps the loop in its plane twice
  solver::State state = test::start(*m), other = test::start(*free);
  double drift = 0;
  test::run(*m, state, 1, 1000, 0.8,
            [&](const solver::State& s) { drift = std::max(drift, m->observe(s).constraint_drift); });
  test::run(*free, other, 1, 1000);
  CHECK((state.q - other.q.head(3)).cwiseAbs().maxCoeff() < 1e-9);  // rad: two sets of equations, each to Newton's 1e-9
  const Observation a = m->observe(state), c = free->observe(other);
  for (std::size_t j = 0; j < 4; ++j) {
    // N, N m: the same, of forces of some 10 N.
    CHECK((a.joints[j].force - c.joints[j].force).norm() < 1e-6 * (1 + c.joints[j].force.norm()));
    CHECK(a.joints[j].torque.norm() < 1e-6);
  }
  CHECK(drift < 1e-12);  // dropped rows included: they hold to round-off
}

TEST_CASE("ToggleStart_IsNotTakenForRedundancy") {
  // Crank and coupler in line: two constraints agree for an instant, and must not be dropped.
  MechanismBuilder b;
  const BodyId crank = rod(b, "crank", 0.4), coupler = rod(b, "coupler", 1.0);
  const BodyId piston = b.add_body({.name = "piston", .mass = 1, .inertia = Matrix3::Identity()});
  b.add_joint(
      {.name = "main", .type = JointType::revolute, .inboard = b.frame_of(b.ground()), .outboard = b.frame_of(crank)});
  b.add_joint({.name = "pin",
               .type = JointType::revolute,
               .inboard = frame_at(b, crank, {0.4, 0, 0}),
               .outboard = b.frame_of(coupler)});
  b.add_joint({.name = "guide",
               .type = JointType::prismatic,
               .inboard = b.frame_of(b.ground()),
               .outboard = b.frame_of(piston),
               .axis = {1, 0, 0},
               .initial = {1.4}});
  b.add_joint({.name = "wrist",
               .type = JointType::revolute,
               .inboard = frame_at(b, coupler, {1, 0, 0}),
               .outboard = b.frame_of(piston)});
  const auto m = b.finalise();
  CHECK(m->nv() - m->nlambda() == 1);
}

TEST_CASE("ReactionsOfALadder_AreTheSmallest") {
  // Three constraints of each loop of hinges are redundant; beside it lies a loop without any.
  const auto ladder = test::four_bars(3, true);
  solver::State state = test::start(*ladder);
  test::run(*ladder, state, 0.1, 50);
  const Observation observation = ladder->observe(state);
  // Every rod of the ladder moves in its plane and nothing pushes it out: reactions of smallest norm have no part
  // there.
  for (const JointObservation& joint : observation.joints) {
    // N, N m: nothing there, to Newton's tolerance.
    CHECK(std::abs(joint.force.z()) < 1e-8);
    CHECK(joint.torque.norm() < 1e-8);
  }
  // Forces in the plane are unique: those of the same ladder with joints that leave nothing redundant.
  const auto plain = test::four_bars(3, false);
  solver::State same = test::start(*plain);
  test::run(*plain, same, 0.1, 50);
  const Observation expected = plain->observe(same);
  // Both sets of equations have the same forces in the plane.
  for (std::size_t j = 0; j < observation.joints.size(); ++j)
    CHECK(observation.joints[j].force.norm() == doctest::Approx(expected.joints[j].force.norm()).epsilon(1e-5));
}

TEST_CASE("TwoHinges_ShareTheDoorsWeight") {
  // Two equal hinges at z = 0 and z = 2 m carry half the weight each, which acts 0.5 m off the axis; a couple of forces
  // and moments of the hinges carry the tipping moment.
  MechanismBuilder b;
  b.set_gravity({0, 0, -10});
  const BodyId door =
      b.add_body({.name = "door", .mass = 20, .com = {0.5, 0, 1}, .inertia = Vector3(2, 2, 1).asDiagonal()});
  for (double z : {0.0, 2.0})
    b.add_joint({.name = z == 0 ? "lower" : "upper",
                 .type = JointType::revolute,
                 .inboard = frame_at(b, b.ground(), {0, 0, z}),
                 .outboard = frame_at(b, door, {0, 0, z})});
  const auto m = b.finalise();
  CHECK(m->nlambda() == 0);  // all five rows of the second hinge
  const solver::State state = test::start(*m);
  const Observation observation = m->observe(state);
  const Vector3 lower = observation.joints[0].force, upper = observation.joints[1].force;
  CHECK(lower.z() == doctest::Approx(100));
  CHECK(upper.z() == doctest::Approx(100));
  CHECK(lower.x() == doctest::Approx(-upper.x()));
  const double moments = observation.joints[0].torque.y() + observation.joints[1].torque.y();
  // Balance about y at the lower hinge: 2 upper.x + moments = 0.5 * 200 (weight tips the door about +y).
  CHECK(2 * upper.x() + moments + 100 == doctest::Approx(0).epsilon(1e-9));  // round-off of small systems
  // Smallest F^2 + (T/L)^2 of forces (F, -F) and moments (T, T), L = 2 m, with 2 m F + 2 T = 100 N m:
  // F : T/L = 2 m : 2 L.
  // Round-off of small systems.
  CHECK(std::abs(upper.x()) == doctest::Approx(10).epsilon(1e-9));
  CHECK(std::abs(moments) == doctest::Approx(80).epsilon(1e-9));
}

TEST_CASE("TiltedHinge_CannotCloseThePlaneLoop") {
  // The loop is over-constrained and inconsistent: nothing may be dropped, and assembly reports which joint stays open.
  const auto m = four_bar(JointType::revolute, 0.2);
  CHECK(m->redundancies().empty());
  solver::State state = m->initial_state();
  const solver::InitialiseSummary summary = solver::initialise(*m, state);
  CHECK_FALSE(summary.solved());
  CHECK(summary.message.find("knee") != std::string::npos);
}

TEST_CASE("GeometryRoundedToSevenDigits_StillCloses") {
  const auto m = four_bar(JointType::revolute, 2e-7, 3e-7);
  REQUIRE(m->redundancies().size() == 1);
  solver::State state = test::start(*m);
  double drift = 0;
  test::run(*m, state, 0.5, 200, 0.8,
            [&](const solver::State& s) { drift = std::max(drift, m->observe(s).constraint_drift); });
  CHECK(drift > 1e-8);  // what the geometry leaves open
  CHECK(drift < 1e-6);  // of the order of the digits left out, 3e-7
}

TEST_CASE("ParallelogramOfThreeCranks_KeepsItsMotion") {
  // A second loop that repeats the first, plane constraints and all.
  MechanismBuilder b;
  b.set_gravity({0, -9.81, 0});
  const BodyId beam = rod(b, "beam", 2.0);
  for (int i = 0; i < 3; ++i) {
    const BodyId crank = rod(b, "crank" + std::to_string(i), 0.5);
    b.add_joint({.name = "foot" + std::to_string(i),
                 .type = JointType::revolute,
                 .inboard = frame_at(b, b.ground(), {double(i), 0, 0}),
                 .outboard = b.frame_of(crank),
                 .initial = {0.4 * kPi}});
    b.add_joint({.name = "head" + std::to_string(i),
                 .type = JointType::revolute,
                 .inboard = frame_at(b, crank, {0.5, 0, 0}),
                 .outboard = frame_at(b, beam, {double(i), 0, 0}),
                 .initial = i == 0 ? std::vector<double>{-0.4 * kPi} : std::vector<double>{}});
  }
  const auto m = b.finalise();
  CHECK(m->nv() - m->nlambda() == 1);
  solver::State state = test::start(*m);
  const double energy = [&] {
    const Observation observation = m->observe(state);
    return observation.kinetic_energy + observation.potential_energy;
  }();
  test::run(*m, state, 0.2, 400, 0.9);
  const Observation observation = m->observe(state);
  CHECK(observation.kinetic_energy > 0.5);
  // 400 steps, second order.
  CHECK(observation.kinetic_energy + observation.potential_energy == doctest::Approx(energy).epsilon(1e-5));
  CHECK(observation.constraint_drift < 1e-11);  // Newton's tolerance of constraints
}

}  // namespace redundancy_test
}  // namespace hersey::mbd
