#include "kinds/approach/approach_coordinates.h"

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

}  // namespace

ApproachCoordinates::ApproachCoordinates(const film::FilmModel& model, PadSize pads, double sign, double widest,
                                         ForceRows force_rows)
    : model_(model), pads_(pads), sign_(sign), widest_(widest), force_rows_(std::move(force_rows)) {}

double ApproachCoordinates::scale(const OperatingPoint& point, const Coordinates& e) {
  return std::max(smallest_gap(point, e), kLeastScale * clearance(model_));
}

Coordinates ApproachCoordinates::with_smallest_gap(const OperatingPoint& point, double gap) {
  const Coordinates widest = this->widest();
  return Coordinates::Constant(1, widest[0] - sign_ * (smallest_gap(point, widest) - gap));
}

// Pads in a row, each a long plane slider near its best inclination (slider.7), (thrust.8).
Coordinates ApproachCoordinates::start(const OperatingPoint& point) {
  const double length = pads_.length;
  const double slenderness = length / model_.L;  // side flow of a pad with L = B takes about half of the load
  const double speed =
      std::max(pads_.radius * std::abs(point.journal_speed), std::abs(point.e_rate[0]) * length / clearance(model_));
  const double strength = 6 * pads_.count * model_.lubricant.mu0 * speed * length * length * model_.L * kLongSlider /
                          (1 + slenderness * slenderness);
  const double gap = std::sqrt(strength / point.load->norm());
  const film::Asperities& rough = model_.asperities;
  const double contact = rough.model == film::AsperityModel::none ? 0 : rough.mean_summit_height + 3 * rough.sigma;
  return with_smallest_gap(point, std::max({gap, contact, kLeastScale * clearance(model_)}));
}

Coordinates ApproachCoordinates::opened(const OperatingPoint& point, const Coordinates& e, int k) {
  return with_smallest_gap(point, std::exp2(k) * smallest_gap(point, e));
}

// The distance is the logarithm of the widest gap looked at over the gap.
// Surfaces that yield overlap beyond the narrowest gap by up to a few times what the load deforms them.
std::vector<double> ApproachCoordinates::distances(const OperatingPoint& /*point*/, double /*depth*/) {
  std::vector<double> result;
  for (double gap = kWidest; gap > kNarrowest; gap /= 2) result.push_back(std::log(2 * kWidest / gap));
  for (double fraction = 0.25; model_.compliance > 0 && fraction <= 8; fraction *= 2)
    result.push_back(kOverlapping + fraction);
  return result;
}

Coordinates ApproachCoordinates::at(const OperatingPoint& point, double distance, double /*angle*/) {
  const double depth = model_.compliance * point.load->norm() / (pads_.count * pads_.length * model_.L);
  if (distance > kOverlapping) return with_smallest_gap(point, -(distance - kOverlapping) * depth);
  return with_smallest_gap(point, 2 * kWidest * std::exp(-distance) * smallest_gap(point, start(point)));
}

}  // namespace hersey::bearing
