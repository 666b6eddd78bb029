#include "hersey/run/simulate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>

#include "hersey/results/error.h"
#include "hersey/results/reader.h"
#include "small_rig.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace simulate_test {

double last(const results::Reader& reader, const std::string& path) { return reader.read(path).values.back(); }

TEST_CASE("Run_ReachesItsEndAndBalances") {
  const TemporaryDirectory scratch;
  int calls = 0;
  Options options{.results = scratch / "run.h5"};
  options.on_progress = [&](const Progress&) { ++calls; };
  const Summary summary = simulate(rig(), options);
  CHECK(summary.status == Status::completed);
  CHECK(summary.t_end == doctest::Approx(4e-3));
  CHECK(calls == summary.steps + 1);

  // Every step is solved to 1e-8 of its largest term; powers are sums of such terms.
  // As every step is solved to 1e-8 of its largest term.
  CHECK(summary.worst_power_balance < 1e-6);
  REQUIRE(summary.bearings.size() == 1);
  CHECK(summary.bearings[0].worst_mass_balance < 1e-6);

  const results::Reader reader(summary.results);
  CHECK(reader.text_attribute("/", "status") == "completed");
  CHECK(static_cast<int>(reader.rows()) == summary.steps + 1);
  CHECK(last(reader, "/time") == summary.t_end);
  CHECK(reader.read("/bearings/big_end/h_min").values.size() == reader.rows());
}

TEST_CASE("Results_TellWhatTheMachineLooksLike") {
  const TemporaryDirectory scratch;
  const std::string text =
      rig_with("  rod: {mass: 0.5 kg, ",
               "  rod: {shapes: {shank: {shape: capsule, to: 0 0.1 0 m, diameter: 2 cm}}, mass: 0.5 kg, ");
  const Summary summary = simulate(rig(text, {"duration=1 ms"}), {.results = scratch / "run.h5"});
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(summary.results);
  CHECK(reader.text_attribute("/bodies/rod/shapes/shank", "shape") == "capsule");
  CHECK(reader.read("/bodies/rod/shapes/shank/to").values == std::vector<double>{0, 0.1, 0});
  CHECK(reader.read("/bodies/rod/shapes/shank/radius").values == std::vector<double>{0.01});
  CHECK(reader.text_attribute("/joints/main", "type") == "revolute");
  CHECK(reader.text_attribute("/joints/main", "inboard") == "ground");
  CHECK(reader.text_attribute("/bearings/big_end", "inboard") == "rod");
  CHECK(reader.text_attribute("/bearings/big_end", "outboard") == "pin");
  CHECK(reader.read("/bearings/big_end/axis").values == std::vector<double>{0, 0, 1});
}

