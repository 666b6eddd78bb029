#pragma once

#include "hersey/mbd/observation.h"
#include "hersey/model/machine.h"
#include "table/quantity.h"

namespace hersey::run {

/// One piston ring in the results file.
class RingRecord {
 public:
  RingRecord(const model::BuiltRing& ring, results::Writer& writer);
  void append(const mbd::Observation& observation) const;
  static void describe(QuantityGroup& group);

 private:
  const model::BuiltRing& ring_;
  struct Row {
    double friction_force = 0, radial_load = 0, power = 0;
  };
  [[nodiscard]] static const QuantityTable<Row, model::BuiltRing>& table();
  QuantityRows<Row, model::BuiltRing> rows_;
};

}  // namespace hersey::run
