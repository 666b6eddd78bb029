#include "heat/layer_shear.h"

#include <algorithm>
#include <cmath>

#include "heat/layer_profile.h"
#include "hersey/core/contract.h"

namespace hersey::film {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// Newton's method converges quadratically: after a change of this fraction of the largest rate its square is left.
// Steps that are shortened are checked by the ratio R of each layer.
constexpr double newton_change = 1e-4, shortened_change = 1e-6;
// Oils whose stress hardly rises take some 80 of the shortened steps.
constexpr int most_newton = 12, most_shortened = 1000;

// Largest fraction of the potential's initial slope that is left at the end of a step.
constexpr double flat = 0.3;

// A rate that changes by less than this fraction of itself determines its viscosity to first order. A rate close to
// zero, where the stress changes its sign, does not.
constexpr double first_order = 1e-3;

}  // namespace

LayerShear::LayerShear(const ShearThinning& thinning, int layers)
    : thinning_(thinning), across_(layering_of(static_cast<std::size_t>(layers))) {
  const auto n = static_cast<std::size_t>(layers);
  rates_.resize(n), missing_.resize(n), by_stress_.resize(n), ratios_.resize(n), sizes_.resize(n), left_.resize(n);
  mu_.resize(n), steps_.resize(n);
}

/// Stress in the middle of a layer over that in the middle of the film.
Vector2d LayerShear::beyond_mean(std::size_t l) const { return (across_.middle(l) - 0.5) * shear_.fall; }

/// Rates at given viscosities: the stress is linear across the film.
void LayerShear::follow(std::span<const double> left) {
  double sum = 0;
  Vector2d by_pressure = Vector2d::Zero();
  for (std::size_t l = 0; l < rates_.size(); ++l) {
    const double fluidity = across_.width(l) / (mu_n_[l] * left[l]);
    sum += fluidity;
    by_pressure += fluidity * beyond_mean(l);
  }
  const Vector2d mean = (shear_.rate - by_pressure) / sum;
  for (std::size_t l = 0; l < rates_.size(); ++l) rates_[l] = (mean + beyond_mean(l)) / (mu_n_[l] * left[l]);
}

void LayerShear::look() {
  for (std::size_t l = 0; l < rates_.size(); ++l) {
    sizes_[l] = rates_[l].norm();
    ratios_[l] = thinning_.ratio(sizes_[l], mu_n_[l]);
    left_[l] = ratios_[l].value;
  }
}

/// Computes steps towards rates whose stresses are linear across the film; all rates still add up to the sliding.
void LayerShear::find_steps() {
  look();
  Matrix2d all = Matrix2d::Zero();
  Vector2d rest = shear_.rate;
  for (std::size_t l = 0; l < rates_.size(); ++l) {
    const double secant = mu_n_[l] * ratios_[l].value, tangent = mu_n_[l] * ratios_[l].tangent().value;
    by_stress_[l] = Matrix2d::Identity() / secant;
    if (sizes_[l] > 0)
      by_stress_[l] += (1 / tangent - 1 / secant) / (sizes_[l] * sizes_[l]) * rates_[l] * rates_[l].transpose();
    missing_[l] = beyond_mean(l) - secant * rates_[l];
    all += across_.width(l) * by_stress_[l];
    rest -= across_.width(l) * (rates_[l] + by_stress_[l] * missing_[l]);
  }
  mean_ = all.inverse() * rest;
  for (std::size_t l = 0; l < rates_.size(); ++l) steps_[l] = by_stress_[l] * (mean_ + missing_[l]);
}

/// Returns the size of the step over the largest rate, or the change of the ratio R of a layer if that is larger. The
/// latter is computed to first order.
double LayerShear::take_steps() {
  double largest = 0, change = 0, change_left = 0;
  for (std::size_t l = 0; l < rates_.size(); ++l) {
    const double along = rates_[l].dot(steps_[l]), size = steps_[l].norm(), before = left_[l];
    rates_[l] += steps_[l];
    if (size < first_order * sizes_[l])
      left_[l] += ratios_[l].slope * along / (sizes_[l] * sizes_[l]);
    else if (size > 0)
      left_[l] = thinning_.ratio(rates_[l].norm(), mu_n_[l]).value;
    largest = std::max(largest, rates_[l].norm()), change = std::max(change, size);
    change_left = std::max(change_left, std::abs(left_[l] / before - 1));
  }
  return std::max(largest > 0 ? change / largest : change, change_left);
}

