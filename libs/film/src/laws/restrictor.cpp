#include "hersey/film/restrictor.h"

#include <cmath>
#include <numbers>

namespace hersey::film {

// (hydrostatic.2)
ValueAndSlope Capillary::flow(double drop, const RestrictorOil& oil) const {
  const double conductance = std::numbers::pi * std::pow(diameter, 4) / (128 * oil.mu * length);
  return {conductance * drop, conductance};
}

ValueAndSlope FlowResistance::flow(double drop, const RestrictorOil& /*oil*/) const {
  return {drop / resistance, 1 / resistance};
}

// (hydrostatic.3): drop = creeping Q + inertial Q |Q|, solved for Q in the form that loses no digits near zero.
ValueAndSlope Orifice::flow(double drop, const RestrictorOil& oil) const {
  const double area = std::numbers::pi / 4 * diameter * diameter;
  const double creeping = 24 * oil.mu / std::pow(diameter, 3);
  const double inertial = oil.density / (2 * std::pow(discharge_coefficient * area, 2));
  const double root = std::sqrt(creeping * creeping + 4 * inertial * std::abs(drop));
  return {2 * drop / (creeping + root), 1 / root};
}

// (hydrostatic.4)
ValueAndSlope ConstantFlow::flow(double drop, const RestrictorOil& /*oil*/) const {
  if (relief_band <= 0 || drop >= relief_band) return {rate, 0};
  return {rate * drop / relief_band, rate / relief_band};
}

}  // namespace hersey::film
