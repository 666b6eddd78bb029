#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/run/simulation.h"
#include "small_rig.h"

using namespace hersey;
using namespace hersey::run;

namespace {

const std::string kPush = "forces.push.components.y";

/// A mass on a rail between a spring, a damper and a force.
const char* const kCart = R"(hersey: 1
bodies:
  cart: {mass: 2 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints:
  rail: {type: prismatic, between: [ground, cart], axis: x}
forces:
  push: {type: force, body: cart, components: ["3 N", "0 N", "0 N"]}
simulation: {duration: 1 s, step: 10 ms}
)";

/// A wheel that a drive turns.
const char* const kWheel = R"(hersey: 1
bodies:
  wheel: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints:
  axle: {type: revolute, between: [ground, wheel], initial: {rotation_rate: 10 rad/s}}
drives:
  motor: {joint: axle, coordinate: rotation, speed: 10 rad/s}
simulation: {duration: 1 s, step: 10 ms}
)";

std::size_t index_of(const Simulation& simulation, const std::string& name) {
  const auto& all = simulation.outputs();
  const auto found = std::find_if(all.begin(), all.end(), [&](const OutputInfo& one) { return one.name == name; });
  REQUIRE(found != all.end());
  return static_cast<std::size_t>(found - all.begin());
}

/// Outputs at the end of an advance from `start` with an input set.
std::vector<double> outputs_with(Simulation& simulation, const Archive::Content& start, double t,
                                 const std::string& input, double value, const std::vector<std::size_t>& which) {
  simulation.restore(start);
  simulation.set(input, value);
  REQUIRE(simulation.advance_to(t).status == Advance::Status::advanced);
  std::vector<double> values;
  for (const std::size_t i : which)
    values.insert(values.end(), simulation.output(i).begin(), simulation.output(i).end());
  return values;
}

/// Central differences of advances, those of step and half the step extrapolated.
std::vector<double> differences(Simulation& simulation, const Archive::Content& start, double t,
                                const std::string& input, double value, double step,
                                const std::vector<std::size_t>& which) {
  const auto central = [&](double h) {
    std::vector<double> up = outputs_with(simulation, start, t, input, value + h, which);
    const std::vector<double> down = outputs_with(simulation, start, t, input, value - h, which);
    for (std::size_t i = 0; i < up.size(); ++i) up[i] = (up[i] - down[i]) / (2 * h);
    return up;
  };
  std::vector<double> fine = central(step / 2);
  const std::vector<double> coarse = central(step);
  for (std::size_t i = 0; i < fine.size(); ++i) fine[i] += (fine[i] - coarse[i]) / 3;
  return fine;
}

}  // namespace

TEST_CASE("DerivativeOfAPushedMass_IsThatOfConstantAcceleration") {
  for (const double length : {0.01, 0.05, 0.037}) {  // one step, five, four of another length
    Simulation simulation(model::read_text(kCart, "cart.yaml"));
    REQUIRE(simulation.advance_to(0.1).status == Advance::Status::advanced);
    simulation.keep_starts(true);
    REQUIRE(simulation.advance_to(0.1 + length).status == Advance::Status::advanced);
    const auto& along = simulation.derivative("forces.push.components.x");
    const double m = 2;
    // Round-off of neighbours that differ in the fifth digit of the force.
    CHECK(along[index_of(simulation, "bodies.cart.position")][0] ==
          doctest::Approx(length * length / (2 * m)).epsilon(1e-8));
    CHECK(along[index_of(simulation, "bodies.cart.velocity")][0] == doctest::Approx(length / m).epsilon(1e-8));
    const auto& across = simulation.derivative("forces.push.components.y");
    CHECK(across[index_of(simulation, "bodies.cart.position")][0] == 0);
  }
}

TEST_CASE("DerivativeByADrivesSpeed_IsTheTimeItTurns") {
  Simulation simulation(model::read_text(kWheel, "wheel.yaml"));
  simulation.keep_starts(true);
  REQUIRE(simulation.advance_to(0.2).status == Advance::Status::advanced);
  const auto& by_speed = simulation.derivative("drives.motor.speed");
  CHECK(by_speed[index_of(simulation, "joints.axle.coordinates")][0] ==
        doctest::Approx(0.2).epsilon(1e-8));                                                          // round-off
  CHECK(by_speed[index_of(simulation, "joints.axle.rates")][0] == doctest::Approx(1).epsilon(1e-8));  // likewise
}

TEST_CASE("DerivativeOfAFilm_IsThatOfDifferencesOfAdvances") {
  model::Model model = rig();
  model.simulation.tolerance = 1e-11;  // so that differences of advances have digits
  const double dt = model.simulation.step;
  for (const int steps : {1, 4}) {
    Simulation simulation(model);
    REQUIRE(simulation.advance_to(3 * dt).status == Advance::Status::advanced);
    simulation.keep_starts(true);
    const Archive::Content start = simulation.save();
    const double end = (3 + steps) * dt;
    std::vector<std::size_t> which;
    for (const char* name : {"bodies.rod.position", "bodies.rod.velocity", "bearings.big_end.h_min",
                             "bearings.big_end.force", "bearings.big_end.p_max", "bearings.big_end.power_film"})
      which.push_back(index_of(simulation, name));
    REQUIRE(simulation.advance_to(end).status == Advance::Status::advanced);
    for (const std::string& input : {kPush, std::string("drives.motor.speed")}) {
      const double step = input == kPush ? 1.0 : 0.1;  // SI
      const auto& all = simulation.derivative(input);
      std::vector<double> found;
      for (const std::size_t i : which) found.insert(found.end(), all[i].begin(), all[i].end());
      Simulation other(model);
      REQUIRE(other.advance_to(3 * dt).status == Advance::Status::advanced);
      const std::vector<double> expected = differences(other, start, end, input, simulation.input(input), step, which);
      std::size_t at = 0;
      for (const std::size_t i : which) {
        double largest = 0, off = 0;
        for (std::size_t k = 0; k < all[i].size(); ++k, ++at) {
          largest = std::max(largest, std::abs(expected[at]));
          off = std::max(off, std::abs(found[at] - expected[at]));
        }
        CAPTURE(steps);
        CAPTURE(input);
        CAPTURE(simulation.outputs()[i].name);
        CAPTURE(largest);
        CHECK(off <= 1e-6 * largest);  // asked for; differences have seven digits
      }
    }
  }
}

TEST_CASE("AskingForDerivatives_ChangesNoBit") {
  Simulation left(rig()), asked(rig());
  asked.keep_starts(true);
  for (int k = 0; k < 6; ++k) {
    REQUIRE(left.step().status == Advance::Status::advanced);
    REQUIRE(asked.step().status == Advance::Status::advanced);
    const std::vector<double> force = asked.output("bearings.big_end.force");
    CHECK(asked.derivative(kPush).size() == asked.outputs().size());
    CHECK(asked.output("bearings.big_end.force") == force);
    CHECK(left.output("bearings.big_end.force") == force);
    CHECK(asked.input(kPush) == left.input(kPush));
  }
}

TEST_CASE("DerivativesThatCannotBeHad_AreRefused") {
  Simulation simulation(rig());
  REQUIRE(simulation.step().status == Advance::Status::advanced);
  CHECK_THROWS_AS((void)simulation.derivative(kPush), InputError);
  CHECK_THROWS_AS((void)simulation.derivative("forces.pull"), InputError);
  model::Model controlled = rig();
  CHECK(why_no_derivatives(controlled).empty());
  controlled.simulation.error_control.emplace();
  CHECK(why_no_derivatives(controlled).find("fixed length") != std::string::npos);
}
