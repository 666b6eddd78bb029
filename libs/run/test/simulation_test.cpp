#include "hersey/run/simulation.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "temporary_directory.h"

using namespace hersey;
using namespace hersey::run;

namespace {

constexpr double kStep = 2.0 / 360 / 50;  // of the rig: 2 deg at 3000 rpm [s]

/// h_min and the force at every row of a results file.
std::vector<double> rows_of(const std::filesystem::path& file, const char* path) {
  return results::Reader(file).read(path).values;
}

/// A mass that a force pushes along a rail, against nothing.
const char* const kPushedMass = R"(hersey: 1
bodies:
  cart: {mass: 2 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints:
  rail: {type: prismatic, between: [ground, cart], axis: x}
forces:
  push: {type: force, body: cart, components: ["3 N", "0 N", "0 N"]}
simulation: {duration: 1 s, step: 10 ms}
)";

/// A wheel rotated by a drive, and one that it drags along through a damper.
const char* const kDrivenWheel = R"(hersey: 1
bodies:
  wheel: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints:
  axle: {type: revolute, between: [ground, wheel], initial: {rotation_rate: 10 rad/s}}
drives:
  motor: {joint: axle, coordinate: rotation, speed: 10 rad/s}
simulation: {duration: 1 s, step: 10 ms}
)";

}  // namespace

TEST_CASE("Simulation_SteppedToItsEnd_HasTheBitsOfSimulate") {
  const TemporaryDirectory scratch;
  const Summary whole = simulate(rig(), {.results = scratch / "whole.h5"});
  REQUIRE(whole.status == Status::completed);
  Simulation stepped(rig(), {.results = scratch / "stepped.h5"});
  std::vector<double> h_min = stepped.output("bearings.big_end.h_min");
  Advance last;
  while ((last = stepped.step()).status == Advance::Status::advanced)
    h_min.push_back(stepped.output("bearings.big_end.h_min").front());
  CHECK(last.status == Advance::Status::ended);
  CHECK(last.message.find("simulation.duration") != std::string::npos);
  const Summary summary = stepped.finish();
  CHECK(summary.status == Status::completed);
  CHECK(summary.steps == whole.steps);
  CHECK(h_min == rows_of(whole.results, "/bearings/big_end/h_min"));
  for (const char* path : {"/time", "/bearings/big_end/h_min", "/bearings/big_end/force", "/bodies/rod/position"})
    CHECK(rows_of(summary.results, path) == rows_of(whole.results, path));
}

// A master that sets the speed anew each time, by less than anyone can measure, starts the integrator afresh each time.
TEST_CASE("SpeedThatHardlyJumps_HardlyMovesTheMachine") {
  const auto h_min = [](double jump) {
    Simulation stepped(rig(rig_with("{x: 0 um}", "{y: -12 um}"),
                           {"bodies.rod.mass=0.2 kg", "bearings.big_end.diameter=50 mm", "bearings.big_end.width=25 mm",
                            "bearings.big_end.radial_clearance=25 um", "bearings.big_end.grid.circumferential=36",
                            "bearings.big_end.grid.axial=7", "simulation.step=0.1 ms"}));
    const double speed = stepped.input("drives.motor.speed"), interval = 0.09e-3;
    std::vector<double> values;
    for (int k = 1; k <= 10; ++k) {
      if (k > 1) stepped.set("drives.motor.speed", speed + (k % 2 + 1) * jump);
      REQUIRE(stepped.advance_to(k * interval).status == Advance::Status::advanced);
      values.push_back(stepped.output("bearings.big_end.h_min").front());
    }
    return values;
  };
  const std::vector<double> steady = h_min(0), jumping = h_min(1e-3);
  REQUIRE(steady.size() == jumping.size());
  for (std::size_t k = 0; k < steady.size(); ++k) {
    CAPTURE(k);
    CHECK(jumping[k] == doctest::Approx(steady[k]).epsilon(2e-3));  // error of steps whose history is cut, at 2 deg
  }
}

