// The section `circuit`, and what of it cannot be solved.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "hersey/core/spelling.h"
#include "hersey/core/two_pi.h"
#include "interpret/context/interpret.h"
#include "schema/circuit_vocabulary.h"

namespace hersey::model {
namespace {

/// Reads nodes and elements of one circuit.
class CircuitReader {
 public:
  CircuitReader(Context& context, const Value& value, OilCircuit& circuit)
      : context_(context), value_(value), circuit_(circuit) {}

  void read() {
    circuit_.position = value_.key_position;
    find_first_temperature();
    read_oil();
    for (const auto& [name, node] : section(value_, "nodes")) read_node(name, node);
    for (const auto& [name, element] : section(value_, "elements")) read_element(name, element);
  }

 private:
  /// The oil carries heat along where a node has a temperature.
  void find_first_temperature() {
    for (const auto& [name, node] : section(value_, "nodes")) {
      const auto own = own_temperature(context_, node.find("temperature"));
      if (own && !circuit_.temperatures) circuit_.temperatures.emplace(), T_first_ = own->T;
    }
  }

  void read_oil() {
    const Value* name = value_.find("lubricant");
    if (name == nullptr) return;
    circuit_.lubricant = name->text;
    require_name(context_, *name, "lubricants", "lubricant");
    for (const Lubricant& lubricant : context_.model.lubricants) {
      if (lubricant.name != name->text) continue;
      const Value* given = value_.find("temperature");
      std::optional<double> T =
          given != nullptr && !given->broken ? std::optional(given->number) : lubricant.temperature;
      if (!T) T = T_first_;
      if (!T && film::depends_on_temperature(lubricant.data.temperature_law))
        context_.fault_at_key(
            value_, "an oil '" + lubricant.name + "' whose viscosity falls with temperature, and no temperature",
            "a `temperature` of the lubricant or of this circuit");
      const film::Lubricant oil = T ? film::at_temperature(lubricant.data, *T) : lubricant.data;
      circuit_.network.oil = {.mu = oil.mu0, .density = oil.density};
      if (!circuit_.temperatures) continue;
      circuit_.temperatures->heat_capacity = oil.density * oil.specific_heat;
      circuit_.temperatures->law = oil.temperature_law;
      if (!film::depends_on_temperature(oil.temperature_law))
        circuit_.temperatures->law = film::FixedViscosity{oil.mu0};
      T_start_ = T.value_or(T_start_);
    }
  }

  /// Index of a temperature in the thermal network: of the node that it is, or of one added behind all others.
  [[nodiscard]] std::size_t network_index(const OwnTemperature& own, const std::string& name) {
    if (own.node) return own.node->node;
    return added({.name = name, .T = own.T, .is_fixed = true});
  }

  std::size_t added(film::ThermalNode node) {
    circuit_.temperatures->added.push_back(std::move(node));
    return context_.model.thermal.network.nodes.size() + circuit_.temperatures->added.size() - 1;
  }

  void read_temperature(const Value& node, const circuit::Node& read) {
    if (!circuit_.temperatures) return;
    CircuitTemperatures& all = *circuit_.temperatures;
    const Value* given = node.find("temperature");
    if (given == nullptr && read.is_given) {
      context_.fault_at_key(node, "a sump or supply without a temperature, in a circuit whose nodes have some",
                            "a `temperature` of its own, or that of a node of `thermal`");
    }
    const auto own = own_temperature(context_, given);
    all.T.push_back(own ? own->T : T_start_);
    const double volume = read.storage ? read.storage->volume : 0;
    all.nodes.push_back(
        own ? network_index(*own, read.name)
            : added({.name = read.name, .heat_capacity = all.heat_capacity * volume, .T = T_start_, .is_oil = true}));
  }

  void read_coolant(const std::string& name, const Value& element) {
    const Value* coolant = element.text == "cooler" ? element.find("coolant") : nullptr;
    if (!circuit_.temperatures) {
      if (coolant != nullptr)
        context_.fault_at_key(element, "a cooler in a circuit whose oil has one temperature",
                              "a `temperature` of the nodes that have a pressure, or a `resistance`");
      return;
    }
    const auto own = own_temperature(context_, coolant);
    circuit_.temperatures->coolants.push_back(own ? network_index(*own, name) : 0);
  }

