#include "start/start.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/build.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "temporary_directory.h"

// A run starts from what the model gives; what it leaves out moves.
namespace hersey::run {
namespace start_test {

constexpr double kDegree = std::numbers::pi / 180;

/// Crank of 150 mm, rod of 500 mm, slider along x; `main`, `pin` and `bore` are the contents of these joints' braces.
std::string slider_crank(const std::string& main, const std::string& pin, const std::string& bore,
                         const std::string& more = "") {
  return R"(hersey: 1
bodies:
  crank: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 2e-3 kg.m^2, zz: 2e-3 kg.m^2}, frames: {pin: {origin: 150 0 0 mm}}}
  rod: {mass: 2 kg, inertia: {xx: 1e-3 kg.m^2, yy: 0.04 kg.m^2, zz: 0.04 kg.m^2}, frames: {end: {origin: 500 0 0 mm}}}
  slider: {mass: 0.5 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  main: {type: revolute, between: [ground, crank])" +
         main + R"(}
  pin: {type: revolute, between: [crank.pin, rod])" +
         pin + R"(}
  wrist: {type: revolute, between: [rod.end, slider]}
  bore: {type: prismatic, between: [ground, slider], axis: x)" +
         bore + "}\n" + more + "simulation: {duration: 1 ms, step: 1 ms}\n";
}

struct Started {
  explicit Started(const std::string& text) : model(rig(text)), machine(model::build(model)) {
    state = starting_state(model, machine);
    observation = machine.mechanism->observe(state);
  }
  [[nodiscard]] double position(std::size_t joint) const { return observation.joints[joint].position[0]; }
  [[nodiscard]] double rate(std::size_t joint) const { return observation.joints[joint].rate[0]; }

  model::Model model;
  model::Machine machine;
  solver::State state;
  mbd::Observation observation;
};

enum : std::size_t { kMain, kPin, kWrist, kBore };

/// Position of the slider at a crank angle, and its derivative by the angle.
double slider(double angle) {
  const double s = 0.15 * std::sin(angle);
  return 0.15 * std::cos(angle) + std::sqrt(0.25 - s * s);
}
double slider_rate(double angle) {
  const double s = 0.15 * std::sin(angle), c = 0.15 * std::cos(angle);
  return -s - s * c / std::sqrt(0.25 - s * s);
}

Fault refusal(const std::string& text) {
  try {
    check(rig(text));
  } catch (const InputError& error) {
    return error.faults().front();
  }
  return {};
}

TEST_CASE("Misfit_OfRoundedValuesIsSpreadAndReported") {
  // The slider belongs 594.686 mm from the shaft; 0.034 mm more are of rounding.
  const std::string text =
      slider_crank(", initial: {rotation: 45 deg, rotation_rate: 10 rad/s}", "", ", initial: {translation: 594.72 mm}");
  const Started start(text);
  const double misfit = 0.59472 - slider(45 * kDegree);
  const double turned = start.position(kMain) - 45 * kDegree, shifted = start.position(kBore) - 0.59472;
  // rtol of the start is 1e-12.
  CHECK(start.position(kBore) == doctest::Approx(slider(start.position(kMain))).epsilon(1e-12));
  CHECK(start.rate(kMain) == doctest::Approx(10).epsilon(1e-12));
  // The least of all changes that close the loop, in rad and sizes of the machine: along the loop's own gradient.
  const double size = start.machine.mechanism->position_scales().maxCoeff(), g = slider_rate(45 * kDegree) / size;
  // Error of second order in the misfit.
  CHECK(shifted == doctest::Approx(-misfit / (1 + g * g)).epsilon(1e-3));
  CHECK(turned == doctest::Approx(misfit / size * g / (1 + g * g)).epsilon(1e-3));

  const std::vector<Fault> warnings = check(start.model);
  std::vector<std::string> moved;
  for (const Fault& warning : warnings)
    if (warning.path.find(".initial.") != std::string::npos) moved.push_back(warning.path);
  CHECK(moved == std::vector<std::string>{"joints.main.initial.rotation", "joints.bore.initial.translation"});
  CHECK(warnings.front().found.find("45") == 0);

  const TemporaryDirectory scratch;
  const Summary summary = simulate(start.model, {.results = scratch / "run.h5"});
  REQUIRE(summary.status == Status::completed);
  bool is_reported = false;
  for (const auto& [name, value] : results::Reader(summary.results).text_table("/assumptions"))
    if (name == "start moved: joint bore, translation") is_reported = value.find("594.72 mm given, 594.68") == 0;
  CHECK(is_reported);
}

TEST_CASE("ValuesThatFitTogether_AreNotReported") {
  const Started start(slider_crank(", initial: {rotation: 45 deg, rotation_rate: 10 rad/s}", "", ""));
  CHECK(start.position(kMain) == 45 * kDegree);
  // rtol of the start is 1e-12.
  CHECK(start.position(kBore) == doctest::Approx(slider(45 * kDegree)).epsilon(1e-12));
  CHECK(start.rate(kBore) == doctest::Approx(10 * slider_rate(45 * kDegree)).epsilon(1e-12));
  for (const Fault& warning : check(start.model)) CHECK(warning.path.find(".initial.") == std::string::npos);
}

TEST_CASE("JumpOfAGivenPosition_IsRefused") {
  const Fault fault = refusal(slider_crank(", initial: {rotation: 45 deg}", "", ", initial: {translation: 600 mm}"));
  CAPTURE(fault.text());
  CHECK(fault.path.find(".initial.") != std::string::npos);
  CHECK(fault.position.line > 0);
  CHECK(fault.found.find("mm apart") != std::string::npos);
  CHECK(fault.suggestion.find("guess") != std::string::npos);
}

TEST_CASE("GivenRate_StaysBesideAGivenPosition") {
  // The slider's position fits; its rate follows from the crank's.
  const std::string bore = ", initial: {translation: " + std::to_string(1e3 * slider(0.5)) + " mm}";
  const Started start(slider_crank(", initial: {rotation_rate: 6 rad/s}", ", guess: {rotation: -0.6 rad}", bore));
  CHECK(start.rate(kMain) == doctest::Approx(6).epsilon(1e-12));  // rtol of the start is 1e-12
  // rtol of the start is 1e-12, over a slope.
  CHECK(start.rate(kBore) == doctest::Approx(6 * slider_rate(start.position(kMain))).epsilon(1e-10));
  CHECK(std::abs(start.rate(kBore)) > 0.1);
}

TEST_CASE("RatesThatContradict_AreRefused") {
  const Fault loop = refusal(slider_crank(", initial: {rotation: 45 deg, rotation_rate: 10 rad/s}", "",
                                          ", initial: {translation_rate: 0 m/s}"));
  CAPTURE(loop.text());
  CHECK(loop.path.find("_rate") != std::string::npos);
  const Fault drive = refusal(slider_crank(", initial: {rotation: 45 deg, rotation_rate: 10 rad/s}", "", "",
                                           "drives:\n  motor: {joint: main, coordinate: rotation, speed: 12 rad/s}\n"));
  CAPTURE(drive.text());
  CHECK(drive.path == "joints.main.initial.rotation_rate");
  CHECK(drive.expected.find("12 rad/s") != std::string::npos);
}

TEST_CASE("Guess_ChoosesHowALoopCloses") {
  const Started outer(slider_crank(", initial: {rotation: 60 deg}", "", ", guess: {translation: 500 mm}"));
  const Started inner(
      slider_crank(", initial: {rotation: 60 deg}", ", guess: {rotation: 150 deg}", ", guess: {translation: -400 mm}"));
  // rtol of the start is 1e-12.
  CHECK(outer.position(kBore) == doctest::Approx(slider(60 * kDegree)).epsilon(1e-12));
  CHECK(inner.position(kBore) == doctest::Approx(0.3 * std::cos(60 * kDegree) - slider(60 * kDegree)).epsilon(1e-12));
  CHECK(refusal(slider_crank(", initial: {rotation: 60 deg}, guess: {rotation: 50 deg}", "", "")).path ==
        "joints.main.guess.rotation");
}

TEST_CASE("ValueOfAClosingJoint_IsKept") {
  // The wrist closes the loop, and its angle is what the model gives.
  std::string text = slider_crank("", ", guess: {rotation: -40 deg}", ", guess: {translation: 580 mm}");
  const std::string wrist = "wrist: {type: revolute, between: [rod.end, slider]";
  text.insert(text.find(wrist) + wrist.size(), ", initial: {rotation: 10 deg, rotation_rate: 2 rad/s}");
  const Started start(text);
  // rtol of the start is 1e-12.
  CHECK(start.position(kWrist) == doctest::Approx(10 * kDegree).epsilon(1e-11));
  CHECK(start.rate(kWrist) == doctest::Approx(2).epsilon(1e-11));
  CHECK(start.position(kBore) == doctest::Approx(slider(start.position(kMain))).epsilon(1e-11));
}

TEST_CASE("OneCoordinateOfAJoint_LeavesItsOthersFree") {
  // Only x is given: y and the rotation follow from the rods that hold the plate.
  const Started start(R"(hersey: 1
bodies:
  ground: {frames: {left: {origin: 0 0 0 m}, right: {origin: 1 0 0 m}}}
  plate: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}, frames: {right: {origin: 1 0 0 m}}}
  one: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}, frames: {end: {origin: 0 1 0 m}}}
  two: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}, frames: {end: {origin: 0 1 0 m}}}