TEST_CASE("HoleInTheTurningPin_FeedsTheFilmAndIsReported") {
  const TemporaryDirectory scratch;
  const std::string text = rig_with("    supply: {line: widest_gap, pressure: 1 bar}\n",
                                    "    supply: {line: widest_gap, pressure: 1 bar}\n"
                                    "    features:\n"
                                    "      bore: {shape: oval_hole, on: journal, around: 14 mm, along: 8 mm, pressure: "
                                    "{expression: '3 + sin(main.rotation)', unit: bar}}\n");
  const Summary summary = simulate(rig(text, {"duration=25 ms"}), {.results = scratch / "run.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  CHECK(summary.rejected_steps == 0);
  // Every step is solved to 1e-8 of its largest term.
  CHECK(summary.bearings[0].worst_mass_balance < 1e-6);
  CHECK(summary.worst_power_balance < 1e-6);
  const results::Reader reader(summary.results);
  const std::vector<double> hole = reader.read("/bearings/big_end/flow_feature_bore").values;
  CHECK(hole.size() == reader.rows());
  CHECK(*std::max_element(hole.begin(), hole.end()) > 1e-8);
}

TEST_CASE("PowerOfMotorAndLoad_GoesIntoFrictionOfTheSettledFilm") {
  // At rest but for the rotating pin: the film dissipates the energy that the drives put in. The dissipation integral
  // and the shear traction are different discrete sums; on this coarse grid they agree to a few per cent.
  const TemporaryDirectory scratch;
  const Summary summary = simulate(rig(kSmallRig, {"duration=80 ms"}), {.results = scratch / "run.h5"});
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(summary.results);
  const double in = last(reader, "/power/drives") + last(reader, "/power/loads");
  const double supply = 1e5 * last(reader, "/bearings/big_end/flow_supply");
  CHECK(in + supply == doctest::Approx(last(reader, "/power/film_friction")).epsilon(0.03));
}

TEST_CASE("SmallestStepReached_FailsWithReasonAndKeepsResults") {
  const TemporaryDirectory scratch;
  const model::Model model =
      rig(kSmallRig, {"simulation.tolerance=1e-30", "simulation.smallest_step=0.05 ms", "duration=1 ms"});
  const Summary summary = simulate(model, {.results = scratch / "run.h5"});
  CHECK(summary.status == Status::failed);
  CHECK(summary.message.find("no convergence with a step of") != std::string::npos);
  CHECK(summary.message.find("worst equation") != std::string::npos);
  CHECK(summary.message.find("too long for the motion") != std::string::npos);
  const results::Reader reader(summary.results);
  CHECK(reader.text_attribute("/", "status") == "failed");
  CHECK(reader.text_attribute("/", "message") == summary.message);
  CHECK(reader.rows() >= 1);
}

TEST_CASE("RunThatEndsAtAThinSmoothFilm_IsGivenAsperities") {
  const TemporaryDirectory scratch;
  const std::string pushed = rig_with("drives:\n", "drives:\n  press: {joint: guide, coordinate: x, speed: 0.2 m/s}\n");
  const Summary summary = simulate(rig(pushed), {.results = scratch / "run.h5"});
  CAPTURE(summary.message);
  CHECK(summary.status == Status::failed);
  CHECK(summary.message.find("bearing big_end") != std::string::npos);
  CHECK(summary.message.find("`asperities` let them touch") != std::string::npos);
  // Far from any contact they are no remedy.
  const Summary other = simulate(rig(kSmallRig, {"simulation.tolerance=1e-30", "simulation.smallest_step=0.05 ms"}),
                                 {.results = scratch / "other.h5"});
  CHECK(other.status == Status::failed);
  CHECK(other.message.find("asperities") == std::string::npos);
}

TEST_CASE("MassBalance_IsRecordedOfFilmsThatConserveOil") {
  const TemporaryDirectory scratch;
  for (const auto& [cavitation, is_recorded] :
       {std::pair{"mass_conserving", true}, std::pair{"guembel", true}, std::pair{"reynolds", false}}) {
    const std::string file = std::string(cavitation) + ".h5";
    CAPTURE(file);
    const auto overrides = {std::string("bearings.big_end.cavitation=") + cavitation, std::string("duration=0.5 ms")};
    REQUIRE(simulate(rig(kSmallRig, overrides), {.results = scratch / file}).status == Status::completed);
    CHECK(results::Reader(scratch / file).has("/bearings/big_end/mass_balance_error") == is_recorded);
  }
}

// A spatial crank with steps so long that the velocities of its closed loop leave every motion it has.
TEST_CASE("StepsTooLongForTheMotion_AreReported") {
  const TemporaryDirectory scratch;
  const std::string text = R"(hersey: 1
gravity: 0 0 -9.81 m/s^2
bodies:
  ground: {frames: {A: {origin: 0 100 120 mm}}}
  crank:
    mass: 0.12 kg
    centre_of_mass: 0 0 40 mm
    inertia: {xx: 1e-4 kg.m^2, yy: 1e-4 kg.m^2, zz: 1e-4 kg.m^2}
    frames: {B: {origin: 0 0 80 mm}}
  rod:
    mass: 0.5 kg
    centre_of_mass: -150 0 0 mm
    inertia: {xx: 4e-4 kg.m^2, yy: 4e-3 kg.m^2, zz: 4e-3 kg.m^2}
    frames: {B: {origin: -300 0 0 mm}}
  slider: {mass: 2 kg, inertia: {xx: 1e-4 kg.m^2, yy: 1e-4 kg.m^2, zz: 1e-4 kg.m^2}}
joints:
  A: {type: revolute, between: [ground.A, crank], axis: x, initial: {rotation: 0 deg, rotation_rate: 6 rad/s}}
  slide: {type: prismatic, between: [ground, slider], axis: x}
  C: {type: universal, between: [slider, rod], axis: z}
  B: {type: spherical, between: [crank.B, rod.B]}
simulation: {duration: 5 s, step: 5 ms, spectral_radius: 0.95}
)";
  const Summary summary = simulate(rig(text), {.results = scratch / "run.h5"});
  if (summary.status == Status::completed) return;
  CAPTURE(summary.message);
  CHECK(summary.message.find("steps of 0.005 s have led here") != std::string::npos);
  CHECK(summary.message.find("spectral_radius") != std::string::npos);
  const Summary damped = simulate(rig(text, {"simulation.spectral_radius=0.8"}), {.results = scratch / "damped.h5"});
  CHECK(damped.status == Status::completed);
}

TEST_CASE("HardStep_IsHalvedAndTheRunGoesOn") {
  // A quarter of a revolution in one step takes eight iterations and more: with seven it is halved until they suffice.
  const TemporaryDirectory scratch;
  const model::Model model =
      rig(rig_with("step: 2 deg", "step: 90 deg"), {"load=5000 N", "duration=10 ms", "simulation.max_iterations=7"});
  const Summary summary = simulate(model, {.results = scratch / "run.h5"});
  INFO(summary.message);
  CHECK(summary.status == Status::completed);
  CHECK(summary.rejected_steps > 0);
  CHECK(summary.work.newton_iterations.most <= 7);
  CHECK(summary.t_end == doctest::Approx(10e-3));
}

TEST_CASE("StopFlag_EndsAfterTheStep") {
  const TemporaryDirectory scratch;
  std::atomic<bool> stop{false};
  Options options{.results = scratch / "run.h5", .stop = &stop};
  int steps = 0;
  options.on_progress = [&](const Progress&) { stop = ++steps > 5; };
  const Summary summary = simulate(rig(), options);
  CHECK(summary.status == Status::stopped);
  CHECK(summary.steps == 5);
  CHECK(results::Reader(summary.results).text_attribute("/", "status") == "stopped");
}

TEST_CASE("SettledRun_EndsEarly") {
  const TemporaryDirectory scratch;
  const model::Model model =
      rig(rig_with("  spectral_radius: 0.6", "  spectral_radius: 0.6\n  settle: {tolerance: 1e-4, over: 180 deg}"),
          {"duration=1 s"});
  const Summary summary = simulate(model, {.results = scratch / "run.h5"});
  CHECK(summary.status == Status::completed);
  CHECK(summary.t_end < 0.5);
  CHECK(summary.message.find("settled") != std::string::npos);
  const results::Reader reader(summary.results);
  CHECK(last(reader, "/bearings/big_end/fields/time") == last(reader, "/time"));
}

TEST_CASE("ExistingResults_AreKept") {
  const TemporaryDirectory scratch;
  const Options options{.results = scratch / "run.h5"};
  const model::Model model = rig(kSmallRig, {"duration=0.3 ms"});
  CHECK(simulate(model, options).status == Status::completed);
  CHECK_THROWS_AS((void)simulate(model, options), results::FileExists);
}

TEST_CASE("OutputEvery_ThinsRowsNotExtremes") {
  const TemporaryDirectory scratch;
  const Summary all = simulate(rig(), {.results = scratch / "all.h5"});
  const Summary some = simulate(rig(kSmallRig + "output: {every: 7}\n"), {.results = scratch / "some.h5"});
  CHECK(some.bearings[0].moft == all.bearings[0].moft);
  CHECK(results::Reader(some.results).rows() <= results::Reader(all.results).rows() / 6);
}

// The fault of a model that reads well but cannot start.
Fault fault_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    check(rig(text, overrides));
  } catch (const InputError& error) {
    return error.faults().front();
  }
  FAIL("the model was accepted");
  return {};
}

