#pragma once

#include "hersey/core/spatial.h"
#include "hersey/mbd/elastic_body.h"

namespace hersey::mbd {

using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

/// Measure of a frame's rotation R against its rest pose, given by amplitudes of shapes.
enum class TurnMeasure {
  sine,   ///< theta, the sine of the angle times the axis: 3 shapes that rotate the frame linearly, for small strains
  matrix  ///< R - 1, row by row: 9 shapes, with which the nodes of the frame move rigidly at any rotation
};

/// Displacement of a frame of an elastic body from its rest pose relative to frame 0: q = [measure of rotation; u], u
/// the displacement in frame 0's axes; with rates and derivatives with respect to [frame 0; the frame] (theory manual
/// eq. (flexible-bodies.8) to (flexible-bodies.11), (flexible-bodies.22)).
class RelativeDeformation {
 public:
  using Amplitudes = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 12, 1>;
  using ByTwists = Eigen::Matrix<double, Eigen::Dynamic, 12, 0, 12, 12>;

  Amplitudes q, rate, acceleration;
  ByTwists B;         ///< dq/dxi = drate/dV = dacceleration/dA
  ByTwists rate_dX;   ///< drate/dxi
  ByTwists accel_dX;  ///< dacceleration/dxi
  ByTwists accel_dV;  ///< dacceleration/dV

  explicit RelativeDeformation(TurnMeasure measure) : measure_(measure) {}

  void update(const ElasticFrame& base, const ElasticFrame& frame, const Pose& rest, bool want_tangent);

  /// d(B^T f)/dxi at fixed f (flexible-bodies.12).
  [[nodiscard]] Matrix12 geometric(const Amplitudes& f) const;

 private:
  using Rotation = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1>;
  using ByVector = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 9, 3>;

  void take_precise(const Vector6& deformation);
  void measure_sine();
  void differentiate_sine();
  void measure_matrix();
  void differentiate_matrix();
  void differentiate(const ElasticFrame& base);
  [[nodiscard]] Matrix3 torque_by_rotation(const Rotation& f) const;

  TurnMeasure measure_;
  Matrix3 R_, relative_;               // frame's axes in frame 0; the same over the rest pose
  Vector3 r_, omega_, v_, alpha_, a_;  // frame's origin; its motion in frame 0's axes
  Vector3 w_, w_rate_;                 // relative angular velocity and its rate
  Rotation rotation_, rotation_rate_, rotation_acceleration_;
  ByVector by_w_;  // rate of the measure by w, as of the measure by a rotation of the frame, d acceleration by w'
  ByVector rate_by_rotation_;   // of the rate at fixed w
  ByVector accel_by_rotation_;  // of the acceleration at fixed w and w'
  ByVector accel_by_w_;
};

}  // namespace hersey::mbd
