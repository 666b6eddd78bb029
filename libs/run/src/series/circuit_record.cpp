#include "series/circuit_record.h"

#include <string>
#include <variant>
#include <vector>

#include "hersey/film/temperature_law.h"

namespace hersey::run {
namespace {

using CircuitRow = bearing::CircuitObservation;
using CircuitStatistic = SummaryEntry::Statistic;

std::vector<std::string> node_names(const model::OilCircuit& circuit) {
  std::vector<std::string> names;
  for (const circuit::Node& node : circuit.network.nodes) names.push_back(node.name);
  return names;
}

std::vector<std::string> element_names(const model::OilCircuit& circuit) {
  std::vector<std::string> names;
  for (const circuit::Element& element : circuit.network.elements) names.push_back(element.name);
  return names;
}

std::vector<std::string> warm_node_names(const model::OilCircuit& circuit) {
  return circuit.temperatures ? node_names(circuit) : std::vector<std::string>{};
}

/// Indices of coolers among the elements.
std::vector<std::size_t> coolers(const model::OilCircuit& circuit) {
  std::vector<std::size_t> indices;
  for (std::size_t e = 0; e < circuit.network.elements.size(); ++e)
    if (std::holds_alternative<circuit::Cooler>(circuit.network.elements[e].law)) indices.push_back(e);
  return indices;
}

std::vector<std::string> cooler_names(const model::OilCircuit& circuit) {
  std::vector<std::string> names;
  for (const std::size_t e : coolers(circuit)) names.push_back(circuit.network.elements[e].name);
  return names;
}

std::vector<std::string> axis_names(const model::OilCircuit& circuit) {
  std::vector<std::string> names;
  for (const circuit::Element& element : circuit.network.elements)
    if (element.passes_axis) names.push_back(element.name);
  return names;
}

bool has_temperatures(const model::OilCircuit& circuit) { return circuit.temperatures.has_value(); }

std::vector<std::string> hole_names(const model::OilCircuit& circuit) {
  std::vector<std::string> names(circuit.holes.size());
  for (const circuit::Element& element : circuit.network.elements)
    if (element.hole) names[*element.hole] = element.name;
  return names;
}

bool has_sources(const model::OilCircuit& circuit) {
  for (const circuit::Element& element : circuit.network.elements)
    if (std::holds_alternative<circuit::DisplacementPump>(element.law) ||
        std::holds_alternative<circuit::PumpCurve>(element.law) ||
        std::holds_alternative<circuit::GivenFlow>(element.law))
      return true;
  return false;
}

/// The words of the model file.
struct TypeOfLaw {
  std::string operator()(const circuit::Drilling& /*law*/) const { return "drilling"; }
  std::string operator()(const circuit::Orifice& /*law*/) const { return "orifice"; }
  std::string operator()(const circuit::Resistance& /*law*/) const { return "resistance"; }
  std::string operator()(const circuit::Cooler& /*law*/) const { return "cooler"; }
  std::string operator()(const circuit::ReliefValve& /*law*/) const { return "relief_valve"; }
  std::string operator()(const circuit::DisplacementPump& /*law*/) const { return "pump"; }
  std::string operator()(const circuit::PumpCurve& /*law*/) const { return "pump_curve"; }
  std::string operator()(const circuit::GivenFlow& /*law*/) const { return "flow"; }
  std::string operator()(const circuit::HoleOverGroove& /*law*/) const { return "hole_over_groove"; }
};

const std::vector<Attribute<model::OilCircuit>>& circuit_attributes() {
  static const std::vector<Attribute<model::OilCircuit>> table{
      {"element_<element>",
       "",
       "type of this element, and its first and its second node",
       [](const model::OilCircuit& circuit, std::size_t k) {
         const circuit::Element& element = circuit.network.elements[k];
         return std::vector{std::visit(TypeOfLaw{}, element.law), circuit.network.nodes[element.from].name,
                            circuit.network.nodes[element.to].name};
       },
       {.each = element_names}}};
  return table;
}

const QuantityTable<CircuitRow, model::OilCircuit>& circuit_quantities() {
  static const QuantityTable<CircuitRow, model::OilCircuit> table{
      {"pressure_<node>",
       "Pa",
       "pressure of this node",
       [](const CircuitRow& row, std::size_t k) { return row.pressures[static_cast<Eigen::Index>(k)]; },
       {.symbol = "p_i",
        .note = "a node of the model's `circuit`",
        .each = node_names,
        .summary_entries = {{CircuitStatistic::mean, "mean pressure of <node>", "MPa"},
                            {CircuitStatistic::smallest, "lowest pressure of <node>", "MPa"}}}},
      {"temperature_<node>",
       "degC",
       "temperature of the oil of this node",
       [](const CircuitRow& row, std::size_t k) {
         return row.temperatures[static_cast<Eigen::Index>(k)] - film::zero_celsius;
       },
       {.symbol = "T_i",
        .note = "of a `circuit` whose nodes have temperatures",
        .each = warm_node_names,
        .summary_entries = {{CircuitStatistic::mean, "mean temperature of <node>", "°C"},
                            {CircuitStatistic::largest, "highest temperature of <node>", "°C"}}}},
      {"drawn_<node>",
       "m^3/s",
       "by films from this node, negative where they give oil back",
       [](const CircuitRow& row, std::size_t k) { return row.drawn[static_cast<Eigen::Index>(k)]; },
       {.each = node_names,
        .summary_entries = {{CircuitStatistic::mean, "mean flow from <node> into films", "mm³/s"}}}},
      {"fill_<node>",
       "1",
       "fraction of this node that is oil: 1, or less at the cavitation pressure, where less oil comes than films and "
       "elements would take",
       [](const CircuitRow& row, std::size_t k) { return row.fills[static_cast<Eigen::Index>(k)]; },
       {.symbol = "theta_i",
        .each = node_names,
        .summary_entries = {{CircuitStatistic::smallest, "lowest fill of <node>"}}}},
      {"starved_<node>",
       "1",
       "1 where this node is not full of oil, else 0",
       [](const CircuitRow& row, std::size_t k) { return row.fills[static_cast<Eigen::Index>(k)] < 1 ? 1.0 : 0.0; },
       {.each = node_names, .summary_entries = {{CircuitStatistic::mean, "share of time in which <node> is starved"}}}},
      {"axis_pressure_<drilling>",
       "Pa",
       "at the axis in this drilling, which passes it",
       [](const CircuitRow& row, std::size_t k) { return row.axis_pressures[static_cast<Eigen::Index>(k)]; },
       {.symbol = "p_a",
        .note = "a `drilling` whose `course` is `through_axis`",
        .each = axis_names,
        .summary_entries = {{CircuitStatistic::smallest, "lowest pressure at the axis of <drilling>", "MPa"}}}},
      {"flow_<element>",
       "m^3/s",
       "through this element, from its first node to its second",
       [](const CircuitRow& row, std::size_t k) { return row.flows[static_cast<Eigen::Index>(k)]; },
       {.symbol = "Q_e",
        .note = "an element of the model's `circuit`",
        .each = element_names,
        .summary_entries = {{CircuitStatistic::mean, "mean flow through <element>", "mm³/s"}}}},
      {"open_area_<hole>",
       "m^2",
       "overlap of this hole with its groove",
       [](const CircuitRow& row, std::size_t k) { return row.open_areas[static_cast<Eigen::Index>(k)]; },
       {.symbol = "A", .note = "a `hole_over_groove` of the model's `circuit`", .each = hole_names}},
      {"heat_<cooler>",
       "W",
       "from the oil into the coolant of this cooler",
       [](const CircuitRow& row, std::size_t k) { return row.cooled[static_cast<Eigen::Index>(k)]; },
       {.note = "a `cooler` of the model's `circuit`",
        .each = cooler_names,
        .summary_entries = {{CircuitStatistic::mean, "mean heat from the oil in <cooler>", "W"}}}},
      {"dissipated",
       "W",
       "that warms the oil on its way through elements: flow times drop of pressure, and leaks of pumps",
       &CircuitRow::dissipated,
       {.only = has_temperatures}},
      {"stored", "m^3", "oil in all nodes with a volume", [](const CircuitRow& row) { return row.content.sum(); }},
      {"balance_error",
       "1",
       "flow into nodes that neither films draw nor nodes store, over the largest flow",
       &CircuitRow::balance_error,
       {.summary_entries = {{CircuitStatistic::largest_in_size, "worst error of the circuit's oil balance"}}}},
      {"source_power",
       "W",
       "that pumps and other sources put into the oil: flow times rise of pressure",
       &CircuitRow::power,
       {.only = has_sources, .summary_entries = {{CircuitStatistic::mean, "mean power of the pumps", "W"}}}},
  };
  return table;
}

}  // namespace

void write_circuit_plan(const model::OilCircuit& circuit, results::Writer& writer) {
  write_once(circuit_attributes(), "/circuit/", circuit, writer);
}

CircuitRecord::CircuitRecord(const model::OilCircuit& circuit, results::Writer& writer)
    : rows_(circuit_quantities(), "/circuit/", circuit, writer) {
  write_circuit_plan(circuit, writer);
}

QuantityGroup CircuitRecord::describe() {
  QuantityGroup group{.path = "/circuit/", .heading = "of the oil circuit", .quantities = {}};
  run::describe(circuit_quantities(), "n", group);
  run::describe(circuit_attributes(), "n", group);
  return group;
}

}  // namespace hersey::run
