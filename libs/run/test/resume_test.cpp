// Interrupted runs that go on, against runs that were never interrupted: the same numbers to the last bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <fstream>

#include "bouncing_ball.h"
#include "edited.h"
#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/results/checkpoint.h"
#include "hersey/results/reader.h"
#include "hersey/results/writer.h"
#include "hersey/run/simulate.h"
#include "small_bar.h"
#include "small_rig.h"
#include "temporary_directory.h"
#include "time_stepping/checkpoint.h"

namespace hersey::run {
namespace resume_test {

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), 8 * a.size()) == 0;
}

/// Runs until `steps` more steps have been taken, or to the end.
Summary run_for(const model::Model& model, const std::filesystem::path& results, int steps, bool resume) {
  std::atomic<bool> stop{false};
  Options options{.results = results, .resume = resume, .stop = &stop};
  int taken = resume ? 1 : 0;  // the start is reported too
  options.on_progress = [&](const Progress&) { stop = taken++ >= steps; };
  return simulate(model, options);
}

/// All datasets of both files agree in every bit.
void check_same(const std::filesystem::path& whole, const std::filesystem::path& parts) {
  const results::Reader a(whole), b(parts);
  REQUIRE(a.datasets() == b.datasets());
  CHECK(a.rows() == b.rows());
  for (const std::string& name : a.datasets()) {
    if (name == "/model" || name == "/assumptions") continue;
    CAPTURE(name);
    if (a.info(name).is_text) {
      CHECK(a.info(name).shape == b.info(name).shape);
      continue;
    }
    const results::Array x = a.read(name), y = b.read(name);
    CHECK(x.info.shape == y.info.shape);
    CHECK(same_bits(x.values, y.values));
  }
}

/// Interrupts the run twice; also checks that something was left to do each time.
void check_resumed(const model::Model& model, const std::filesystem::path& folder, int first, int second) {
  const std::filesystem::path whole = folder / "whole.h5", parts = folder / "parts.h5";
  const Summary straight = simulate(model, {.results = whole});
  INFO(straight.message);
  REQUIRE(straight.status == Status::completed);
  CHECK_FALSE(std::filesystem::exists(checkpoint_file(whole)));
  REQUIRE(run_for(model, parts, first, false).status == Status::stopped);
  CHECK(std::filesystem::exists(checkpoint_file(parts)));
  REQUIRE(run_for(model, parts, second, true).status == Status::stopped);
  const Summary summary = simulate(model, {.results = parts, .resume = true});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  CHECK(summary.steps == straight.steps);
  CHECK(summary.rejected_steps == straight.rejected_steps);
  CHECK(summary.newton_iterations == straight.newton_iterations);
  CHECK(summary.worst_power_balance == straight.worst_power_balance);
  for (std::size_t i = 0; i < summary.bearings.size(); ++i) {
    CHECK(summary.bearings[i].moft == straight.bearings[i].moft);
    CHECK(summary.bearings[i].mean_power == straight.bearings[i].mean_power);
  }
  CHECK_FALSE(std::filesystem::exists(checkpoint_file(parts)));
  check_same(whole, parts);
}

void check_resumed(const std::string& text, int first, int second) {
  const TemporaryDirectory scratch;
  check_resumed(model::read_text(text, (scratch / "model.yaml").string()), scratch.path(), first, second);
}

const std::string kMechanism = R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  crank: {mass: 2 kg, centre_of_mass: 10 0 0 mm, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 2e-3 kg.m^2}}
  rod: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 2e-3 kg.m^2}, frames: {end: {origin: 200 0 0 mm}}}
  arm: {mass: 1 kg, centre_of_mass: 50 0 0 mm, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 2e-3 kg.m^2}}
joints:
  main: {type: revolute, between: [ground, crank], initial: {rotation: 20 deg}}
  pin: {type: revolute, between: [crank, rod], initial: {rotation: 30 deg, rotation_rate: 3 rad/s}}
  shoulder: {type: revolute, between: [ground, arm]}
