#pragma once

#include "hersey/core/archive.h"

namespace hersey::mbd {

/// A force or torque on a scalar coordinate, with its derivatives.
struct CoordinateEffort {
  double value = 0;        ///< effort in the direction of the coordinate [N; N m]
  double by_position = 0;  ///< d value / d coordinate
  double by_rate = 0;      ///< d value / d rate
};

/// A force or torque on one joint coordinate that depends on time, the coordinate and its rate.
class CoordinateForce {
 public:
  virtual ~CoordinateForce() = default;

  /// Returns the effort at `t` [s], at this coordinate and rate (rad, rad/s or m, m/s).
  [[nodiscard]] virtual CoordinateEffort evaluate(double t, double position, double rate) const = 0;

  /// Accepts a step that ended here: forces with a history store it.
  virtual void accept_step(double t, double position, double rate) { (void)t, (void)position, (void)rate; }

  /// Saves or restores the history; see solver::CondensedPart.
  virtual void persist(Archive& archive) { (void)archive; }

  /// True if its power is external, as that of a motor; false for springs and brakes.
  [[nodiscard]] virtual bool is_source() const { return false; }

  /// True if it is conservative, as a spring is.
  [[nodiscard]] virtual bool is_store() const { return false; }

  /// Returns the energy stored at this coordinate [J]; 0 if it is not conservative.
  [[nodiscard]] virtual double stored_energy(double position) const { return (void)position, 0; }
};

}  // namespace hersey::mbd