  void read_node(const std::string& name, const Value& node) {
    circuit::Node read{.name = name};
    circuit_.pressures.emplace_back();
    if (const Value* pressure = node.find("pressure")) {
      read.is_given = true;
      circuit_.pressures.back() = function_of(context_, *pressure, "Pa");
      require_function_of_time(context_, *circuit_.pressures.back(), "a pressure of a node");
    }
    if (node.find("volume") != nullptr)
      read.storage = circuit::Storage{.volume = number_of(node, "volume"),
                                      .wall_compliance = number_of(node, "compliance"),
                                      .bulk_modulus = number_of(node, "bulk_modulus"),
                                      .free_air = number_of(node, "free_air"),
                                      .solubility = number_of(node, "solubility")};
    read.p_cav = number_of(value_, "cavitation_pressure");
    read_temperature(node, read);
    circuit_.network.nodes.push_back(std::move(read));
    circuit_.node_positions.push_back(node.key_position);
  }

  [[nodiscard]] std::optional<std::size_t> end_of(const Value& element, const std::string& key) {
    const Value* name = element.find(key);
    if (name == nullptr || name->broken) return std::nullopt;
    if (const auto found = circuit_.find_node(name->text)) return found;
    const std::vector<std::string> names = names_in(value_, "nodes");
    context_.fault(*name, "unknown node '" + name->text + "'", one_of(names), did_you_mean(name->text, names));
    return std::nullopt;
  }

  void read_element(const std::string& name, const Value& element) {
    if (element.broken) return;
    const auto from = end_of(element, "from"), to = end_of(element, "to");
    circuit::Element read{.name = name, .from = from.value_or(0), .to = to.value_or(0), .law = law_of(element)};
    const bool is_pump = element.text == "pump", rotates = element.find("radii") != nullptr;
    if (is_pump || rotates) read.shaft = shaft_of(element, is_pump);
    if (element.text == "hole_over_groove") {
      read.hole = circuit_.holes.size();
      circuit_.holes.push_back({.bearing = text_of(element, "bearing"),
                                .hole = text_of(element, "hole"),
                                .groove = text_of(element, "groove")});
    }
    if (rotates && element.find("radii")->members.size() == 2) {
      read.r_from = element.find("radii")->members[0].value.number;
      read.r_to = element.find("radii")->members[1].value.number;
    }
    if (element.text == "drilling" && meaning_of(element, "course", course_words) == Course::through_axis)
      read.passes_axis = passes_axis(element, read);
    if (!is_pump && !rotates && element.text == "drilling")
      for (const char* key : {"speed", "joint"})
        if (const Value* given = element.find(key))
          context_.fault_at_key(*given, "a rotation of a drilling without `radii`",
                                "radii: [30 mm, 55 mm], or no rotation");
    if (!from || !to) return;
    if (*from == *to) return context_.fault(*element.find("to"), "an element from a node to itself", "two nodes");
    read_coolant(name, element);
    circuit_.network.elements.push_back(std::move(read));
    circuit_.element_positions.push_back(element.key_position);
  }

  [[nodiscard]] bool passes_axis(const Value& element, const circuit::Element& read) {
    if (read.r_from > 0 && read.r_to > 0) return true;
    context_.fault(*element.find("course"), "a drilling through an axis without a distance from it at either end",
                   "radii: [30 mm, 55 mm], above 0");
    return false;
  }

  [[nodiscard]] circuit::Law law_of(const Value& element) {
    const std::string& type = element.text;
    if (type == "drilling")
      return circuit::Drilling{number_of(element, "length"), number_of(element, "diameter"),
                               number_of(element, "roughness"), number_of(element, "loss_coefficient"),
                               meaning_of(element, "friction", friction_words)};
    if (type == "orifice")
      return circuit::Orifice{number_of(element, "diameter"), number_of(element, "discharge_coefficient")};
    if (type == "resistance") return circuit::Resistance{number_of(element, "resistance")};
    if (type == "cooler") return circuit::Cooler{number_of(element, "resistance"), number_of(element, "conductance")};
    if (type == "relief_valve") return valve_of(element);
    if (type == "pump")
      return circuit::DisplacementPump{number_of(element, "displacement") / two_pi, number_of(element, "leakage"),
                                       number_of(element, "mechanical_efficiency")};
    if (type == "hole_over_groove") return circuit::HoleOverGroove{number_of(element, "discharge_coefficient")};
    if (type == "pump_curve")
      if (const Value* curve = element.find("flow"))
        return circuit::PumpCurve{function_of(context_, *curve, "m^3/s", {"rise", "Pa"}).value};
    return circuit::GivenFlow{number_of(element, "flow")};
  }

