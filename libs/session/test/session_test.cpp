#include "hersey/session/session.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <fstream>

#include "hersey/results/error.h"
#include "hersey/results/reader.h"
#include "hersey/run/checkpoint.h"
#include "temporary_directory.h"

namespace hersey::session {
namespace session_test {

// A journal that rotates in a floating bush under a load: forty steps.
const std::string kRig = R"(hersey: 1
parameters: {load: 500 N}
bodies:
  pin: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
  rod: {mass: 0.5 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  main: {type: revolute, between: [ground, pin], initial: {rotation_rate: 3000 rpm}}
  guide: {type: planar, between: [ground, rod], initial: {x: 0 um}}
drives:
  motor: {joint: main, coordinate: rotation, speed: 3000 rpm}
  hold: {joint: guide, coordinate: rotation, position: 0 deg}
forces:
  push: {type: force, body: rod, components: [0 N, "-${load}", 0 N]}
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  big_end:
    shell: rod
    journal: pin
    diameter: 45 mm
    width: 15.6 mm
    radial_clearance: 34 um
    lubricant: oil
    grid: {circumferential: 24, axial: 5}
    supply: {line: widest_gap, pressure: 1 bar}
simulation: {duration: 4 ms, step: 0.1 ms, spectral_radius: 0.6}
)";
const std::string kStudy = kRig + "study: {parameters: {load: [300 N, 500 N]}}\n";

std::string replaced(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), replacement);
}

int line_of(const std::string& text, const std::string& what) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(text.find(what)), '\n'));
}

