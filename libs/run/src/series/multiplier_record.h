#pragma once

#include <complex>
#include <vector>

#include "hersey/model/model.h"
#include "table/quantity.h"

namespace hersey::run {

/// Floquet multipliers of the periodic motion in which a run begins, in the results file.
class MultiplierRecord {
 public:
  MultiplierRecord(const model::Model& model, results::Writer& writer) : rows_(table(), kPath, model, writer) {}
  /// @param period  of the motion [s]
  void write(const std::vector<std::complex<double>>& multipliers, double period) const;
  [[nodiscard]] static QuantityGroup describe();

 private:
  struct Row {
    std::complex<double> multiplier;
    double period = 0;  // [s]
  };
  static constexpr const char* kPath = "/cycles/multipliers/";
  [[nodiscard]] static const QuantityTable<Row, model::Model>& table();
  QuantityRows<Row, model::Model> rows_;
};

}  // namespace hersey::run
