// Films inside moving machines: wall time of the examples, per step and per Newton iteration.
//
//   coupled_bench [EXAMPLES_DIR]
//
// The paper's seven loads run as `hersey run` does, one run per core; the slider-crank is a single run.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>

#include "hersey/model/read.h"
#include "hersey/run/simulate.h"
#include "hersey/study/study.h"

namespace {

using namespace hersey;
using Clock = std::chrono::steady_clock;

struct Cost {
  int runs = 0, steps = 0, iterations = 0;
  double wall = 0;
  bool completed = true;
};

void print(const char* name, const Cost& cost, double target) {
  fmt::print("{:34} {:4} {:7} {:10.2f} {:10.3f} {:9.2f} {:8.0f}   {}\n", name, cost.runs, cost.steps,
             static_cast<double>(cost.iterations) / cost.steps, 1e3 * cost.wall / cost.steps, cost.wall, target,
             cost.completed && cost.wall <= target ? "met" : "MISSED");
}

Cost slider_crank(const std::filesystem::path& examples, const std::filesystem::path& scratch,
                  const std::vector<std::string>& overrides) {
  const model::Model model = model::read((examples / "slider_crank/model.yaml").string(), overrides);
  run::Options options;
  options.results = scratch / "slider_crank.h5";
  options.overwrite = true;
  const run::Summary summary = run::simulate(model, options);
  return {1, summary.steps, summary.newton_iterations, summary.wall_time, summary.status == run::Status::completed};
}

Cost paper_loads(const std::filesystem::path& examples, const std::filesystem::path& scratch) {
  const std::string path = (examples / "paper_big_end/model.yaml").string();
  const std::vector<model::StudyRun> runs = model::expand_study(path, {"clearance=0.034 mm"});
  study::Options options;
  options.directory = scratch;
  options.overwrite = true;
  const Clock::time_point began = Clock::now();
  Cost cost;
  for (const study::RunResult& result : study::simulate_all(path, runs, options)) {
    ++cost.runs;
    cost.steps += result.summary.steps;
    cost.iterations += result.summary.newton_iterations;
    cost.completed = cost.completed && result.solved() && result.summary.status == run::Status::completed;
  }
  cost.wall = std::chrono::duration<double>(Clock::now() - began).count();
  return cost;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path examples = argc > 1 ? argv[1] : "examples";
  const std::filesystem::path scratch = std::filesystem::temp_directory_path() / "hersey-coupled-bench";
  std::filesystem::create_directories(scratch);
  fmt::print("{:34} {:>4} {:>7} {:>10} {:>10} {:>9} {:>8}\n", "case", "runs", "steps", "Newton/st.", "ms/step",
             "wall [s]", "at most");
  print("slider-crank, 720 deg, 0.5 deg", slider_crank(examples, scratch, {}), 10);
  print("paper's seven loads, 34 um", paper_loads(examples, scratch), 60);
  std::filesystem::remove_all(scratch);
}
