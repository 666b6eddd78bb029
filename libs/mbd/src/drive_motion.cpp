#include "drive_motion.h"

#include <array>
#include <cmath>

namespace hersey::mbd {
namespace {

/// Five-point Gauss-Legendre rule over [a, b].
double gauss5(const ScalarFunction& f, double a, double b) {
  // Nodes and weights: Abramowitz and Stegun (1964), table 25.4.
  static constexpr std::array<double, 3> x{0.0, 0.538469310105683091, 0.906179845938663993};
  static constexpr std::array<double, 3> w{0.568888888888888889, 0.478628670499366468, 0.236926885056189088};
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  const auto at = [&](double t) { return f.value({&t, 1}); };
  double sum = w[0] * at(middle);
  for (std::size_t i = 1; i < x.size(); ++i) sum += w[i] * (at(middle - half * x[i]) + at(middle + half * x[i]));
  return half * sum;
}

/// Bisects until halves and whole agree; kinks of a table stop at the depth limit, where they no longer matter.
double integrate(const ScalarFunction& f, double a, double b, double whole, int depth) {
  const double middle = 0.5 * (a + b);
  const double left = gauss5(f, a, middle), right = gauss5(f, middle, b);
  if (depth == 0 || std::abs(left + right - whole) <= 1e-13 * (std::abs(left) + std::abs(right))) return left + right;
  return integrate(f, a, middle, left, depth - 1) + integrate(f, middle, b, right, depth - 1);
}

}  // namespace

DriveMotion::DriveMotion(const DriveSpec& spec, double initial)
    : kind_(spec.kind),
      function_(spec.function),
      constant_(dynamic_cast<const ConstantFunction*>(spec.function.get()) != nullptr),
      anchor_position_(initial) {}

double DriveMotion::position(double t) const {
  if (kind_ == DriveSpec::Kind::position) return function_->value({&t, 1});
  if (constant_) return anchor_position_ + function_->value({&t, 1}) * t;
  return anchor_position_ + integrate(*function_, anchor_time_, t, gauss5(*function_, anchor_time_, t), 40);
}

double DriveMotion::velocity(double t) const {
  if (kind_ == DriveSpec::Kind::speed) return function_->value({&t, 1});
  double rate = 0;
  function_->gradient({&t, 1}, {&rate, 1});
  return rate;
}

double DriveMotion::acceleration(double t) const {
  if (kind_ == DriveSpec::Kind::position) return function_->second_derivative({&t, 1});
  double rate = 0;
  function_->gradient({&t, 1}, {&rate, 1});
  return rate;
}

void DriveMotion::anchor(double t) {
  if (kind_ == DriveSpec::Kind::position || constant_ || t == anchor_time_) return;
  anchor_position_ = position(t);
  anchor_time_ = t;
}

}  // namespace hersey::mbd
