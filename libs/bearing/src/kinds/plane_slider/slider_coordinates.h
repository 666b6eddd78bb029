#pragma once

#include "kinds/approach/approach_coordinates.h"
#include "kinds/plane_slider/slider_surfaces.h"

namespace hersey::bearing {

/// The single coordinate e of a runner below a pad: minus the film thickness at the pad's middle.
class SliderCoordinates final : public ApproachCoordinates {
 public:
  /// Keeps a reference to `model`. @param length  of the pad [m] @param opening  as SliderSurfaces
  SliderCoordinates(const film::FilmModel& model, double length, Eigen::VectorXd opening);

  [[nodiscard]] film::SurfaceMotion surfaces(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] std::vector<film::MotionDirection> directions(const Coordinates& e, Index first,
                                                              Index count) const override;
  [[nodiscard]] double smallest_gap(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] std::string position_text(const OperatingPoint& point, const Coordinates& e) const override;

 private:
  SliderSurfaces surfaces_;
};

}  // namespace hersey::bearing
