#pragma once

#include "hersey/mbd/two_body_force.h"

namespace hersey::mbd {

/// An elastic connection of two frames in all six directions (theory manual eq. (mechanisms.24)).
/// The deformation is x = [phi; r]: the rotation vector from A to B and the position of B's origin relative to A's, in
/// A's axes. The wrench follows from the energy x^T K x / 2 and the dissipation xdot^T D xdot / 2, so that it is
/// conservative and dissipative at any rotation below 180 degrees; a rotation of more than 170 degrees is a domain
/// error.
class Bushing final : public TwoBodyForce {
 public:
  /// @param stiffness  K, symmetric, positive semidefinite, rotations first [N m/rad, N/rad; N, N/m]
  /// @param damping    D, likewise [times s]
  Bushing(const Matrix6& stiffness, const Matrix6& damping);

  void evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) override;
  [[nodiscard]] double stored_energy(const RelativeMotion& motion) const override;
  [[nodiscard]] double lost_power(const RelativeMotion& motion) const override;
  [[nodiscard]] std::string domain_error() const override;

 private:
  Matrix6 K_, D_;
  double angle_ = 0;  ///< angle of rotation at the last evaluation
};

}  // namespace hersey::mbd
