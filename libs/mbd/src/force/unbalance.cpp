#include "hersey/mbd/unbalance.h"

namespace hersey::mbd {
namespace {

constexpr double kOneInstant = 1e-5;  // of a step: steps end within a millionth of one where they are meant to

}  // namespace

void Unbalance::begin_step(const RelativeMotion& start, double dt) {
  dt_ = dt;
  follow_time(start);
}

// Accelerations at the end of a step that ends where the unbalance begins are solved for with its forces.
void Unbalance::accept_step(const RelativeMotion& end) { follow_time(end); }

void Unbalance::follow_time(const RelativeMotion& motion) {
  const bool acted = acts_;
  acts_ = motion.t >= begins_ - kOneInstant * dt_;
  if (acted || !acts_) return;
  potential_then_ = potential(motion);
  kinetic_then_ = kinetic(motion);
}

void Unbalance::evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) {
  response = ForceResponse{};
  if (!acts_) return;
  const Vector3 u = motion.X_AB.R * moment_, r = motion.X_AB.r;
  const Vector3 omega = motion.V_AB_A.head<3>(), alpha = motion.A_AB_A.head<3>();
  const Vector3 velocity = motion.V_AB_A.tail<3>() + omega.cross(r);
  const Vector3 pull = motion.A_AB_A.tail<3>() + alpha.cross(r) + omega.cross(velocity) - gravity_;
  const Vector3 u_rate = omega.cross(u);
  const Vector3 f = -(alpha.cross(u) + omega.cross(u_rate));  // (rotors.4)
  response.W_B_A << r.cross(f) - u.cross(pull), f;

  using Directions = Eigen::Matrix<double, 3, 6>;
  const auto lift = [&](const Directions& df, const Directions& d_pull, Matrix6& dW) {
    dW.topRows<3>() = skew(r) * df - skew(u) * d_pull;
    dW.bottomRows<3>() = df;
  };
  // A twist [phi; rho] of B moves its origin by rho + phi x r and u by phi x u.
  Directions dr, about = Directions::Zero();
  dr << -skew(r), Matrix3::Identity();
  about.leftCols<3>().setIdentity();
  lift(skew(u) * about, dr, response.dW_dA);
  if (!want_tangent) return;

  const Matrix3 turned = skew(omega), angular = skew(alpha) + turned * turned;
  const Directions du = -skew(u) * about;
  lift(-angular * du, angular * dr, response.dW_dX);
  response.dW_dX.topRows<3>() += skew(pull) * du - skew(f) * dr;

  const Directions df_dV = (skew(u_rate) + turned * skew(u)) * about;
  lift(df_dV, -skew(velocity) * about + turned * dr, response.dW_dV);
}

double Unbalance::stored_energy(const RelativeMotion& motion) const {
  return acts_ ? potential(motion) - potential_then_ : 0;
}

double Unbalance::kinetic_energy(const RelativeMotion& motion) const {
  return acts_ ? kinetic(motion) - kinetic_then_ : 0;
}

double Unbalance::potential(const RelativeMotion& motion) const { return -gravity_.dot(motion.X_AB.R * moment_); }

double Unbalance::kinetic(const RelativeMotion& motion) const {
  const Vector3 omega = motion.V_AB_A.head<3>();
  const Vector3 velocity = motion.V_AB_A.tail<3>() + omega.cross(motion.X_AB.r);
  return velocity.dot(omega.cross(motion.X_AB.R * moment_));
}

void Unbalance::persist(Archive& archive) {
  if (std::isinf(begins_)) return;
  archive.io("acts", acts_), archive.io("potential_then", potential_then_), archive.io("kinetic_then", kinetic_then_);
}

}  // namespace hersey::mbd
