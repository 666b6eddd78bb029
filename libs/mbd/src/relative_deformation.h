#pragma once

#include "hersey/core/spatial.h"
#include "hersey/mbd/elastic_body.h"

namespace hersey::mbd {

using Matrix6x12 = Eigen::Matrix<double, 6, 12>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

/// How far a frame of an elastic body has moved from its rest pose, as frame 0 sees it: q = [theta; u], theta the axial
/// vector of the relative rotation (sin of the angle times the axis), u the displacement, both in frame 0's axes; with
/// rates and derivatives with respect to [frame 0; the frame] (theory manual eq. (flexible-bodies.8) to
/// (flexible-bodies.11)).
class RelativeDeformation {
 public:
  Vector6 q = Vector6::Zero(), rate = Vector6::Zero(), acceleration = Vector6::Zero();
  Matrix6x12 B;         ///< dq/dxi = drate/dV = dacceleration/dA
  Matrix6x12 rate_dX;   ///< drate/dxi
  Matrix6x12 accel_dX;  ///< dacceleration/dxi
  Matrix6x12 accel_dV;  ///< dacceleration/dV

  void update(const ElasticFrame& base, const ElasticFrame& frame, const Pose& rest, bool want_tangent);

  /// d(B^T f)/dxi at fixed f.
  [[nodiscard]] Matrix12 geometric(const Vector6& f) const;

 private:
  void differentiate(const ElasticFrame& base);

  Matrix3 R_, relative_;               // frame's axes in frame 0; the same over the rest pose
  Vector3 r_, omega_, v_, alpha_, a_;  // frame's origin; its motion turned into frame 0's axes
  Vector3 w_, w_rate_;                 // relative angular velocity and its rate
  Matrix3 B_theta_;                    // theta_rate = B_theta w
};

}  // namespace hersey::mbd
