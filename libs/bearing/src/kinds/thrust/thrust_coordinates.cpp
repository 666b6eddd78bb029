#include "kinds/thrust/thrust_coordinates.h"

#include <fmt/format.h>

#include <utility>

namespace hersey::bearing {
namespace {

ThrustParameters parameters_at(const OperatingPoint& point, const Coordinates& e) {
  ThrustParameters p = ThrustParameters::Zero();
  p[kThrustZ] = e[0], p[kThrustAx] = point.tilt.x(), p[kThrustAy] = point.tilt.y();
  p[kThrustZRate] = point.e_rate[0], p[kThrustAxRate] = point.tilt_rate.x(), p[kThrustAyRate] = point.tilt_rate.y();
  p[kThrustSpeed] = point.journal_speed;
  return p;
}

/// F_z, M_y and -M_x (thrust.6).
SteadyCoordinates::ForceRows thrust_force_rows() {
  SteadyCoordinates::ForceRows rows = SteadyCoordinates::ForceRows::Zero(3, 6);
  rows(0, 5) = rows(1, 1) = 1;
  rows(2, 0) = -1;
  return rows;
}

}  // namespace

ThrustCoordinates::ThrustCoordinates(const film::FilmModel& model, int pads, double arc, Eigen::VectorXd opening)
    : ApproachCoordinates(model, {.length = model.R * arc, .count = pads, .radius = model.R}, 1, 2 * model.R + model.L,
                          thrust_force_rows()),
      surfaces_(model, std::move(opening)) {}

film::SurfaceMotion ThrustCoordinates::surfaces(const OperatingPoint& point, const Coordinates& e) {
  film::SurfaceMotion motion;
  surfaces_.evaluate(parameters_at(point, e), point.growth, 0, motion);
  return motion;
}

std::vector<film::MotionDirection> ThrustCoordinates::directions(const Coordinates& /*e*/, Index first,
                                                                 Index count) const {
  std::vector<film::MotionDirection> result;
  for (Index k = first; k < first + count; ++k) result.push_back(surfaces_.direction(k));
  return result;
}

double ThrustCoordinates::smallest_gap(const OperatingPoint& point, const Coordinates& e) {
  (void)surfaces(point, e);
  return surfaces_.smallest_gap();
}

std::string ThrustCoordinates::position_text(const OperatingPoint& /*point*/, const Coordinates& e) const {
  return fmt::format("film thickness {:.4g} um on the axis", 1e6 * e[0]);
}

}  // namespace hersey::bearing
