#include "run_events.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <variant>

#include "exit_code.h"
#include "fault_json.h"
#include "hersey/core/error_text.h"

namespace hersey::cli {
namespace {

// Lines begin with the kind of the event.
using EventJson = nlohmann::ordered_json;
constexpr std::string_view kBeginning = "{\"kind\":";

/// Number or null: JSON has no infinity.
EventJson finite(double value) { return std::isfinite(value) ? EventJson(value) : EventJson(nullptr); }

/// [m], as the model gives it (cold); null of films that are not between two cylinders.
EventJson radial_clearance(const model::Bearing& bearing) {
  const film::FilmModel& film = bearing.film;
  const bool is_cylindrical = bearing.kind->has_axis() || std::holds_alternative<film::Skirt>(film.surface);
  return is_cylindrical ? finite(film.c) : EventJson(nullptr);
}

EventJson json_of(const std::vector<run::BearingProgress>& bearings) {
  EventJson figures = EventJson::object();
  for (const run::BearingProgress& bearing : bearings) {
    EventJson& own = figures[bearing.name];
    own = {{"h_min", finite(bearing.h_min)}, {"p_max", finite(bearing.p_max)},
           {"e_x", finite(bearing.e_x)},     {"e_y", finite(bearing.e_y)},
           {"power", finite(bearing.power)}, {"flow", finite(bearing.flow)},
           {"T_max", finite(bearing.T_max)}, {"power_asperity", finite(bearing.power_asperity)}};
    if (!bearing.has_heat) continue;
    own["heat"] = {{"to_oil", finite(bearing.heat_to_oil)},
                   {"to_shell", finite(bearing.heat_to_shell)},
                   {"to_journal", finite(bearing.heat_to_journal)},
                   {"stored", finite(bearing.heat_stored)}};
  }
  return figures;
}

EventJson json_of(const run::PowerProgress& power) {
  EventJson figures{{"drives", finite(power.drives)},
                    {"loads", finite(power.loads)},
                    {"gravity", finite(power.gravity)},
                    {"springs", finite(power.springs)},
                    {"contacts", finite(power.contacts)},
                    {"bearings", finite(power.bearings)},
                    {"elastic", finite(power.elastic)},
                    {"kinetic_rate", finite(power.kinetic_rate)},
                    {"balance_error", finite(power.error)},
                    {"film_friction", finite(power.film_friction)},
                    {"asperity_friction", finite(power.asperity_friction)}};
  if (power.has_network)
    figures["heat"] = {{"surroundings", finite(power.heat_to_surroundings)}, {"bodies", finite(power.heat_in_bodies)}};
  return figures;
}

/// Of the run that is over: where in the text its message leads.
EventJson json_of(const run::NamedPart& part) {
  return {{"path", part.path},
          {"file", part.position.file},
          {"line", part.position.line},
          {"column", part.position.column}};
}

EventJson json_of(const run::CircuitProgress& circuit) {
  EventJson nodes = EventJson::object(), flows = EventJson::object();
  for (const run::CircuitProgress::Node& node : circuit.nodes) {
    nodes[node.name] = {{"pressure", finite(node.pressure)}, {"drawn", finite(node.drawn)}};
    if (std::isfinite(node.temperature)) nodes[node.name]["temperature"] = node.temperature;
  }
  for (const run::CircuitProgress::Element& element : circuit.elements) flows[element.name] = finite(element.flow);
  return {{"nodes", std::move(nodes)}, {"flows", std::move(flows)}};
}

const char* word(run::Status status) {
  switch (status) {
    case run::Status::completed:
      return "completed";
    case run::Status::stopped:
      return "stopped";
    case run::Status::failed:
      return "failed";
  }
  return "failed";
}

}  // namespace

RunEvents::RunEvents(const std::filesystem::path& file) {
  if (file.empty()) return;
  const auto refuse = [&](const std::string& why) {
    if (fd_ >= 0) ::close(fd_);
    throw InputError(Fault{{"--events", 0, 0}, "", file.string() + why, "a new file, or one of earlier events", ""});
  };
  std::error_code ignored;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
  fd_ = ::open(file.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (fd_ < 0) refuse(" cannot be written");
  // Appended to a model or a table, events would ruin it.
  std::array<char, kBeginning.size()> first{};
  const ssize_t got = std::filesystem::is_regular_file(file, ignored) ? ::pread(fd_, first.data(), first.size(), 0) : 0;
  if (got > 0 && std::string_view(first.data(), static_cast<std::size_t>(got)) != kBeginning)
    refuse(" exists and is no file of events");
}

RunEvents::~RunEvents() {
  if (fd_ >= 0) ::close(fd_);
}

void RunEvents::started(const model::Model& model, const std::vector<model::StudyRun>& runs) {
  if (fd_ < 0) return;
  runs_ = std::max<std::size_t>(runs.size(), 1);
  positions_ = model.positions;
  const model::Simulation& plan = model.simulation;
  EventJson event{{"kind", "started"}, {"title", model.title},       {"pid", ::getpid()},
                  {"t", plan.start},   {"t_start", plan.start},      {"t_end", plan.start + plan.duration},
                  {"share", 0},        {"runs", EventJson::array()}, {"bearings", EventJson::object()}};
  for (const model::StudyRun& run : runs) event["runs"].push_back(run.label);
  // The runs of a study may differ in it.
  for (const model::Bearing& bearing : model.bearings)
    event["bearings"][bearing.name] = {{"clearance", runs.empty() ? radial_clearance(bearing) : EventJson(nullptr)}};
  write(event);
}

void RunEvents::warned(std::size_t run, const std::vector<Fault>& warnings) {
  if (fd_ < 0) return;
  for (const Fault& warning : warnings) {
    EventJson event{
        {"kind", "warning"}, {"run", run}, {"text", warning.text()}, {"fault", EventJson(fault_json(warning))}};
    write(event);
  }
}

void RunEvents::stepped(std::size_t run, const run::Progress& progress) {
  if (fd_ < 0) return;
  constexpr double kLeastPause = 0.1;   // [s]: ten frames a second look continuous
  constexpr double kPauseShare = 1e-4;  // 20,000 lines in the first hour, 30,000 more up to a day
  const Clock::time_point now = Clock::now();
  const double pause = std::max(kLeastPause, kPauseShare * progress.elapsed);
  const bool is_last = progress.t_end - progress.t < 0.5 * progress.dt;
  if (!is_last && std::chrono::duration<double>(now - last_step_).count() < pause) return;
  last_step_ = now;
  t_ = progress.t;
  const double span = progress.t_end - progress.t_start;
  const double part = span > 0 ? std::clamp((progress.t - progress.t_start) / span, 0.0, 1.0) : 0.0;
  const double share = (static_cast<double>(finished_) + part) / static_cast<double>(runs_);
  EventJson event{{"kind", "stepped"},
                  {"run", run},
                  {"t", progress.t},
                  {"t_end", progress.t_end},
                  {"share", share},
                  {"dt", progress.dt},
                  {"newton_iterations", progress.newton_iterations},
                  {"moft", finite(progress.moft)},
                  {"elapsed", progress.elapsed},
                  {"bearings", json_of(progress.bearings ? progress.bearings() : std::vector<run::BearingProgress>{})}};
  if (const run::CircuitProgress circuit = progress.circuit ? progress.circuit() : run::CircuitProgress{};
      !circuit.nodes.empty())
    event["circuit"] = json_of(circuit);
  if (progress.powers) event["powers"] = json_of(progress.powers());
  write(event);
}

void RunEvents::cycle_ended(std::size_t run, const run::CycleProgress& cycle) {
  if (fd_ < 0) return;
  write({{"kind", "cycle"},
         {"run", run},
         {"t", t_},
         {"number", cycle.number},
         {"change", finite(cycle.change)},
         {"largest", cycle.largest},
         {"leads_in", cycle.leads_in}});
}

void RunEvents::finished(std::size_t run, const study::RunResult& result) {
  if (fd_ < 0) return;
  ++finished_;
  const bool ran = result.solved();
  t_ = ran ? result.summary.t_end : t_;
  message_ = ran ? result.summary.message : result.message;
  const bool has_failed = !ran || result.summary.status == run::Status::failed;
  place_ = has_failed ? run::named_part(message_, positions_) : std::nullopt;
  if (ran)
    for (const run::BearingSummary& bearing : result.summary.bearings)
      for (const std::string& text : bearing.warnings)
        write({{"kind", "warning"}, {"run", run}, {"text", "bearing " + bearing.name + ", " + text}});
  if (runs_ == 1) return;
  EventJson event{{"kind", "run_finished"},
                  {"run", run},
                  {"t", t_},
                  {"share", static_cast<double>(finished_) / static_cast<double>(runs_)},
                  {"status", ran ? word(result.summary.status) : "failed"},
                  {"message", message_}};
  write_end(event);
}

void RunEvents::ended(int code) {
  if (fd_ < 0) return;
  const char* status = code == kOk ? "completed" : code == kInterrupted ? "stopped" : "failed";
  EventJson event{{"kind", "finished"}, {"t", t_}, {"status", status}, {"message", message_}, {"code", code}};
  write_end(event);
}

void RunEvents::failed(const std::exception& error) {
  if (fd_ < 0) return;
  const std::string message = error_text(error);
  place_ = run::named_part(message, positions_);
  if (const auto* input = dynamic_cast<const InputError*>(&error); input != nullptr && !input->faults().empty()) {
    const Fault& first = input->faults().front();
    if (first.position.line > 0) place_ = run::NamedPart{first.path, first.position};
  }
  EventJson event{{"kind", "finished"}, {"t", t_}, {"status", "failed"}, {"message", message}, {"code", kFailed}};
  write_end(event);
}

void RunEvents::write_end(nlohmann::ordered_json& event) {
  if (place_) event["at"] = json_of(*place_);
  write(event);
}

void RunEvents::write(const nlohmann::ordered_json& event) {
  if (fd_ < 0) return;
  const std::string line = event.dump(-1, ' ', false, EventJson::error_handler_t::replace) + "\n";
  ssize_t done = 0;
  do done = ::write(fd_, line.data(), line.size());
  while (done < 0 && errno == EINTR);
  if (done == static_cast<ssize_t>(line.size())) return;
  ::close(fd_);
  fd_ = -1;
}

}  // namespace hersey::cli
