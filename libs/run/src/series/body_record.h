#pragma once

#include <string>

#include "hersey/mbd/mechanism.h"
#include "table/quantity.h"

namespace hersey::run {

/// The motion of one body in the results file.
class BodyRecord {
 public:
  /// @param other  record of another body, to share common parts; null: there is none
  BodyRecord(const std::string& name, const BodyRecord* other, results::Writer& writer);
  void append(const mbd::FrameMotion& motion) const { rows_.append(motion); }
  /// Adds its series.
  static void describe(QuantityGroup& group);

 private:
  struct Plan {};
  [[nodiscard]] static const QuantityTable<mbd::FrameMotion, Plan>& table();
  QuantityRows<mbd::FrameMotion, Plan> rows_;
};

}  // namespace hersey::run
