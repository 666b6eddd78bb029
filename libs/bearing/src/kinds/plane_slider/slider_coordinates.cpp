#include "kinds/plane_slider/slider_coordinates.h"

#include <fmt/format.h>

#include <utility>

namespace hersey::bearing {
namespace {

SliderParameters parameters_of(const OperatingPoint& point, const Coordinates& e) {
  SliderParameters p = SliderParameters::Zero();
  p[kSliderE] = e[0], p[kSliderTy] = point.tilt.x(), p[kSliderTz] = point.tilt.y();
  p[kSliderERate] = point.e_rate[0], p[kSliderTyRate] = point.tilt_rate.x(), p[kSliderTzRate] = point.tilt_rate.y();
  p[kSliderSpeed] = point.journal_speed;
  return p;
}

/// F_x, and the moments that work on the slopes (slider.5): -M_z along, M_y across.
SteadyCoordinates::ForceRows slider_force_rows() {
  SteadyCoordinates::ForceRows rows = SteadyCoordinates::ForceRows::Zero(3, 6);
  rows(0, 3) = rows(2, 1) = 1;
  rows(1, 2) = -1;
  return rows;
}

}  // namespace

SliderCoordinates::SliderCoordinates(const film::FilmModel& model, double length, Eigen::VectorXd opening)
    : ApproachCoordinates(model, {.length = length}, -1, length, slider_force_rows()),
      surfaces_(model, std::move(opening)) {}

film::SurfaceMotion SliderCoordinates::surfaces(const OperatingPoint& point, const Coordinates& e) {
  film::SurfaceMotion motion;
  surfaces_.evaluate(parameters_of(point, e), point.growth, 0, motion);
  return motion;
}

std::vector<film::MotionDirection> SliderCoordinates::directions(const Coordinates& /*e*/, Index first,
                                                                 Index count) const {
  std::vector<film::MotionDirection> result;
  for (Index k = first; k < first + count; ++k) result.push_back(surfaces_.direction(k));
  return result;
}

double SliderCoordinates::smallest_gap(const OperatingPoint& point, const Coordinates& e) {
  (void)surfaces(point, e);
  return surfaces_.smallest_gap();
}

std::string SliderCoordinates::position_text(const OperatingPoint& point, const Coordinates& e) const {
  (void)point;
  return fmt::format("film thickness {:.4g} um at the pad's middle", -1e6 * e[0]);
}

}  // namespace hersey::bearing
