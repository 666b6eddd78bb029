// Faults of users in mechanisms and their messages.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "hersey/core/contract.h"
#include "hersey/core/input_error.h"
#include "hersey/mbd/mechanism_builder.h"
#include "hersey/solver/initialise.h"
#include "test_mechanisms.h"

namespace hersey::mbd {
namespace faults_test {

using solver::InitialiseStatus;
using solver::InitialiseSummary;

bool names(const std::vector<std::string>& list, const std::string& part) {
  return std::any_of(list.begin(), list.end(), [&](const std::string& s) { return s.find(part) != std::string::npos; });
}

/// A plane four-bar whose joints are all of `closing` type at the end of the loop.
std::unique_ptr<Mechanism> four_bar(JointType middle, JointType closing, double rocker = 1.0) {
  MechanismBuilder b;
  const auto rod = [&](const char* name) {
    return b.add_body({.name = name, .mass = 1, .com = {0.5, 0, 0}, .inertia = Vector3(0.01, 0.1, 0.1).asDiagonal()});
  };
  const BodyId crank = rod("crank"), coupler = rod("coupler"), last = rod("rocker");
  const auto at = [&](BodyId id, double x) {
    return b.add_frame({.name = "f", .body = id, .X_BF = {Matrix3::Identity(), {x, 0, 0}}});
  };
  b.add_joint({.name = "left",
               .type = JointType::revolute,
               .inboard = b.frame_of(b.ground()),
               .outboard = b.frame_of(crank),
               .initial = {1.2}});
  b.add_joint({.name = "pin",
               .type = middle,
               .inboard = at(crank, 0.4),
               .outboard = b.frame_of(coupler),
               .initial = middle == JointType::revolute ? std::vector<double>{-1.2} : std::vector<double>{0, -1.2}});
  b.add_joint({.name = "right",
               .type = JointType::revolute,
               .inboard = at(b.ground(), 1.1),
               .outboard = b.frame_of(last),
               .initial = {1.5}});
  b.add_joint({.name = "knee", .type = closing, .inboard = at(coupler, 1), .outboard = at(last, rocker)});
  return b.finalise();
}

TEST_CASE("PlaneLoop_ClosesWithCylindricalAndSphericalJoints") {
  const auto m = four_bar(JointType::cylindrical, JointType::spherical);
  solver::State state = m->initial_state();
  const InitialiseSummary summary = solver::initialise(*m, state, {.fixed = {0}});
  INFO(summary.message);
  CHECK(summary.solved());
  CHECK(std::abs(state.q[0] - 1.2) < 1e-9);  // the crank kept its prescribed position; to 1e-7 of the others' motion
}

TEST_CASE("LoopTooShort_CannotBeAssembledAndNamesTheJoint") {
  const auto m = four_bar(JointType::cylindrical, JointType::spherical, 40);
  solver::State state = m->initial_state();
  const InitialiseSummary summary = solver::initialise(*m, state);
  CHECK(summary.status == InitialiseStatus::cannot_assemble);
  CHECK(summary.message.find("knee") != std::string::npos);
}

TEST_CASE("MotionWithoutInertia_IsNamed") {
  MechanismBuilder b;
  const BodyId arm = b.add_body({.name = "arm"});
  b.add_joint({.name = "hinge",
               .type = JointType::cylindrical,
               .inboard = b.frame_of(b.ground()),
               .outboard = b.frame_of(arm)});
  const auto m = b.finalise();
  solver::State state = m->initial_state();
  const InitialiseSummary summary = solver::initialise(*m, state);
  CHECK(summary.status == InitialiseStatus::undetermined);
  CHECK(summary.undetermined == std::vector<std::string>{"joint hinge, translation", "joint hinge, rotation"});
}

TEST_CASE("ConflictingDrive_IsRedundantWithTheLoopItMoves") {
  // A crank and, through the loop, its rocker: two drives for one degree of freedom.
  MechanismBuilder b;
  const BodyId body = b.add_body({.name = "wheel", .mass = 1, .inertia = Matrix3::Identity()});
  const FrameId ground = b.frame_of(b.ground());
  const JointId near =
      b.add_joint({.name = "near", .type = JointType::revolute, .inboard = ground, .outboard = b.frame_of(body)});
  const JointId far =
      b.add_joint({.name = "far", .type = JointType::free, .inboard = ground, .outboard = b.frame_of(body)});
  b.add_drive({.name = "one", .coordinate = {near, 0}, .function = test::constant(0.2)});
  b.add_drive({.name = "two", .coordinate = {far, 0}, .function = test::constant(0.0)});
  const auto m = b.finalise();
  solver::State state = m->initial_state();
  const InitialiseSummary summary = solver::initialise(*m, state);
  CHECK(summary.status == InitialiseStatus::redundant);
  CHECK(names(summary.redundant, "drive two"));
}

TEST_CASE("EveryFaultOfTheParts_IsReportedTogether") {
  MechanismBuilder b;
  const BodyId heavy = b.add_body({.name = "heavy", .mass = -1, .inertia = Vector3(1, 1, 3).asDiagonal()});
  const JointId joint = b.add_joint({.name = "self",
                                     .type = JointType::revolute,
                                     .inboard = b.frame_of(heavy),
                                     .outboard = b.add_frame({.name = "f", .body = heavy, .X_BF = {}})});
  for (const char* name : {"first", "second"})
    b.add_drive({.name = name, .coordinate = {joint, 0}, .function = test::constant(1)});
  b.add_spring({.name = "soft", .coordinate = {joint, 0}, .stiffness = -3});
  try {
    (void)b.finalise();
    FAIL("nothing thrown");
  } catch (const InputError& error) {
    CHECK(error.faults().size() == 5);
    const std::string text = error.what();
    for (const char* part : {"bodies.heavy.mass", "bodies.heavy.inertia", "joints.self", "forces.soft", "drive first"})
      CHECK(text.find(part) != std::string::npos);
  }
}

TEST_CASE("MisuseOfTheBuilder_IsAContractError") {
  MechanismBuilder b;
  CHECK_THROWS_AS((void)b.frame_of({7}), ContractError);
  CHECK_THROWS_AS(b.add_frame({.name = "f", .body = {3}, .X_BF = {}}), ContractError);
  CHECK_THROWS_AS(b.add_frame({.name = "f", .body = {0}, .X_BF = {2 * Matrix3::Identity(), Vector3::Zero()}}),
                  ContractError);
  CHECK_THROWS_AS(
      b.add_joint({.name = "j", .type = JointType::revolute, .inboard = {0}, .outboard = {0}, .axis = {0, 0, 0}}),
      ContractError);
  CHECK_THROWS_AS(b.add_force("f", {0}, {0}, nullptr), ContractError);
}

TEST_CASE("CollapsedSpring_IsADomainError") {
  MechanismBuilder b;
  const BodyId bob = b.add_body({.name = "bob", .mass = 1, .inertia = Matrix3::Identity()});
  b.add_force("strut", b.frame_of(b.ground()), b.frame_of(bob), std::make_shared<SpringDamper>(100, 0, 0.5));
  const auto m = b.finalise();
  solver::State state = m->initial_state();
  const InitialiseSummary summary = solver::initialise(*m, state);
  CHECK(summary.status == InitialiseStatus::domain_error);
  CHECK(summary.message.find("strut") != std::string::npos);
}

}  // namespace faults_test
}  // namespace hersey::mbd
