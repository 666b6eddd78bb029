#include <algorithm>
#include <variant>

#include "hersey/core/spelling.h"
#include "hersey/film/film_terminals.h"
#include "interpret/context/interpret.h"

// Lumped bodies and surroundings, and which walls they are.
namespace hersey::model {
namespace {

/// Index of the node called `name`; reports a missing one.
std::optional<std::size_t> node_called(Context& context, const Value& name) {
  if (name.broken) return std::nullopt;
  const std::vector<film::ThermalNode>& nodes = context.model.thermal.network.nodes;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (nodes[k].name == name.text) return k;
    names.push_back(nodes[k].name);
  }
  context.fault(name, "unknown thermal node '" + name.text + "'",
                names.empty() ? "a node, but the model has no `thermal: {nodes: ...}`" : one_of(names),
                did_you_mean(name.text, names));
  return std::nullopt;
}

void read_path(Context& context, const std::string& name, const Value& value) {
  const Value* between = value.find("between");
  if (between == nullptr || between->broken || between->members.size() != 2) return;
  const auto a = node_called(context, between->members[0].value), b = node_called(context, between->members[1].value);
  if (!a || !b) return;
  if (*a == *b) return context.fault(*between, "a path from a node to itself", "two nodes");
  context.model.thermal.network.paths.push_back({name, *a, *b, number_of(value, "conductance")});
}

}  // namespace

std::optional<film::NetworkNode> network_node(Context& context, const Value& name) {
  const auto node = node_called(context, name);
  if (!node) return std::nullopt;
  const film::ThermalNode& found = context.model.thermal.network.nodes[*node];
  return film::NetworkNode{.T = found.T, .node = *node, .name = found.name};
}

film::NodeWall node_wall_of(Context& context, const Value& wall) {
  const Value* name = wall.find("node");
  return name == nullptr ? film::NodeWall{} : network_node(context, *name).value_or(film::NodeWall{});
}

std::optional<OwnTemperature> own_temperature(Context& context, const Value* value) {
  if (value == nullptr || value->broken || value->members.empty()) return std::nullopt;
  const Value& content = value->members.front().value;
  if (content.broken) return std::nullopt;
  if (content.type->kind == Type::Kind::quantity) return OwnTemperature{content.number};
  const auto node = network_node(context, *content.find("node"));
  return node ? std::optional(OwnTemperature{node->T, node}) : std::nullopt;
}

void interpret_thermal_network(Context& context) {
  const Value* thermal = context.root.find("thermal");
  if (thermal == nullptr || thermal->broken) return;
  for (const auto& [name, value] : section(*thermal, "nodes")) {
    const Value* fixed = value.find("fixed");
    film::ThermalNode node{.name = name, .is_fixed = fixed != nullptr};
    node.heat_capacity = number_of(value, "heat_capacity");
    node.T = fixed != nullptr ? fixed->number : number_of(value, "temperature");
    const Value* start = value.find("temperature");
    if (fixed != nullptr && start != nullptr && start->given)
      context.fault(*start, "a temperature at the start of surroundings that keep theirs", "`fixed` alone");
    context.model.thermal.network.nodes.push_back(std::move(node));
    context.model.thermal.positions.push_back(value.key_position);
  }
  for (const auto& [name, value] : section(*thermal, "paths")) read_path(context, name, value);
}

void check_thermal_network(Context& context) {
  if (!context.faults.empty()) return;  // names may be undefined
  const film::ThermalNetworkModel& network = context.model.thermal.network;
  std::vector<bool> is_met(network.nodes.size(), false);
  for (const film::ThermalPath& path : network.paths) is_met[path.a] = is_met[path.b] = true;
  for (const Bearing& bearing : context.model.bearings) {
    const auto* heat = std::get_if<film::ThermalModel>(&bearing.heat);
    if (heat == nullptr) continue;
    for (const auto& [terminal, node] : film::terminals_of(*heat).nodes())
      if (static_cast<std::size_t>(node) < is_met.size()) is_met[static_cast<std::size_t>(node)] = true;
  }
  if (context.model.circuit && context.model.circuit->temperatures) {
    const CircuitTemperatures& of_circuit = *context.model.circuit->temperatures;
    for (const std::size_t node : of_circuit.nodes)
      if (node < is_met.size()) is_met[node] = true;
    for (std::size_t e = 0; e < of_circuit.coolants.size(); ++e)
      if (std::holds_alternative<circuit::Cooler>(context.model.circuit->network.elements[e].law) &&
          of_circuit.coolants[e] < is_met.size())
        is_met[of_circuit.coolants[e]] = true;
  }
  for (std::size_t k = 0; k < is_met.size(); ++k) {
    if (is_met[k]) continue;
    context.model.warnings.push_back(
        {context.model.thermal.positions[k], "thermal.nodes." + network.nodes[k].name,
         "a node that no path and no bearing leads to",
         "a path to another node, or a wall `{wall: node, node: " + network.nodes[k].name + "}`", ""});
  }
}

}  // namespace hersey::model
