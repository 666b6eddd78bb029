#pragma once

#include "kinds/approach/approach_coordinates.h"
#include "kinds/thrust/thrust_surfaces.h"

namespace hersey::bearing {

/// The single coordinate zeta of a runner above its stator: the film thickness on the axis. Forces are those of the
/// film on the stator, F_z along it and the moments M_y and -M_x on the slopes of the runner's axis (thrust.6): the
/// load of an operating point, on the runner, is negative.
class ThrustCoordinates final : public ApproachCoordinates {
 public:
  /// Keeps a reference to `model`. @param pads  their number @param arc  of each [rad] @param opening  as
  /// ThrustSurfaces
  ThrustCoordinates(const film::FilmModel& model, int pads, double arc, Eigen::VectorXd opening);

  [[nodiscard]] film::SurfaceMotion surfaces(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] std::vector<film::MotionDirection> directions(const Coordinates& e, Index first,
                                                              Index count) const override;
  [[nodiscard]] double smallest_gap(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] std::string position_text(const OperatingPoint& point, const Coordinates& e) const override;

 private:
  ThrustSurfaces surfaces_;
};

}  // namespace hersey::bearing
