#include "load_heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "hersey/core/input_error.h"
#include "hersey/film/temperature_law.h"
#include "hersey/model/wall_conduction.h"
#include "option_value.h"
#include "solid_heat.h"

namespace hersey::cli {
namespace {

[[noreturn]] void refuse_load_heat(const char* option, std::string found, std::string expected,
                                   std::string suggestion = "") {
  throw InputError(Fault{{"", 0, 0}, option, std::move(found), std::move(expected), std::move(suggestion)});
}

/// The first option that concerns heat; null: none is given.
const char* heat_option(const LoadsArguments& asked) {
  if (!asked.conductivity.empty()) return "--conductivity";
  if (!asked.expansion.empty()) return "--expansion";
  if (!asked.reference_temperature.empty()) return "--reference-temperature";
  if (!asked.temperature.empty()) return "--temperature";
  if (!asked.cooling.empty()) return "--cooling";
  return nullptr;
}

double constant_of(const char* option, const std::string& text, const char* unit, const char* expected,
                   bool may_be_zero) {
  const double value = in_si(option, text, unit);
  if (!(may_be_zero ? value >= 0 : value > 0)) refuse_load_heat(option, "'" + text + "'", expected);
  return value;
}

/// The body in the model if it conducts heat there; else null.
const model::Body* conducting_in_model(const model::Model& model, const std::string& name) {
  for (const model::Body& body : model.bodies)
    if (body.name == name && body.flexible && body.flexible->heat) return &body;
  return nullptr;
}

/// What cools the body, and nodes of given temperature: by the options, else by the model.
fem::ThermalSurroundings surroundings_for(const LoadsArguments& asked, const model::Model& model,
                                          const model::Body* of_model, const run::BodyLoads& loads) {
  if (asked.temperature.empty() && asked.cooling.empty())
    return of_model == nullptr ? fem::ThermalSurroundings() : model::surroundings_of(model, *of_model);
  for (const std::string& text : asked.temperature)
    if (text.find('=') == std::string::npos)
      refuse_load_heat("--temperature", "'" + text + "'", "a set and a value, SET=80degC");
  SolidArguments solid;
  solid.temperature = asked.temperature, solid.cooling = asked.cooling;
  return surroundings_of(solid, loads.mesh());
}

/// Faces below films give their heat to the film alone.
void spare_films(const run::BodyLoads& loads, std::vector<fem::CooledFaces>& cooled) {
  std::set<std::pair<int, int>> films;
  for (const fem::ElementFace face : loads.faces()) films.emplace(face.element, face.face);
  for (fem::CooledFaces& surface : cooled)
    std::erase_if(surface.faces, [&](fem::ElementFace face) { return films.count({face.element, face.face}) > 0; });
}

/// Temperatures of all nodes, and the heat that comes from the films.
void conduct_from_films(const run::BodyLoads& loads, const run::FilmTemperatures& films, std::size_t materials,
                        LoadHeat& heat) {
  fem::ThermalSurroundings surroundings{.cooled = heat.temperatures.cooled, .prescribed = {}};
  for (const auto& [node, T] : heat.temperatures.prescribed) surroundings.prescribed.push_back({{node}, T});
  const std::vector<fem::ThermalMaterial> of_elements(materials, heat.temperatures.material);
  fem::HeatConduction conduction(loads.mesh(), of_elements, surroundings);
  const solver::FactorSummary summary = conduction.factorise();
  if (summary.status == solver::FactorStatus::singular)
    refuse_load_heat("--cooling", summary.message, "--cooling SURFACE=80W/m^2/K:20degC for that part",
                     "or --temperature SET=80degC");
  if (!summary.solved()) throw std::runtime_error(summary.message);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(loads.mesh().nodes.size()));
  heat.temperatures.T = conduction.temperatures(none);
  const Eigen::VectorXd leaving = conduction.reaction_heat(heat.temperatures.T, none);
  Eigen::Index set = 0;
  for (const auto& [node, T] : heat.temperatures.prescribed) {
    if (std::binary_search(films.nodes.begin(), films.nodes.end(), node)) heat.film_heat -= leaving[set];
    ++set;
  }
  heat.coldest = heat.temperatures.T.minCoeff() - film::zero_celsius;
  heat.warmest = heat.temperatures.T.maxCoeff() - film::zero_celsius;
}

std::string source_of(const run::BodyLoads& loads, bool is_cycle, std::size_t instants) {
  const std::string over = is_cycle        ? "the last cycle"
                           : instants == 1 ? "one instant"
                                           : fmt::format("the time of {} instants", instants);
  return fmt::format("body {}'s own side of its films, mean over {}", loads.body(), over);
}

}  // namespace

