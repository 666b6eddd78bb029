#include "heat/layer_shear.h"

#include <algorithm>
#include <cmath>

#include "heat/layer_profile.h"

namespace hersey::film {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// Newton converges by squares: a change of this share of the largest rate leaves its square. Kacanov's method gains a
// factor 1 - (tangent over secant viscosity) in each turn.
constexpr double newton_change = 1e-4, kacanov_change = 1e-11;
constexpr int most_newton = 12, most_kacanov = 2000;

// A rate that changes by less than this share of itself takes its viscosity along to first order. One next to nothing,
// where the stress turns, does not.
constexpr double first_order = 1e-3;

}  // namespace

LayerShear::LayerShear(const ShearThinning& thinning, int layers)
    : thinning_(thinning), across_(layering_of(static_cast<std::size_t>(layers))) {
  const auto n = static_cast<std::size_t>(layers);
  rates_.resize(n), missing_.resize(n), by_stress_.resize(n), ratios_.resize(n), sizes_.resize(n), left_.resize(n);
  mu_.resize(n);
}

/// Stress in the middle of a layer over that in the middle of the film.
Vector2d LayerShear::beyond_mean(std::size_t l) const { return (across_.middle(l) - 0.5) * shear_.fall; }

/// Rates between viscosities that are given: the stress is linear across the film.
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

/// One step towards rates whose stresses are linear across the film; its size over the largest rate. What shear leaves
/// follows to first order.
double LayerShear::newton_step() {
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
  const Vector2d mean = all.inverse() * rest;
  double largest = 0, change = 0;
  for (std::size_t l = 0; l < rates_.size(); ++l) {
    const Vector2d step = by_stress_[l] * (mean + missing_[l]);
    const double along = rates_[l].dot(step), size = step.norm();
    rates_[l] += step;
    if (size < first_order * sizes_[l])
      left_[l] += ratios_[l].slope * along / (sizes_[l] * sizes_[l]);
    else if (size > 0)
      left_[l] = thinning_.ratio(rates_[l].norm(), mu_n_[l]).value;
    largest = std::max(largest, rates_[l].norm()), change = std::max(change, size);
  }
  return largest > 0 ? change / largest : change;
}

bool LayerShear::by_newton(std::span<double> left) {
  for (int k = 0; k < most_newton; ++k) {
    if (!(newton_step() <= newton_change)) continue;
    std::copy(left_.begin(), left_.end(), left.begin());
    return true;
  }
  return false;
}

void LayerShear::by_kacanov(std::span<double> left) {
  std::fill(left.begin(), left.end(), 1.0);
  double change = 1;
  for (int k = 0; k < most_kacanov && change > kacanov_change; ++k) {
    follow(left);
    look();
    change = 0;
    for (std::size_t l = 0; l < left.size(); ++l) {
      change = std::max(change, std::abs(left_[l] - left[l]) / left_[l]);
      left[l] = left_[l];
    }
  }
}

void LayerShear::thin(std::span<const double> mu_n, const ShearOfGap& shear, std::span<double> left) {
  mu_n_ = mu_n, shear_ = shear;
  follow(left);
  if (!by_newton(left)) by_kacanov(left);
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
