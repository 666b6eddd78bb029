#include "hersey/study/study.h"

#include <doctest/doctest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "source_dir.h"
#include "temporary_directory.h"

namespace hersey::study {
namespace study_test {

// The command line tests' model with a study of two loads and two clearances, in a folder of its own.
class StudyFolder {
 public:
  StudyFolder() {
    std::ifstream source(std::string(hersey::source_dir()) + "/tests/cli/bearing.yaml");
    std::stringstream text;
    text << source.rdbuf();
    REQUIRE(!text.str().empty());
    std::ofstream(model()) << text.str()
                           << "\nstudy:\n  parameters:\n    load: [100 N, 300 N]\n"
                              "    bearings.main.radial_clearance: [40 um, 50 um]\n";
  }
  [[nodiscard]] std::string model() const { return (directory_ / "model.yaml").string(); }
  [[nodiscard]] std::filesystem::path path() const { return directory_.path(); }

 private:
  TemporaryDirectory directory_;
};

TEST_CASE("RunsAtTheSameTime_GiveTheNumbersOfRunsAlone") {
  const StudyFolder folder;
  const std::vector<model::StudyRun> runs = model::expand_study(folder.model());
  REQUIRE(runs.size() == 4);
  const auto together = simulate_all(folder.model(), runs, {.directory = folder.path(), .threads = 4});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    CAPTURE(runs[i].label);
    REQUIRE(together[i].solved());
    const run::Summary alone = run::simulate(model::read(folder.model(), runs[i].overrides),
                                             {.results = folder.path() / ("alone" + std::to_string(i) + ".h5")});
    // No state is shared between runs: the same operations in the same order.
    CHECK(together[i].summary.bearings[0].moft == alone.bearings[0].moft);
    CHECK(together[i].summary.bearings[0].eccentricity_ratio == alone.bearings[0].eccentricity_ratio);
    const results::Reader reader(together[i].summary.results);
    CHECK(reader.list_attribute("/", "study_parameters").size() == 2);
  }
}

TEST_CASE("RunsAtTheSameTime_WriteTheirCheckpoints") {
  const StudyFolder folder;
  std::vector<model::StudyRun> runs = model::expand_study(folder.model(), {"simulation.checkpoint={every: 0.1 ms}"});
  REQUIRE(runs.size() == 4);
  // Interrupted together in the middle: each leaves a checkpoint, from which it goes on.
  std::atomic<bool> stop = false;
  Options options{.directory = folder.path(), .threads = 4, .stop = &stop};
  std::set<std::size_t> begun;
  options.on_progress = [&](std::size_t run, const run::Progress& progress) {
    begun.insert(run);
    stop = stop || (progress.t > 1e-3 && begun.size() == runs.size());
  };
  for (const RunResult& result : simulate_all(folder.model(), runs, options)) {
    CAPTURE(result.message + result.summary.message);
    CHECK(result.solved());
    CHECK(result.summary.status == run::Status::stopped);
    CHECK(std::filesystem::exists(run::checkpoint_file(result.summary.results)));
  }
  options.resume = true;
  options.stop = nullptr;
  const auto resumed = simulate_all(folder.model(), runs, options);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    CAPTURE(runs[i].label);
    REQUIRE(resumed[i].solved());
    const std::filesystem::path alone = folder.path() / ("alone" + std::to_string(i) + ".h5");
    REQUIRE(run::simulate(model::read(folder.model(), runs[i].overrides), {.results = alone}).status ==
            run::Status::completed);
    const results::Reader one(alone), other(resumed[i].summary.results);
    for (const char* name : {"/time", "/bearings/main/h_min", "/bearings/main/p_max", "/bodies/shaft/position"})
      CHECK(one.read(name).values == other.read(name).values);
  }
}

TEST_CASE("RunsAskedToStopBeforeTheyBegin_DidNotFail") {
  const StudyFolder folder;
  const std::vector<model::StudyRun> runs = model::expand_study(folder.model());
  const std::atomic<bool> stop = true;
  for (const RunResult& result : simulate_all(folder.model(), runs, {.directory = folder.path(), .stop = &stop})) {
    CHECK(result.status == RunEnding::not_begun);
    CHECK(!std::filesystem::exists(results_file({.directory = folder.path()}, result.run)));
  }
}

TEST_CASE("FailedRun_LeavesTheOthersAlone") {
  const StudyFolder folder;
  const std::vector<model::StudyRun> runs = model::expand_study(folder.model());
  // The second run's results exist already and may not be replaced.
  std::ofstream(results_file({.directory = folder.path()}, runs[1])) << "not mine";
  std::size_t finished = 0;
  Options options{.directory = folder.path(), .threads = 2};
  options.on_finished = [&](std::size_t, const RunResult&) { ++finished; };
  const auto results = simulate_all(folder.model(), runs, options);
  CHECK(finished == 4);
  CHECK(!results[1].solved());
  for (std::size_t i : {0, 2, 3}) CHECK(results[i].summary.status == run::Status::completed);
}

}  // namespace study_test
}  // namespace hersey::study