drives:
  motor: {joint: main, coordinate: rotation, speed: {expression: '20 + 5*sin(70*t)', unit: rad/s}}
forces:
  servo: {type: speed_control, joint: shoulder, coordinate: rotation, speed: 10 rad/s, proportional: 0.2 N.m.s/rad, integral: 4 N.m/rad, limit: 3 N.m}
simulation: {duration: 0.1 s, step: 0.5 ms}
)";

TEST_CASE("ResumedMechanism_IsTheSame") { check_resumed(kMechanism, 37, 81); }

TEST_CASE("ResumedRunOfControlledError_IsTheSame") {
  // Interrupted before and after the table's bend, where the method starts afresh.
  const std::string text = edited(edited(kMechanism, "{expression: '20 + 5*sin(70*t)', unit: rad/s}",
                                         "{table: {points: [[0, 5], [0.04, 20], [0.1, 8]], x_unit: s, y_unit: rad/s}}"),
                                  "step: 0.5 ms", "step: {tolerance: 1e-6}");
  check_resumed(text + "output: {interval: 3 ms}\n", 5, 40);
}

// There the method starts afresh, from accelerations that follow from the last step: its length and the oil it began
// with.
TEST_CASE("RunResumedAtAKinkOfADrive_StartsAfreshFromTheSameFilm") {
  for (const char* coupling : {"monolithic", "{scheme: partitioned, acceleration: quasi_newton}",
                               "{scheme: partitioned, acceleration: aitken}"}) {
    CAPTURE(coupling);
    std::string text = edited(rig_with("  crank: main\n", ""), "step: 2 deg", "step: {tolerance: 1e-4}");
    text = edited(text, "rotation, speed: 3000 rpm}",
                  "rotation, speed: {table: {points: [[0, 3000], [0.002, 3000], [0.004, 4500]], "
                  "x_unit: s, y_unit: rpm}}}");
    text = edited(text, "    lubricant: oil\n", std::string("    lubricant: oil\n    coupling: ") + coupling + "\n");
    const TemporaryDirectory scratch;
    REQUIRE(simulate(rig(text), {.results = scratch / "steps.h5"}).status == Status::completed);
    const std::vector<double> t = results::Reader(scratch / "steps.h5").read("/time").values;
    const auto kink = std::find(t.begin(), t.end(), 0.002);
    REQUIRE(kink != t.end());
    check_resumed(text, static_cast<int>(kink - t.begin()), 3);
  }
}

TEST_CASE("ResumedFilm_IsTheSame") {
  for (const char* coupling : {"monolithic", "{scheme: partitioned, acceleration: quasi_newton}",
                               "{scheme: partitioned, acceleration: aitken}"}) {
    CAPTURE(coupling);
    const std::string line = "    supply: {line: widest_gap, pressure: 1 bar}\n";
    check_resumed(rig_with(line, line + "    coupling: " + coupling + "\n"), 7, 12);
  }
}

TEST_CASE("ResumedFilmWithTemperature_IsTheSame") {
  // Oil of the second kind thins by the shear in its layers.
  for (const auto& [coupling, grade] :
       {std::pair{"monolithic", "grade: iso_vg_22"},
        std::pair{"{scheme: partitioned, acceleration: quasi_newton}", "grade: sae_5w20"}}) {
    const std::string oil = grade;  // clang 14 captures no structured binding
    CAPTURE(oil);
    const std::string line = "    supply: {line: widest_gap, pressure: 1 bar}\n";
    const std::string heat =
        "    thermal: {model: film, supply_temperature: 40 degC, layers: 3, shell: {wall: ring, outer_diameter: 60 mm, "
        "ambient: 30 degC}}\n";
    const std::string text =
        edited(rig_with(line, line + heat + "    coupling: " + coupling + "\n"), "viscosity: 15 mPa.s", grade);
    check_resumed(text, 7, 12);
    // Walls at the mean heat of cycles of eight steps: interrupted within the first and within the second.
    check_resumed(edited(text, "duration: \"${duration}\"", "cycle: {period: 16 deg, until_converged: 0, most: 4}"), 7,
                  12);
  }
}

