#include <fmt/format.h>
#include <malloc.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "exit_code.h"
#include "hersey/core/error_text.h"
#include "hersey/core/task_pool.h"
#include "hersey/core/write_file.h"
#include "hersey/report/report.h"
#include "hersey/results/reader.h"
#include "hersey/session/session.h"
#include "hersey/study/bearing_study.h"
#include "hersey/study/run_figures.h"
#include "hersey/study/sensitivity.h"
#include "run_events.h"
#include "standard_streams.h"
#include "study_command.h"

namespace hersey::cli {
namespace {

using nlohmann::json;

// Writes one line at once: several tasks append to one file, and its lines must stay whole.
void answer(const json& line) {
  const std::string text = line.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw std::runtime_error(fmt::format("an answer is lost: {}", std::strerror(errno)));
    done += static_cast<std::size_t>(written);
  }
}

/// The course of a run, for pages that show it while it goes on; it goes with the run's end. A file that cannot be
/// written ends no run.
class Course : public session::Listener {
 public:
  /// @param file  empty: nothing is written
  Course(std::filesystem::path file, const json& request, const model::Model& model) : file_(std::move(file)) {
    if (file_.empty()) return;
    try {
      const json first{
          {"kind", "of_study"}, {"run", request.at("run")}, {"values", request.value("values", json::array())}};
      write_file(file_, {first.dump(-1, ' ', false, json::error_handler_t::replace) + "\n"});
      events_.emplace(file_);
      events_->started(model, {});
    } catch (const std::runtime_error&) {
      events_.reset();
    }
  }
  ~Course() override {
    std::error_code ignored;
    if (!file_.empty()) std::filesystem::remove(file_, ignored);
  }

  void stepped(std::size_t run, const run::Progress& progress) override {
    if (events_) events_->stepped(run, progress);
  }

 private:
  std::filesystem::path file_;
  std::optional<RunEvents> events_;
};

/// Computes runs and writes their answers; the description of a figure is written once, before its first value.
class Task {
 public:
  explicit Task(const StudyTaskArguments& arguments)
      : arguments_(arguments), solver_(arguments.model, arguments.overrides) {
    for (const std::string& name : arguments.outputs) note_bearing(name);
  }

