#include "hersey/bearing/bearing_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hersey::bearing {
namespace {

constexpr double kStandardGravity = 9.80665;

double angle_of(const Eigen::Vector2d& v) { return std::atan2(v.y(), v.x()); }

double sense_of(const OperatingPoint& point) { return std::copysign(1.0, point.entraining_speed()); }

}  // namespace

BearingNumbers bearing_numbers(const film::FilmModel& model, const SteadyState& state) {
  BearingNumbers n;
  const double c = clearance(model, state.point);
  const double W = state.load.norm(), area = 2 * model.R * model.L, R_c = model.R / c;
  const double omega = std::abs(state.point.entraining_speed());
  n.load = W;
  n.load_angle = angle_of(state.load);
  n.eccentricity_ratio = state.e.norm() / c;
  n.eccentricity_angle = angle_of(state.e);
  n.attitude = std::remainder(sense_of(state.point) * (n.eccentricity_angle - n.load_angle), 2 * std::numbers::pi);
  n.hersey = model.lubricant.mu0 * omega / (2 * std::numbers::pi) * area / W;
  n.sommerfeld_S = n.hersey * R_c * R_c;
  n.sommerfeld_So = 1 / (2 * std::numbers::pi * n.sommerfeld_S);
  // At the centre every direction is along the eccentricity.
  const double r = state.e.norm();
  n.radial_velocity = r > 0 ? state.point.e_rate.dot(state.e) / r : state.point.e_rate.norm();
  if (n.radial_velocity != 0)
    n.sommerfeld_squeeze = W / area / (R_c * R_c) / (model.lubricant.mu0 * std::abs(n.radial_velocity) / c);
  n.friction_journal = std::abs(state.film.torque_journal) / (model.R * W);
  n.friction_shell = std::abs(state.film.torque_shell) / (model.R * W);
  if (model.asperities.model != film::AsperityModel::none) {
    const Eigen::Vector2d borne = state.film.force_asperity.head<2>();
    n.asperity_share = std::max(0.0, borne.dot(state.load) / (W * W));
    n.film_ratio = state.film.h_min / model.asperities.sigma;
  } else if (model.roughness.counts()) {
    n.film_ratio = state.film.h_min / model.roughness.composite_sigma();
  }
  return n;
}

LoadAxesCoefficients in_load_axes(const film::FilmModel& model, const SteadyState& state) {
  const double W = state.load.norm(), omega = std::abs(state.point.entraining_speed());
  const Eigen::Vector2d x = state.load / W;
  Eigen::Matrix2d axes;  // columns x and y of the load's axes in the bearing's
  axes << x.x(), -sense_of(state.point) * x.y(), x.y(), sense_of(state.point) * x.x();
  const DynamicCoefficients& all = state.coefficients;
  const double c = clearance(model, state.point);
  LoadAxesCoefficients result;
  result.K = axes.transpose() * all.stiffness.topLeftCorner<2, 2>() * axes * (c / W);
  result.C = axes.transpose() * all.damping.topLeftCorner<2, 2>() * axes * (c * omega / W);
  return result;
}

WhirlStability whirl_stability(const LoadAxesCoefficients& coefficients, double c, double W, double omega) {
  const Eigen::Matrix2d &K = coefficients.K, &C = coefficients.C;
  WhirlStability result;
  // At the threshold the film acts on the circling rotor as a spring of stiffness k0 without damping (bearing.32).
  const double k0 = (K(0, 0) * C(1, 1) + K(1, 1) * C(0, 0) - K(0, 1) * C(1, 0) - K(1, 0) * C(0, 1)) / C.trace();
  const double gamma2 = ((K(0, 0) - k0) * (K(1, 1) - k0) - K(0, 1) * K(1, 0)) / C.determinant();
  const double infinity = std::numeric_limits<double>::infinity();
  if (omega == 0 || gamma2 <= 0) {
    result.always_stable = true;
    result.critical_mass = result.stability_number = result.threshold_speed = infinity;
    return result;
  }
  result.whirl_ratio = std::sqrt(gamma2);
  if (k0 <= 0) {
    result.never_stable = true;
    return result;
  }
  result.stability_number = std::sqrt(k0 / gamma2);
  result.critical_mass = k0 / gamma2 * W / (c * omega * omega);
  result.threshold_speed = result.stability_number * std::sqrt(kStandardGravity / c);
  return result;
}

}  // namespace hersey::bearing
