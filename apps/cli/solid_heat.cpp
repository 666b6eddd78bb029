#include "solid_heat.h"

#include <fmt/format.h>

#include "hersey/core/input_error.h"
#include "hersey/core/spelling.h"
#include "hersey/fem/heat_conduction.h"
#include "hersey/fem/load_distributions.h"
#include "option_value.h"

namespace hersey::cli {
namespace {

[[noreturn]] void refuse_heat(const char* option, std::string found, std::string expected,
                              std::string suggestion = "") {
  throw InputError(Fault{{"", 0, 0}, option, std::move(found), std::move(expected), std::move(suggestion)});
}

/// "NAME=value" cut at its equals sign.
struct Named {
  std::string name, value;
};

Named named_value(const char* option, const std::string& text, const char* expected) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) refuse_heat(option, "'" + text + "'", expected);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

[[noreturn]] void refuse_name(const char* option, const fem::Mesh& mesh, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& [known, faces] : mesh.surfaces) names.push_back(known);
  for (const auto& [known, nodes] : mesh.node_sets)
    if (mesh.surfaces.count(known) == 0) names.push_back(known);
  refuse_heat(option, fmt::format("the mesh has no surface or set with faces '{}'", name),
              names.empty() ? "a mesh with surfaces" : one_of(names), did_you_mean(name, names));
}

std::vector<fem::ElementFace> faces_of(const char* option, const fem::Mesh& mesh, const std::string& name) {
  std::vector<fem::ElementFace> faces = fem::faces_called(mesh, name);
  if (faces.empty()) refuse_name(option, mesh, name);
  return faces;
}

std::vector<int> nodes_of(const char* option, const fem::Mesh& mesh, const std::string& name) {
  if (const auto set = mesh.node_sets.find(name); set != mesh.node_sets.end() && !set->second.empty())
    return set->second;
  return fem::nodes_on(mesh, faces_of(option, mesh, name));
}

fem::PrescribedNodes nodes_at_temperature(const fem::Mesh& mesh, const std::string& text) {
  const Named given = named_value("--temperature", text, "a set and a value, SET=80degC, or one value, 80degC");
  return {nodes_of("--temperature", mesh, given.name), in_si("--temperature", given.value, "K")};
}

fem::CooledFaces cooled_faces(const fem::Mesh& mesh, const std::string& text) {
  const char* expected = "a surface, a coefficient and a temperature, SURFACE=80W/m^2/K:20degC";
  const Named given = named_value("--cooling", text, expected);
  const std::size_t colon = given.value.find(':');
  if (colon == std::string::npos) refuse_heat("--cooling", "'" + text + "'", expected);
  const fem::CooledFaces cooled{faces_of("--cooling", mesh, given.name),
                                in_si("--cooling", given.value.substr(0, colon), "W/m^2/K"),
                                in_si("--cooling", given.value.substr(colon + 1), "K")};
  if (cooled.transfer < 0) refuse_heat("--cooling", "'" + text + "'", "a coefficient that is not negative");
  return cooled;
}

/// Heat spread evenly over surfaces.
Eigen::VectorXd heat_into(const fem::Mesh& mesh, const std::vector<std::string>& texts) {
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(mesh.nodes.size()));
  for (const std::string& text : texts) {
    const Named given = named_value("--heat", text, "a surface and a power, SURFACE=500W");
    const std::vector<fem::ElementFace> faces = faces_of("--heat", mesh, given.name);
    const double flux = in_si("--heat", given.value, "W") / fem::area_of(mesh, faces);
    heat += fem::heat_load(mesh, faces, [&](const Vector3&) { return flux; });
  }
  return heat;
}

/// One temperature for all of the body, "80degC".
bool is_uniform(const std::vector<std::string>& temperatures) {
  return temperatures.size() == 1 && temperatures.front().find('=') == std::string::npos;
}

/// Temperatures by conduction, and where the heat goes.
void conduct(const SolidArguments& arguments, const fem::ElasticBody& body, SolidHeat& heat) {
  const fem::ThermalSurroundings surroundings = surroundings_of(arguments, body.mesh);
  const Eigen::VectorXd into = heat_into(body.mesh, arguments.heat);
  fem::HeatConduction conduction(body.mesh, heat.materials, surroundings, body.integration);
  const solver::FactorSummary summary = conduction.factorise();
  if (summary.status == solver::FactorStatus::singular)
    refuse_heat("--cooling", summary.message, "--cooling SURFACE=80W/m^2/K:20degC, or --temperature SET=80degC");
  if (!summary.solved()) throw std::runtime_error(summary.message);
  heat.T = conduction.temperatures(into);
  const Eigen::VectorXd cooling = conduction.cooling(heat.T), heat_of_supports = conduction.reaction_heat(heat.T, into);
  const auto name_of = [](const std::string& text) { return text.substr(0, text.find('=')); };
  for (std::size_t s = 0; s < arguments.cooling.size(); ++s)
    heat.leaving.push_back({name_of(arguments.cooling[s]), cooling[static_cast<Eigen::Index>(s)]});
  for (std::size_t s = 0; s < arguments.temperature.size(); ++s)
    heat.leaving.push_back({name_of(arguments.temperature[s]), heat_of_supports[static_cast<Eigen::Index>(s)]});
}

double heat_constant(const char* option, const std::string& text, const char* unit, const char* expected,
                     bool may_be_zero) {
  if (text.empty()) refuse_heat(option, "temperatures without it", expected, "give it on the command line");
  const double value = in_si(option, text, unit);
  if (!(may_be_zero ? value >= 0 : value > 0)) refuse_heat(option, "'" + text + "'", expected);
  return value;
}

}  // namespace

fem::ThermalSurroundings surroundings_of(const SolidArguments& arguments, const fem::Mesh& mesh) {
  fem::ThermalSurroundings surroundings;
  for (const std::string& text : arguments.temperature)
    surroundings.prescribed.push_back(nodes_at_temperature(mesh, text));
  for (const std::string& text : arguments.cooling) surroundings.cooled.push_back(cooled_faces(mesh, text));
  return surroundings;
}

std::optional<SolidHeat> heat_of(const SolidArguments& arguments, const fem::ElasticBody& body) {
  const bool conducts = !arguments.cooling.empty() || !arguments.heat.empty();
  if (!conducts && arguments.temperature.empty()) return std::nullopt;
  const bool uniform = is_uniform(arguments.temperature);
  if (uniform && conducts)
    refuse_heat("--temperature", "one temperature everywhere, and heat that flows", "--temperature SET=80degC");
  fem::ThermalMaterial material;
  material.expansion =
      heat_constant("--expansion", arguments.expansion, "1/K", "a coefficient of expansion such as 12e-6 1/K", true);
  material.conductivity = uniform ? 1
                                  : heat_constant("--conductivity", arguments.conductivity, "W/m/K",
                                                  "a conductivity such as 46W/m/K", false);
  SolidHeat heat{.materials = {}, .T = {}, .rise = {}, .leaving = {}};
  heat.materials.assign(body.materials.size(), material);
  if (uniform)
    heat.T.setConstant(body.node_count(), in_si("--temperature", arguments.temperature.front(), "K"));
  else
    conduct(arguments, body, heat);
  heat.rise = heat.T.array() - in_si("--reference-temperature", arguments.reference_temperature, "K");
  return heat;
}

}  // namespace hersey::cli
