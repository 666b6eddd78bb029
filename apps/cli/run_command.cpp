#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "commands.h"
#include "exit_code.h"
#include "hersey/model/study.h"
#include "hersey/report/report.h"
#include "hersey/results/error.h"
#include "hersey/run/checkpoint.h"
#include "hersey/run/simulate.h"
#include "hersey/run/summary_json.h"
#include "hersey/session/session.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "run_events.h"
#include "standard_streams.h"
#include "table.h"
#include "timing_table.h"

namespace hersey::cli {
namespace {

using Paths = std::vector<std::filesystem::path>;

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
  const std::string name = fmt::format("{}cycle {}", cycle.leads_in ? "lead-in, " : "", cycle.number);
  if (std::isfinite(cycle.change)) {
    say("{}: {:.2g} % ({})\n", name, 100 * cycle.change, cycle.largest);
  } else {
    say("{}\n", name);
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

/// Shows a run, or all runs of a study, while they go on.
class Display : public session::Listener {
 public:
  /// @param model  whose warnings have been printed
  /// @param runs   of a study; empty: a single run
  /// @param events  are written beside
  Display(const model::Model& model, const std::vector<model::StudyRun>& runs, RunEvents& events)
      : runs_(runs), events_(events) {
    for (const Fault& warning : model.warnings) reported_.insert(warning.text());
  }

  /// Warnings that several runs of a study share are printed with the first of them.
  void warned(std::size_t run, const std::vector<Fault>& warnings) override {
    bar_.clear();
    events_.warned(run, warnings);
    const std::string name = runs_.empty() ? "" : runs_[run].label + ": ";
    for (const Fault& warning : warnings)
      if (const std::string text = warning.text(); reported_.insert(text).second) say("warning: {}{}\n", name, text);
  }

  void stepped(std::size_t run, const run::Progress& progress) override {
    note_step();
    events_.stepped(run, progress);
    bar_.show(label(run), progress);
  }

  void cycle_ended(std::size_t run, const run::CycleProgress& cycle) override {
    bar_.clear();
    events_.cycle_ended(run, cycle);
    report(cycle);
  }

  void stopping() override { interrupt_is_heeded(); }

  void finished(std::size_t run, const study::RunResult& result) override {
    if (runs_.empty()) interrupt_is_heeded();
    ++finished_;
    bar_.clear();
    events_.finished(run, result);
    if (result.solved()) {
      report(label(run), result.summary);
    } else {
      say("hersey: {}: {}\n", label(run), result.message);
    }
    if (runs_.empty()) report_work(result.summary);
  }

 private:
  [[nodiscard]] std::string label(std::size_t run) const {
    return runs_.empty() ? "" : fmt::format("{}/{} {}", finished_, runs_.size(), runs_[run].label);
  }

  const std::vector<model::StudyRun>& runs_;
  RunEvents& events_;
  ProgressBar bar_;
  std::size_t finished_ = 0;
  std::set<std::string> reported_;
};

int run_all(const RunArguments& arguments, const session::Session& session, const std::filesystem::path& folder,
            const std::vector<model::StudyRun>& runs, const session::RunOptions& options, Display& display) {
  int code = kOk;
  Paths files;
  std::vector<run::Summary> summaries;
  for (const study::RunResult& result : session.run_all(runs, folder, options, display)) {
    code = std::max(code, exit_code(result));
    if (!result.solved()) continue;
    files.push_back(result.summary.results);
    summaries.push_back(result.summary);
  }
  interrupt_is_heeded();
  if (files.empty()) return code;
  return close(arguments, folder, files, summaries, code);
}

int run_with(const RunArguments& arguments, RunEvents& events) {
  const auto began = std::chrono::steady_clock::now();
  const session::Session session(arguments.model, arguments.overrides);
  const std::filesystem::path folder = arguments.output.empty() ? session.results_folder() : arguments.output;
  warn(session.model().warnings);
  run::require_machine(session.model());
  std::vector<model::StudyRun> runs = session.runs();
  // A study with every parameter fixed by --set is a single run.
  if (!runs.empty() && runs.front().values.empty()) runs.clear();
  session::RunOptions options{.step_error = arguments.step_error, .check_start = true, .threads = arguments.jobs};
  if (arguments.force) options.existing = session::Existing::replace;
  if (arguments.resume) options.existing = session::Existing::resume;
  options.stop = &catch_interrupts();
  options.pages = {folder / "report.html"};
  if (!arguments.events.empty()) options.pages.push_back(arguments.events);
  Display display(session.model(), runs, events);
  events.started(session.model(), runs);
  if (!runs.empty()) return run_all(arguments, session, folder, runs, options, display);
  const run::Summary summary = session.run(folder / "results.h5", options, display);
  const int code = close(arguments, folder, {summary.results}, {summary}, exit_code(summary.status));
  if (arguments.timing && summary.steps > 0) {
    const std::chrono::duration<double> total = std::chrono::steady_clock::now() - began;
    say("{}", timing_text(summary, total.count()));
  }
  return code;
}

}  // namespace

int run_command(const RunArguments& arguments) {
  RunEvents events(arguments.events);
  try {
    const int code = run_with(arguments, events);
    events.ended(code);
    return code;
  } catch (const std::exception& error) {
    events.failed(error);
    throw;
  }
}

}  // namespace hersey::cli
