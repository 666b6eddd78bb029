#include "record/thermal_record.h"

#include "hersey/film/temperature_law.h"

namespace hersey::run {
namespace {

using Seen = film::NetworkObservables;
using As = Told::As;

std::vector<std::string> node_names(const model::Model& model) {
  std::vector<std::string> names;
  for (const film::ThermalNode& node : model.thermal.network.nodes) names.push_back(node.name);
  return names;
}

const QuantityTable<Seen, model::Model>& thermal_quantities() {
  static const QuantityTable<Seen, model::Model> table{
      {"T_<node>",
       "degC",
       "temperature of this body, or of these surroundings",
       [](const Seen& seen, std::size_t k) { return seen.T[static_cast<Eigen::Index>(k)] - film::zero_celsius; },
       {.symbol = "T_i",
        .note = "a node of the model's `thermal`",
        .each = node_names,
        .told = {{As::at_end, "temperature of <node> at the end", "°C"}, {As::largest, "hottest <node>", "°C"}}}},
      {"heat_from_films_<node>",
       "W",
       "from films into this body, mean of the step",
       [](const Seen& seen, std::size_t k) { return seen.heat[static_cast<Eigen::Index>(k)]; },
       {.each = node_names, .told = {{As::mean, "mean heat from films into <node>", "W"}}}},
      {"heat_to_surroundings",
       "W",
       "from bodies and films into nodes that are fixed",
       &Seen::to_fixed,
       {.told = {{As::mean, "mean heat into surroundings", "W"}}}},
      {"heat_stored", "W", "rate of the heat in bodies", &Seen::stored},
      {"heat_balance_error",
       "1",
       "heat from films that is neither stored nor gone, over the largest of these",
       [](const Seen& seen) { return seen.error(); },
       {.told = {{As::largest_in_size, "worst error of the bodies' heat balance"}}}},
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
