#include "hersey/circuit/laws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hersey/circuit/friction_factor.h"

namespace hersey::circuit {
namespace {

double area_of(double diameter) { return std::numbers::pi / 4 * diameter * diameter; }

/// Drop of pressure of a drilling at a mean velocity, and its derivative.
struct Loss {
  double value;  ///< [Pa]
  double slope;  ///< [Pa s/m]
};

// (circuit.3) at a velocity v >= 0.
Loss loss_of(const Drilling& bore, const Oil& oil, double v) {
  const double laminar = 32 * oil.mu * bore.length / (bore.diameter * bore.diameter);
  const FrictionRatio ratio =
      bore.friction == Friction::laminar
          ? FrictionRatio{}
          : friction_ratio(oil.density * v * bore.diameter / oil.mu, bore.roughness / bore.diameter);
  const double bends = 0.5 * bore.loss_coefficient * oil.density;
  return {laminar * ratio.value * v + bends * v * v, laminar * ratio.value * (1 + ratio.slope) + 2 * bends * v};
}

}  // namespace

// The velocity of a loss is found by Newton's method within bounds: laminar flow alone is an upper one.
Flow Drilling::flow(double drop, const Oil& oil, double /*speed*/) const {
  constexpr double kSameVelocity = 4 * std::numeric_limits<double>::epsilon();
  constexpr int kMost = 200;  // 60 halvings reach round-off from any bounds; Newton's method takes five
  const double wanted = std::abs(drop), area = area_of(diameter);
  double low = 0, high = wanted * diameter * diameter / (32 * oil.mu * length), v = high;
  Loss loss = loss_of(*this, oil, v);
  for (int k = 0; k < kMost && high - low > kSameVelocity * high; ++k) {
    (loss.value > wanted ? high : low) = v;
    const double next = v - (loss.value - wanted) / loss.slope;
    if (std::abs(next - v) <= kSameVelocity * v) break;
    v = next > low && next < high ? next : 0.5 * (low + high);
    loss = loss_of(*this, oil, v);
  }
  return {std::copysign(area * v, drop), area / loss.slope};
}

// (circuit.5)
Flow Orifice::flow(double drop, const Oil& oil, double /*speed*/) const {
  const double jet = discharge_coefficient * area_of(diameter) * std::sqrt(2 / oil.density);
  const double creeping = std::pow(diameter, 3) / (24 * oil.mu);  // flow over drop
  const double transition = std::pow(jet / creeping, 2);
  const double squares = drop * drop + transition * transition;
  const double root = std::sqrt(std::sqrt(squares));
  return {jet * drop / root, jet / root * (1 - 0.5 * drop * drop / squares)};
}

Flow Resistance::flow(double drop, const Oil& /*oil*/, double /*speed*/) const {
  return {drop / resistance, 1 / resistance};
}

// (circuit.6)
Flow ReliefValve::flow(double drop, const Oil& /*oil*/, double /*speed*/) const {
  if (drop <= opening_pressure) return {};
  return {conductance * (drop - opening_pressure), conductance};
}

// (circuit.7)
Flow DisplacementPump::flow(double drop, const Oil& /*oil*/, double speed) const {
  return {displacement * speed + leakage * drop, leakage};
}

Flow PumpCurve::flow(double drop, const Oil& /*oil*/, double /*speed*/) const {
  const double rise = -drop;
  double by_rise = 0;
  curve->gradient({&rise, 1}, {&by_rise, 1});
  return {curve->value({&rise, 1}), -by_rise};
}

Flow GivenFlow::flow(double /*drop*/, const Oil& /*oil*/, double /*speed*/) const { return {rate, 0}; }

}  // namespace hersey::circuit
