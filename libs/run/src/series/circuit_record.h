#pragma once

#include "hersey/bearing/oil_circuit.h"
#include "hersey/model/model.h"
#include "table/quantity.h"

namespace hersey::run {

/// Writes what does not change: the type of each element and its nodes.
void write_circuit_plan(const model::OilCircuit& circuit, results::Writer& writer);

/// The oil circuit in the results file: pressures of its nodes, flows through its elements.
class CircuitRecord {
 public:
  CircuitRecord(const model::OilCircuit& circuit, results::Writer& writer);
  void append(const bearing::CircuitObservation& observation) const { rows_.append(observation); }
  [[nodiscard]] static QuantityGroup describe();

 private:
  QuantityRows<bearing::CircuitObservation, model::OilCircuit> rows_;
};

}  // namespace hersey::run
