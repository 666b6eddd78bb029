#pragma once

#include <cmath>
#include <limits>

#include "hersey/mbd/two_body_force.h"

namespace hersey::mbd {

/// An unbalance of a shaft (theory manual, rotors.4): the first moment of mass by which a body differs from a balanced
/// one, without a mass of its own. Its inertia forces are those of any motion, run-up included.
///
/// Frame A is an inertial one, B lies on the shaft, at the unbalance's station. An unbalance that begins within a run,
/// as by the loss of a blade, is none before: it acts in steps that start at its instant or later. What it changes of
/// the energies by its appearance is none of the bodies' work: they are counted from that instant.
/// @verified_by unbalance_test.cpp, tests/cli/run_up_test.py
class Unbalance final : public TwoBodyForce {
 public:
  /// @param moment   mass times eccentricity, in B's axes [kg m]
  /// @param gravity  in A's axes [m/s^2]
  /// @param begins   the instant at which it appears [s]
  Unbalance(const Vector3& moment, const Vector3& gravity, double begins = -std::numeric_limits<double>::infinity())
      : moment_(moment), gravity_(gravity), begins_(begins), acts_(std::isinf(begins)) {}

  void begin_step(const RelativeMotion& start, double dt) override;
  void accept_step(const RelativeMotion& end) override;
  void evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) override;
  /// Returns the potential energy of the moment in gravity [J].
  [[nodiscard]] double stored_energy(const RelativeMotion& motion) const override;
  [[nodiscard]] double kinetic_energy(const RelativeMotion& motion) const override;
  void persist(Archive& archive) override;

 private:
  void follow_time(const RelativeMotion& motion);
  [[nodiscard]] double potential(const RelativeMotion& motion) const;
  [[nodiscard]] double kinetic(const RelativeMotion& motion) const;

  Vector3 moment_, gravity_;
  double begins_;                                 // [s]
  bool acts_;                                     // in the step that has begun, or begins
  double dt_ = 0;                                 // length of that step [s]
  double potential_then_ = 0, kinetic_then_ = 0;  // where it began within the run [J]
};

}  // namespace hersey::mbd