bool LayerShear::by_newton(std::span<double> left) {
  for (int k = 0; k < most_newton; ++k) {
    find_steps();
    if (!(take_steps() <= newton_change)) continue;
    std::copy(left_.begin(), left_.end(), left.begin());
    return true;
  }
  return false;
}

/// True if the steps change the ratio R of every layer by next to nothing. NaN is not near.
bool LayerShear::is_near() const {
  for (std::size_t l = 0; l < rates_.size(); ++l) {
    const double then = thinning_.ratio((rates_[l] + steps_[l]).norm(), mu_n_[l]).value;
    if (!(std::abs(then / left_[l] - 1) <= shortened_change)) return false;
  }
  return true;
}

/// Returns the slope of the potential (thermal.67) along the steps, at a fraction of them. The mean of the steps is
/// zero, so that a stress common to all layers does not count.
double LayerShear::slope_at(double step_length) const {
  double slope = 0;
  for (std::size_t l = 0; l < rates_.size(); ++l) {
    const Vector2d rate = rates_[l] + step_length * steps_[l];
    const double mu = mu_n_[l] * thinning_.ratio(rate.norm(), mu_n_[l]).value;
    slope += across_.width(l) * (mu * rate - beyond_mean(l) - mean_).dot(steps_[l]);
  }
  return slope;
}

/// The potential is convex: its slope rises along the steps, and the minimum is bracketed where they are too long.
double LayerShear::find_step_length() const {
  const double enough = flat * std::abs(slope_at(0));
  double low = 0, high = 1, step_length = 1, slope = slope_at(1);
  if (slope <= enough) return step_length;
  constexpr double narrow = 1e-3;  // of the fraction
  while (std::abs(slope) > enough && high - low > narrow * high) {
    (slope > 0 ? high : low) = step_length;
    step_length = 0.5 * (low + high);
    slope = slope_at(step_length);
  }
  return step_length;
}

bool LayerShear::by_descent(std::span<double> left) {
  std::fill(left.begin(), left.end(), 1.0);
  follow(left);
  for (int k = 0; k < most_shortened; ++k) {
    find_steps();
    const bool are_last = is_near();
    const double step_length = are_last ? 1 : find_step_length();
    for (std::size_t l = 0; l < rates_.size(); ++l) rates_[l] += step_length * steps_[l];
    if (!are_last) continue;
    look();
    std::copy(left_.begin(), left_.end(), left.begin());
    return true;
  }
  return false;
}

void LayerShear::thin(std::span<const double> mu_n, const ShearOfGap& shear, std::span<double> left) {
  mu_n_ = mu_n, shear_ = shear;
  follow(left);
  HERSEY_REQUIRE(by_newton(left) || by_descent(left), "an oil whose stress rises with its rate: has_rising_stress()");
}

Vector2d LayerShear::flow_factors() {
  for (std::size_t l = 0; l < mu_.size(); ++l) mu_[l] = mu_n_[l] * left_[l];
  Vector2d beyond = Vector2d::Zero();
  for (std::size_t l = 0; l < rates_.size(); ++l) {
    const double square = rates_[l].squaredNorm();
    if (square == 0) continue;
    const double cube = across_.width(l) * across_.width(l) * across_.width(l);
    beyond +=
        cube * (1 / ratios_[l].tangent().value - 1 / ratios_[l].value) / (mu_n_[l] * square) * rates_[l].cwiseAbs2();
  }
  return Vector2d::Ones() + beyond / profile_of(mu_, WithinLayers::constant).fluidity;
}

}  // namespace hersey::film