  void run(const json& request) {
    const auto began = std::chrono::steady_clock::now();
    json reply{{"run", request.at("run")}, {"status", "completed"}};
    try {
      model::StudyRun run{arguments_.overrides, "", "", {}};
      for (const json& change : request.at("set")) run.overrides.push_back(change.get<std::string>());
      figures_ = json::object();
      if (arguments_.analysis == "simulation")
        simulate(run, request, reply);
      else
        solve(run, request, reply);
      reply["figures"] = figures_;
    } catch (const std::exception& error) {
      reply["status"] = "failed";
      reply["error"] = error_text(error);
    }
    if (!news_.empty()) answer({{"describe", news_}});
    news_ = json::object();
    reply["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    answer(reply);
  }

 private:
  void note_bearing(const std::string& name) {
    const std::string prefix = "bearings.";
    if (!name.starts_with(prefix)) return;
    const std::string bearing = name.substr(prefix.size(), name.find('.', prefix.size()) - prefix.size());
    if (std::find(bearings_.begin(), bearings_.end(), bearing) == bearings_.end()) bearings_.push_back(bearing);
  }

  // @param size  what one `unit` is in SI
  void add(const std::string& key, double in_si, const std::string& name, const std::string& unit,
           const std::string& si_unit, double size) {
    figures_[key] = std::isfinite(in_si) ? json(in_si) : json();
    if (described_.insert(key).second)
      news_[key] = {{"name", name}, {"unit", unit}, {"si_unit", si_unit}, {"si", size}};
  }

  void solve(const model::StudyRun& run, const json& request, json& reply) {
    for (const auto& [name, solution] : solver_.solve(run, bearings_)) {
      if (!solution.solved()) throw std::runtime_error(solution.message);
      for (const study::BearingFigure& figure : study::figures_of(solution))
        add("bearings." + name + "." + figure.key, figure.words.empty() ? figure.value * figure.si : NAN, figure.name,
            figure.unit, figure.si_unit, figure.si);
      if (!solution.warnings.empty()) reply["doubts"] = solution.warnings;
      if (request.contains("slopes")) add_slopes(name, solution, request.at("slopes"), reply);
    }
  }

  // Adds the derivatives of the requested figures by the parameters: figure in SI over the parameter's own unit.
  void add_slopes(const std::string& bearing, const study::BearingSolution& solution, const json& parameters,
                  json& reply) {
    if (!study::are_sensitivities_exact(solution)) {
      reply["no_slopes"] = "film and heat, or film and surfaces that deform, answer each other";
      return;
    }
    std::vector<std::string> keys;
    for (const json& key : parameters) keys.push_back(key.get<std::string>());
    const study::BearingStudyOptions options{.bearing = bearing, .grid_error = false, .threads = 1};
    const std::vector<study::BearingFigure> figures = study::figures_of(solution);
    auto name = parameters.items().begin();
    for (const study::Sensitivity& found : study::sensitivities(arguments_.model, solution, options, keys)) {
      if (!found.exact || !found.solved()) {
        reply["no_slopes"] = found.solved() ? "the film has no derivative with " + name.key() : found.message;
        return;
      }
      for (std::size_t k = 0; k < figures.size(); ++k) {
        const std::string figure = "bearings." + bearing + "." + figures[k].key;
        const auto& wanted = arguments_.outputs;
        if (std::isfinite(found.slopes[k]) && std::find(wanted.begin(), wanted.end(), figure) != wanted.end())
          reply["slopes"][name.key()][figure] = found.slopes[k] * found.size;
      }
      ++name;
    }
  }

  void simulate(const model::StudyRun& run, const json& request, json& reply) {
    const std::filesystem::path file = request.at("results").get<std::string>();
    // A run that was killed goes on from its checkpoint.
    session::RunOptions options{.existing = session::Existing::resume_or_replace};
    if (request.contains("values"))
      for (const json& value : request.at("values"))
        options.study_parameters.push_back({value.at(0).get<std::string>(), value.at(1).get<std::string>()});
    const session::Session session(arguments_.model, run.overrides);
    Course course(request.value("events", ""), request, session.model());
    const run::Summary summary = session.run(file, options, course);
    if (summary.status != run::Status::completed) throw std::runtime_error(summary.message);
    const results::Reader reader(file);
    for (const study::RunFigure& figure : study::figures_of(reader, arguments_.outputs))
      add(figure.key, figure.value, figure.text, display_unit(figure.si_unit), figure.si_unit,
          display_size(figure.si_unit));
    if (request.contains("report")) {
      report::write_html(std::vector{file}, request.at("report").get<std::string>());
      reply["report"] = request.at("report");
    }
    const std::string keep = request.value("keep", "results");
    if (keep == "figures") std::filesystem::remove(file);
  }

  static std::string display_unit(const std::string& si) {
    if (si == "m") return "um";
    if (si == "Pa") return "MPa";
    if (si == "1") return "";
    if (si == "m^3") return "mm^3";
    if (si == "m^3/s") return "mm^3/s";
    return si;
  }

  static double display_size(const std::string& si) {
    if (si == "m") return 1e-6;
    if (si == "Pa") return 1e6;
    if (si == "m^3" || si == "m^3/s") return 1e-9;
    return 1;
  }

  const StudyTaskArguments& arguments_;
  study::RunSolver solver_;
  std::vector<std::string> bearings_;
  std::set<std::string> described_;
  json figures_ = json::object(), news_ = json::object();
};

}  // namespace

int study_task_command(const StudyTaskArguments& arguments) {
  if (arguments.end_with_parent) ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  TaskPool::shared().set_threads(1);  // runs beside each other, not parts of one
  // What one run gives back the next one wants: pages that go to the system and return cost a tenth of a quick run.
  ::mallopt(M_TRIM_THRESHOLD, 1 << 29);
  ::mallopt(M_MMAP_THRESHOLD, 1 << 29);
  Task task(arguments);
  std::string line;
  while (std::getline(std::cin, line)) {
    if (line.empty()) continue;
    const json request = json::parse(line, nullptr, false);
    if (request.is_discarded() || !request.contains("run") || !request.contains("set")) {
      say("hersey: study-task: not a run: {}\n", line);
      return kWrongInput;
    }
    task.run(request);
  }
  return kOk;
}

}  // namespace hersey::cli