  [[nodiscard]] circuit::Law valve_of(const Value& element) {
    const circuit::ReliefValve valve{number_of(element, "opening_pressure"), number_of(element, "conductance")};
    const Value* opening = element.find("opening_pressure");
    if (opening != nullptr && !opening->broken && valve.opening_pressure <= 0)
      context_.fault(*opening,
                     fmt::format("a relief valve that opens at {:.4g} bar, not above ambient pressure",
                                 1e-5 * valve.opening_pressure),
                     "a drop of pressure above 0, such as 4 bar");
    return valve;
  }

  [[nodiscard]] std::size_t shaft_of(const Value& element, bool is_pump) {
    CircuitShaft shaft{.ratio = number_of(element, "ratio")};
    const Value *speed = element.find("speed"), *joint = element.find("joint");
    if ((speed != nullptr) == (joint != nullptr))
      context_.fault_at_key(element, speed != nullptr ? "'speed' and 'joint'" : "neither 'speed' nor 'joint'",
                            "one of both");
    if (speed != nullptr) shaft.speed = number_of(element, "speed") * shaft.ratio;
    if (joint != nullptr) {
      const auto coordinate = coordinate_of(context_, element);
      if (coordinate && !coordinate->rotational)
        context_.fault(*element.find("coordinate"), "coordinate '" + coordinate->name + "', a displacement",
                       "a rotation");
      shaft.on = CoordinateName{joint->text, text_of(element, "coordinate")};
    }
    if (is_pump && !context_.has_fault_in(element.path)) require_forward(element, shaft);
    circuit_.shafts.push_back(std::move(shaft));
    return circuit_.shafts.size() - 1;
  }

  /// As far as it is known before the run: from a speed, or from a drive with a constant one.
  void require_forward(const Value& element, const CircuitShaft& shaft) {
    double speed = shaft.speed;
    for (const Drive& drive : context_.model.drives)
      if (shaft.on && drive.joint == shaft.on->joint && drive.coordinate == shaft.on->coordinate &&
          drive.prescribes == Drive::Prescribes::speed && drive.motion.value != nullptr && drive.motion.is_constant())
        speed = drive.motion.value->value({}) * shaft.ratio;
    if (speed >= 0) return;
    context_.fault_at_key(element, fmt::format("a pump that turns backwards, at {:.4g} rpm", speed * 60 / two_pi),
                          "a speed of at least 0", "a negative `ratio` turns it the other way than its joint");
  }

  Context& context_;
  const Value& value_;
  OilCircuit& circuit_;
  std::optional<double> T_first_;  // of the first node that has one
  double T_start_ = 0;             // of nodes without a temperature of their own
};

/// Nodes between which pressures are related, as sets with one representative each.
class NodeSets {
 public:
  explicit NodeSets(std::size_t count) : first_(count) { std::iota(first_.begin(), first_.end(), std::size_t{0}); }
  [[nodiscard]] std::size_t of(std::size_t node) const { return first_[node] == node ? node : of(first_[node]); }
  void join(std::size_t a, std::size_t b) { first_[of(a)] = of(b); }

