#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/model/study.h"
#include "hersey/report/report.h"
#include "hersey/results/error.h"
#include "hersey/results/output_lock.h"
#include "hersey/run/simulate.h"
#include "hersey/run/summary_json.h"
#include "hersey/study/study.h"
#include "interrupt.h"
#include "output_file.h"
#include "progress_bar.h"
#include "standard_streams.h"
#include "table.h"

namespace hersey::cli {
namespace {

using Paths = std::vector<std::filesystem::path>;

// results/<folder> for <folder>/model.yaml, results/<stem> for any other name.
std::filesystem::path output_folder(const RunArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  const std::filesystem::path model = std::filesystem::absolute(arguments.model);
  const bool plain = model.stem() == "model" && !model.parent_path().filename().empty();
  return std::filesystem::path("results") / (plain ? model.parent_path().filename() : model.stem());
}

void refuse_existing(const Paths& files, bool force) {
  for (const std::filesystem::path& file : files) {
    results::require_idle(file);  // a file that is being written can neither be replaced nor resumed
    if (!force && std::filesystem::exists(file)) throw results::FileExists(file);
  }
}

/// Refuses outputs of a run that are inputs of the model.
void require_own_files(const model::Model& model, const std::filesystem::path& folder, const Paths& results) {
  std::vector<OutputFile> outputs{{"--output", folder / "report.html"}};
  for (const std::filesystem::path& file : results) {
    outputs.push_back({"--output", file});
    outputs.push_back({"--output", run::checkpoint_file(file)});
  }
  require_separate(outputs, files_of(model));
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw results::WriteError(folder, "the folder cannot be made: " + error.message());
}

int exit_code(run::Status status) {
  switch (status) {
    case run::Status::completed:
      return kOk;
    case run::Status::stopped:
      return kInterrupted;
    case run::Status::failed:
      return kFailed;
  }
  return kFailed;
}

int exit_code(const study::RunResult& result) {
  switch (result.status) {
    case study::RunEnding::solved:
      return exit_code(result.summary.status);
    case study::RunEnding::not_begun:
      return kInterrupted;
    case study::RunEnding::failed:
      return kFailed;
  }
  return kFailed;
}

// Units of the values in `runs`; the rows of `summary` name their own.
nlohmann::json units_of_runs() {
  const nlohmann::json errors{
      {"moft", "m"}, {"pofp", "Pa"}, {"max_force", "N"}, {"mean_power", "W"}, {"mean_flow", "m^3/s"}};
  return {{"t_end", "s"}, {"t_results", "s"}, {"wall_time", "s"},
          {"work", "s"},  {"energy", "J"},    {"step_error", errors}};
}

// Report and closing table from whatever rows there are; a report that cannot be made does not undo a good run.
int close(const RunArguments& arguments, const std::filesystem::path& folder, const Paths& files,
          const std::vector<run::Summary>& summaries, int code) {
  const std::filesystem::path page = folder / "report.html";
  std::vector<report::SummaryRow> rows;
  try {
    report::write_html(files, page);
    rows = report::summary_table(files);
  } catch (const results::FileError& error) {
    say("hersey: no report: {}\n", error.what());
    code = std::max(code, static_cast<int>(kFailed));
  }
  if (arguments.json) {
    nlohmann::json document{{"report", page.string()}, {"units", units_of_runs()}, {"runs", nlohmann::json::array()}};
    for (const run::Summary& summary : summaries)
      document["runs"].push_back(nlohmann::json::parse(run::summary_json(summary)));
    document["summary"] = nlohmann::json::parse(report::summary_json(files));
    fmt::print("{}\n", document.dump(2));
    return code;
  }
  const std::string more = "hersey report --all " + (files.empty() ? std::string() : files.front().string());
  fmt::print("{}\n", summaries.size() > 1 ? comparison_text(rows)
                     : arguments.all      ? summary_text(rows)
                                          : screen_text(rows, more));
  fmt::print("results: {}\nreport:  {}\n", summaries.size() > 1 ? folder.string() : files.front().string(),
             page.string());
  return code;
}

void report(const run::CycleProgress& cycle) {
  if (std::isfinite(cycle.change)) {
    say("cycle {}: {:.2g} % ({})\n", cycle.number, 100 * cycle.change, cycle.largest);
  } else {
    say("cycle {}\n", cycle.number);
  }
}

// If energy is gained without a source or lost without a sink, the motion is not that of a physical machine.
void report_energy_error(const std::string& name, const run::EnergySummary& energy) {
  constexpr double kMostUnexplained = 0.2;
  if (!(energy.error() > kMostUnexplained)) return;
  say("warning: {}{:.2g} J, {:.0f} % of the energy at the start and put in since, is neither stored nor lost anywhere: "
      "steps too long for this motion; expected a shorter `simulation.step`, or `step: {{tolerance: 1e-4}}`\n",
      name, energy.unexplained(), 100 * energy.error());
}

void report(const std::string& label, const run::Summary& summary) {
  const std::string name = label.empty() ? "" : label + ": ";
  report_energy_error(name, summary.energy);
  for (const run::BearingSummary& bearing : summary.bearings)
    for (const std::string& warning : bearing.warnings) say("warning: {}bearing {}, {}\n", name, bearing.name, warning);
  for (const run::BearingSummary& bearing : summary.bearings)
    if (label.empty() && !bearing.cavitated_shear.empty())
      say("bearing {}: {}\n", bearing.name, bearing.cavitated_shear);
  if (!summary.warning.empty()) say("hersey: {}{}\n", name, summary.warning);
  if (summary.status != run::Status::completed) {
    say("hersey: {}{}\n", name, summary.message);
    if (summary.steps > 0)
      say("hersey: results up to t = {:.6g} s are in {}\n", summary.t_results, summary.results.string());
    if (summary.status == run::Status::stopped && std::filesystem::exists(run::checkpoint_file(summary.results)))
      say("hersey: {}the same command with --resume goes on from there\n", name);
  } else {
    const std::string rejected =
        summary.rejected_steps > 0 ? fmt::format(" ({} more rejected)", summary.rejected_steps) : "";
    // The cost of a run in a study is printed in short; that of a single run follows in detail.
    const std::string cost =
        !label.empty() && summary.steps > 0
            ? fmt::format(", {:.3g} ms per step, Newton iterations {:g} (median)",
                          1e3 * summary.work.stepping / summary.steps, summary.work.newton_iterations.median)
            : "";
    say("{}{} steps{} in {:.2f} s{}{}{}\n", name, summary.steps, rejected, summary.wall_time, cost,
        summary.message.empty() ? "" : ", ", summary.message);
  }
}

std::string text_of(const run::PerStep& figures) {
  return fmt::format("median {:g}, mean {:.1f}, most {}", figures.median, figures.mean, figures.most);
}

// Reports the shares of the computing time, largest first, and the work of coupling films and bodies.
void report_work(const run::Summary& summary) {
  const run::Work& work = summary.work;
  if (summary.steps == 0 || work.stepping <= 0) return;
  say("{:.3g} ms per step after {:.2f} s of start-up; Newton iterations per step: {}\n",
      1e3 * work.stepping / summary.steps, work.start_up, text_of(work.newton_iterations));
  std::vector<run::WorkPart> parts = work.parts;
  std::stable_sort(parts.begin(), parts.end(),
                   [](const run::WorkPart& a, const run::WorkPart& b) { return a.seconds > b.seconds; });
  std::string shares;
  for (const run::WorkPart& part : parts) {
    const double percent = 100 * part.seconds / work.stepping;
    if (percent >= 0.1) shares += fmt::format("{}{} {:.1f} %", shares.empty() ? "" : ", ", part.name, percent);
  }
  say("share of time: {}\n", shares);
  // Only the films with the most iterations are reported.
  constexpr std::size_t kMostReported = 3;
  std::vector<run::CouplingWork> couplings = work.couplings;
  std::stable_sort(couplings.begin(), couplings.end(), [](const run::CouplingWork& a, const run::CouplingWork& b) {
    return a.film_iterations.mean > b.film_iterations.mean;
  });
  if (couplings.size() > kMostReported + 1)
    couplings.resize(kMostReported);
  else
    couplings = work.couplings;
  for (const run::CouplingWork& coupling : couplings) {
    const std::string exchanges =
        coupling.exchanges.most > 0 ? fmt::format("exchanges per step: {}; ", text_of(coupling.exchanges)) : "";
    const std::string as_one =
        coupling.steps_as_one > 0
            ? fmt::format("{} steps solved as one system, as their exchange came to no end; ", coupling.steps_as_one)
            : "";
    say("bearing {}: {}; {}{}film iterations per step: {}\n", coupling.bearing, coupling.scheme, exchanges, as_one,
        text_of(coupling.film_iterations));
  }
}

int run_one(const RunArguments& arguments, const std::filesystem::path& folder) {
  const model::Model model = model::read(arguments.model, arguments.overrides);
  run::Options options;
  options.results = folder / "results.h5";
  options.overwrite = arguments.force;
  options.resume = arguments.resume;
  options.step_error = arguments.step_error;
  options.stop = &catch_interrupts();
  options.on_stopping = interrupt_is_heeded;
  require_own_files(model, folder, {options.results});
  refuse_existing({options.results}, arguments.force || arguments.resume);
  ProgressBar bar;
  options.on_progress = [&](const run::Progress& progress) {
    note_step();
    bar.show("", progress);
  };
  options.on_cycle = [&](const run::CycleProgress& cycle) {
    bar.clear();
    report(cycle);
  };
  warn(run::check(model));
  make_folder(folder);
  const run::Summary summary = run::simulate(model, options);
  interrupt_is_heeded();
  bar.clear();
  report("", summary);
  report_work(summary);
  return close(arguments, folder, {options.results}, {summary}, exit_code(summary.status));
}

/// Warnings that several runs of a study share are printed with the first of them.
void report_once(const std::string& run, const std::vector<Fault>& warnings, std::set<std::string>& reported) {
  for (const Fault& warning : warnings) {
    if (const std::string text = warning.text(); reported.insert(text).second) say("warning: {}: {}\n", run, text);
  }
}

int run_all(const RunArguments& arguments, const model::Model& model, const std::filesystem::path& folder,
            const std::vector<model::StudyRun>& runs) {
  study::Options options;
  options.directory = folder;
  options.overwrite = arguments.force;
  options.resume = arguments.resume;
  options.step_error = arguments.step_error;
  options.threads = arguments.jobs;
  options.stop = &catch_interrupts();
  options.on_stopping = interrupt_is_heeded;
  Paths planned;
  for (const model::StudyRun& run : runs) planned.push_back(study::results_file(options, run));
  require_own_files(model, folder, planned);
  refuse_existing(planned, arguments.force || arguments.resume);
  make_folder(folder);

  ProgressBar bar;
  std::size_t finished = 0;
  std::set<std::string> reported;
  for (const Fault& warning : model.warnings) reported.insert(warning.text());
  options.on_warnings = [&](std::size_t i, const std::vector<Fault>& warnings) {
    bar.clear();
    report_once(runs[i].label, warnings, reported);
  };
  options.on_progress = [&](std::size_t i, const run::Progress& progress) {
    note_step();
    bar.show(fmt::format("{}/{} {}", finished, runs.size(), runs[i].label), progress);
  };
  options.on_finished = [&](std::size_t i, const study::RunResult& result) {
    ++finished;
    bar.clear();
    const std::string label = fmt::format("{}/{} {}", finished, runs.size(), runs[i].label);
    if (result.solved()) {
      report(label, result.summary);
    } else {
      say("hersey: {}: {}\n", label, result.message);
    }
  };
  const std::vector<study::RunResult> results = study::simulate_all(arguments.model, runs, options);
  interrupt_is_heeded();

  int code = kOk;
  Paths files;
  std::vector<run::Summary> summaries;
  for (const study::RunResult& result : results) {
    code = std::max(code, exit_code(result));
    if (!result.solved()) continue;
    files.push_back(result.summary.results);
    summaries.push_back(result.summary);
  }
  if (files.empty()) return code;
  return close(arguments, folder, files, summaries, code);
}

}  // namespace

int run_command(const RunArguments& arguments) {
  const std::filesystem::path folder = output_folder(arguments);
  const model::Model model = model::read(arguments.model, arguments.overrides);
  warn(model.warnings);
  if (model.is_of_bearings_alone()) {
    throw InputError(Fault{{arguments.model, 0, 0},
                           "",
                           "bearings alone",
                           "bodies and a simulation to run",
                           "'hersey bearing' solves bearings by themselves"});
  }
  const std::vector<model::StudyRun> runs = model::expand_study(arguments.model, arguments.overrides);
  // A study with every parameter fixed by --set is a single run.
  const bool varies = !runs.empty() && !runs.front().values.empty();
  return varies ? run_all(arguments, model, folder, runs) : run_one(arguments, folder);
}

}  // namespace hersey::cli
