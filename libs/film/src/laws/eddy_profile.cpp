#include "laws/eddy_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hersey::film {
namespace {

// Constants of Reichardt's law as Ng and Pan fitted them to measured profiles between plates and in pipes.
constexpr double kappa = 0.4, delta = 10.7;

/// Logarithms of friction over that of a laminar film, with slopes by the logarithm of the Reynolds number.
struct LogFriction {
  double log_reynolds = 0;
  std::array<ValueAndSlope, 3> of = {};  ///< sliding, along, across
};

// The integrands fall over a wall layer that is 1/h+ thick: abscissas eta = s^3/2 resolve it by 400 intervals to 1e-8.
constexpr int intervals = 400;

/// Integrates across a film whose friction velocity and thickness make h+ = exp(log_h), (turbulence.4, turbulence.5).
/// Halves of the film are alike. Values are (integral, its derivative by log_h).
LogFriction integrate(double log_h) {
  const double h_plus = std::exp(log_h);
  ValueAndSlope slip, along, across;
  for (int k = 0; k <= intervals; ++k) {
    const double s = static_cast<double>(k) / intervals, eta = 0.5 * s * s * s;
    const double simpson = (k == 0 || k == intervals ? 1 : k % 2 == 1 ? 4 : 2) / (3.0 * intervals);
    const double weight = 2 * simpson * 1.5 * s * s, lever = 12 * (eta - 0.5) * (eta - 0.5);
    const double y = eta * h_plus, t = std::tanh(y / delta);
    const double f = 1 + kappa * (y - delta * t), g = 0.5 * kappa * y * t * t;
    // Derivatives by log_h, with which y grows like itself.
    const double f_h = 2 * g, g_h = g + kappa * y * (y / delta) * t * (1 - t * t);
    const double f2 = f * f;
    slip.value += weight / f, slip.slope -= weight * f_h / f2;
    across.value += weight * lever / f, across.slope -= weight * lever * f_h / f2;
    along.value += weight * lever * (f - g) / f2;
    along.slope += weight * lever * ((f_h - g_h) / f2 - 2 * (f - g) * f_h / (f2 * f));
  }
  LogFriction friction;
  friction.log_reynolds = 2 * log_h + std::log(slip.value);
  const double per_reynolds = 1 / (2 + slip.slope / slip.value);
  const auto inverse = [&](const ValueAndSlope& flow) {
    return ValueAndSlope{-std::log(flow.value), -flow.slope / flow.value * per_reynolds};
  };
  friction.of = {inverse(slip), inverse(along), inverse(across)};
  return friction;
}

/// Returns the film at a Reynolds number, found by Newton's method on (turbulence.6).
LogFriction at_reynolds(double log_reynolds) {
  double log_h = 0.5 * log_reynolds;  // laminar
  LogFriction friction = integrate(log_h);
  constexpr int most = 30;
  constexpr double close = 1e-12;
  for (int k = 0; k < most && std::abs(friction.log_reynolds - log_reynolds) > close; ++k) {
    // d log_reynolds/d log_h = 2/(1 + slope of the sliding's friction), since Re = h+^2 over that friction.
    log_h += (log_reynolds - friction.log_reynolds) * 0.5 * (1 + friction.of[0].slope);
    friction = integrate(log_h);
  }
  return friction;
}

// Range of the table and its number of knots. Beyond it powers of the Reynolds number continue the friction.
constexpr double table_begin = 10, table_end = 1e7;
constexpr int knots = 161;

/// Table at even distances of the logarithm of the Reynolds number.
class FrictionTable {
 public:
  FrictionTable() {
    for (int k = 0; k < knots; ++k) at_.push_back(at_reynolds(first_ + k * step_));
  }

  [[nodiscard]] ValueAndSlope factor(double log_reynolds, std::size_t which) const {
    const double x = std::clamp((log_reynolds - first_) / step_, 0.0, static_cast<double>(knots - 1));
    const int k = std::min(static_cast<int>(x), knots - 2);
    const ValueAndSlope &a = at_[static_cast<std::size_t>(k)].of[which],
                        &b = at_[static_cast<std::size_t>(k) + 1].of[which];
    const double t = x - k, rise = b.value - a.value, from = step_ * a.slope, to = step_ * b.slope;
    const double bend = 3 * rise - 2 * from - to, twist = from + to - 2 * rise;
    const double value = a.value + t * (from + t * (bend + t * twist));
    const double slope = (from + t * (2 * bend + 3 * t * twist)) / step_;
    const double beyond = log_reynolds - (first_ + step_ * x);  // outside of the table
    const double friction = std::exp(value + slope * beyond);
    return {friction, friction * slope};
  }

 private:
  double first_ = std::log(table_begin), step_ = std::log(table_end / table_begin) / (knots - 1);
  std::vector<LogFriction> at_;
};

}  // namespace

double eddy_viscosity_ratio(double y_plus) { return kappa * (y_plus - delta * std::tanh(y_plus / delta)); }

EddyFriction eddy_friction(double reynolds) {
  static const FrictionTable table;
  const double x = std::log(reynolds);
  return {table.factor(x, 0), table.factor(x, 1), table.factor(x, 2)};
}

}  // namespace hersey::film
