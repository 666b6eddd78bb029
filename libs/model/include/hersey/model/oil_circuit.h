#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hersey/circuit/circuit.h"
#include "hersey/core/input_error.h"
#include "hersey/film/temperature_law.h"
#include "hersey/film/thermal_network.h"
#include "hersey/model/function.h"
#include "hersey/model/names.h"

namespace hersey::model {

/// What rotates a pump, or a body with a drilling.
struct CircuitShaft {
  double speed = 0;                       ///< of a shaft that follows no coordinate [rad/s]
  std::optional<CoordinateName> on = {};  ///< the coordinate whose rate, times `ratio`, is the speed
  double ratio = 1;                       ///< [-]
};

/// A hole of one surface of a bearing that passes over a groove of the other, an element.
struct CircuitHole {
  std::string bearing, hole, groove;                 ///< names
  std::size_t of_bearing = 0;                        ///< index in Model::bearings
  std::size_t hole_feature = 0, groove_feature = 0;  ///< indices in Bearing::film.features
};

/// Temperatures of the circuit's oil. Its nodes are nodes of the thermal network: one of the model, or one added behind
/// these.
struct CircuitTemperatures {
  double heat_capacity = 0;                   ///< of the oil, per volume [J/(m^3 K)]
  film::TemperatureLaw law;                   ///< its viscosity
  std::vector<film::ThermalNode> added = {};  ///< behind the network's own, in this order
  std::vector<std::size_t> nodes = {};        ///< in the network, of each node of the circuit
  std::vector<std::size_t> coolants = {};     ///< in the network, of each element; 0 but of coolers
  std::vector<double> T = {};                 ///< of each node of the circuit at the start [K]
};

/// The section `circuit`: the oil between the films' feeds.
struct OilCircuit {
  circuit::Network network;
  std::vector<std::optional<Function>> pressures;  ///< of each node that has a given one [Pa], over time
  std::vector<CircuitShaft> shafts;
  std::vector<CircuitHole> holes;  ///< in the order of circuit::Element::hole
  std::string lubricant;
  std::optional<CircuitTemperatures> temperatures;  ///< unset: the oil has one temperature
  std::vector<SourcePosition> node_positions, element_positions;
  SourcePosition position;

  /// Index of the node called so; unset: there is none.
  [[nodiscard]] std::optional<std::size_t> find_node(const std::string& name) const {
    for (std::size_t k = 0; k < network.nodes.size(); ++k)
      if (network.nodes[k].name == name) return k;
    return std::nullopt;
  }
};

/// A feature of a bearing that a node of the circuit feeds.
struct CircuitPort {
  std::size_t feature = 0;  ///< index in Bearing::film.features
  std::size_t node = 0;     ///< index in OilCircuit::network.nodes
};

}  // namespace hersey::model