std::vector<Fault> faults_of(const std::string& text) {
  try {
    (void)Session(text, "rig.yaml", {}).check();
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

/// Writes down the events, and asks for a stop once `stop_after` steps of a run are known.
class Notes : public Listener {
 public:
  explicit Notes(int stop_after = -1) : stop_after_(stop_after) {}
  void warned(std::size_t run, const std::vector<Fault>& warnings) override {
    note(run, "warned");
    warnings_.insert(warnings_.end(), warnings.begin(), warnings.end());
  }
  void stepped(std::size_t run, const run::Progress& progress) override {
    CHECK(progress.t >= t_);
    t_ = progress.t;
    ++steps_;
    if (events(run).empty() || events(run).back() != "stepped") note(run, "stepped");
    if (stop_after_ >= 0 && steps_ > stop_after_) stop_ = true;
  }
  void stopping() override { note(0, "stopping"); }
  void finished(std::size_t run, const study::RunResult& result) override {
    CHECK(result.solved());
    // Closed: it can be read, and says how the run ended.
    const results::Reader reader(result.summary.results);
    note(run, "finished as " + reader.text_attribute("/", "status").value_or("nothing"));
    t_ = 0;
  }

  [[nodiscard]] std::vector<std::string>& events(std::size_t run) {
    if (events_.size() <= run) events_.resize(run + 1);
    return events_[run];
  }
  [[nodiscard]] const std::vector<Fault>& warnings() const { return warnings_; }
  [[nodiscard]] const std::atomic<bool>* stop() const { return &stop_; }

 private:
  void note(std::size_t run, std::string event) { events(run).push_back(std::move(event)); }

  int stop_after_, steps_ = 0;
  double t_ = 0;
  std::atomic<bool> stop_{false};
  std::vector<std::vector<std::string>> events_;
  std::vector<Fault> warnings_;
};

using Events = std::vector<std::string>;

TEST_CASE("FaultyText_GivesAllFaultsWithTheirLines") {
  std::string text = replaced(kRig, "diameter: 45 mm", "diameter: 45 kg");
  text = replaced(text, "width: 15.6 mm", "breadth: 15.6 mm");
  text = replaced(text, "body: rod", "body: bar");
  std::vector<int> lines;
  for (const Fault& fault : faults_of(text)) {
    CHECK(fault.position.file == "rig.yaml");
    lines.push_back(fault.position.line);
  }
  for (const char* what : {"body: bar", "diameter: 45 kg", "breadth"})
    CHECK(std::count(lines.begin(), lines.end(), line_of(text, what)) == 1);
  CHECK(std::is_sorted(lines.begin(), lines.end()));
}

TEST_CASE("FaultOfTheStart_IsFoundByCheckAndNotByTheText") {
  const std::string text = replaced(kRig, "{x: 0 um}", "{x: 40 um}");  // beyond the clearance of 34 um
  const Session session(text, "rig.yaml", {});
  CHECK_THROWS_AS((void)session.check(), InputError);
  REQUIRE(faults_of(text).size() == 1);
  CHECK(faults_of(text).front().position.line == line_of(text, "  big_end:"));
}

TEST_CASE("FaultOfOneRunOfAStudy_IsFoundByCheck") {
  const std::string text = kRig + "study: {parameters: {load: [300 N, 500 kg]}}\n";
  REQUIRE(faults_of(text).size() == 1);
  CHECK(faults_of(text).front().position.line == line_of(text, "  push:"));  // where the value is put in
  CHECK(Session(kStudy, "rig.yaml", {}).check().runs == 2);
  CHECK(Session(kRig, "rig.yaml", {}).check().runs == 1);
}

TEST_CASE("WarningsOfAllRuns_AreReportedOnce") {
  CHECK(Session(kRig, "rig.yaml", {}).check().warnings.empty());
  // The second clearance is far from what is usual, with either load.
  const std::string key = "bearings.big_end.radial_clearance";
  const Session session(kRig + "study: {parameters: {" + key + ": [34 um, 300 um], load: [300 N, 500 N]}}\n",
                        "rig.yaml", {});
  const Check found = session.check();
  CHECK(found.runs == 4);
  REQUIRE(found.warnings.size() == 1);
  CHECK(found.warnings.front().path == key);
}

TEST_CASE("OtherOverrides_AreOfTheSameText") {
  const Session session(kRig, "rig.yaml", {"load=300 N"});
  const Session other = session.with({"load=400 N"});
  CHECK(other.text() == session.text());
  CHECK(session.model().forces.size() == other.model().forces.size());
  CHECK(other.overrides() == std::vector<std::string>{"load=400 N"});
  CHECK(session.model().resolved_text != other.model().resolved_text);
  CHECK_THROWS_AS((void)session.with({"load=400 kg"}), InputError);
}

TEST_CASE("EventsOfARun_ComeInOrder") {
  const TemporaryDirectory scratch;
  const Session session(replaced(kRig, "drives:", "  again: {type: revolute, between: [ground, pin]}\ndrives:"),
                        "rig.yaml", {});
  Notes notes;
  const run::Summary summary = session.run(scratch / "a" / "run.h5", {.check_start = true}, notes);
  CHECK(summary.status == run::Status::completed);
  CHECK(notes.events(0) == Events{"warned", "stepped", "finished as completed"});
  REQUIRE(notes.warnings().size() == 1);  // a second joint on the same axis
  CHECK(notes.warnings().front().path == "joints.again");
}

TEST_CASE("EventsOfEveryRunOfAStudy_ComeInOrder") {
  const TemporaryDirectory scratch;
  const Session session(kStudy, "rig.yaml", {});
  const std::vector<model::StudyRun> runs = session.runs();
  REQUIRE(runs.size() == 2);
  Notes notes;
  const auto results = session.run_all(runs, scratch.path(), {.check_start = true, .threads = 1}, notes);
  for (std::size_t i : {0, 1}) {
    CHECK(results[i].summary.status == run::Status::completed);
    CHECK(notes.events(i) == Events{"warned", "stepped", "finished as completed"});
    CHECK(results[i].summary.results == scratch / (runs[i].slug + ".h5"));
  }
}

TEST_CASE("InterruptedRun_LeavesReadableResults_AndGoesOn") {
  const TemporaryDirectory scratch;
  const Session session(kRig, "rig.yaml", {});
  const std::filesystem::path whole = scratch / "whole.h5", parts = scratch / "parts.h5";
  Listener nobody;
  const run::Summary straight = session.run(whole, {}, nobody);
  REQUIRE(straight.status == run::Status::completed);

  Notes first(10), second;
  const run::Summary stopped = session.run(parts, {.stop = first.stop()}, first);
  CHECK(stopped.status == run::Status::stopped);
  CHECK(first.events(0) == Events{"stepped", "stopping", "finished as stopped"});
  {
    const results::Reader reader(parts), complete(whole);
    const std::vector<double> so_far = reader.read("/bearings/big_end/h_min").values,
                              all = complete.read("/bearings/big_end/h_min").values;
    REQUIRE(so_far.size() == 11);  // the start and ten steps
    CHECK(std::equal(so_far.begin(), so_far.end(), all.begin()));
  }
  CHECK_THROWS_AS((void)session.run(parts, {}, nobody), results::FileExists);
  const run::Summary resumed = session.run(parts, {.existing = Existing::resume}, second);
  CHECK(resumed.status == run::Status::completed);
  CHECK(second.events(0) == Events{"stepped", "finished as completed"});
  CHECK(resumed.steps == straight.steps);
  // No operation differs.
  for (const char* name : {"/time", "/bearings/big_end/h_min", "/bodies/rod/position"})
    CHECK(results::Reader(parts).read(name).values == results::Reader(whole).read(name).values);
}

TEST_CASE("ExistingResults_AreRefusedBeforeAnythingIsDone") {
  const TemporaryDirectory scratch;
  const Session session(kStudy, "rig.yaml", {});
  const std::vector<model::StudyRun> runs = session.runs();
  const std::filesystem::path existing = scratch / (runs[1].slug + ".h5");
  std::ofstream(existing) << "not mine";
  Notes notes;
  CHECK_THROWS_AS((void)session.run(existing, {.check_start = true}, notes), results::FileExists);
  CHECK_THROWS_AS((void)session.run_all(runs, scratch.path(), {.check_start = true}, notes), results::FileExists);
  CHECK_THROWS_AS((void)session.simulation(existing), results::FileExists);
  CHECK(notes.events(0).empty());
  CHECK(!std::filesystem::exists(scratch / (runs[0].slug + ".h5")));
}

TEST_CASE("ResultsOfAnInterruptedRun_AreResumedOrReplaced") {
  const TemporaryDirectory scratch;
  const Session session(kRig, "rig.yaml", {});
  const RunOptions again{.existing = Existing::resume_or_replace};
  Listener nobody;
  Notes notes(10), rest, anew;
  REQUIRE(session.run(scratch / "run.h5", {.stop = notes.stop()}, notes).status == run::Status::stopped);
  const run::Summary resumed = session.run(scratch / "run.h5", again, nobody);
  CHECK(resumed.status == run::Status::completed);
  CHECK(resumed.warning.empty());
  // Complete, so without a checkpoint: it is computed once more, where `resume` would leave it.
  CHECK(session.run(scratch / "run.h5", again, nobody).message != "it was complete already");
  CHECK(session.run(scratch / "run.h5", {.existing = Existing::resume}, nobody).message == "it was complete already");
}

TEST_CASE("InputsOfTheModel_AreNotOverwritten") {
  const TemporaryDirectory scratch;
  const std::filesystem::path file = scratch / "model.yaml";
  std::ofstream(file) << kRig;
  const Session session(file.string());
  Listener nobody;
  const RunOptions replace{.existing = Existing::replace};
  CHECK_THROWS_AS((void)session.run(file, replace, nobody), InputError);
  CHECK_THROWS_AS((void)session.run_all({{{}, "", "model", {}}}, scratch / "runs" / "..",
                                        {.existing = Existing::replace, .pages = {file}}, nobody),
                  InputError);
  CHECK_THROWS_AS((void)session.simulation(file, true), InputError);
  std::ifstream kept(file);
  CHECK(std::string(std::istreambuf_iterator<char>(kept), {}) == kRig);
}

TEST_CASE("RunThatCannotStart_LeavesNothing") {
  const TemporaryDirectory scratch;
  const Session session(replaced(kRig, "{x: 0 um}", "{x: 40 um}"), "rig.yaml", {});
  Notes notes;
  CHECK_THROWS_AS((void)session.run(scratch / "run.h5", {}, notes), InputError);
  CHECK(notes.events(0).empty());
  CHECK(!std::filesystem::exists(scratch / "run.h5"));
}

TEST_CASE("SteppedMachine_HasTheNumbersOfTheRun") {
  const TemporaryDirectory scratch;
  const Session session(kRig, "rig.yaml", {});
  Listener nobody;
  const run::Summary whole = session.run(scratch / "run.h5", {}, nobody);
  run::Simulation simulation = session.simulation(scratch / "stepped" / "run.h5");
  while (simulation.step().status == run::AdvanceStatus::advanced) {
  }
  CHECK(simulation.finish().bearings[0].moft == whole.bearings[0].moft);  // the same operations
}

TEST_CASE("FileIsOpenedOnce") {
  const TemporaryDirectory scratch;
  const std::filesystem::path file = scratch / "small" / "model.yaml";
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << kStudy;
  const Session session(file.string());
  CHECK(session.results_folder() == std::filesystem::path("results") / "small");
  CHECK(model_name((scratch / "rotor.yaml").string()) == "rotor");
  for (const char* same : {"model.yaml", ".//model.yaml", "../small/model.yaml"})
    CHECK(model_name((file.parent_path() / same).string()) == "small");
  std::ofstream(file) << "hersey: 2\n";
  CHECK(session.runs().size() == 2);
  CHECK(session.with({"load=1 N"}).runs().empty());  // the override fixes what the study varies
}

const std::string kBearing = R"(hersey: 1
lubricants: {oil: {viscosity: 15 mPa.s}}
bearings:
  main: {diameter: 45 mm, width: 15.6 mm, radial_clearance: 34 um, lubricant: oil, grid: {circumferential: 24, axial: 5},
         supply: {line: widest_gap, pressure: 1 bar},
         operating_point: {journal_speed: 3000 rpm, load: 500 N}}
)";

TEST_CASE("Bearing_IsSolvedByItself") {
  const Session session(kBearing, "main.yaml", {});
  const study::BearingStudyOptions options{.bearing = "main", .grid_error = false};
  const study::BearingSolution alone = session.solve_bearing(study::BearingSolver(), options);
  INFO(alone.message);
  REQUIRE(alone.solved());
  const std::string load = "bearings.main.operating_point.load";
  const auto swept = session.solve_bearings({{{}, "", "", {}}, {{load + "=800 N"}, "", "", {}}}, options);
  REQUIRE(swept.size() == 2);
  CHECK(swept[0].state.film.h_min == alone.state.film.h_min);  // the same operations
  CHECK(swept[1].state.film.h_min < alone.state.film.h_min);
  const auto found = session.sensitivities(alone, options, {load}, true);
  REQUIRE(found.size() > 1);
  CHECK(found.front().parameter == load);
  CHECK(std::count_if(found.begin(), found.end(), [&](const auto& one) { return one.parameter == load; }) == 1);
  Listener nobody;
  CHECK_THROWS_AS((void)session.run("none/main.h5", {}, nobody), InputError);  // there is nothing to simulate
  CHECK(!std::filesystem::exists("none"));
}

}  // namespace session_test
}  // namespace hersey::session
