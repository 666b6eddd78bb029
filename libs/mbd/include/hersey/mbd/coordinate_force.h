#pragma once

#include "hersey/core/archive.h"

namespace hersey::mbd {

/// A force or torque on a scalar coordinate, with its derivatives.
struct CoordinateEffort {
  double value = 0;        ///< in the direction of the coordinate [N; N m]
  double by_position = 0;  ///< d value / d coordinate
  double by_rate = 0;      ///< d value / d rate
};

/// A force or torque on one joint coordinate that depends on time, the coordinate and its rate.
class CoordinateForce {
 public:
  virtual ~CoordinateForce() = default;

  /// The effort at `t` [s], at this coordinate and rate (rad, rad/s or m, m/s).
  [[nodiscard]] virtual CoordinateEffort evaluate(double t, double position, double rate) const = 0;

  /// A step ended here: forces with a memory keep it.
  virtual void accept_step(double t, double position, double rate) { (void)t, (void)position, (void)rate; }

  /// That memory; see solver::CondensedPart.
  virtual void persist(Archive& archive) { (void)archive; }

  /// Whether its power is put in from outside, as a motor's is; a spring's or a brake's is not.
  [[nodiscard]] virtual bool is_source() const { return false; }

  /// Whether it gives back what it takes, as a spring does.
  [[nodiscard]] virtual bool is_store() const { return false; }

  /// What it holds at this coordinate [J]; 0 where it is no store.
  [[nodiscard]] virtual double stored_energy(double position) const { return (void)position, 0; }
};

}  // namespace hersey::mbd
