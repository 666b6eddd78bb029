#include "kinds/plane_slider/slider_coordinates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hersey::bearing {
namespace {

// Load of a long plane slider near its best inclination over 6 mu U L (B/h)^2 (slider.7).
constexpr double kLongSlider = 0.0267;

// The search for a load goes from this many times the estimated gap down to its fraction below.
constexpr double kWidest = 64, kNarrowest = 1.0 / 256;

// Distance from which on it measures the overlap of surfaces that yield, over what the mean pressure deforms them.
const double kOverlapping = std::log(2 * kWidest / kNarrowest);

// Steps are measured in no less than this fraction of the film's scale: of a gap that is closed, as asperities allow.
constexpr double kLeastScale = 1e-3;

SliderParameters parameters_of(const OperatingPoint& point, const Coordinates& e) {
  SliderParameters p = SliderParameters::Zero();
  p[kSliderE] = e[0], p[kSliderTy] = point.tilt.x(), p[kSliderTz] = point.tilt.y();
  p[kSliderERate] = point.e_rate[0], p[kSliderTyRate] = point.tilt_rate.x(), p[kSliderTzRate] = point.tilt_rate.y();
  p[kSliderSpeed] = point.journal_speed;
  return p;
}

}  // namespace

SliderCoordinates::SliderCoordinates(const film::FilmModel& model, double length, Eigen::VectorXd opening)
    : model_(model), length_(length), surfaces_(model, std::move(opening)), force_rows_(ForceRows::Zero(3, 6)) {
  // F_x, and the moments that work on the slopes (slider.5): -M_z along, M_y across.
  force_rows_(0, 3) = force_rows_(2, 1) = 1;
  force_rows_(1, 2) = -1;
}

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

Coordinates SliderCoordinates::widest() const { return Coordinates::Constant(1, -length_); }

double SliderCoordinates::scale(const OperatingPoint& point, const Coordinates& e) {
  return std::max(smallest_gap(point, e), kLeastScale * clearance(model_));
}

Coordinates SliderCoordinates::with_smallest_gap(const OperatingPoint& point, double gap) {
  const Coordinates widest = this->widest();
  return Coordinates::Constant(1, widest[0] + smallest_gap(point, widest) - gap);
}

Coordinates SliderCoordinates::start(const OperatingPoint& point) {
  const double slenderness = length_ / model_.L;  // side flow of a pad with L = B takes about half of the load
  const double speed = std::max(std::abs(point.journal_speed), std::abs(point.e_rate[0]) * length_ / clearance(model_));
  const double strength =
      6 * model_.lubricant.mu0 * speed * length_ * length_ * model_.L * kLongSlider / (1 + slenderness * slenderness);
  const double gap = std::sqrt(strength / point.load->norm());
  const film::Asperities& rough = model_.asperities;
  const double contact = rough.model == film::AsperityModel::none ? 0 : rough.mean_summit_height + 3 * rough.sigma;
  return with_smallest_gap(point, std::max({gap, contact, kLeastScale * clearance(model_)}));
}

Coordinates SliderCoordinates::opened(const OperatingPoint& point, const Coordinates& e, int k) {
  return with_smallest_gap(point, std::exp2(k) * smallest_gap(point, e));
}

// The distance is the logarithm of the widest gap looked at over the gap.
// Surfaces that yield overlap beyond the narrowest gap by up to a few times what the load deforms them.
std::vector<double> SliderCoordinates::distances(const OperatingPoint& /*point*/, double /*depth*/) {
  std::vector<double> result;
  for (double gap = kWidest; gap > kNarrowest; gap /= 2) result.push_back(std::log(2 * kWidest / gap));
  for (double fraction = 0.25; model_.compliance > 0 && fraction <= 8; fraction *= 2)
    result.push_back(kOverlapping + fraction);
  return result;
}

Coordinates SliderCoordinates::at(const OperatingPoint& point, double distance, double /*angle*/) {
  const double depth = model_.compliance * point.load->norm() / (length_ * model_.L);
  if (distance > kOverlapping) return with_smallest_gap(point, -(distance - kOverlapping) * depth);
  return with_smallest_gap(point, 2 * kWidest * std::exp(-distance) * smallest_gap(point, start(point)));
}

std::string SliderCoordinates::position_text(const OperatingPoint& point, const Coordinates& e) const {
  (void)point;
  return fmt::format("film thickness {:.4g} um at the pad's middle", -1e6 * e[0]);
}

}  // namespace hersey::bearing
