#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <variant>

#include "hersey/film/rising_stress.h"
#include "interpret/context/interpret.h"
#include "schema/thermal_walls.h"

namespace hersey::model {
namespace {

/// Of the walls of the bearing; `heat` is its `thermal`.
std::optional<bearing::WallExpansion> wall_expansion_of(const Value& heat) {
  const Value* given = heat.find("expansion");
  if (given == nullptr || given->broken) return std::nullopt;
  const bool is_of_film = heat.text == "film";
  const auto wall = [&](const char* key) -> std::optional<double> {
    const Value* T = is_of_film ? nullptr : given->find(key);
    return T != nullptr && !T->broken ? std::optional(T->number) : std::nullopt;
  };
  return bearing::WallExpansion{
      .material = {number_of(*given, "shell"), number_of(*given, "journal"), number_of(*given, "reference")},
      .T_shell = wall("shell_temperature"),
      .T_journal = wall("journal_temperature")};
}

/// Clearance of a film of one temperature T between walls that have grown.
void grow(Context& context, const Value& heat, std::optional<double> T, Bearing& bearing) {
  if (!bearing.expansion) return;
  const bearing::WallExpansion& walls = *bearing.expansion;
  const Value& at = *heat.find("expansion");
  if (!T && !(walls.T_shell && walls.T_journal)) {
    context.fault_at_key(at, "walls that expand, and no temperature of theirs",
                         "a `temperature` of the lubricant or of `thermal`, or that of both walls");
    return;
  }
  bearing.growth = walls.growth(bearing.film.R, T.value_or(0));
  if (bearing.film.c + bearing.growth > 0 || bearing.film.c <= 0) return;
  context.fault_at_key(at,
                       fmt::format("a seizure: a clearance of {:.4g} um that closes by {:.4g} um at temperature",
                                   1e6 * bearing.film.c, -1e6 * bearing.growth),
                       "a clearance that stays open: a larger one, a cooler journal or other materials");
}

bearing::GlobalHeat global_heat(Context& context, const Value& thermal) {
  bearing::GlobalHeat heat;
  const Value *supply = thermal.find("supply_temperature"), *cooling = thermal.find("cooling");
  if ((supply == nullptr) == (cooling == nullptr)) {
    context.fault_at_key(thermal,
                         supply == nullptr ? "nothing that takes the heat away" : "two ways for all of the heat",
                         "a 'supply_temperature' (the oil cools) or 'cooling' (the housing does)");
    return heat;
  }
  if (supply != nullptr) heat.T_supply = supply->number;
  if (cooling == nullptr) return heat;
  heat.cools_by_surroundings = true;
  heat.area = number_of(*cooling, "area");
  heat.transfer = number_of(*cooling, "heat_transfer");
  heat.T_ambient = number_of(*cooling, "ambient");
  return heat;
}

/// True of a film around a journal, whose shell and journal have walls of their own kinds.
bool is_bore(const film::FilmModel& film) { return std::holds_alternative<film::Cylinder>(film.surface); }

/// True if oil removes heat between closed edges: an open end draws fresh oil, a supply renews the oil that enters it,
/// or oil passes from one feed to another of lower pressure.
bool oil_is_renewed(const film::FilmModel& film, const film::ThermalModel& heat) {
  const bool has_open_end = std::any_of(film.ends.begin(), film.ends.end(), [](const film::PatchEnds& ends) {
    return ends.first.kind != film::EdgeKind::closed || ends.last.kind != film::EdgeKind::closed;
  });
  if (has_open_end && (heat.carry_over < 1 || !heat.has_grooves)) return true;
  std::vector<double> pressures;
  if (film.supply.kind != film::SupplyKind::none) pressures.push_back(film.supply.pressure);
  for (const film::SurfaceFeature& feature : film.features)
    if (feature.is_fed) pressures.push_back(feature.pressure);
  if (pressures.empty()) return false;
  const auto [least, most] = std::minmax_element(pressures.begin(), pressures.end());
  return heat.carry_over < 1 || *least < *most;
}

/// A ring that is none, or a film whose heat has nowhere to go.
void check_walls(Context& context, const Value& thermal, const film::FilmModel& film, const film::ThermalModel& heat) {
  const auto* ring = std::get_if<film::RingWall>(&heat.shell);
  if (ring != nullptr && !ring->closes && is_bore(film) && film::arcs_of(film) == nullptr)
    context.fault(*thermal.find("shell"), "a pad around a full bore", "a `ring`, or `arcs`");
  if (ring != nullptr && ring->closes && ring->outer_radius <= film.R) {
    context.fault(*thermal.find("shell")->find("outer_diameter"), "a ring no larger than its bore",
                  "an outer diameter above that of the bearing");
  }
  const bool is_fed = film.supply.kind != film::SupplyKind::none || !film.features.empty();
  if (film.cavitation == film::Cavitation::reynolds && is_fed && heat.carry_over > 0) {
    context.fault_at_key(thermal,
                         "grooves that stir the film's oil, with `cavitation: reynolds`, which loses oil and brings it "
                         "back whole: the groove's temperature has no finite answer",
                         "`carry_over: 0`, or `cavitation: mass_conserving`");
  }
  const bool leaves = !film::is_closed(film) || oil_is_renewed(film, heat);
  const bool takes = ring != nullptr || has_node_walls(heat) || std::holds_alternative<film::BodyWall>(heat.shell) ||
                     std::holds_alternative<film::WallAtTemperature>(heat.shell) ||
                     std::holds_alternative<film::BodyJournal>(heat.journal) ||
                     std::holds_alternative<film::WallAtTemperature>(heat.journal);
  if (!leaves && !takes)
    context.fault_at_key(
        thermal, "closed edges, and walls that conduct no heat: no heat can leave",
        (is_bore(film)
             ? std::string("a shell or journal that is `given`, a `ring`, a `body` or a `node`, an open edge, ")
             : "a wall that is `given`, a `pad` or a `node`, an open edge, ") +
            "or a supply that renews its oil (`carry_over` below 1)");
}

/// The key `temperature` of a supply line or a feature; null where it is left to `supply_temperature`.
const Value* temperature_of(const Value* supply) {
  return supply == nullptr || supply->broken ? nullptr : supply->find("temperature");
}

/// Node of the thermal network that a feed's node of the circuit is; none where the circuit's oil has one temperature.
std::optional<film::NetworkNode> node_of_circuit(const Context& context, const Value* feature) {
  const std::optional<OilCircuit>& circuit = context.model.circuit;
  const Value* name = feature != nullptr ? feature->find("circuit") : nullptr;
  if (name == nullptr || !circuit || !circuit->temperatures) return std::nullopt;
  const auto found = circuit->find_node(name->text);
  if (!found) return std::nullopt;
  return film::NetworkNode{.T = circuit->temperatures->T[*found],
                           .node = circuit->temperatures->nodes[*found],
                           .name = name->text,
                           .takes_back = true};
}

/// Where oil comes from and goes to, and how warm it comes.
void read_supplies(Context& context, const Value& bearing, const film::FilmModel& film, film::ThermalModel& heat) {
  const Value& thermal = *bearing.find("thermal");
  const OwnTemperature all = own_temperature(context, thermal.find("supply_temperature")).value_or(OwnTemperature{});
  heat.T_supply = all.T;
  const auto edges = own_temperature(context, thermal.find("edge_temperature")).value_or(all);
  heat.T_edges = edges.T, heat.oil.edges = edges.node;
  const auto line = own_temperature(context, temperature_of(bearing.find("supply")));
  if (line) heat.T_line = line->T;
  if (film.supply.kind != film::SupplyKind::none) heat.oil.line = line ? line->node : all.node;
  const Value* features = bearing.find("features");
  for (const film::SurfaceFeature& feature : film.features) {
    const Value* value = features != nullptr ? features->find(feature.name) : nullptr;  // a pad's step is a shape
    const Value* const temperature = temperature_of(value);
    const auto own = own_temperature(context, temperature);
    if (own && temperature != nullptr && !feature.is_fed)
      context.fault(*temperature, "a temperature of a pocket that nothing feeds",
                    "a `pressure` that feeds it, or no temperature: it holds the film's own oil");
    const auto of_circuit = node_of_circuit(context, value);
    if (of_circuit && temperature != nullptr)
      context.fault(*temperature, "a temperature of a feed whose node of the circuit has one", "one of both");
    heat.T_features.push_back(of_circuit ? of_circuit->T : own.value_or(all).T);
    heat.oil.features.push_back(of_circuit ? of_circuit : own.value_or(all).node);
  }
  if (const Value* drain = thermal.find("drains_to"); drain != nullptr && !drain->broken)
    heat.oil.drain = network_node(context, *drain);
}

/// Supplies' temperatures without a film that has any.
void warn_of_unused_temperatures(Context& context, const Value& bearing) {
  const auto warn = [&](const Value& supply) {
    if (temperature_of(&supply) == nullptr || temperature_of(&supply)->broken) return;
    const Value& T = *supply.find("temperature");
    context.model.warnings.push_back({T.position, T.path, "a temperature of a supply that the film does not ask for",
                                      "`thermal: {model: film, ...}`, or none",
                                      "with one temperature of the oil there is no other"});
  };
  if (const Value* line = bearing.find("supply"); line != nullptr) warn(*line);
  for (const auto& [name, feature] : section(bearing, "features")) warn(feature);
}

/// Completes the data of walls besides their own keys: tables over the angle, nodes of the network.
void complete_walls(Context& context, const Value& thermal, const WallKeys& walls, const film::FilmModel& film,
                    film::ThermalModel& heat) {
  const film::Grid& grid = film.grid;
  const Value &shell = *thermal.find(walls.fixed), &journal = *thermal.find(walls.moving);
  if (is_bore(film) && std::holds_alternative<film::WallAtTemperature>(heat.shell))
    heat.shell = wall_at_temperature(context, *shell.find("temperature"), grid);
  if (std::holds_alternative<film::NodeWall>(heat.shell)) heat.shell = node_wall_of(context, shell);
  if (std::holds_alternative<film::NodeWall>(heat.journal)) heat.journal = node_wall_of(context, journal);
  auto* ring = std::get_if<film::RingWall>(&heat.shell);
  if (ring == nullptr) return;
  if (!ring->closes) ring->outer_radius += film.R;  // read as a thickness
  const auto ambient = own_temperature(context, shell.find("ambient"));
  if (ambient) ring->T_ambient = ambient->T, ring->surroundings = ambient->node;
}

/// Material of the shell or the journal, by which the heat of asperities is shared; steel by default.
film::SurfaceMaterial surface_of(Context& context, const Value& bearing, const std::string& wall) {
  const Value* materials = bearing.find("materials");
  const Value* material = materials != nullptr && !materials->broken ? materials->find(wall) : nullptr;
  if (material == nullptr || material->broken || !material->has("conductivity") || !material->has("specific_heat"))
    return {};
  const double density = number_of(*material, "density");
  if (!(density > 0)) {
    context.fault_at_key(*material, "a material with a `specific_heat` and no `density`",
                         "its `density` as well: heat is stored by their product", "steel has 7850 kg/m^3");
    return {};
  }
  return {.conductivity = number_of(*material, "conductivity"),
          .heat_capacity = density * number_of(*material, "specific_heat")};
}

// Layers share the film's stress: where that stops rising, rates are anything.
void check_shear(Context& context, const Value& thermal, int layers, const film::ShearThinning& oil) {
  if (layers == 1 || film::has_rising_stress(oil)) return;
  context.fault(
      thermal, "layers of an oil whose shear stress all but stops rising as it is sheared faster",
      fmt::format("a limit_ratio of at least {:g} in the oil's shear_thinning, or the tenth power of the rate "
                  "or more (an exponent of at least 0.1 in carreau, at most 0.9 in cross); or 'layers: 1'",
                  film::least_limit),
      "each layer is sheared at the rate that its stress takes");
}

/// The temperature of what pads around a journal stand in, if they grow.
void read_carrier(Context& context, const Value& thermal, const film::FilmModel& film, film::ThermalModel& heat) {
  const Value* T = thermal.find("shell")->find("carrier");
  if (T == nullptr || T->broken) return;
  if (!heat.expansion) {
    context.fault_at_key(*T, "a carrier of pads that keep their size", "an `expansion` of shell and journal beside it");
    return;
  }
  heat.expansion->carrier = {.T = T->number, .thickness = std::get<film::RingWall>(heat.shell).outer_radius - film.R};
}

/// How a clearance follows walls around a journal.
void read_expansion(Context& context, const Value& thermal, const film::FilmModel& film, film::ThermalModel& heat) {
  if (const auto expansion = wall_expansion_of(thermal)) heat.expansion = expansion->material;
  read_carrier(context, thermal, film, heat);
  if (heat.expansion && heat.expansion->shell != 0 && std::holds_alternative<film::BodyWall>(heat.shell)) {
    context.fault(*thermal.find("expansion"), "a shell that grows by its body's mesh and by a coefficient as well",
                  "'shell: 0 1/K' beside 'shell: {wall: body}'", "the body's `heat.expansion` says how the bore grows");
  }
  if (heat.expansion && heat.expansion->journal != 0 && std::holds_alternative<film::BodyJournal>(heat.journal)) {
    context.fault(*thermal.find("expansion"), "a journal that grows by its body's mesh and by a coefficient as well",
                  "'journal: 0 1/K' beside 'journal: {wall: body}'",
                  "the body's `heat.expansion` says how the journal grows");
  }
}

/// Of the journal in the bearing; of a runner as thick as the film is wide: a disc, or a plate of the pad's size [m^3].
double volume_of_moving(const film::FilmModel& film) {
  const double outer = is_bore(film) ? film.R : film.R + 0.5 * film.L;
  if (film::closes(film.surface)) return std::numbers::pi * outer * outer * film.L;
  return film.R * (film.grid.phi(film.grid.n_phi - 1) - film.grid.phi(0)) * film.L * film.L;
}

film::ThermalModel film_heat(Context& context, const Value& value, const WallKeys& walls, const film::FilmModel& film) {
  const Value& thermal = *value.find("thermal");
  film::ThermalModel heat;
  heat.layers = integer_of(thermal, "layers");
  check_shear(context, thermal, heat.layers, film.lubricant.shear_thinning);
  heat.carry_over = number_of(thermal, "carry_over");
  heat.shell_surface = surface_of(context, value, walls.fixed);
  heat.journal_surface = surface_of(context, value, walls.moving);
  heat.shell = read_alternative(*thermal.find(walls.fixed), is_bore(film) ? shell_walls() : pad_walls());
  heat.journal = read_alternative(*thermal.find(walls.moving), is_bore(film) ? journal_walls() : runner_walls());
  if (auto* free = std::get_if<film::FreeJournal>(&heat.journal); free != nullptr && free->heat_capacity == 0)
    free->heat_capacity = heat_of_steel * volume_of_moving(film);
  complete_walls(context, thermal, walls, film, heat);
  read_supplies(context, value, film, heat);
  // On a plane nothing leads the oil behind a pad back before it.
  heat.has_grooves = !film.ends.empty() && film::closes(film.surface);
  if (is_bore(film)) read_expansion(context, thermal, film, heat);
  check_walls(context, thermal, film, heat);
  return heat;
}

/// Temperatures of a model of heat at which the oil is not known.
void warn_of_temperatures(Context& context, const Value& thermal, const Lubricant& lubricant) {
  for (const char* key : {"temperature", "supply_temperature", "edge_temperature"}) {
    const auto is_key = [&](const Member& member) { return member.key == key; };
    const auto found = std::find_if(thermal.members.begin(), thermal.members.end(), is_key);
    if (found == thermal.members.end() || !found->value.given || found->value.broken) continue;
    const bool is_any = found->value.type->kind == Type::Kind::any_of && !found->value.members.empty();
    const Value& given = is_any ? found->value.members.front().value : found->value;
    if (given.type->kind == Type::Kind::quantity)
      warn_of_temperature(context, given, lubricant.validity, lubricant.name);
  }
}

}  // namespace

void read_flat_heat(Context& context, const Value& value, const WallKeys& walls, const Lubricant* lubricant,
                    Bearing& bearing) {
  const Value* thermal = value.find("thermal");
  if (thermal == nullptr || thermal->broken || context.has_fault_in(value.path)) return;
  if (thermal->text != "film") return warn_of_unused_temperatures(context, value);
  if (const Value* T = value.find("temperature"); T != nullptr && !T->broken) {
    context.fault_at_key(*T,
                         "one temperature of the oil beside `thermal: {model: film}`, which finds those of the film",
                         "`thermal`, or `temperature` with `thermal: isothermal`");
    return;
  }
  const film::ThermalModel heat = film_heat(context, value, walls, bearing.film);
  if (lubricant != nullptr) {
    bearing.validity = lubricant->validity;
    warn_of_temperatures(context, *thermal, *lubricant);
  }
  bearing.film.lubricant = film::at_temperature(bearing.film.lubricant, heat.T_supply);
  bearing.heat = heat;
}

void read_thermal(Context& context, const Value& value, const Lubricant* lubricant, Bearing& bearing) {
  const Value* thermal = value.find("thermal");
  if (thermal == nullptr || thermal->broken || context.has_fault_in(thermal->path)) return;
  film::Lubricant& oil = bearing.film.lubricant;
  std::optional<double> T = lubricant != nullptr ? lubricant->temperature : std::nullopt;
  bearing.expansion = wall_expansion_of(*thermal);
  if (thermal->text != "film") warn_of_unused_temperatures(context, value);
  if (thermal->text == "isothermal") {
    if (const Value* given = thermal->find("temperature")) T = given->number;
    grow(context, *thermal, T, bearing);
  } else if (thermal->text == "global") {
    bearing::GlobalHeat heat = global_heat(context, *thermal);
    T = heat.cools_by_surroundings ? heat.T_ambient : heat.T_supply;
    heat.expansion = bearing.expansion;
    bearing.heat = heat;
  } else {
    const film::ThermalModel heat = film_heat(context, value, {}, bearing.film);
    T = heat.T_supply;
    bearing.heat = heat;
  }
  if (lubricant != nullptr) {
    bearing.validity = lubricant->validity;
    warn_of_temperatures(context, *thermal, *lubricant);
  }
  if (T) {
    oil = film::at_temperature(oil, *T);
    return;
  }
  if (lubricant == nullptr || !film::depends_on_temperature(oil.temperature_law)) return;
  context.fault_at_key(value,
                       "an oil '" + lubricant->name + "' whose viscosity falls with temperature, and no temperature",
                       "a `temperature` of the lubricant, or a bearing with `thermal`");
}

}  // namespace hersey::model
