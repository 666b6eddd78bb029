#pragma once

#include "hersey/bearing/gap_kinematics.h"
#include "kinds/thrust/thrust_surfaces.h"

namespace hersey::bearing {

/// The gap between a stator, whose pads lie on the plane z = 0 of frame A, and a runner, the plane z = 0 of frame B.
class ThrustGap final : public GapKinematics {
 public:
  /// As ThrustSurfaces.
  ThrustGap(const film::FilmModel& model, Eigen::VectorXd opening);

  [[nodiscard]] std::string evaluate(const mbd::RelativeMotion& motion, film::SurfaceMotion& surfaces) override;
  [[nodiscard]] const film::MotionDirection& direction(Index parameter) const override {
    return surfaces_.direction(parameter);
  }
  [[nodiscard]] bool is_angle(Index /*parameter*/) const override { return false; }
  [[nodiscard]] double smallest_gap() const override { return surfaces_.smallest_gap(); }
  [[nodiscard]] std::string contact_text() const override { return "the runner touches the stator"; }
  [[nodiscard]] std::string position_text() const override;
  [[nodiscard]] Turning turning() const override;
  [[nodiscard]] GapPosition position(const mbd::RelativeMotion& motion) const override;
  [[nodiscard]] Eigen::VectorXd relative_shift(const Pose& before, const Pose& after) const override;

 private:
  double c_;
  ThrustSurfaces surfaces_;
};

}  // namespace hersey::bearing
