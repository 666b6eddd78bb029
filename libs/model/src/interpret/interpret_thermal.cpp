#include <numbers>
#include <variant>

#include "interpret/interpret.h"
#include "schema/thermal_walls.h"

namespace hersey::model {
namespace {

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

/// A ring that is none, or a film whose heat has nowhere to go.
void check_walls(Context& context, const Value& thermal, const film::FilmModel& film, const film::ThermalModel& heat) {
  const auto* ring = std::get_if<film::RingWall>(&heat.shell);
  if (ring != nullptr && ring->outer_radius <= film.R) {
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
  const bool leaves = !film::is_closed(film);
  const bool takes = ring != nullptr || std::holds_alternative<film::BodyWall>(heat.shell) ||
                     std::holds_alternative<film::WallAtTemperature>(heat.shell) ||
                     std::holds_alternative<film::WallAtTemperature>(heat.journal);
  if (!leaves && !takes)
    context.fault_at_key(thermal, "closed edges, and walls that take no heat: it has nowhere to go",
                         "a shell or journal that is `given` or a `ring`, or an open edge");
}

film::ThermalModel film_heat(Context& context, const Value& thermal, const film::FilmModel& film) {
  film::ThermalModel heat;
  heat.layers = integer_of(thermal, "layers");
  heat.T_supply = number_of(thermal, "supply_temperature");
  const Value* edges = thermal.find("edge_temperature");
  heat.T_edges = edges != nullptr ? edges->number : heat.T_supply;
  heat.carry_over = number_of(thermal, "carry_over");
  heat.shell = read_alternative(*thermal.find("shell"), shell_walls());
  heat.journal = read_alternative(*thermal.find("journal"), journal_walls());
  if (auto* free = std::get_if<film::FreeJournal>(&heat.journal); free != nullptr && free->heat_capacity == 0)
    free->heat_capacity = heat_of_steel * std::numbers::pi * film.R * film.R * film.L;
  check_walls(context, thermal, film, heat);
  return heat;
}

}  // namespace

void read_thermal(Context& context, const Value& value, const Lubricant* lubricant, Bearing& bearing) {
  const Value* thermal = value.find("thermal");
  if (thermal == nullptr || thermal->broken || context.has_fault_in(thermal->path)) return;
  film::Lubricant& oil = bearing.film.lubricant;
  std::optional<double> T = lubricant != nullptr ? lubricant->temperature : std::nullopt;
  if (thermal->text == "isothermal") {
    if (const Value* given = thermal->find("temperature")) T = given->number;
  } else if (thermal->text == "global") {
    const bearing::GlobalHeat heat = global_heat(context, *thermal);
    T = heat.cools_by_surroundings ? heat.T_ambient : heat.T_supply;
    bearing.heat = heat;
  } else {
    const film::ThermalModel heat = film_heat(context, *thermal, bearing.film);
    T = heat.T_supply;
    bearing.heat = heat;
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
