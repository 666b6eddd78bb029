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
Flow Drilling::flow(double drop, const Oil& oil, const Setting& /*setting*/) const {
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
Flow Orifice::flow(double drop, const Oil& oil, const Setting& /*setting*/) const {
  const double jet = discharge_coefficient * area_of(diameter) * std::sqrt(2 / oil.density);
  const double creeping = std::pow(diameter, 3) / (24 * oil.mu);  // flow over drop
  const double transition = std::pow(jet / creeping, 2);
  const double squares = drop * drop + transition * transition;
  const double root = std::sqrt(std::sqrt(squares));
  return {jet * drop / root, jet / root * (1 - 0.5 * drop * drop / squares)};
}

Flow Resistance::flow(double drop, const Oil& /*oil*/, const Setting& /*setting*/) const {
  return {drop / resistance, 1 / resistance};
}

Flow Cooler::flow(double drop, const Oil& /*oil*/, const Setting& /*setting*/) const {
  return {drop / resistance, 1 / resistance};
}

// (circuit.15)
double Cooler::remaining(double capacity_rate) const {
  return capacity_rate > 0 ? std::exp(-conductance / capacity_rate) : 0;
}

// (circuit.6)
Flow ReliefValve::flow(double drop, const Oil& /*oil*/, const Setting& /*setting*/) const {
  if (drop <= opening_pressure) return {};
  return {conductance * (drop - opening_pressure), conductance};
}

// (circuit.7)
Flow DisplacementPump::flow(double drop, const Oil& /*oil*/, const Setting& setting) const {
  return {displacement * setting.speed + leakage * drop, leakage};
}

Flow PumpCurve::flow(double drop, const Oil& /*oil*/, const Setting& /*setting*/) const {
  const double rise = -drop;
  double by_rise = 0;
  curve->gradient({&rise, 1}, {&by_rise, 1});
  return {curve->value({&rise, 1}), -by_rise};
}

// (circuit.13). What is open counts as a round hole of the same area.
Flow HoleOverGroove::flow(double drop, const Oil& oil, const Setting& setting) const {
  const double area = setting.open_area;
  if (!(area > 0)) return {};
  const double diameter = std::sqrt(4 * area / std::numbers::pi);
  const double creeping = diameter * diameter * diameter / (24 * oil.mu);  // flow over drop
  const double root =
      discharge_coefficient * std::sqrt(2 / oil.density) * 6 * std::numbers::pi * oil.mu / diameter;  // of Delta_c
  const double ratio = drop / (root * root), squares = 1 + ratio * ratio;
  const double by_drop = creeping / std::sqrt(std::sqrt(squares));
  return {by_drop * drop, by_drop * (1 - 0.5 * ratio * ratio / squares), by_drop * drop / area * (1 + 0.5 / squares)};
}

Flow GivenFlow::flow(double /*drop*/, const Oil& /*oil*/, const Setting& /*setting*/) const { return {rate, 0}; }

}  // namespace hersey::circuit