std::optional<LoadHeat> heat_of_loads(const LoadsArguments& asked, const model::Model& model,
                                      const run::BodyLoads& loads, const std::vector<std::size_t>& chosen,
                                      std::size_t materials) {
  const char* option = heat_option(asked);
  const model::Body* of_model = conducting_in_model(model, loads.body());
  if (option != nullptr && asked.format == "vtkhdf")
    refuse_load_heat(option, "'vtkhdf' is written", "--loads calculix or nastran",
                     "the surfaces' temperatures are in the .vtkhdf file without it");
  if (option == nullptr && (of_model == nullptr || asked.format == "vtkhdf")) return std::nullopt;
  if (asked.conductivity.empty() && of_model == nullptr)
    refuse_load_heat("--conductivity", fmt::format("{} without it, and no `heat` of body {}", option, loads.body()),
                     "a conductivity such as 46W/m/K");
  const bool is_cycle = loads.cycle().has_value();
  const std::vector<std::size_t> instants = is_cycle ? loads.last_cycle() : chosen;
  const run::FilmTemperatures films = loads.mean_temperatures(instants);
  if (films.surfaces.empty()) {
    if (option == nullptr) return std::nullopt;
    refuse_load_heat(option, fmt::format("the films on body {} have no temperatures", loads.body()),
                     "results of a model whose bearings have `thermal: {model: film}`");
  }
  if (!loads.mesh().ties.empty())
    refuse_load_heat(
        option != nullptr ? option : "--loads",
        fmt::format("the mesh of body {} is tied by equations, across which no heat is conducted", loads.body()),
        "a mesh whose parts have common nodes");
  LoadHeat heat;
  fem::BodyTemperatures& to_write = heat.temperatures;
  if (of_model != nullptr) {
    const model::BodyHeat& given = *of_model->flexible->heat;
    to_write.material = given.material, to_write.T_reference = given.T_reference;
  }
  if (!asked.conductivity.empty())
    to_write.material.conductivity =
        constant_of("--conductivity", asked.conductivity, "W/m/K", "a conductivity such as 46W/m/K", false);
  if (!asked.expansion.empty())
    to_write.material.expansion =
        constant_of("--expansion", asked.expansion, "1/K", "a coefficient of expansion such as 12e-6 1/K", true);
  if (!asked.reference_temperature.empty())
    to_write.T_reference = in_si("--reference-temperature", asked.reference_temperature, "K");
  fem::ThermalSurroundings surroundings = surroundings_for(asked, model, of_model, loads);
  spare_films(loads, surroundings.cooled);
  to_write.cooled = std::move(surroundings.cooled);
  for (const fem::PrescribedNodes& set : surroundings.prescribed)
    for (const int node : set.nodes) to_write.prescribed[node] = set.T;
  for (std::size_t k = 0; k < films.nodes.size(); ++k)
    to_write.prescribed[films.nodes[k]] = films.T[static_cast<Eigen::Index>(k)] + film::zero_celsius;
  to_write.source = source_of(loads, is_cycle, instants.size());
  heat.films = films.surfaces;
  conduct_from_films(loads, films, materials, heat);
  return heat;
}

}  // namespace hersey::cli
