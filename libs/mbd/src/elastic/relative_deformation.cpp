#include "elastic/relative_deformation.h"

namespace hersey::mbd {
namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9x3 = Eigen::Matrix<double, 9, 3>;

/// Row by row.
Vector9 entries(const Matrix3& A) { return Eigen::Map<const Vector9>(Matrix3(A.transpose()).data()); }

/// Columns entries(f(e_k)).
template <class Function>
Matrix9x3 by_axis(const Function& f) {
  Matrix9x3 columns;
  for (int k = 0; k < 3; ++k) columns.col(k) = entries(f(skew(Vector3(Vector3::Unit(k)))));
  return columns;
}

}  // namespace

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
  measure_ == TurnMeasure::sine ? measure_sine() : measure_matrix();
  const Eigen::Index n = rotation_.size() + 3;
  q.resize(n), rate.resize(n), acceleration.resize(n);
  q << rotation_, r_ - rest.r;
  if (frame.deformation) take_precise(*frame.deformation);
  rate << rotation_rate_, u_rate;
  acceleration << rotation_acceleration_,
      w_.cross(v_) + a_ - base.A.tail<3>() - base.A.head<3>().cross(r_) - omega_0.cross(u_rate);
  // Maps twists of [frame 0; frame] to the relative rotation phi and the change of r.
  B.resize(n, 12);
  B.topRows(n - 3) << -by_w_, ByVector::Zero(n - 3, 3), by_w_ * R_, ByVector::Zero(n - 3, 3);
  B.bottomRows<3>() << skew(r_), -Matrix3::Identity(), Matrix3::Zero(), R_;
  if (want_tangent) differentiate(base);
}

/// R = 1 + theta~ + theta~ theta~ / (1 + cos), of angles below a right one.
void RelativeDeformation::take_precise(const Vector6& deformation) {
  q.tail<3>() = deformation.tail<3>();
  const Matrix3 theta = skew(Vector3(deformation.head<3>()));
  const double cosine = 0.5 * (relative_.trace() - 1);
  if (measure_ == TurnMeasure::sine)
    q.head<3>() = deformation.head<3>();
  else if (cosine > 0)
    q.head<9>() = entries(theta + theta * theta / (1 + cosine));
}

/// theta_rate = B_theta w, d(B_theta)/dt w = -(theta . w) w + (R w) x w / 2.
void RelativeDeformation::measure_sine() {
  const Matrix3 B_theta = 0.5 * (relative_.trace() * Matrix3::Identity() - relative_);
  Vector3 theta;
  theta << relative_(2, 1) - relative_(1, 2), relative_(0, 2) - relative_(2, 0), relative_(1, 0) - relative_(0, 1);
  theta *= 0.5;
  rotation_ = theta;
  by_w_ = B_theta;
  rotation_rate_ = B_theta * w_;
  rotation_acceleration_ = B_theta * w_rate_ - theta.dot(w_) * w_ + 0.5 * (relative_ * w_).cross(w_);
}

void RelativeDeformation::differentiate_sine() {
  const Vector3 theta = q.head<3>();
  const Matrix3 W = skew(w_), identity = Matrix3::Identity();
  // dB_theta z = Q(z) phi, Q(z) = -z theta^T + (R z)~ / 2.
  const auto Q = [&](const Vector3& z) { return Matrix3(-z * theta.transpose() + 0.5 * skew(relative_ * z)); };
  rate_by_rotation_ = Q(w_);
  // d(Q(w) w) for a change of w.
  accel_by_w_ = -theta.dot(w_) * identity - w_ * theta.transpose() - 0.5 * W * relative_ + 0.5 * skew(relative_ * w_);
  // and for a rotation: theta by B_theta phi, R by phi x R.
  accel_by_rotation_ = Q(w_rate_) - w_ * w_.transpose() * by_w_ + 0.5 * W * skew(relative_ * w_);
}

/// R' = w~ R, R'' = (w'~ + w~ w~) R.
void RelativeDeformation::measure_matrix() {
  const Matrix3 W = skew(w_);
  rotation_ = entries(relative_ - Matrix3::Identity());
  by_w_ = by_axis([&](const Matrix3& e) { return Matrix3(e * relative_); });
  rotation_rate_ = entries(W * relative_);
  rotation_acceleration_ = entries((skew(w_rate_) + W * W) * relative_);
}

