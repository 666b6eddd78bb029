#include "series/circuit_record.h"

#include <string>
#include <variant>
#include <vector>

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

bool has_sources(const model::OilCircuit& circuit) {
  for (const circuit::Element& element : circuit.network.elements)
    if (std::holds_alternative<circuit::DisplacementPump>(element.law) ||
        std::holds_alternative<circuit::PumpCurve>(element.law) ||
        std::holds_alternative<circuit::GivenFlow>(element.law))
      return true;
  return false;
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
      {"drawn_<node>",
       "m^3/s",
       "by films from this node, negative where they give oil back",
       [](const CircuitRow& row, std::size_t k) { return row.drawn[static_cast<Eigen::Index>(k)]; },
       {.each = node_names,
        .summary_entries = {{CircuitStatistic::mean, "mean flow from <node> into films", "mm³/s"}}}},
      {"flow_<element>",
       "m^3/s",
       "through this element, from its first node to its second",
       [](const CircuitRow& row, std::size_t k) { return row.flows[static_cast<Eigen::Index>(k)]; },
       {.symbol = "Q_e",
        .note = "an element of the model's `circuit`",
        .each = element_names,
        .summary_entries = {{CircuitStatistic::mean, "mean flow through <element>", "mm³/s"}}}},
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

CircuitRecord::CircuitRecord(const model::OilCircuit& circuit, results::Writer& writer)
    : rows_(circuit_quantities(), "/circuit/", circuit, writer) {}

QuantityGroup CircuitRecord::describe() {
  QuantityGroup group{.path = "/circuit/", .heading = "of the oil circuit", .quantities = {}};
  run::describe(circuit_quantities(), "n", group);
  return group;
}

}  // namespace hersey::run
