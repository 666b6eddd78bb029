#include "kinds/skirt/skirt_gap.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "gap/varied.h"
#include "hersey/bearing/clearance.h"

namespace hersey::bearing {
namespace {

// Of the skirt's origin along the liner's axis, from the liner's own.
Varied height_above_liner(const Pose& X_AB) {
  const VariedVector r = varied_origin(X_AB.r), d = varied_direction(X_AB.R.col(2));
  const Varied zero{0, Eigen::Matrix<double, 1, 6>::Zero()};
  return zero - r[0] * d[0] - r[1] * d[1] - r[2] * d[2];
}

}  // namespace

// The liner is to the skirt what a journal is to its shell (skirt.1), with the same speeds (skirt.4).
SkirtGap::SkirtGap(const film::FilmModel& model, Eigen::VectorXd opening, std::optional<LinerBore> liner)
    : R_(model.R), L_(model.L), c_(clearance(model)), surfaces_(model, std::move(opening), std::move(liner)) {
  parameters_ = Eigen::VectorXd::Zero(surfaces_.parameter_count());
  d_dX_ = d_dV_ = Jacobian::Zero(surfaces_.parameter_count(), 6);
}

std::string SkirtGap::evaluate(const mbd::RelativeMotion& motion, film::SurfaceMotion& surfaces) {
  if (!is_aligned(motion.X_AB)) {
    return fmt::format("the surfaces do not face each other: the liner's z-axis is at {:.0f} deg to the skirt's",
                       std::acos(std::abs(motion.X_AB.R(2, 2))) * 180 / std::numbers::pi);
  }
  JournalKinematics liner = journal_kinematics(motion.X_AB, motion.V_AB_A, R_, c_);
  const Varied height = height_above_liner(motion.X_AB);
  liner.value[kSkirtHeight] = height.value;
  liner.d_dX.row(kSkirtHeight) = height.d;
  liner.d_dV.row(kSkirtHeight).setZero();
  parameters_ = liner.value.head(parameters_.size());
  d_dX_ = liner.d_dX.topRows(parameters_.size());
  d_dV_ = liner.d_dV.topRows(parameters_.size());
  surfaces_.evaluate(liner.value, growth_, growth_rate_, std::copysign(1.0, motion.X_AB.R(2, 2)), surfaces);
  return {};
}

std::string SkirtGap::position_text() const {
  const double e = -parameters_[kEx], half_rise = -0.5 * L_ * parameters_[kTx];
  return fmt::format("the skirt is off the liner's axis by {:.4g} um at its top and {:.4g} um at its bottom",
                     1e6 * (e + half_rise), 1e6 * (e - half_rise));
}

// No surface of a skirt turns over its grid: its shape rests on it.
GapKinematics::Turning SkirtGap::turning() const { return {}; }

GapPosition SkirtGap::position(const mbd::RelativeMotion& motion) const {
  const JournalKinematics liner = journal_kinematics(motion.X_AB, motion.V_AB_A, R_, c_);
  return {.e = Coordinates::Constant(1, -liner.value[kEx]),
          .tilt = -liner.tilt(),
          .speed = -liner.value[kAxialSpeed],
          .relative = -liner.e() / (c_ + growth_)};
}

Eigen::VectorXd SkirtGap::relative_shift(const Pose& before, const Pose& after) const {
  const Vector6 rest = Vector6::Zero();
  return (journal_kinematics(before, rest, R_, c_).e() - journal_kinematics(after, rest, R_, c_).e()) / c_;
}

}  // namespace hersey::bearing
