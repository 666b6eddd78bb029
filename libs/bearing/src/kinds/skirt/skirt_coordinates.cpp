#include "kinds/skirt/skirt_coordinates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hersey/bearing/clearance.h"

namespace hersey::bearing {
namespace {

// The narrowest gap that the search for a side force looks at, over the way to contact.
constexpr double kNarrowestSkirtGap = 1e-3;

double sense_of_force(const OperatingPoint& point) { return point.load && (*point.load)[0] < 0 ? -1 : 1; }

}  // namespace

SkirtCoordinates::SkirtCoordinates(const film::FilmModel& model, Eigen::VectorXd opening,
                                   std::optional<LinerBore> liner)
    : model_(model), surfaces_(model, std::move(opening), std::move(liner)), force_rows_(ForceRows::Zero(3, 6)) {
  // Of the skirt's own motion, so against what the film does to it: -F_x, -M_y, M_x (skirt.5).
  force_rows_(0, 3) = force_rows_(1, 1) = -1;
  force_rows_(2, 0) = 1;
  cosine_ = surfaces_.direction(kEx).g;
}

film::SurfaceMotion SkirtCoordinates::surfaces(const OperatingPoint& point, const Coordinates& e) {
  ParameterVector liner = ParameterVector::Zero();
  liner[kEx] = -e[0], liner[kExRate] = -point.e_rate[0];
  liner.segment<2>(kTx) = -point.tilt;
  liner.segment<2>(kTxRate) = -point.tilt_rate;
  liner[kAxialSpeed] = -model_.R * point.journal_speed;
  film::SurfaceMotion motion;
  surfaces_.evaluate(liner, point.growth, 0, 1, motion);
  return motion;
}

std::vector<film::MotionDirection> SkirtCoordinates::directions(const Coordinates& /*e*/, Index first,
                                                                Index count) const {
  static constexpr std::array<Index, 6> of_liner{kEx, kTx, kTy, kExRate, kTxRate, kTyRate};
  std::vector<film::MotionDirection> result;
  for (Index k = first; k < first + count; ++k) {
    result.push_back(surfaces_.direction(of_liner.at(static_cast<std::size_t>(k))));
    result.back().g = -result.back().g;
    result.back().g_rate = -result.back().g_rate;
  }
  return result;
}

double SkirtCoordinates::smallest_gap(const OperatingPoint& point, const Coordinates& e) {
  (void)surfaces(point, e);
  return surfaces_.smallest_gap();
}

double SkirtCoordinates::scale(const OperatingPoint& point, const Coordinates& /*e*/) {
  return clearance(model_, point);
}

double SkirtCoordinates::room(const OperatingPoint& point) {
  const double sense = sense_of_force(point);
  const Eigen::VectorXd g = surfaces(point, Coordinates::Zero(1)).g;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < g.size(); ++k)
    if (sense * cosine_[k] > 0) least = std::min(least, g[k] / (sense * cosine_[k]));
  return least;
}

Coordinates SkirtCoordinates::start(const OperatingPoint& point) {
  return Coordinates::Constant(1, 0.5 * sense_of_force(point) * room(point));
}

Coordinates SkirtCoordinates::opened(const OperatingPoint& /*point*/, const Coordinates& e, int k) {
  return std::exp2(-k) * e;
}

// Each distance halves what is left of the gap; surfaces that yield overlap beyond it by up to a few times what the
// force deforms them.
std::vector<double> SkirtCoordinates::distances(const OperatingPoint& point, double depth) {
  const double way = room(point);
  std::vector<double> result;
  for (double gap = 0.5; gap > kNarrowestSkirtGap; gap /= 2) result.push_back((1 - gap) * way);
  depth += model_.compliance * point.load->norm() / (model_.R * model_.L);
  for (double fraction = 0.25; depth > 0 && fraction <= 8; fraction *= 2) result.push_back(way + fraction * depth);
  return result;
}

Coordinates SkirtCoordinates::at(const OperatingPoint& point, double distance, double /*angle*/) {
  return Coordinates::Constant(1, sense_of_force(point) * distance);
}

std::string SkirtCoordinates::position_text(const OperatingPoint& /*point*/, const Coordinates& e) const {
  return fmt::format("{:.4g} um from the liner's axis towards the thrust side at half of its length", 1e6 * e[0]);
}

}  // namespace hersey::bearing
