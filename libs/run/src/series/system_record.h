#pragma once

#include "cycle/engine_friction.h"
#include "hersey/model/model.h"
#include "hersey/run/summary.h"
#include "observation/step_record.h"
#include "table/quantity.h"

namespace hersey::run {

/// The machine as a whole at an instant.
struct SystemRow {
  const model::Model& model;
  const StepRecord& step;
  const EnergySummary& energy;  ///< since the start of the run
};

/// Time, solution, energy and power of the whole machine in the results file.
class SystemRecord {
 public:
  SystemRecord(const model::Model& model, results::Writer& writer);
  void append(const SystemRow& row) const { rows_.append(row); }
  [[nodiscard]] static QuantityGroup describe();

 private:
  QuantityRows<SystemRow, model::Model> rows_;
};

/// Differences between successive cycles of the machine, in the results file.
class CycleRecord {
 public:
  /// @pre the model has cycles
  CycleRecord(const model::Model& model, results::Writer& writer);
  /// A cycle that has ended.
  struct Row {
    double t = 0;       ///< its end [s]
    double change = 0;  ///< CycleChange::value
    EngineFriction friction;
  };
  void append(const Row& row) const { rows_.append(row); }
  [[nodiscard]] static QuantityGroup describe();

 private:
  [[nodiscard]] static const QuantityTable<Row, model::Model>& table();
  QuantityRows<Row, model::Model> rows_;
};

}  // namespace hersey::run
