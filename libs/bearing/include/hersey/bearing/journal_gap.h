#pragma once

#include <optional>

#include "hersey/bearing/gap_kinematics.h"
#include "hersey/bearing/journal_kinematics.h"
#include "hersey/bearing/rigid_surfaces.h"

namespace hersey::bearing {

/// The gap between a journal, whose axis is the z-axis of frame B, and its bore, whose axis is that of frame A.
class JournalGap final : public GapKinematics {
 public:
  /// @param journal_deforms  its deformation rotates with it, as features and profiles of the journal do
  JournalGap(const film::FilmModel& model, bool journal_deforms);

  /// After a step that ended near the centre, the widest gap, and with it a supply there, keeps its angle over the
  /// step.
  void begin_step(const mbd::RelativeMotion& start) override;
  void end_step(const mbd::RelativeMotion& end) override;
  void persist(Archive& archive) override;
  [[nodiscard]] std::string evaluate(const mbd::RelativeMotion& motion, film::SurfaceMotion& surfaces) override;
  [[nodiscard]] const film::MotionDirection& direction(Index parameter) const override;
  [[nodiscard]] bool is_angle(Index parameter) const override;
  [[nodiscard]] double smallest_gap() const override { return surfaces_.smallest_gap(); }
  [[nodiscard]] std::string contact_text() const override { return "the journal touches the shell"; }
  [[nodiscard]] std::string position_text() const override;
  [[nodiscard]] Turning turning() const override;
  [[nodiscard]] GapPosition position(const mbd::RelativeMotion& motion) const override;
  [[nodiscard]] Eigen::VectorXd relative_shift(const Pose& before, const Pose& after) const override;

 private:
  double R_, L_, c_;
  RigidSurfaces surfaces_;
  JournalKinematics kinematics_;
  bool is_near_centre_ = false;         ///< as the last step ended
  std::optional<double> fixed_supply_;  ///< angle of the widest gap over the step [rad]
};

}  // namespace hersey::bearing
