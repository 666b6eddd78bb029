#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "hersey/fem/stress.h"
#include "hersey/fem/thermal_expansion.h"
#include "hersey/fem/vibration.h"
#include "hersey/fem/vtu_file.h"
#include "hersey/film/temperature_law.h"
#include "hersey/session/output_file.h"
#include "run_stress.h"
#include "solid_heat.h"
#include "solid_setup.h"
#include "standard_streams.h"
#include "table.h"

namespace hersey::cli {
namespace {

constexpr double megapascal = 1e6, millimetre = 1e-3;

/// Prints a numerical failure on stderr.
int fail(const std::string& message) {
  say("hersey: {}\n", message);
  return kFailed;
}

Eigen::Map<const Eigen::Matrix3Xd> by_node(const Eigen::MatrixXd& u, Eigen::Index column) {
  return {u.col(column).data(), 3, u.rows() / 3};
}

/// The largest of a value per node, and where.
struct Peak {
  double value = 0;
  long node = 0;  ///< its label
};

Peak peak_of(const fem::Mesh& mesh, const Eigen::VectorXd& values) {
  Eigen::Index at = 0;
  const double value = values.maxCoeff(&at);
  return {value, mesh.node_labels[static_cast<std::size_t>(at)]};
}

nlohmann::json json_of(const Peak& peak) { return {{"value", peak.value}, {"node", peak.node}}; }

void write_modes(const SolidArguments& arguments, const fem::ElasticBody& body, const fem::Vibration& modes) {
  fem::VtuFrame frame;
  for (Eigen::Index k = 0; k < modes.omega.size(); ++k)
    frame.node_fields.push_back({fmt::format("mode_{}", k + 1), by_node(modes.shapes, k)});
  fem::write_vtu(arguments.vtu, body.mesh, frame);
}

void print_modes(const SolidArguments& arguments, const fem::ElasticBody& body, const fem::Vibration& modes) {
  fmt::print("body      {} degrees of freedom, {:.6g} kg\n", body.size(), body.mass);
  if (arguments.hold.empty())
    fmt::print("free      {} rigid motions\n\n", modes.rigid);
  else
    fmt::print("supported at {}\n\n", fmt::join(arguments.hold, ", "));
  std::vector<std::vector<std::string>> lines = {{"mode", "frequency/Hz", ""}};
  for (Eigen::Index k = 0; k < modes.omega.size(); ++k)
    lines.push_back({fmt::format("{}", k + 1), fmt::format("{:.5g}", modes.omega[k] / (2 * std::numbers::pi)),
                     k < modes.rigid ? "rigid" : ""});
  fmt::print("{}", aligned(lines, 2));
}

/// Results of `stress`.
struct StressResult {
  fem::StaticSolution solution;
  fem::Stress stress;
  std::optional<SolidHeat> heat;
  Peak displacement, von_mises;
  Vector3 reaction = Vector3::Zero();
};

void write_stress(const SolidArguments& arguments, const fem::ElasticBody& body, const StressResult& result) {
  fem::VtuFrame frame;
  frame.node_fields.push_back({"displacement", by_node(result.solution.u, 0)});
  frame.node_fields.push_back({"stress", result.stress.nodal});
  frame.node_fields.push_back({"von_mises", result.stress.nodal_von_mises.transpose()});
  if (result.heat) frame.node_fields.push_back({"temperature", result.heat->T.transpose()});
  frame.element_fields.push_back({"von_mises_of_element", result.stress.element_von_mises.transpose()});
  fem::write_vtu(arguments.vtu, body.mesh, frame);
}

/// Temperatures and where the heat goes.
void print_heat(const fem::ElasticBody& body, const SolidHeat& heat) {
  const Peak hottest = peak_of(body.mesh, heat.T), coldest = peak_of(body.mesh, -heat.T);
  fmt::print("hottest               {:.4f} degC at node {}\n", hottest.value - film::zero_celsius, hottest.node);
  fmt::print("coldest               {:.4f} degC at node {}\n", -coldest.value - film::zero_celsius, coldest.node);
  for (const SolidHeat::Leaving& out : heat.leaving) fmt::print("{:<22}{:.6g} W leave\n", out.name, out.power);
}

void print_stress(const fem::ElasticBody& body, const StressResult& r) {
  fmt::print("body                  {} degrees of freedom\n", body.size());
  fmt::print("largest displacement  {:.6g} mm at node {}\n", r.displacement.value / millimetre, r.displacement.node);
  fmt::print("largest von Mises     {:.5g} MPa at node {} (mean of its elements)\n", r.von_mises.value / megapascal,
             r.von_mises.node);
  fmt::print("force of supports     ({:.6g}, {:.6g}, {:.6g}) N\n", r.reaction.x(), r.reaction.y(), r.reaction.z());
  fmt::print("strain energy         {:.6g} J\n", r.stress.energy);
  if (r.heat) print_heat(body, *r.heat);
}

nlohmann::json json_of(const fem::ElasticBody& body, const SolidHeat& heat) {
  Peak coldest = peak_of(body.mesh, -heat.T);
  coldest.value = -coldest.value;
  nlohmann::json document = {{"hottest", json_of(peak_of(body.mesh, heat.T))},
                             {"coldest", json_of(coldest)},
                             {"leaving", nlohmann::json::array()},
                             {"units", {{"hottest", "K"}, {"coldest", "K"}, {"leaving", "W"}}}};
  for (const SolidHeat::Leaving& out : heat.leaving)
    document["leaving"].push_back({{"name", out.name}, {"power", out.power}});
  return document;
}

}  // namespace

int modes_command(const SolidArguments& arguments) {
  session::require_separate({{"--vtu", arguments.vtu}}, {arguments.file});
  const fem::ElasticBody body = solid_of(arguments, true);
  const fem::Vibration modes =
      fem::natural_modes(body, fixed_dofs_of(arguments, body.mesh), {.count = arguments.count});
  if (!modes.solved()) return fail(modes.message);
  if (!arguments.vtu.empty()) write_modes(arguments, body, modes);
  if (!arguments.json) {
    print_modes(arguments, body, modes);
    return kOk;
  }
  nlohmann::json document = {{"file", arguments.file},
                             {"degrees_of_freedom", body.size()},
                             {"mass", body.mass},
                             {"held", arguments.hold},
                             {"rigid", modes.rigid},
                             {"units", {{"mass", "kg"}, {"frequencies", "Hz"}}},
                             {"frequencies", nlohmann::json::array()}};
  for (const double omega : modes.omega) document["frequencies"].push_back(omega / (2 * std::numbers::pi));
  fmt::print("{}\n", document.dump(2));
  return kOk;
}

int stress_command(const SolidArguments& arguments) {
  if (is_results_file(arguments.file)) return run_stress_command(arguments);
  require_no_run_options(arguments);
  session::require_separate({{"--vtu", arguments.vtu}}, {arguments.file});
  const fem::ElasticBody body = solid_of(arguments, !arguments.gravity.empty());
  StressResult result{
      .solution = {}, .stress = {}, .heat = heat_of(arguments, body), .displacement = {}, .von_mises = {}};
  Eigen::VectorXd f = loads_of(arguments, body);
  if (result.heat) f += fem::expansion_load(body, result.heat->materials, result.heat->rise);
  std::vector<fem::Support> supports;
  for (const int dof : fixed_dofs_of(arguments, body.mesh)) supports.push_back({dof, 0});
  result.solution = fem::solve_static(body, supports, f);
  if (!result.solution.is_supported)
    throw InputError(Fault{{"", 0, 0}, "--hold", result.solution.message, "sets that leave no motion free", ""});
  if (!result.solution.solved()) return fail(result.solution.message);
  const Eigen::VectorXd u = result.solution.u.col(0);
  result.stress = result.heat ? fem::recover_stress(body, u, result.heat->materials, result.heat->rise)
                              : fem::recover_stress(body, u);
  result.displacement = peak_of(body.mesh, by_node(result.solution.u, 0).colwise().norm().transpose());
  result.von_mises = peak_of(body.mesh, result.stress.nodal_von_mises);
  result.reaction = by_node(result.solution.reaction, 0).rowwise().sum();
  if (!arguments.vtu.empty()) write_stress(arguments, body, result);
  if (!arguments.json) {
    print_stress(body, result);
    return kOk;
  }
  nlohmann::json document = {
      {"file", arguments.file},
      {"degrees_of_freedom", body.size()},
      {"largest_displacement", json_of(result.displacement)},
      {"largest_von_mises", json_of(result.von_mises)},
      {"reaction", {result.reaction.x(), result.reaction.y(), result.reaction.z()}},
      {"strain_energy", result.stress.energy},
      {"units",
       {{"largest_displacement", "m"}, {"largest_von_mises", "Pa"}, {"reaction", "N"}, {"strain_energy", "J"}}}};
  if (result.heat) document["heat"] = json_of(body, *result.heat);
  fmt::print("{}\n", document.dump(2));
  return kOk;
}

}  // namespace hersey::cli