TEST_CASE("Simulation_CommunicatingAtItsStep_HasTheBitsOfSimulate") {
  const TemporaryDirectory scratch;
  const Summary whole = simulate(rig(), {.results = scratch / "whole.h5"});
  Simulation stepped(rig());  // without a results file
  std::vector<double> h_min = stepped.output("bearings.big_end.h_min");
  double t = 0;
  while (t + kStep < stepped.end()) {
    t += kStep;  // summed, as a co-simulation master does
    REQUIRE(stepped.advance_to(t).status == Advance::Status::advanced);
    h_min.push_back(stepped.output("bearings.big_end.h_min").front());
  }
  std::vector<double> rows = rows_of(whole.results, "/bearings/big_end/h_min");
  rows.resize(h_min.size());
  CHECK(h_min == rows);
}

TEST_CASE("AnyCommunicationStep_IsHitExactly") {
  Simulation simulation(model::read_text(kPushedMass, "cart.yaml"));
  // Constant acceleration: generalized-alpha is exact up to round-off, whatever the steps.
  for (const double t : {0.0123, 0.0377, 0.05, 0.0512, 0.5, 0.99}) {
    REQUIRE(simulation.advance_to(t).status == Advance::Status::advanced);
    CHECK(std::abs(simulation.time() - t) <= 1e-12);  // round-off of times that are added up, with room
    // Round-off, and what Newton's tolerance of 1e-8 leaves of a hundred steps.
    CHECK(simulation.output("bodies.cart.position")[0] == doctest::Approx(0.75 * t * t).epsilon(1e-9));
  }
  CHECK_THROWS_AS((void)simulation.advance_to(0.5), InputError);
}

TEST_CASE("ForceSetFromOutside_ActsFromThereOn") {
  Simulation simulation(model::read_text(kPushedMass, "cart.yaml"));
  REQUIRE(simulation.inputs().size() == 3);
  CHECK(simulation.inputs()[0].name == "forces.push.components.x");
  CHECK(simulation.inputs()[0].unit == "N");
  CHECK(simulation.inputs()[0].start == 3);
  REQUIRE(simulation.advance_to(0.5).status == Advance::Status::advanced);
  simulation.set("forces.push.components.x", -5);
  CHECK(simulation.input("forces.push.components.x") == -5);
  REQUIRE(simulation.advance_to(0.9).status == Advance::Status::advanced);
  // 1.5 m/s^2 for 0.5 s, then -2.5 m/s^2 for 0.4 s: exact up to round-off, as the history starts anew at the jump.
  CHECK(simulation.output("bodies.cart.velocity")[0] == doctest::Approx(0.75 - 1.0).epsilon(1e-9));
  CHECK(simulation.output("bodies.cart.position")[0] == doctest::Approx(0.1875 + 0.3 - 0.2).epsilon(1e-9));
}

TEST_CASE("SpeedSetFromOutside_IsTakenUpAtOnce") {
  Simulation simulation(model::read_text(kDrivenWheel, "wheel.yaml"));
  REQUIRE(simulation.advance_to(0.5).status == Advance::Status::advanced);
  simulation.set("drives.motor.speed", 4);
  REQUIRE(simulation.advance_to(0.6).status == Advance::Status::advanced);
  // The angle goes on from 5 rad; velocities follow as by an impulse, and nothing rings behind it.
  CHECK(simulation.output("joints.axle.coordinates")[0] == doctest::Approx(5.4).epsilon(1e-9));
  CHECK(simulation.output("joints.axle.rates")[0] == doctest::Approx(4).epsilon(1e-9));
}

TEST_CASE("InputSetToWhatItIs_ChangesNoBit") {
  Simulation left(rig()), touched(rig());
  while (left.step().status == Advance::Status::advanced) {
    touched.set("drives.motor.speed", touched.input("drives.motor.speed"));
    touched.set("forces.push.components.y", -500);
    REQUIRE(touched.step().status == Advance::Status::advanced);
    REQUIRE(touched.output("bearings.big_end.force") == left.output("bearings.big_end.force"));
  }
}

