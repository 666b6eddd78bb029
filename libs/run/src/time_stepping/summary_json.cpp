#include "hersey/run/summary_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace hersey::run {
namespace {

const char* word(Status status) {
  switch (status) {
    case Status::completed:
      return "completed";
    case Status::stopped:
      return "stopped";
    case Status::failed:
      return "failed";
  }
  return "";
}

nlohmann::json json_of(const PerStep& figures) {
  return {{"median", figures.median}, {"mean", figures.mean}, {"most", figures.most}};
}

nlohmann::json json_of(const Work& work) {
  nlohmann::json document{{"start_up", work.start_up},
                          {"stepping", work.stepping},
                          {"newton_iterations", json_of(work.newton_iterations)},
                          {"parts", nlohmann::json::object()},
                          {"couplings", nlohmann::json::object()},
                          {"films", nlohmann::json::object()}};
  for (const WorkPart& part : work.parts) document["parts"][part.name] = part.seconds;
  for (const CouplingWork& coupling : work.couplings)
    document["couplings"][coupling.bearing] = {{"scheme", coupling.scheme},
                                               {"film_iterations", json_of(coupling.film_iterations)},
                                               {"exchanges", json_of(coupling.exchanges)},
                                               {"steps_as_one", coupling.steps_as_one}};
  for (const FilmCost& film : work.films)
    document["films"][film.bearing] = {{"nodes", film.nodes},
                                       {"seconds", film.seconds},
                                       {"evaluations", film.work.evaluations},
                                       {"factorisations", film.work.factorisations},
                                       {"balance", film.work.balance},
                                       {"jacobian", film.work.jacobian},
                                       {"factors", film.work.factors},
                                       {"solutions", film.work.solutions},
                                       {"derivatives", film.work.derivatives},
                                       {"forces", film.work.forces}};
  return document;
}

nlohmann::json json_of(const EnergySummary& energy) {
  return {{"put_in", energy.put_in},
          {"film_dissipation", energy.films},
          {"boundary_friction", energy.boundary_friction},
          {"contacts", energy.contacts},
          {"dampers", energy.dampers},
          {"oil", energy.oil},
          {"film_storage", energy.film_storage},
          {"stored", energy.stored},
          {"unexplained", energy.unexplained()},
          {"available", energy.available},
          {"error", energy.error()},
          {"from_nowhere", energy.from_nowhere},
          {"share_from_nowhere", energy.share_from_nowhere()}};
}

// Values that were not requested are null.
nlohmann::json step_errors_of(const Summary& summary) {
  const auto number = [](double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); };
  nlohmann::json bearings = nlohmann::json::object();
  for (const BearingSummary& bearing : summary.bearings) {
    const StepErrors& errors = bearing.step_error;
    bearings[bearing.name] = {{"moft", number(errors.moft)},
                              {"pofp", number(errors.pofp)},
                              {"max_force", number(errors.max_force)},
                              {"mean_power", number(errors.mean_power)},
                              {"mean_flow", number(errors.mean_flow)}};
  }
  return {{"largest_of_a_step", summary.worst_step_error}, {"bearings", bearings}};
}

nlohmann::json conditions_of(const Summary& summary) {
  nlohmann::json bearings = nlohmann::json::object();
  for (const BearingSummary& bearing : summary.bearings)
    if (!bearing.cavitated_shear.empty()) bearings[bearing.name]["cavitated shear"] = bearing.cavitated_shear;
  return bearings;
}

}  // namespace

std::string summary_json(const Summary& summary) {
  const nlohmann::json document{{"status", word(summary.status)},
                                {"message", summary.message},
                                {"results", summary.results.string()},
                                {"conditions", conditions_of(summary)},
                                {"t_end", summary.t_end},
                                {"t_results", summary.t_results},
                                {"steps", summary.steps},
                                {"rejected_steps", summary.rejected_steps},
                                {"cycles", summary.cycles},
                                {"lead_in_cycles", summary.lead_in_cycles},
                                {"newton_iterations", summary.newton_iterations},
                                {"worst_constraint_drift", summary.worst_constraint_drift},
                                {"worst_power_balance", summary.worst_power_balance},
                                {"step_error", step_errors_of(summary)},
                                {"energy", json_of(summary.energy)},
                                {"wall_time", summary.wall_time},
                                {"work", json_of(summary.work)}};
  return document.dump(2);
}

}  // namespace hersey::run