TEST_CASE("ResumedFilmBetweenWarmBodies_IsTheSame") {
  const std::string line = "    supply: {line: widest_gap, pressure: 1 bar}\n";
  for (const char* step : {"2 deg", "{tolerance: 1e-4}"}) {
    CAPTURE(step);
    const std::string heat =
        "    thermal: {model: film, supply_temperature: 40 degC, layers: 3, shell: {wall: node, node: block}, journal: "
        "{wall: node, node: block}, expansion: {shell: 40e-6 1/K, journal: 12e-6 1/K}}\n";
    std::string text = edited(rig_with(line, line + heat), "viscosity: 15 mPa.s", "grade: iso_vg_22");
    text =
        edited(text, "simulation:\n",
               "thermal:\n  nodes:\n    block: {heat_capacity: 2 J/K}\n    room: {fixed: 20 degC}\n  paths:\n    out: "
               "{between: [block, room], conductance: 3 W/K}\nsimulation:\n");
    check_resumed(edited(text, "step: 2 deg", std::string("step: ") + step), 7, 12);
  }
}

// In steps, and over cycles of eight of them: interrupted within the first and within the second.
TEST_CASE("ResumedFilmWithItsSump_IsTheSame") {
  const std::string line = "    supply: {line: widest_gap, pressure: 1 bar}\n";
  const std::string heat =
      "    thermal: {model: film, supply_temperature: {node: sump}, drains_to: sump, layers: 3, shell: {wall: ring, "
      "outer_diameter: 60 mm, ambient: {node: block}}}\n";
  std::string text = edited(rig_with(line, line + heat), "viscosity: 15 mPa.s", "grade: iso_vg_22");
  text = edited(text, "simulation:\n",
                "thermal:\n  nodes:\n    sump: {heat_capacity: 5 J/K}\n    block: {heat_capacity: 2 J/K}\n    room: "
                "{fixed: 20 degC}\n  paths:\n    out: {between: [block, room], conductance: 3 W/K}\n    cooler: "
                "{between: [sump, room], conductance: 9 W/K}\nsimulation:\n");
  check_resumed(text, 7, 12);
  check_resumed(edited(text, "duration: \"${duration}\"", "cycle: {period: 16 deg, until_converged: 0, most: 4}"), 7,
                12);
}

TEST_CASE("ResumedFilmUnderErrorControl_IsTheSame") {
  check_resumed(rig_with("step: 2 deg", "step: {tolerance: 1e-5}\n  settle: {tolerance: 1e-9, over: 1 ms}"), 9, 30);
}

TEST_CASE("ResumedFlexibleBodies_AreTheSame") {
  for (const char* form : {"modal", "nodal", "nodal\n      strain: finite"}) {
    for (const char* step : {"step: 0.1 ms", "step: {tolerance: 1e-6}"}) {
      CAPTURE(form);
      CAPTURE(step);
      const TemporaryDirectory scratch;
      write_bar(scratch / "bar.inp", 4);
      std::string text = edited(kPendulum, "modes: 4", std::string("modes: 4\n      form: ") + form);
      if (std::string(form) == "nodal") text = edited(text, "      tip: {nodes: right}\n", "");
      text = edited(edited(text, "duration: 50 ms", "duration: 8 ms"), "step: 0.1 ms", step);
      text = edited(text, "vtu_every: 10 ms", "vtu_every: 2 ms");
      const model::Model model = model::read_text(text, (scratch / "model.yaml").string());
      check_resumed(model, scratch.path(), 11, 13);
      std::ifstream whole(scratch / "whole_bar.pvd"), parts(scratch / "parts_bar.pvd");
      std::string a{std::istreambuf_iterator<char>(whole), {}}, b{std::istreambuf_iterator<char>(parts), {}};
      for (std::size_t at = 0; (at = b.find("parts_bar", at)) != std::string::npos;) b.replace(at, 9, "whole_bar");
      CHECK(a == b);
      CHECK(a.find("00004.vtu") != std::string::npos);
    }
  }
}