joints:
  float: {type: planar, between: [ground, plate], initial: {x: 0.3 m}}
  a: {type: revolute, between: [ground.left, one]}
  b: {type: revolute, between: [ground.right, two]}
  c: {type: revolute, between: [one.end, plate]}
  d: {type: revolute, between: [two.end, plate.right]}
simulation: {duration: 1 ms, step: 1 ms}
)");
  const mbd::JointValues& plate = start.observation.joints[0].position;
  CHECK(plate[0] == doctest::Approx(0.3).epsilon(1e-12));                  // rtol of the start is 1e-12
  CHECK(plate[1] == doctest::Approx(std::sqrt(1 - 0.09)).epsilon(1e-10));  // rtol of the start is 1e-12, over a slope
}

TEST_CASE("RandomStarts_AreAsGiven") {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> angle(-170, 170), rate(-50, 50);
  for (int i = 0; i < 20; ++i) {
    const double main = angle(random), omega = rate(random);
    CAPTURE(main);
    CAPTURE(omega);
    const Started start(slider_crank(
        ", initial: {rotation: " + std::to_string(main) + " deg, rotation_rate: " + std::to_string(omega) + " rad/s}",
        "", ""));
    CHECK(start.position(kMain) == std::stod(std::to_string(main)) * kDegree);
    // rtol of the start is 1e-12.
    CHECK(start.rate(kMain) == doctest::Approx(std::stod(std::to_string(omega))).epsilon(1e-12));
    const double x = slider(start.position(kMain)), other = 0.3 * std::cos(start.position(kMain)) - x;
    // rtol of the start is 1e-12.
    CHECK(std::min(std::abs(start.position(kBore) - x), std::abs(start.position(kBore) - other)) < 1e-11);
    CHECK(check(start.model).size() == check(rig(slider_crank("", "", ""))).size());  // of redundancies alone
  }
}

}  // namespace start_test
}  // namespace hersey::run
