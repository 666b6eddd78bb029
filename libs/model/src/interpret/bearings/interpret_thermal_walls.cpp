#include "hersey/film/thermal_network.h"
#include "interpret/context/interpret.h"
#include "schema/film_vocabulary.h"

namespace hersey::model {
namespace {

/// In the mean over a cycle a node stores nothing.
void require_way_out_of_drains(Context& context) {
  for (const Bearing& bearing : context.model.bearings) {
    const auto* heat = std::get_if<film::ThermalModel>(&bearing.heat);
    if (heat == nullptr || !heat->oil.drain) continue;
    if (film::reaches_surroundings(context.model.thermal.network, heat->oil.drain->node)) continue;
    const Value* value = context.root.find("bearings")->find(bearing.name);
    context.fault_at_key(*value->find("thermal")->find("drains_to"),
                         "oil that drains to '" + heat->oil.drain->name + "', whose heat reaches no surroundings",
                         "a path from there to a node with a `fixed` temperature, or `thermal.walls: transient`");
  }
}

/// Neither does a node of the circuit's oil, nor anything in steady motion.
void require_way_out_of_circuit(Context& context) {
  const std::optional<OilCircuit>& circuit = context.model.circuit;
  if (!circuit || !circuit->temperatures) return;
  const film::ThermalNetworkModel& network = context.model.thermal.network;
  for (const film::ThermalNode& node : circuit->temperatures->added)
    if (node.is_fixed) return;
  for (const std::size_t node : circuit->temperatures->nodes)
    if (node < network.nodes.size() && film::reaches_surroundings(network, node)) return;
  context.faults.push_back(
      {circuit->position, "circuit",
       "oil whose heat reaches no surroundings: neither a node nor a coolant keeps its temperature",
       "a path from the sump to a node with a `fixed` temperature, a cooler, or a node with a "
       "`temperature` of its own",
       ""});
}

}  // namespace

void interpret_thermal_walls(Context& context) {
  Model& model = context.model;
  model.thermal_walls = model.simulation.cycle ? ThermalWalls::cycle_mean : ThermalWalls::transient;
  const Value* thermal = context.root.find("thermal");
  const Value* walls = thermal != nullptr ? thermal->find("walls") : nullptr;
  if (walls != nullptr && !walls->broken) {
    model.thermal_walls = meaning_of(*walls, thermal_walls_words);
    if (model.thermal_walls == ThermalWalls::cycle_mean && !model.simulation.cycle)
      context.fault(*walls, "walls at the mean heat of a cycle, in a machine without cycles",
                    "'transient' or 'frozen', or a `simulation.cycle`");
  }
  if (model.thermal_walls == ThermalWalls::cycle_mean) require_way_out_of_drains(context);
  if (model.thermal_walls == ThermalWalls::cycle_mean || !model.simulation.has_duration())
    require_way_out_of_circuit(context);
  if (model.thermal_walls == ThermalWalls::transient) return;
  for (Bearing& bearing : model.bearings)
    if (auto* heat = std::get_if<film::ThermalModel>(&bearing.heat)) heat->walls = film::WallMotion::fixed;
}

}  // namespace hersey::model