TEST_CASE("ResumedContact_IsTheSame") { check_resumed(kBall, 60, 100); }

TEST_CASE("ResumedKinematics_AreTheSame") {
  std::string text = edited(kMechanism, "simulation: {", "simulation: {analysis: kinematics, ");
  text = edited(text, "  servo:", "  none:");
  text.erase(text.find("forces:"), text.find("simulation:") - text.find("forces:"));
  text = edited(text, "drives:\n",
                "drives:\n  turn: {joint: pin, coordinate: rotation, speed: 4 rad/s}\n"
                "  lift: {joint: shoulder, coordinate: rotation, speed: 1 rad/s}\n");
  check_resumed(edited(text, ", rotation_rate: 3 rad/s", ""), 20, 90);
}

TEST_CASE("ResumedCycles_AreTheSame") {
  check_resumed(rig_with("  duration: \"${duration}\"\n", "  cycle: {period: 36 deg, until_converged: 0.02}\n"), 25,
                31);
}

TEST_CASE("CheckpointsOnTheWay_ChangeNothing") {
  const TemporaryDirectory scratch;
  REQUIRE(simulate(rig(), {.results = scratch / "plain.h5"}).status == Status::completed);
  const model::Model often = rig(rig_with("step: 2 deg", "step: 2 deg\n  checkpoint: {every: 0.3 ms}"));
  Options options{.results = scratch / "often.h5"};
  int written = 0;
  std::filesystem::file_time_type last;
  options.on_progress = [&](const Progress&) {
    std::error_code missing;
    const auto now = std::filesystem::last_write_time(checkpoint_file(options.results), missing);
    if (!missing && now != last) ++written, last = now;
  };
  REQUIRE(simulate(often, options).status == Status::completed);
  CHECK(written >= 12);
  check_same(scratch / "plain.h5", scratch / "often.h5");
}

TEST_CASE("CheckpointSchedule_CountsBothTimes") {
  model::Simulation plan;
  plan.start = 1;
  plan.step = 0.01;
  plan.checkpoint = {.every = 0.1, .wall_time = 1e9};
  CheckpointSchedule schedule(plan);
  CHECK_FALSE(schedule.is_due(1.09));
  CHECK(schedule.is_due(1.1));
  schedule.written(1.25, 0.0);
  CHECK_FALSE(schedule.is_due(1.29));
  CHECK(schedule.is_due(1.3 - 1e-12));
  plan.checkpoint = {.every = 0, .wall_time = 1e-9};
  CHECK(CheckpointSchedule(plan).is_due(1));
}

