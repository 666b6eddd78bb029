#pragma once

#include <vector>

#include "cycle/bearing_cycle.h"
#include "hersey/core/archive.h"
#include "hersey/mbd/observation.h"
#include "hersey/model/machine.h"
#include "hersey/model/model.h"

namespace hersey::run {

/// What a cycle of an engine loses to friction, and the volume that its pistons displace (skirt.15).
struct EngineFriction {
  double energy = 0;  ///< lost in all films, their contact and piston rings [J]
  double volume = 0;  ///< between the extreme places of all skirts [m^3]
  /// Friction mean effective pressure [Pa]; not a number where nothing is displaced.
  [[nodiscard]] double mean_effective_pressure() const;
};

/// Returns the power that a piston ring takes [W].
[[nodiscard]] double ring_power(const model::BuiltRing& ring, const mbd::Observation& observation);

/// True if a model has a volume that its pistons displace: a skirt in a liner.
[[nodiscard]] bool displaces(const model::Model& model);

/// Gathers what piston rings lose over cycles, by the trapezoidal rule.
class EngineFrictionSums {
 public:
  explicit EngineFrictionSums(const model::Machine& machine) : machine_(machine) {}
  /// The machine at an accepted state; the first call begins the first cycle.
  void take(const mbd::Observation& observation);
  /// Ends the cycle with the state last taken. @param bearings  their cycles
  [[nodiscard]] EngineFriction close(const std::vector<BearingCycle>& bearings);
  /// The cycle under way.
  void persist(Archive& archive);

 private:
  const model::Machine& machine_;
  bool is_begun_ = false;
  double t_ = 0, power_ = 0;  ///< of the state last taken [s, W]
  double energy_ = 0;         ///< of rings since the begin of the cycle [J]
};

}  // namespace hersey::run