int line_of(const std::string& text, const std::string& what) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(text.find(what)), '\n'));
}

TEST_CASE("ClosedGapAtTheStart_PointsAtTheBearing") {
  const std::string text = rig_with("x: 0 um", "x: 40 um");
  const Fault fault = fault_of(text);
  CHECK(fault.path == "bearings.big_end");
  CHECK(fault.position.line == line_of(text, "  big_end:"));
  CHECK(fault.found.find("the journal touches the shell") != std::string::npos);
}

TEST_CASE("RedundantConstraints_AreWarnedOf") {
  // A second revolute joint on the same axis repeats every constraint; only the rotation is free.
  const std::string text = rig_with("drives:", "  again: {type: revolute, between: [ground, pin]}\ndrives:");
  const std::vector<Fault> warnings = check(rig(text));
  REQUIRE(warnings.size() == 1);
  CHECK(
      warnings[0].found.starts_with("redundant: 5 of the constraints that close the loop of main and again follow "
                                    "from the others (3 on positions, 2 on orientations)"));
  CHECK(warnings[0].path == "joints.again");
  CHECK(warnings[0].position.line == line_of(text, "  again:"));
  CHECK(check(rig()).empty());
}

TEST_CASE("UndampedMultipliers_ArePointedAtBeforeTheRun") {
  const Fault fault = fault_of(kSmallRig, {"simulation.spectral_radius=1"});
  CHECK(fault.path == "simulation.spectral_radius");
  CHECK(fault.position.line > 0);
}

TEST_CASE("ContradictingDrives_AreNamed") {
  // Both joints rotate the same pin.
  std::string text = rig_with("drives:", "  again: {type: revolute, between: [ground, pin]}\ndrives:");
  text.replace(text.find("  hold:"), 0, "  second: {joint: again, coordinate: rotation, speed: 100 rpm}\n");
  std::string found;
  try {
    check(rig(text));
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) found += fault.text() + "\n";
  }
  CHECK(found.find("singular mechanism") != std::string::npos);
  CHECK(found.find("drive second") != std::string::npos);
  CHECK(found.find("rig.yaml:" + std::to_string(line_of(text, "  second:"))) != std::string::npos);
}

TEST_CASE("MasslessBody_IsNamed") {
  const Fault fault = fault_of(rig_with("bodies:", "bodies:\n  ghost: {mass: 0 kg}"));
  CHECK(fault.found.find("nothing determines the motion") != std::string::npos);
  CHECK(fault.found.find("ghost") != std::string::npos);
}

}  // namespace simulate_test
}  // namespace hersey::run
