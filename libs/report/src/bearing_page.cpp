#include "hersey/report/bearing_page.h"

#include <nlohmann/json.hpp>

#include "base64.h"
#include "hersey/core/contract.h"
#include "page_file.h"

namespace hersey::report {
namespace {

using nlohmann::json;

json pairs(const std::vector<std::pair<std::string, std::string>>& list) {
  json result = json::array();
  for (const auto& [name, text] : list) result.push_back({name, text});
  return result;
}

json dataset(const Eigen::VectorXd& values, const std::vector<Eigen::Index>& shape, const std::string& unit,
             const std::string& text = "") {
  const std::vector<double> numbers(values.data(), values.data() + values.size());
  return {{"unit", unit}, {"description", text}, {"shape", shape}, {"type", "f4"}, {"data", base64_float32(numbers)}};
}

// Name of a film as a machine's results have it: of a ring "turbine_inner", else that of the bearing.
std::string name_of_film(const PageFilm& film, const std::string& bearing) {
  return film.name.empty() ? bearing : bearing + "_" + film.name;
}

// A film as a results file stores it, with a single instant.
void add_datasets(const PageFilm& film, const std::string& bearing, json& result) {
  const Eigen::Index n_phi = film.phi.size(), n_z = film.z.size();
  const std::string fields = "/bearings/" + name_of_film(film, bearing) + "/fields/";
  result[fields + "time"] = dataset(Eigen::VectorXd::Zero(1), {1}, "s");
  result[fields + film.along] = dataset(film.phi, {n_phi}, film.along == "phi" ? "rad" : "m");
  if (!film.arcs.empty())
    result[fields + "arc"] = dataset(Eigen::Map<const Eigen::VectorXd>(film.arcs.data(), n_phi), {n_phi}, "1");
  result[fields + film.across] = dataset(film.z, {n_z}, "m");
  for (const PageField& field : film.fields)
    result[fields + field.name] = dataset(field.values, {1, n_phi, n_z}, field.unit, field.text);
}

json features(const PageFilm& film) {
  json list = json::array();
  for (const PageFeature& f : film.features)
    list.push_back(
        {{"name", f.name}, {"round", f.is_round}, {"phi", f.phi}, {"z", f.z}, {"arc", f.arc}, {"length", f.length}});
  return list;
}

json figures(const PageSolution& solution) {
  json list = json::array();
  for (const PageFigure& f : solution.figures) {
    json entry{{"key", f.key}, {"group", f.group}, {"name", f.name}, {"unit", f.unit}, {"value", f.value}};
    if (f.grid_error >= 0) entry["grid_error"] = f.grid_error;
    if (!f.words.empty()) entry["words"] = f.words;
    list.push_back(std::move(entry));
  }
  return list;
}

json solution_data(const PageSolution& solution, const std::string& bearing) {
  json data{{"label", solution.label},   {"values", pairs(solution.values)}, {"error", solution.message},
            {"remark", solution.remark}, {"figures", figures(solution)},     {"films", json::array()},
            {"datasets", json::object()}};
  if (solution.has_axis) data["load"] = {solution.load.x(), solution.load.y()};
  for (const PageFilm& film : solution.films) {
    json& entry = data["films"].emplace_back();
    entry = {{"name", film.name}, {"bearing", name_of_film(film, bearing)}, {"features", features(film)}};
    if (solution.has_axis) {
      entry["clearance"] = film.clearance;
      entry["e"] = {film.e.x(), film.e.y()};
    }
    if (solution.solved()) add_datasets(film, bearing, data["datasets"]);
  }
  return data;
}

}  // namespace

std::string solution_json(const PageSolution& solution, const std::string& bearing) {
  return solution_data(solution, bearing).dump(-1, ' ', false, json::error_handler_t::replace);
}

void write_html(const BearingPage& page, const std::filesystem::path& out) {
  HERSEY_REQUIRE(!page.solutions.empty(), "a report shows at least one solution");
  json bearing{{"description", page.description}, {"file", page.file},       {"name", page.bearing},
               {"created", page.created},         {"version", page.version}, {"conditions", pairs(page.conditions)},
               {"solutions", json::array()}};
  for (const PageSolution& solution : page.solutions) {
    bearing["solutions"].push_back(solution_data(solution, page.bearing));
  }
  write_page({{"title", page.title}, {"runs", json::array()}, {"bearing", bearing}}, out);
}

}  // namespace hersey::report
