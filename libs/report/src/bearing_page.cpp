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

// The film as a results file stores it, with a single instant.
json datasets(const PageSolution& solution, const std::string& bearing) {
  const Eigen::Index n_phi = solution.phi.size(), n_z = solution.z.size();
  const std::string fields = "/bearings/" + bearing + "/fields/";
  json result;
  result[fields + "time"] = dataset(Eigen::VectorXd::Zero(1), {1}, "s");
  result[fields + solution.along] = dataset(solution.phi, {n_phi}, solution.along == "phi" ? "rad" : "m");
  if (!solution.arcs.empty())
    result[fields + "arc"] = dataset(Eigen::Map<const Eigen::VectorXd>(solution.arcs.data(), n_phi), {n_phi}, "1");
  result[fields + solution.across] = dataset(solution.z, {n_z}, "m");
  for (const PageField& field : solution.fields)
    result[fields + field.name] = dataset(field.values, {1, n_phi, n_z}, field.unit, field.text);
  return result;
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
            {"remark", solution.remark}, {"figures", figures(solution)},     {"features", json::array()},
            {"datasets", json::object()}};
  if (solution.has_axis) {
    data["clearance"] = solution.clearance;
    data["e"] = {solution.e.x(), solution.e.y()};
    data["load"] = {solution.load.x(), solution.load.y()};
  }
  for (const PageFeature& f : solution.features) {
    data["features"].push_back(
        {{"name", f.name}, {"round", f.is_round}, {"phi", f.phi}, {"z", f.z}, {"arc", f.arc}, {"length", f.length}});
  }
  if (solution.solved()) data["datasets"] = datasets(solution, bearing);
  return data;
}

}  // namespace

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