/// The fault of resuming with another model.
std::string refusal(const model::Model& model, const std::filesystem::path& results) {
  try {
    (void)simulate(model, {.results = results, .resume = true});
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

TEST_CASE("ChangedModel_IsRefused") {
  const TemporaryDirectory scratch;
  const std::filesystem::path results = scratch / "run.h5";
  REQUIRE(run_for(rig(), results, 5, false).status == Status::stopped);
  CHECK(refusal(rig(rig_with("load: 500 N", "load: 600 N")), results)
            .find("line 4 was '  load: 500 N' and is '  load: 600 N'") != std::string::npos);
  CHECK(refusal(rig(kSmallRig, {"load=600 N"}), results).find("# --set load=600 N") != std::string::npos);
  CHECK(refusal(rig(kSmallRig + "# more\n"), results).find(", '# more', is new") != std::string::npos);
  CHECK(refusal(rig(), results) == "taken");
  CHECK(refusal(rig(rig_with("load: 500 N", "load: 600 N")), results) != "taken");  // nor when it is complete
}

TEST_CASE("ChangedMesh_IsRefused") {
  const TemporaryDirectory scratch;
  const std::filesystem::path results = scratch / "run.h5";
  const auto model = [&] { return model::read_text(kPendulum, (scratch / "model.yaml").string()); };
  write_bar(scratch / "bar.inp", 3);
  REQUIRE(run_for(model(), results, 5, false).status == Status::stopped);
  write_bar(scratch / "bar.inp", 4);
  CHECK(refusal(model(), results).find("the content of bar.inp") != std::string::npos);
}

TEST_CASE("DamagedFiles_AreReported") {
  const TemporaryDirectory scratch;
  const std::filesystem::path results = scratch / "run.h5", checkpoint = checkpoint_file(results);
  REQUIRE(run_for(rig(), results, 5, false).status == Status::stopped);
  const Archive::Content good = results::read_checkpoint(checkpoint);
  const auto resume = [&] { (void)simulate(rig(), {.results = results, .resume = true}); };

  Archive::Content bad = good;
  bad.numbers.erase("state/q");
  results::write_checkpoint(checkpoint, bad);
  CHECK_THROWS_WITH_AS(resume(), doctest::Contains("there is no 'state/q'"), results::ReadError);
  bad = good;
  bad.numbers["state/more"] = {{}, {1}};
  results::write_checkpoint(checkpoint, bad);
  CHECK_THROWS_WITH_AS(resume(), doctest::Contains("it holds 'state/more'"), results::ReadError);
  bad = good;
  bad.numbers["state/v"].values[0] = std::nan("");
  results::write_checkpoint(checkpoint, bad);
  CHECK_THROWS_WITH_AS(resume(), doctest::Contains("a number that is not finite"), results::ReadError);
  bad = good;
  bad.numbers["record/rows"].values[0] += 1;
  results::write_checkpoint(checkpoint, bad);
  CHECK_THROWS_WITH_AS(resume(), doctest::Contains("it lacks rows of "), results::ReadError);
  std::ofstream(checkpoint) << "nonsense";
  CHECK_THROWS_WITH_AS(resume(), doctest::Contains("not a checkpoint"), results::ReadError);
  CHECK_FALSE(std::filesystem::exists(results.string() + ".unfinished"));

  // The earlier checkpoint is still good.
  results::write_checkpoint(checkpoint, good);
  resume();
  CHECK(results::Reader(results).text_attribute("/", "status") == "completed");
}

TEST_CASE("OtherProgramVersion_IsAWarning") {
  const TemporaryDirectory scratch;
  const std::filesystem::path results = scratch / "run.h5", checkpoint = checkpoint_file(results);
  REQUIRE(run_for(rig(), results, 5, false).status == Status::stopped);
  Archive::Content content = results::read_checkpoint(checkpoint);
  content.texts["identity/version"] = "0.0.1";
  results::write_checkpoint(checkpoint, content);
  const Summary summary = simulate(rig(), {.results = results, .resume = true});
  CHECK(summary.status == Status::completed);
  CHECK(summary.warning.find("was written by hersey 0.0.1") != std::string::npos);
}

TEST_CASE("KilledBeforeItsModelWasWritten_BeginsAnew") {
  const TemporaryDirectory scratch;
  const std::filesystem::path results = scratch / "run.h5";
  results::Writer(results, {}).finish(results::Status::running);  // the state of a program that was killed at that time
  const Summary summary = simulate(rig(), {.results = results, .resume = true});
  CHECK(summary.status == Status::completed);
  CHECK(summary.warning.find("began anew") != std::string::npos);
  CHECK(results::Reader(results).text("/model") == kSmallRig);
}

TEST_CASE("CompleteRun_LeavesNoPieceOfACheckpoint") {
  const TemporaryDirectory scratch;
  const std::filesystem::path results = scratch / "run.h5";
  REQUIRE(run_for(rig(), results, 5, false).status == Status::stopped);
  std::ofstream(checkpoint_file(results).string() + ".new") << "as far as it came";  // killed while it wrote another
  REQUIRE(simulate(rig(), {.results = results, .resume = true}).status == Status::completed);
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(results.parent_path()))
    left.push_back(entry.path().filename().string());
  CHECK(left == std::vector<std::string>{"run.h5"});
}

TEST_CASE("ResultsAppear_WithTheirModel") {
  const TemporaryDirectory scratch;
  const std::filesystem::path results = scratch / "run.h5";
  std::ofstream(results) << "those of before";
  CHECK_THROWS_AS((void)simulate(rig(), {.results = results}), results::FileExists);
  CHECK_FALSE(std::filesystem::exists(results.string() + ".unfinished"));
  CHECK(std::filesystem::file_size(results) == 15);
  Options options{.results = results, .overwrite = true};
  bool is_there = false;
  options.on_progress = [&](const Progress&) {
    is_there = is_there || results::Reader(results).has("/model");
    CHECK_FALSE(std::filesystem::exists(results.string() + ".unfinished"));
  };
  REQUIRE(simulate(rig(), options).status == Status::completed);
  CHECK(is_there);
}

TEST_CASE("NothingToGoOnFrom_BeginsAnewOrIsDone") {
  const TemporaryDirectory scratch;
  const std::filesystem::path results = scratch / "run.h5";
  const Summary first = simulate(rig(), {.results = results, .resume = true});
  CHECK(first.status == Status::completed);
  CHECK(first.warning.find("began anew") != std::string::npos);
  const auto written = std::filesystem::last_write_time(results);
  const Summary again = simulate(rig(), {.results = results, .resume = true});
  CHECK(again.status == Status::completed);
  CHECK(again.message == "it was complete already");
  CHECK(again.t_results == first.t_end);
  CHECK(std::filesystem::last_write_time(results) == written);
}

TEST_CASE("CheckpointBesideResultsThatSayToBeComplete_IsGoneOnFrom") {
  const TemporaryDirectory scratch;
  const std::filesystem::path whole = scratch / "whole.h5", parts = scratch / "parts.h5", kept = scratch / "kept";
  REQUIRE(simulate(rig(), {.results = whole}).status == Status::completed);
  REQUIRE(run_for(rig(), parts, 5, false).status == Status::stopped);
  std::filesystem::copy_file(checkpoint_file(parts), kept);
  REQUIRE(simulate(rig(), {.results = parts, .resume = true}).status == Status::completed);
  // The files of a program that is killed between the end of its results and the removal of its checkpoint.
  std::filesystem::copy_file(kept, checkpoint_file(parts));
  const Summary again = simulate(rig(), {.results = parts, .resume = true});
  CHECK(again.status == Status::completed);
  CHECK(again.message != "it was complete already");
  CHECK_FALSE(std::filesystem::exists(checkpoint_file(parts)));
  check_same(whole, parts);
}

TEST_CASE("FileOfNothingButReservedSpace_IsNoHindrance") {
  const TemporaryDirectory scratch;
  const std::filesystem::path results = scratch / "run.h5";
  std::ofstream(results, std::ios::binary) << std::string(1 << 20, '\0');
  CHECK(simulate(rig(), {.results = results, .resume = true}).status == Status::completed);
  std::ofstream(results, std::ios::binary) << "somebody's text";
  CHECK_THROWS_AS((void)simulate(rig(), {.results = results, .resume = true}), results::ReadError);
}

TEST_CASE("ReplacedResults_LoseTheirCheckpoint") {
  const TemporaryDirectory scratch;
  const std::filesystem::path results = scratch / "run.h5";
  REQUIRE(run_for(rig(), results, 5, false).status == Status::stopped);
  REQUIRE(std::filesystem::exists(checkpoint_file(results)));
  const model::Model other = rig(kSmallRig, {"simulation.tolerance=1e-30", "simulation.smallest_step=0.05 ms"});
  CHECK(simulate(other, {.results = results, .overwrite = true}).status == Status::failed);
  CHECK_FALSE(std::filesystem::exists(checkpoint_file(results)));
}

}  // namespace resume_test
}  // namespace hersey::run
