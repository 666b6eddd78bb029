#pragma once

#include "hersey/film/thermal_network.h"
#include "hersey/model/model.h"
#include "table/quantity.h"

namespace hersey::run {

/// The thermal network at an instant.
struct ThermalRow {
  const model::Model& model;
  const film::NetworkObservables& observation;
};

/// The thermal network's bodies in the results file.
class ThermalRecord {
 public:
  /// @pre the model has a network
  ThermalRecord(const model::Model& model, results::Writer& writer);
  void append(const ThermalRow& row) const { rows_.append(row); }
  [[nodiscard]] static QuantityGroup describe();

 private:
  QuantityRows<ThermalRow, model::Model> rows_;
};

}  // namespace hersey::run
