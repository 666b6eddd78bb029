#pragma once

#include <vector>

#include "hersey/mbd/mechanism.h"
#include "table/quantity.h"

namespace hersey::run {

/// Force or torque on one coordinate of a joint: of a drive, of a coupling, or of friction, springs and control in a
/// joint.
struct Effort {
  double value = 0;  ///< force or torque [N; N m]
  double power = 0;  ///< put into the machine [W]
};

/// All forces and torques on joint coordinates, in the results file.
class EffortRecord {
 public:
  EffortRecord(const mbd::MechanismSpec& spec, results::Writer& writer);
  void append(const mbd::Observation& observation) const;
  [[nodiscard]] static std::vector<QuantityGroup> describe();

 private:
  struct Coordinate {
    bool is_rotational = false;
  };
  using Table = QuantityTable<Effort, Coordinate>;
  using Rows = QuantityRows<Effort, Coordinate>;
  [[nodiscard]] static const Table& of_drives();
  [[nodiscard]] static const Table& of_couplings();
  [[nodiscard]] static const Table& of_forces();

  std::vector<Rows> drives_, couplings_, forces_;
};

}  // namespace hersey::run
