#include "series/thermal_record.h"

#include <functional>
#include <string>
#include <vector>

#include "hersey/film/temperature_law.h"

namespace hersey::run {
namespace {

using Observables = film::NetworkObservables;
using Statistic = SummaryEntry::Statistic;

/// Indices of the bodies among the nodes; surroundings keep the temperature that the model gives them.
std::vector<Eigen::Index> bodies(const model::Model& model) {
  std::vector<Eigen::Index> indices;
  const std::vector<film::ThermalNode>& nodes = model.thermal.network.nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (!nodes[k].is_fixed) indices.push_back(static_cast<Eigen::Index>(k));
  return indices;
}

std::vector<std::string> body_names(const model::Model& model) {
  std::vector<std::string> names;
  for (const Eigen::Index k : bodies(model))
    names.push_back(model.thermal.network.nodes[static_cast<std::size_t>(k)].name);
  return names;
}

template <class Member>
auto of_network(Member member) {
  return [member](const ThermalRow& row) { return std::invoke(member, row.observation); };
}

const QuantityTable<ThermalRow, model::Model>& thermal_quantities() {
  static const QuantityTable<ThermalRow, model::Model> table{
      {"T_<body>",
       "degC",
       "temperature of this body",
       [](const ThermalRow& row, std::size_t k) {
         return row.observation.T[bodies(row.model)[k]] - film::zero_celsius;
       },
       {.symbol = "T_i",
        .note = "a node of the model's `thermal`",
        .each = body_names,
        .summary_entries = {{Statistic::largest, "hottest <body>", "°C"},
                            {Statistic::at_end, "temperature of <body> at the end", "°C"}}}},
      {"heat_from_films_<body>",
       "W",
       "from films into this body, mean of the step",
       [](const ThermalRow& row, std::size_t k) { return row.observation.heat[bodies(row.model)[k]]; },
       {.each = body_names, .summary_entries = {{Statistic::mean, "mean heat from films into <body>", "W"}}}},
      {"heat_to_surroundings",
       "W",
       "from bodies and films into nodes that are fixed",
       of_network(&Observables::to_fixed),
       {.summary_entries = {{Statistic::mean, "mean heat into surroundings", "W"}}}},
      {"heat_stored", "W", "rate of the heat in bodies", of_network(&Observables::stored)},
      {"heat_balance_error",
       "1",
       "heat from films that is neither stored nor gone, over the largest of these",
       of_network(&Observables::error),
       {.summary_entries = {{Statistic::largest_in_size, "worst error of the bodies' heat balance"}}}},
  };
  return table;
}

}  // namespace

ThermalRecord::ThermalRecord(const model::Model& model, results::Writer& writer)
    : rows_(thermal_quantities(), "/thermal/", model, writer) {}

QuantityGroup ThermalRecord::describe() {
  QuantityGroup group{.path = "/thermal/", .heading = "of the thermal network", .quantities = {}};
  run::describe(thermal_quantities(), "n", group);
  return group;
}

}  // namespace hersey::run
