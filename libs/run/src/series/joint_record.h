#pragma once

#include "hersey/mbd/mechanism.h"
#include "table/quantity.h"

namespace hersey::run {

/// True if a value of the joint's coordinates is an angle.
[[nodiscard]] bool is_rotational(const mbd::JointSpec& joint, int value);

/// Coordinates and reactions of one joint in the results file.
class JointRecord {
 public:
  /// @param other  record of another joint, to share common parts; null: there is none
  JointRecord(const mbd::JointSpec& joint, const JointRecord* other, results::Writer& writer);
  void append(const mbd::JointObservation& observation) const { rows_.append(observation); }
  /// Adds its series.
  static void describe(QuantityGroup& group);

 private:
  QuantityRows<mbd::JointObservation, mbd::JointSpec> rows_;
};

}  // namespace hersey::run
