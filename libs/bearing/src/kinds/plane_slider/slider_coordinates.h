#pragma once

#include "hersey/bearing/steady_coordinates.h"
#include "kinds/plane_slider/slider_surfaces.h"

namespace hersey::bearing {

/// The single coordinate e of a runner below a pad: minus the film thickness at the pad's middle.
class SliderCoordinates final : public SteadyCoordinates {
 public:
  /// Keeps a reference to `model`. @param length  of the pad [m] @param opening  as SliderSurfaces
  SliderCoordinates(const film::FilmModel& model, double length, Eigen::VectorXd opening);

  [[nodiscard]] Index count() const override { return 1; }
  [[nodiscard]] const ForceRows& force_rows() const override { return force_rows_; }
  [[nodiscard]] film::SurfaceMotion surfaces(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] std::vector<film::MotionDirection> directions(const Coordinates& e, Index first,
                                                              Index count) const override;
  [[nodiscard]] double smallest_gap(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] Coordinates widest() const override;
  [[nodiscard]] double scale(const OperatingPoint& point, const Coordinates& e) override;
  [[nodiscard]] Coordinates start(const OperatingPoint& point) override;
  [[nodiscard]] Coordinates opened(const OperatingPoint& point, const Coordinates& e, int k) override;
  [[nodiscard]] std::vector<double> distances(const OperatingPoint& point, double depth) override;
  [[nodiscard]] Coordinates at(const OperatingPoint& point, double distance, double angle) override;
  [[nodiscard]] std::string position_text(const OperatingPoint& point, const Coordinates& e) const override;

 private:
  [[nodiscard]] Coordinates with_smallest_gap(const OperatingPoint& point, double gap);

  const film::FilmModel& model_;
  double length_;
  SliderSurfaces surfaces_;
  ForceRows force_rows_;
};

}  // namespace hersey::bearing