TEST_CASE("RestoredState_GoesOnWithTheSameBits") {
  Simulation simulation(rig());
  for (int k = 0; k < 8; ++k) REQUIRE(simulation.step().status == Advance::Status::advanced);
  simulation.set("forces.push.components.y", -700);
  const Archive::Content saved = simulation.save();
  const std::vector<double> force_there = simulation.output("bearings.big_end.force");
  const double t = simulation.time();
  const auto go_on = [](Simulation& one) {
    std::vector<double> forces;
    for (int k = 0; k < 8; ++k) {
      REQUIRE(one.step().status == Advance::Status::advanced);
      for (const double f : one.output("bearings.big_end.force")) forces.push_back(f);
    }
    return forces;
  };
  const std::vector<double> first = go_on(simulation);
  simulation.restore(saved);
  CHECK(simulation.time() == t);
  CHECK(simulation.input("forces.push.components.y") == -700);
  CHECK(simulation.output("bearings.big_end.force") == force_there);
  CHECK(go_on(simulation) == first);
  Simulation other(rig());
  other.restore(saved);
  CHECK(go_on(other) == first);
  Simulation of_another(rig(rig_with("15 mPa.s", "16 mPa.s")));
  CHECK_THROWS_AS(of_another.restore(saved), InputError);
}

TEST_CASE("WrongNames_AreReportedWithTheNearest") {
  Simulation simulation(rig());
  CHECK_THROWS_WITH_AS(simulation.set("drives.motr.speed", 1), doctest::Contains("drives.motor.speed"), InputError);
  CHECK_THROWS_WITH_AS((void)simulation.output("bearings.big_end.hmin"), doctest::Contains("bearings.big_end.h_min"),
                       InputError);
  CHECK_THROWS_AS(simulation.set("drives.motor.speed", std::nan("")), InputError);
}

TEST_CASE("StepWithoutAnAnswer_IsReportedAndKeepsTheResults") {
  const TemporaryDirectory scratch;
  Simulation simulation(rig(), {.results = scratch / "run.h5"});
  REQUIRE(simulation.step().status == Advance::Status::advanced);
  simulation.set("forces.push.components.y", -1e12);  // far beyond what a film of smooth surfaces carries
  Advance last;
  while ((last = simulation.step()).status == Advance::Status::advanced) {
  }
  REQUIRE(!last.solved());
  CHECK(last.message.find("t = ") != std::string::npos);
  CHECK(!simulation.step().solved());
  const Summary summary = simulation.finish();
  CHECK(summary.status == Status::failed);
  const results::Reader reader(scratch / "run.h5");
  CHECK(reader.text_attribute("/", "status") == "failed");
  CHECK(reader.rows() >= 2);
}

TEST_CASE("ModelWithoutMotion_IsRefused") {
  CHECK_THROWS_AS(Simulation(rig(rig_with("  crank: main\n", "  crank: main\n  analysis: equilibrium\n"))), InputError);
}

// Accelerations are constant between the jumps, so that the trapezoidal rule has every energy without error.
TEST_CASE("InputsThatJump_LeaveNoEnergyUnexplained") {
  Simulation pushed(model::read_text(kPushedMass, "cart.yaml"));
  Simulation driven(model::read_text(kDrivenWheel, "wheel.yaml"));
  for (int k = 0; k < 40; ++k) {
    pushed.set("forces.push.components.x", k % 2 == 0 ? -50 : 80);
    driven.set("drives.motor.speed", 4 + k);
    REQUIRE(pushed.step().status == Advance::Status::advanced);
    REQUIRE(driven.step().status == Advance::Status::advanced);
  }
  CHECK(pushed.summary().energy.stored > 1e-3);
  CHECK(pushed.summary().energy.error() < 1e-12);  // round-off
  CHECK(driven.summary().energy.put_in == doctest::Approx(0.5 * (43.0 * 43 - 100)));
  CHECK(driven.summary().energy.error() < 1e-12);  // likewise
}
