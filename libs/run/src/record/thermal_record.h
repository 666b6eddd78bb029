#pragma once

#include "hersey/film/thermal_network.h"
#include "hersey/model/model.h"
#include "record/quantity.h"

namespace hersey::run {

/// The thermal network's bodies in the results file.
class ThermalRecord {
 public:
  /// @pre the model has a network
  ThermalRecord(const model::Model& model, results::Writer& writer);
  void append(const film::NetworkObservables& seen) const { rows_.append(seen); }
  [[nodiscard]] static QuantityGroup describe();

 private:
  QuantityRows<film::NetworkObservables, model::Model> rows_;
};

}  // namespace hersey::run
