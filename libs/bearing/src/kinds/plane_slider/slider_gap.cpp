#include "kinds/plane_slider/slider_gap.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "hersey/bearing/clearance.h"

namespace hersey::bearing {

SliderGap::SliderGap(const film::FilmModel& model, Eigen::VectorXd opening)
    : c_(clearance(model)), surfaces_(model, std::move(opening)) {
  parameters_ = Eigen::VectorXd::Zero(kSliderParameterCount);
  d_dX_ = d_dV_ = Jacobian::Zero(kSliderParameterCount, 6);
}

std::string SliderGap::evaluate(const mbd::RelativeMotion& motion, film::SurfaceMotion& surfaces) {
  if (!faces_pad(motion.X_AB)) {
    return fmt::format("the surfaces do not face each other: the runner's x-axis is at {:.0f} deg to the pad's",
                       std::acos(std::abs(motion.X_AB.R(0, 0))) * 180 / std::numbers::pi);
  }
  const SliderKinematics kinematics = slider_kinematics(motion.X_AB, motion.V_AB_A);
  parameters_ = kinematics.value;
  d_dX_ = kinematics.d_dX;
  d_dV_ = kinematics.d_dV;
  surfaces_.evaluate(kinematics.value, growth_, growth_rate_, surfaces);
  return {};
}

std::string SliderGap::position_text() const {
  return fmt::format(
      "the pad's middle is {:.4g} um from the runner, which leans by {:.4g} along and {:.4g} across the "
      "sliding direction",
      -1e6 * parameters_[kSliderE], parameters_[kSliderTy], parameters_[kSliderTz]);
}

// No surface of a slider turns over its grid; a pad's features and shapes rest on it.
GapKinematics::Turning SliderGap::turning() const { return {}; }

GapPosition SliderGap::position(const mbd::RelativeMotion& motion) const {
  const SliderKinematics k = slider_kinematics(motion.X_AB, motion.V_AB_A);
  return {.e = Coordinates::Constant(1, k.value[kSliderE]),
          .tilt = {k.value[kSliderTy], k.value[kSliderTz]},
          .speed = k.value[kSliderSpeed],
          .relative = Eigen::VectorXd::Constant(1, 1 + k.value[kSliderE] / c_)};
}

Eigen::VectorXd SliderGap::relative_shift(const Pose& before, const Pose& after) const {
  const double shift = slider_kinematics(after, Vector6::Zero()).value[kSliderE] -
                       slider_kinematics(before, Vector6::Zero()).value[kSliderE];
  return Eigen::VectorXd::Constant(1, shift / c_);
}

}  // namespace hersey::bearing
