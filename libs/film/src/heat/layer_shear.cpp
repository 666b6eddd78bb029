#include "heat/layer_shear.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "heat/layer_profile.h"

namespace hersey::film {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// Newton converges by squares: a change of this share of the largest rate leaves nothing that counts. Kacanov's method
// gains a factor 1 - (tangent over secant viscosity) in each turn.
constexpr double newton_change = 1e-6, kacanov_change = 1e-11;
constexpr int most_newton = 12, most_kacanov = 2000;

/// Rates of shear of the layers at one place, as vectors around and along the axis [1/s].
class LayerRates {
 public:
  LayerRates(const ShearThinning& thinning, std::span<const double> mu_n, const ShearOfGap& shear)
      : thinning_(thinning),
        mu_n_(mu_n),
        shear_(shear),
        rates_(mu_n.size()),
        missing_(mu_n.size()),
        by_stress_(mu_n.size()),
        width_(1.0 / static_cast<double>(mu_n.size())) {}

  /// Of viscosities that are given: the stress is linear across the film, and all rates make up the sliding.
  void follow(std::span<const double> left) {
    double sum = 0;
    Vector2d by_pressure = Vector2d::Zero();
    for (std::size_t l = 0; l < rates_.size(); ++l) {
      const double fluidity = width_ / (mu_n_[l] * left[l]);
      sum += fluidity;
      by_pressure += fluidity * beyond_mean(l);
    }
    const Vector2d mean = (shear_.rate - by_pressure) / sum;
    for (std::size_t l = 0; l < rates_.size(); ++l) rates_[l] = (mean + beyond_mean(l)) / (mu_n_[l] * left[l]);
  }

  /// By what the tangent within the layers raises `fluidity`, that of the flow along pressure, in both directions [-].
  [[nodiscard]] Vector2d flow_factors(double fluidity) const {
    Vector2d beyond = Vector2d::Zero();
    for (std::size_t l = 0; l < rates_.size(); ++l) {
      const double square = rates_[l].squaredNorm();
      if (square == 0) continue;
      const ShearRatio R = thinning_.ratio(std::sqrt(square), mu_n_[l]);
      beyond += (1 / R.tangent().value - 1 / R.value) / (mu_n_[l] * square) * rates_[l].cwiseAbs2();
    }
    return Vector2d::Ones() + width_ * width_ * width_ / fluidity * beyond;
  }

  [[nodiscard]] double left(std::size_t l) const { return thinning_.ratio(rates_[l].norm(), mu_n_[l]).value; }

  /// One step towards rates whose stresses are linear across the film; its size over the largest rate.
  double newton_step() {
    Matrix2d all = Matrix2d::Zero();
    Vector2d rest = shear_.rate;
    for (std::size_t l = 0; l < rates_.size(); ++l) {
      const double size = rates_[l].norm();
      const ShearRatio R = thinning_.ratio(size, mu_n_[l]);
      const double secant = mu_n_[l] * R.value, tangent = mu_n_[l] * R.tangent().value;
      by_stress_[l] = Matrix2d::Identity() / secant;
      if (size > 0) by_stress_[l] += (1 / tangent - 1 / secant) / (size * size) * rates_[l] * rates_[l].transpose();
      missing_[l] = beyond_mean(l) - secant * rates_[l];
      all += width_ * by_stress_[l];
      rest -= width_ * (rates_[l] + by_stress_[l] * missing_[l]);
    }
    const Vector2d mean = all.inverse() * rest;
    double largest = 0, change = 0;
    for (std::size_t l = 0; l < rates_.size(); ++l) {
      const Vector2d step = by_stress_[l] * (mean + missing_[l]);
      rates_[l] += step;
      largest = std::max(largest, rates_[l].norm()), change = std::max(change, step.norm());
    }
    return largest > 0 ? change / largest : change;
  }

 private:
  /// Stress in the middle of a layer over that in the middle of the film.
  [[nodiscard]] Vector2d beyond_mean(std::size_t l) const {
    return ((static_cast<double>(l) + 0.5) * width_ - 0.5) * shear_.fall;
  }

  const ShearThinning& thinning_;
  std::span<const double> mu_n_;
  const ShearOfGap& shear_;
  std::vector<Vector2d> rates_, missing_;
  std::vector<Matrix2d> by_stress_;
  double width_;
};

bool solve_by_newton(LayerRates& rates, std::span<double> left) {
  for (int k = 0; k < most_newton; ++k) {
    if (!(rates.newton_step() <= newton_change)) continue;
    for (std::size_t l = 0; l < left.size(); ++l) left[l] = rates.left(l);
    return true;
  }
  return false;
}

void solve_by_kacanov(LayerRates& rates, std::span<double> left) {
  std::fill(left.begin(), left.end(), 1.0);
  double change = 1;
  for (int k = 0; k < most_kacanov && change > kacanov_change; ++k) {
    rates.follow(left);
    change = 0;
    for (std::size_t l = 0; l < left.size(); ++l) {
      const double next = rates.left(l);
      change = std::max(change, std::abs(next - left[l]) / next);
      left[l] = next;
    }
  }
}

}  // namespace

Vector2d thin_layers(const ShearThinning& thinning, std::span<const double> mu_n, const ShearOfGap& shear,
                     std::span<double> left) {
  LayerRates rates(thinning, mu_n, shear);
  rates.follow(left);
  if (!solve_by_newton(rates, left)) solve_by_kacanov(rates, left);
  std::vector<double> mu(left.size());
  for (std::size_t l = 0; l < mu.size(); ++l) mu[l] = mu_n[l] * left[l];
  return rates.flow_factors(profile_of(mu).fluidity);
}

}  // namespace hersey::film