void RelativeDeformation::differentiate_matrix() {
  const Matrix3 W = skew(w_), rotating = skew(w_rate_) + W * W;
  rate_by_rotation_ = by_axis([&](const Matrix3& e) { return Matrix3(W * e * relative_); });
  accel_by_w_ = by_axis([&](const Matrix3& e) { return Matrix3((e * W + W * e) * relative_); });
  accel_by_rotation_ = by_axis([&](const Matrix3& e) { return Matrix3(rotating * e * relative_); });
}

void RelativeDeformation::differentiate(const ElasticFrame& base) {
  using Matrix3x12 = Eigen::Matrix<double, 3, 12>;
  measure_ == TurnMeasure::sine ? differentiate_sine() : differentiate_matrix();
  const Vector3 u_rate = rate.tail<3>(), omega_0 = base.V.head<3>();
  const Matrix3 W = skew(w_), W0 = skew(omega_0), identity = Matrix3::Identity();
  Matrix3x12 rotation,
      shift;  // phi and dr of a twist; also w and u_rate of a velocity, w_rate and ... of an acceleration
  rotation << -identity, Matrix3::Zero(), R_, Matrix3::Zero();
  shift << skew(r_), -identity, Matrix3::Zero(), R_;
  Matrix3x12 base_rotation = Matrix3x12::Zero(), frame_shift = Matrix3x12::Zero();
  base_rotation.leftCols<3>() = identity;
  frame_shift.rightCols<3>() = R_;

  const Matrix3x12 w_dX = -skew(omega_) * rotation, u_rate_dX = -skew(v_) * rotation - W0 * shift;
  const Eigen::Index n = q.size(), rows_of_rotation = n - 3;
  rate_dX.resize(n, 12), accel_dX.resize(n, 12), accel_dV.resize(n, 12);
  rate_dX.topRows(rows_of_rotation) = by_w_ * w_dX + rate_by_rotation_ * rotation;
  rate_dX.bottomRows<3>() = u_rate_dX;
  // w_rate = alpha - alpha_0 + w x omega.
  const Matrix3x12 w_rate_dX = -skew(alpha_) * rotation - skew(omega_) * w_dX - W * skew(omega_) * rotation;
  const Matrix3x12 w_rate_dV = -skew(omega_) * rotation + W * (rotation + base_rotation);
  accel_dX.topRows(rows_of_rotation) = by_w_ * w_rate_dX + accel_by_rotation_ * rotation + accel_by_w_ * w_dX;
  accel_dX.bottomRows<3>() = -skew(v_) * w_dX - W * skew(v_) * rotation - skew(a_) * rotation -
                             skew(base.A.head<3>()) * shift - W0 * u_rate_dX;
  accel_dV.topRows(rows_of_rotation) = by_w_ * w_rate_dV + accel_by_w_ * rotation;
  accel_dV.bottomRows<3>() = -skew(v_) * rotation + W * frame_shift + skew(u_rate) * base_rotation - W0 * shift;
}

/// Returns the derivative of by_w^T f by a rotation of the frame: of the sine -f theta^T - R^T f~ / 2; of the matrix,
/// whose torque is the sum of (R e_j) x F_j over columns, the sum of F_j~ (R e_j)~.
Matrix3 RelativeDeformation::torque_by_rotation(const Rotation& f) const {
  if (measure_ == TurnMeasure::sine) {
    const Vector3 f_theta = f;
    return -f_theta * q.head<3>().transpose() - 0.5 * relative_.transpose() * skew(f_theta);
  }
  Matrix3 sum = Matrix3::Zero();
  for (int j = 0; j < 3; ++j) sum += skew(Vector3(f[j], f[3 + j], f[6 + j])) * skew(Vector3(relative_.col(j)));
  return sum;
}

Matrix12 RelativeDeformation::geometric(const Amplitudes& f) const {
  const Rotation f_rotation = f.head(f.size() - 3);
  const Vector3 f_u = f.tail<3>();
  const Matrix3 identity = Matrix3::Identity(), Rt = R_.transpose();
  const Vector3 torque = by_w_.transpose() * f_rotation;
  const Matrix3 torque_dphi = torque_by_rotation(f_rotation);
  Eigen::Matrix<double, 3, 12> rotation, shift;
  rotation << -identity, Matrix3::Zero(), R_, Matrix3::Zero();
  shift << skew(r_), -identity, Matrix3::Zero(), R_;
  Matrix12 G;
  G.middleRows<3>(0) = -torque_dphi * rotation + skew(f_u) * shift;
  G.middleRows<3>(3).setZero();
  G.middleRows<3>(6) = Rt * (torque_dphi + skew(torque)) * rotation;
  G.middleRows<3>(9) = Rt * skew(f_u) * rotation;
  return G;
}

}  // namespace hersey::mbd
