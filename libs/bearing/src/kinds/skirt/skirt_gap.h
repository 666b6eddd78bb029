#pragma once

#include "hersey/bearing/gap_kinematics.h"
#include "kinds/skirt/skirt_surfaces.h"

namespace hersey::bearing {

/// The gap between a skirt, a cylinder about the z-axis of frame A, and a liner about that of frame B. The position is
/// that of the skirt in the liner.
class SkirtGap final : public GapKinematics {
 public:
  /// As SkirtSurfaces.
  SkirtGap(const film::FilmModel& model, Eigen::VectorXd opening, std::optional<LinerBore> liner = {});

  [[nodiscard]] std::string evaluate(const mbd::RelativeMotion& motion, film::SurfaceMotion& surfaces) override;
  [[nodiscard]] const film::MotionDirection& direction(Index parameter) const override {
    return surfaces_.direction(parameter);
  }
  [[nodiscard]] bool is_angle(Index /*parameter*/) const override { return false; }
  [[nodiscard]] double smallest_gap() const override { return surfaces_.smallest_gap(); }
  [[nodiscard]] std::string contact_text() const override { return "the skirt touches the liner"; }
  [[nodiscard]] std::string position_text() const override;
  [[nodiscard]] Turning turning() const override;
  [[nodiscard]] GapPosition position(const mbd::RelativeMotion& motion) const override;
  [[nodiscard]] Eigen::VectorXd relative_shift(const Pose& before, const Pose& after) const override;

 private:
  double R_, L_, c_;
  SkirtSurfaces surfaces_;
};

}  // namespace hersey::bearing
