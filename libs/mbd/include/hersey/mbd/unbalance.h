#pragma once

#include "hersey/mbd/two_body_force.h"

namespace hersey::mbd {

/// An unbalance of a shaft (theory manual, rotors.4): the first moment of mass by which a body differs from a balanced
/// one, without a mass of its own. Its inertia forces are those of any motion, run-up included.
///
/// Frame A is an inertial one, B lies on the shaft, at the unbalance's station.
/// @verified_by unbalance_test.cpp
class Unbalance final : public TwoBodyForce {
 public:
  /// @param moment   mass times eccentricity, in B's axes [kg m]
  /// @param gravity  in A's axes [m/s^2]
  Unbalance(const Vector3& moment, const Vector3& gravity) : moment_(moment), gravity_(gravity) {}

  void evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) override;
  /// Returns the potential energy of the moment in gravity [J].
  [[nodiscard]] double stored_energy(const RelativeMotion& motion) const override;
  [[nodiscard]] double kinetic_energy(const RelativeMotion& motion) const override;

 private:
  Vector3 moment_, gravity_;
};

}  // namespace hersey::mbd