 private:
  std::vector<std::size_t> first_;
};

/// True if the flow of an element depends on pressures, whatever the angles of shafts: a hole over a groove may be
/// shut.
bool relates_pressures(const circuit::Element& element) {
  if (element.hole) return false;
  if (const auto* pump = std::get_if<circuit::DisplacementPump>(&element.law)) return pump->leakage > 0;
  return !std::holds_alternative<circuit::GivenFlow>(element.law);
}

bool is_source(const circuit::Element& element) {
  return std::holds_alternative<circuit::DisplacementPump>(element.law) ||
         std::holds_alternative<circuit::PumpCurve>(element.law) ||
         std::holds_alternative<circuit::GivenFlow>(element.law);
}

}  // namespace

void interpret_circuit(Context& context) {
  const Value* value = context.root.find("circuit");
  if (value == nullptr || value->broken) return;
  context.model.circuit.emplace();
  CircuitReader(context, *value, *context.model.circuit).read();
}

std::optional<std::size_t> circuit_node(Context& context, const Value& name) {
  if (name.broken) return std::nullopt;
  if (!context.model.circuit) {
    context.fault(name, "a node '" + name.text + "' of a circuit, and no circuit",
                  "a section `circuit` with this node");
    return std::nullopt;
  }
  if (const auto found = context.model.circuit->find_node(name.text)) return found;
  const std::vector<std::string> names = names_in(*context.root.find("circuit"), "nodes");
  context.fault(name, "unknown node '" + name.text + "' of the circuit", one_of(names), did_you_mean(name.text, names));
  return std::nullopt;
}

namespace {

/// The oil of a node ceases to fill it where it ceases to fill the films that draw there.
void require_one_cavitation_pressure(Context& context) {
  std::vector<const Bearing*> first(context.model.circuit->network.nodes.size(), nullptr);
  for (const Bearing& bearing : context.model.bearings)
    for (const CircuitPort& port : bearing.circuit_ports) {
      const Bearing*& other = first[port.node];
      if (other == nullptr) other = &bearing;
      if (bearing.film.p_cav == other->film.p_cav) continue;
      context.faults.push_back(
          {bearing.position, "bearings." + bearing.name,
           fmt::format("a cavitation pressure of {:.4g} bar, and {:.4g} bar of bearing '{}' on the same node '{}'",
                       1e-5 * bearing.film.p_cav, 1e-5 * other->film.p_cav, other->name,
                       context.model.circuit->network.nodes[port.node].name),
           "one cavitation pressure of all bearings on a node, or a node for each", ""});
    }
}

}  // namespace

void check_circuit(Context& context) {
  if (!context.model.circuit || !context.faults.empty()) return;  // names may be undefined
  require_one_cavitation_pressure(context);
  const OilCircuit& circuit = *context.model.circuit;
  const std::vector<circuit::Node>& nodes = circuit.network.nodes;
  std::vector<bool> has_element(nodes.size(), false), has_port(nodes.size(), false), has_level(nodes.size(), false);
  NodeSets sets(nodes.size());
  bool has_source = false;
  for (const circuit::Element& element : circuit.network.elements) {
    has_element[element.from] = has_element[element.to] = true;
    if (relates_pressures(element)) sets.join(element.from, element.to);
    has_source = has_source || is_source(element);
  }
  for (const Bearing& bearing : context.model.bearings)
    for (const CircuitPort& port : bearing.circuit_ports) {
      has_port[port.node] = true;
      if (has_element[port.node] || nodes[port.node].is_given) continue;
      const std::string path = "bearings." + bearing.name + ".features." + bearing.film.features[port.feature].name;
      context.faults.push_back(
          {context.model.position_of(path), path,
           "a feed from node '" + nodes[port.node].name + "', which no element of the circuit meets",
           "a node that an element leads to", ""});
    }
  // Films drain to their edges, whose pressures are given.
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (nodes[k].is_given) has_source = true;
    if (nodes[k].is_given || has_port[k]) has_level[sets.of(k)] = true;
  }
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const std::string path = "circuit.nodes." + nodes[k].name;
    if (!has_element[k] && !has_port[k]) {
      context.model.warnings.push_back({circuit.node_positions[k], path, "a node that no element and no feed leads to",
                                        "an element to another node, or none of that name", ""});
    } else if (!has_level[sets.of(k)]) {
      context.faults.push_back({circuit.node_positions[k], path,
                                "a pressure without a level: nothing that depends on it leads to a given pressure",
                                "a drilling, valve or film between it and a node with a `pressure`", ""});
    }
  }
  if (!has_source)
    context.faults.push_back({circuit.position, "circuit", "a circuit without a source",
                              "a pump, a `flow`, or a node with a `pressure`", ""});
}

}  // namespace hersey::model
