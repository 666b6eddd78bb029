#include "hersey/mbd/linear_bearing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "hersey/core/contract.h"
#include "hersey/core/table_function.h"

namespace hersey::mbd {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kEntries = 16;  // of three matrices and two vectors

double& entry(BearingCoefficients& c, std::size_t index) {
  const auto within = static_cast<Eigen::Index>(index % 4);
  if (index < 4) return c.stiffness(within);
  if (index < 8) return c.damping(within);
  if (index < 12) return c.inertia(within);
  return within < 2 ? c.position(within) : c.force(within - 2);
}

/// Motion of B's origin across the axis.
struct Across {
  explicit Across(const RelativeMotion& motion)
      : r(motion.X_AB.r),
        omega(motion.V_AB_A.head<3>()),
        alpha(motion.A_AB_A.head<3>()),
        u(motion.V_AB_A.tail<3>() + omega.cross(r)),
        rate(motion.A_AB_A.tail<3>() + alpha.cross(r) + omega.cross(u)) {}

  const Vector3 r, omega, alpha;  ///< position, angular velocity and acceleration
  const Vector3 u, rate;          ///< velocity of the origin and its rate
};

}  // namespace

BearingCoefficientTable::BearingCoefficientTable(const std::vector<double>& speeds,
                                                 const std::vector<BearingCoefficients>& coefficients) {
  HERSEY_REQUIRE(!speeds.empty() && speeds.size() == coefficients.size(), "coefficients for every speed");
  for (const BearingCoefficients& c : coefficients)
    HERSEY_REQUIRE(c.inertia.isApprox(c.inertia.transpose(), 1e-9) || c.inertia.isZero(), "an inertia is symmetric");
  lowest_ = speeds.front();
  highest_ = speeds.back();
  for (std::size_t index = 0; index < kEntries; ++index) {
    std::vector<double> values;
    values.reserve(coefficients.size());
    for (BearingCoefficients c : coefficients) values.push_back(entry(c, index));
    entries_.push_back(std::make_unique<const TableFunction>(
        speeds, std::move(values), TableFunction::Options{.interpolation = Interpolation::smooth}));
  }
}

BearingCoefficients BearingCoefficientTable::at(double speed) const {
  const double within = std::clamp(speed, lowest_, highest_);
  BearingCoefficients coefficients;
  for (std::size_t index = 0; index < kEntries; ++index)
    entry(coefficients, index) = entries_[index]->value({&within, 1});
  return coefficients;
}

BearingCoefficients BearingCoefficientTable::slope(double speed) const {
  BearingCoefficients slope;
  if (speed < lowest_ || speed > highest_ || lowest_ == highest_) return slope;
  for (std::size_t index = 0; index < kEntries; ++index)
    entries_[index]->gradient({&speed, 1}, {&entry(slope, index), 1});
  return slope;
}

std::string BearingCoefficientTable::fault_at(double speed) const {
  constexpr double kBeyond = 0.01;  // of the fastest: searches and vibrations overshoot
  constexpr double kRpm = std::numbers::pi / 30;
  const double fastest = std::max(std::abs(lowest_), std::abs(highest_)), margin = kBeyond * fastest;
  const double low = std::min(lowest_, 0.0) - margin, high = std::max(highest_, 0.0) + margin;
  if (lowest_ == highest_ || (speed >= low && speed <= high)) return {};
  return fmt::format(
      "the shaft rotates at {:.4g} rpm against the housing, and the table of coefficients has speeds from {:.4g} to "
      "{:.4g} rpm",
      speed / kRpm, lowest_ / kRpm, highest_ / kRpm);
}

void LinearBearing::evaluate(const RelativeMotion& motion, bool want_tangent, ForceResponse& response) {
  const Across at(motion);
  speed_ = at.omega.z();
  const BearingCoefficients c = table_->at(at.omega.z());
  const Vector2d e = at.r.head<2>() - c.position, u = at.u.head<2>(), rate = at.rate.head<2>();
  Vector3 f = Vector3::Zero();
  f.head<2>() = c.force - c.stiffness * e - c.damping * u - c.inertia * rate;
  response = ForceResponse{};
  response.W_B_A << at.r.cross(f), f;

  const auto lift = [&](const Eigen::Matrix<double, 2, 6>& df, Matrix6& dW) {
    dW.bottomRows<3>().topRows<2>() = df;
    dW.topRows<3>() = skew(at.r) * dW.bottomRows<3>();
  };
  using Directions = Eigen::Matrix<double, 3, 6>;
  // A twist [phi; rho] of B moves its origin by rho + phi x r; a velocity or an acceleration likewise.
  Directions dr;
  dr << -skew(at.r), Matrix3::Identity();
  lift(-c.inertia * dr.topRows<2>(), response.dW_dA);
  if (!want_tangent) return;

  const Matrix3 turned = skew(at.omega);
  const Directions du = turned * dr, d_rate = skew(at.alpha) * dr + turned * du;
  lift(-c.stiffness * dr.topRows<2>() - c.damping * du.topRows<2>() - c.inertia * d_rate.topRows<2>(), response.dW_dX);
  response.dW_dX.topRows<3>() -= skew(f) * dr;

  // Of the velocity, (rotors.2): d(rate) = d(omega) x u + omega x du, and the speed changes the coefficients.
  Directions rate_by_velocity = turned * dr;
  rate_by_velocity.leftCols<3>() -= skew(at.u);
  Eigen::Matrix<double, 2, 6> df_dV = -c.damping * dr.topRows<2>() - c.inertia * rate_by_velocity.topRows<2>();
  const BearingCoefficients s = table_->slope(at.omega.z());
  df_dV.col(2) += s.force - s.stiffness * e + c.stiffness * s.position - s.damping * u - s.inertia * rate;
  lift(df_dV, response.dW_dV);
}

double LinearBearing::stored_energy(const RelativeMotion& motion) const {
  const BearingCoefficients c = table_->at(motion.V_AB_A.z());
  const Vector2d e = motion.X_AB.r.head<2>() - c.position;
  return 0.5 * e.dot(c.stiffness * e) - c.force.dot(e);
}

double LinearBearing::kinetic_energy(const RelativeMotion& motion) const {
  const Vector2d u = Across(motion).u.head<2>();
  return 0.5 * u.dot(table_->at(motion.V_AB_A.z()).inertia * u);
}

// (rotors.3)
double LinearBearing::lost_power(const RelativeMotion& motion) const {
  const Across at(motion);
  const double speed = at.omega.z(), speed_rate = at.alpha.z();
  const BearingCoefficients c = table_->at(speed), s = table_->slope(speed);
  const Vector2d e = at.r.head<2>() - c.position, u = at.u.head<2>();
  const Eigen::Matrix2d symmetric = 0.5 * (c.stiffness + c.stiffness.transpose());
  const double circulated = u.dot((c.stiffness - symmetric) * e), damped = u.dot(c.damping * u);
  const double by_speed = (symmetric * e - c.force).dot(s.position) - 0.5 * e.dot(s.stiffness * e) + s.force.dot(e) -
                          0.5 * u.dot(s.inertia * u);
  return circulated + damped + by_speed * speed_rate;
}

}  // namespace hersey::mbd
