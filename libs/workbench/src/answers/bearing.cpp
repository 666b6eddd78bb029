#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "answers/kept.h"
#include "answers/request.h"
#include "hersey/model/short_names.h"
#include "hersey/report/bearing_page.h"
#include "hersey/run/assumptions.h"
#include "hersey/workbench/answers.h"
#include "hersey/workbench/solution_page.h"

namespace hersey::workbench {
namespace {

using Moment = std::chrono::steady_clock;

double seconds_since(Moment::time_point began) { return std::chrono::duration<double>(Moment::now() - began).count(); }

std::string name_in(const std::string& setting) { return setting.substr(0, setting.find('=')); }

/// Overrides with key paths in place of short names; a load takes the place of a position of the text, and the other
/// way round.
std::vector<std::string> overrides_of(const model::Model& model, const model::Bearing& bearing,
                                      const std::vector<std::string>& set) {
  const model::ShortNames names = model::short_names(model, bearing);
  const auto path_of = [&](const std::string& name) {
    const auto found =
        std::find_if(names.paths.begin(), names.paths.end(), [&](const auto& pair) { return pair.first == name; });
    return found == names.paths.end() ? name : found->second;
  };
  const auto is_parameter = [&](const std::string& name) {
    return std::any_of(model.parameters.begin(), model.parameters.end(),
                       [&](const model::Parameter& parameter) { return parameter.name == name; });
  };
  std::vector<std::string> overrides;
  for (const std::string& setting : set) {
    const std::string name = name_in(setting);
    overrides.push_back(is_parameter(name) ? setting : path_of(name) + setting.substr(name.size()));
  }
  const auto& [load, position] = names.load_or_position;
  if (load.empty()) return overrides;
  const auto is_set = [&](const std::string& name) {
    return std::any_of(overrides.begin(), overrides.end(),
                       [&](const std::string& setting) { return name_in(setting) == path_of(name); });
  };
  const auto is_given = [&](const std::string& name) { return model.positions.contains(path_of(name)); };
  if (is_set(position) && !is_set(load) && is_given(load)) overrides.push_back(path_of(load) + "=none");
  if (is_set(load) && !is_set(position) && is_given(position)) overrides.push_back(path_of(position) + "=none");
  return overrides;
}

Json figures_json(const study::BearingSolution& solution) {
  Json list = Json::array();
  for (const study::BearingFigure& figure : study::figures_of(solution)) {
    Json entry{{"key", figure.key}, {"group", figure.group}, {"name", figure.label}, {"unit", figure.unit}};
    entry["value"] = std::isfinite(figure.value) ? Json(figure.value) : Json();
    if (!figure.words.empty()) entry["words"] = figure.words;
    list.push_back(std::move(entry));
  }
  return list;
}

/// Of a journal in its bore.
Json position_json(const report::PageSolution& page) {
  if (!page.has_axis || page.films.empty()) return nullptr;
  const report::PageFilm& film = page.films.front();
  return {{"e", {film.e.x(), film.e.y()}},
          {"angle", std::atan2(film.e.y(), film.e.x())},
          {"clearance", film.clearance},
          {"ratio", film.e.norm() / film.clearance}};
}

bool flag_in(const Json& request, const char* key) {
  const auto found = request.find(key);
  return found != request.end() && found->is_boolean() && found->get<bool>();
}

}  // namespace

std::string Answers::bearing(std::string_view request) const {
  const Moment::time_point began = Moment::now();
  const Json given = request_object(request);
  const std::string text = text_in(given, "text"), file = kept_->file(text_in(given, "path"));
  const std::string name = text_in(given, "bearing", ""), previous = text_in(given, "previous", "");
  std::vector<std::string> fields = texts_in(given, "fields");
  if (fields.empty()) fields = {"pressure", "thickness"};
  try {
    const std::shared_ptr<const session::Session> base = kept_->session(text, file);
    const std::string bearing_name = study::bearing_called(base->model(), name).name;
    const std::vector<std::string> overrides =
        overrides_of(base->model(), study::bearing_called(base->model(), name), texts_in(given, "set"));
    const session::Session session = overrides.empty() ? *base : base->with(overrides);
    const std::shared_ptr<const study::BearingSolution> nearby = kept_->solution(previous);
    const bool is_averaged = flag_in(given, "averaged");
    const study::BearingStudyOptions options{
        .bearing = bearing_name, .grid_error = false, .phase_averages = is_averaged, .nearby = nearby.get()};
    const Moment::time_point read = Moment::now();
    study::BearingSolution solution = session.solve_bearing(kept_->solver, options);
    const double solving = seconds_since(read);
    report::PageSolution page = page_of(solution);
    for (report::PageFilm& film : page.films)
      std::erase_if(film.fields, [&](const report::PageField& field) {
        return std::find(fields.begin(), fields.end(), field.name) == fields.end();
      });
    Json answer{{"solved", solution.solved()}, {"message", solution.message}};
    answer["figures"] = solution.solved() ? figures_json(solution) : Json::array();
    answer["position"] = position_json(page);
    answer["bearing"] = bearing_name;
    answer["conditions"] = Json::array();
    for (const auto& [condition, meaning] :
         run::bearing_assumptions(study::bearing_called(session.model(), bearing_name)))
      answer["conditions"].push_back({condition, meaning});
    answer["warnings"] = solution.warnings;
    answer["set"] = overrides;
    answer["started_from"] = solution.from_neighbour ? Json(previous) : Json();
    answer["averaged"] = is_averaged;
    answer["grid"] = {{"circumferential", solution.model.grid.n_phi}, {"axial", solution.model.grid.n_z}};
    const std::string shown = report::solution_json(page, bearing_name);
    answer["id"] = solution.solved() ? Json(kept_->keep(std::move(solution))) : Json();
    answer["solving"] = solving;
    answer["time"] = seconds_since(began);
    std::string whole = dumped(answer);
    whole.back() = ',';
    return whole + "\"solution\":" + shown + "}";
  } catch (const InputError& error) {
    refuse(error);
  }
}

}  // namespace hersey::workbench
