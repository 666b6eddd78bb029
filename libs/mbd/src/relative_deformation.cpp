#include "relative_deformation.h"

namespace hersey::mbd {

void RelativeDeformation::update(const ElasticFrame& base, const ElasticFrame& frame, const Pose& rest,
                                 bool want_tangent) {
  R_ = base.X_WF.R.transpose() * frame.X_WF.R;
  r_ = base.X_WF.R.transpose() * (frame.X_WF.r - base.X_WF.r);
  relative_ = R_ * rest.R.transpose();
  omega_ = R_ * frame.V.head<3>();
  v_ = R_ * frame.V.tail<3>();
  alpha_ = R_ * frame.A.head<3>();
  a_ = R_ * frame.A.tail<3>();
  const Vector3 omega_0 = base.V.head<3>();
  w_ = omega_ - omega_0;
  w_rate_ = alpha_ - base.A.head<3>() + w_.cross(omega_);
  const Vector3 u_rate = v_ - base.V.tail<3>() - omega_0.cross(r_);
  B_theta_ = 0.5 * (relative_.trace() * Matrix3::Identity() - relative_);
  Vector3 theta;
  theta << relative_(2, 1) - relative_(1, 2), relative_(0, 2) - relative_(2, 0), relative_(1, 0) - relative_(0, 1);
  theta *= 0.5;
  q << theta, r_ - rest.r;
  if (frame.deformation) q = *frame.deformation;
  rate << B_theta_ * w_, u_rate;
  // dB_theta/dt w = -(theta . w) w + (R w) x w / 2.
  acceleration << B_theta_ * w_rate_ - theta.dot(w_) * w_ + 0.5 * (relative_ * w_).cross(w_),
      w_.cross(v_) + a_ - base.A.tail<3>() - base.A.head<3>().cross(r_) - omega_0.cross(u_rate);
  // Twists of [frame 0; frame] to the relative turn phi and the change of r.
  B << -B_theta_, Matrix3::Zero(), B_theta_ * R_, Matrix3::Zero(), skew(r_), -Matrix3::Identity(), Matrix3::Zero(), R_;
  if (want_tangent) differentiate(base);
}

void RelativeDeformation::differentiate(const ElasticFrame& base) {
  using Matrix3x12 = Eigen::Matrix<double, 3, 12>;
  const Vector3 theta = q.head<3>(), u_rate = rate.tail<3>(), omega_0 = base.V.head<3>();
  const Matrix3 W = skew(w_), W0 = skew(omega_0), identity = Matrix3::Identity();
  Matrix3x12 turn, shift;  // phi and dr of a twist; also w and u_rate of a velocity, w_rate and ... of an acceleration
  turn << -identity, Matrix3::Zero(), R_, Matrix3::Zero();
  shift << skew(r_), -identity, Matrix3::Zero(), R_;
  Matrix3x12 base_turn = Matrix3x12::Zero(), frame_shift = Matrix3x12::Zero();
  base_turn.leftCols<3>() = identity;
  frame_shift.rightCols<3>() = R_;
  // dB_theta z = Q(z) phi, Q(z) = -z theta^T + (R z)~ / 2.
  const auto Q = [&](const Vector3& z) { return Matrix3(-z * theta.transpose() + 0.5 * skew(relative_ * z)); };

  const Matrix3x12 w_dX = -skew(omega_) * turn, u_rate_dX = -skew(v_) * turn - W0 * shift;
  rate_dX << B_theta_ * w_dX + Q(w_) * turn, u_rate_dX;

  // d(Q(w) w) for a change of w.
  const Matrix3 Q_dw =
      -theta.dot(w_) * identity - w_ * theta.transpose() - 0.5 * W * relative_ + 0.5 * skew(relative_ * w_);
  // and for a turn: theta by B_theta phi, R by phi x R.
  const Matrix3 Q_dphi = -w_ * w_.transpose() * B_theta_ + 0.5 * W * skew(relative_ * w_);
  // w_rate = alpha - alpha_0 + w x omega.
  const Matrix3x12 w_rate_dX = -skew(alpha_) * turn - skew(omega_) * w_dX - W * skew(omega_) * turn;
  const Matrix3x12 w_rate_dV = -skew(omega_) * turn + W * (turn + base_turn);
  accel_dX << B_theta_ * w_rate_dX + (Q(w_rate_) + Q_dphi) * turn + Q_dw * w_dX,
      -skew(v_) * w_dX - W * skew(v_) * turn - skew(a_) * turn - skew(base.A.head<3>()) * shift - W0 * u_rate_dX;
  accel_dV << B_theta_ * w_rate_dV + Q_dw * turn,
      -skew(v_) * turn + W * frame_shift + skew(u_rate) * base_turn - W0 * shift;
}

Matrix12 RelativeDeformation::geometric(const Vector6& f) const {
  const Vector3 theta = q.head<3>(), f_theta = f.head<3>(), f_u = f.tail<3>();
  const Matrix3 identity = Matrix3::Identity(), Rt = R_.transpose();
  const Vector3 torque = B_theta_.transpose() * f_theta;
  // d(B_theta^T f) = [-f theta^T - R^T f~ / 2] phi.
  const Matrix3 torque_dphi = -f_theta * theta.transpose() - 0.5 * relative_.transpose() * skew(f_theta);
  Eigen::Matrix<double, 3, 12> turn, shift;
  turn << -identity, Matrix3::Zero(), R_, Matrix3::Zero();
  shift << skew(r_), -identity, Matrix3::Zero(), R_;
  Matrix12 G;
  G.middleRows<3>(0) = -torque_dphi * turn + skew(f_u) * shift;
  G.middleRows<3>(3).setZero();
  G.middleRows<3>(6) = Rt * (torque_dphi + skew(torque)) * turn;
  G.middleRows<3>(9) = Rt * skew(f_u) * turn;
  return G;
}

}  // namespace hersey::mbd
