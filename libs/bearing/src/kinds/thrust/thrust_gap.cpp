#include "kinds/thrust/thrust_gap.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "hersey/bearing/clearance.h"

namespace hersey::bearing {

ThrustGap::ThrustGap(const film::FilmModel& model, Eigen::VectorXd opening)
    : c_(clearance(model)), surfaces_(model, std::move(opening)) {
  parameters_ = Eigen::VectorXd::Zero(kThrustParameterCount);
  d_dX_ = d_dV_ = Jacobian::Zero(kThrustParameterCount, 6);
}

std::string ThrustGap::evaluate(const mbd::RelativeMotion& motion, film::SurfaceMotion& surfaces) {
  if (!faces_stator(motion.X_AB)) {
    return fmt::format("the surfaces do not face each other: the runner's z-axis is at {:.0f} deg to the stator's",
                       std::acos(std::abs(motion.X_AB.R(2, 2))) * 180 / std::numbers::pi);
  }
  const ThrustKinematics kinematics = thrust_kinematics(motion.X_AB, motion.V_AB_A);
  parameters_ = kinematics.value;
  d_dX_ = kinematics.d_dX;
  d_dV_ = kinematics.d_dV;
  surfaces_.evaluate(kinematics.value, growth_, growth_rate_, surfaces);
  return {};
}

std::string ThrustGap::position_text() const {
  return fmt::format(
      "the runner is {:.4g} um from the stator's plane on its axis, and its axis leans by {:.4g} towards x and {:.4g} "
      "towards y",
      1e6 * parameters_[kThrustZ], parameters_[kThrustAx], parameters_[kThrustAy]);
}

// A runner is an even plane, and pads with their features and shapes rest on the stator: nothing moves over the grid.
ThrustGap::Turning ThrustGap::turning() const { return {}; }

GapPosition ThrustGap::position(const mbd::RelativeMotion& motion) const {
  const ThrustKinematics k = thrust_kinematics(motion.X_AB, motion.V_AB_A);
  return {.e = Coordinates::Constant(1, k.value[kThrustZ]),
          .tilt = {k.value[kThrustAx], k.value[kThrustAy]},
          .speed = k.value[kThrustSpeed],
          .relative = Eigen::VectorXd::Constant(1, 1 - k.value[kThrustZ] / c_)};
}

Eigen::VectorXd ThrustGap::relative_shift(const Pose& before, const Pose& after) const {
  const double shift = thrust_kinematics(after, Vector6::Zero()).value[kThrustZ] -
                       thrust_kinematics(before, Vector6::Zero()).value[kThrustZ];
  return Eigen::VectorXd::Constant(1, shift / c_);
}

}  // namespace hersey::bearing
