#pragma once

#include "hersey/model/build.h"
#include "table/quantity.h"

namespace hersey::run {

/// A flexible body at an instant.
struct FlexibleRow {
  const mbd::ElasticObservation& observation;
  Eigen::VectorXd amplitudes;  ///< of its shapes
};

/// One flexible body in the results file, besides its motion.
class FlexibleRecord {
 public:
  /// @param body  outlives this
  FlexibleRecord(const model::BuiltFlexible& body, results::Writer& writer);
  void append(const mbd::Observation& observation) const;
  /// Adds its quantities.
  static void describe(QuantityGroup& group);

 private:
  const model::BuiltFlexible& body_;
  QuantityRows<FlexibleRow, model::BuiltFlexible> rows_;
};

}  // namespace hersey::run
