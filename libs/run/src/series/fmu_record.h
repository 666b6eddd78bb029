#pragma once

#include <vector>

#include "hersey/model/model.h"
#include "observation/fmu_signals.h"
#include "table/quantity.h"

namespace hersey::run {

/// The signals that an FMU exchanges with the machine, in the results file.
class FmuRecord {
 public:
  FmuRecord(const model::Fmu& fmu, results::Writer& writer);
  void append(const FmuSignals& signals) const;
  [[nodiscard]] static QuantityGroup describe();

 private:
  struct Signal {
    std::string name, unit;
  };
  using Table = QuantityTable<double, Signal>;
  [[nodiscard]] static const Table& of_inputs();
  [[nodiscard]] static const Table& of_outputs();

  std::vector<QuantityRows<double, Signal>> inputs_, outputs_;
};

}  // namespace hersey::run
