#pragma once

#include <Eigen/Dense>
#include <span>

#include "hersey/film/shear_law.h"

namespace hersey::film {

/// What shears the oil at one place.
struct ShearOfGap {
  Eigen::Vector2d rate = Eigen::Vector2d::Zero();  ///< the journal's speed past the shell over the gap [1/s]
  Eigen::Vector2d fall = Eigen::Vector2d::Zero();  ///< gap times the pressure's gradient: tau(h) - tau(0) [Pa]
};

/// What shear leaves of the viscosity in each layer, R [-], so that every layer is sheared at the rate its own stress
/// takes and all rates together make up the sliding (thermal.24). Newton's method, or where that does not arrive
/// Kacanov's, by which viscosities follow the rates they have led to.
/// @param mu_n  of the layers at rest at their temperatures and the pressure of the place [Pa s]
/// @param left  R: a start (1 is one) and the answer, same shape
/// @returns by what the flow along pressure is easier, around and along the axis, than between layers each of which is
///          as thin as in its middle [-]: within a layer it sees the tangent of the stress (thermal.25)
[[nodiscard]] Eigen::Vector2d thin_layers(const ShearThinning& thinning, std::span<const double> mu_n,
                                          const ShearOfGap& shear, std::span<double> left);

}  // namespace hersey::film
