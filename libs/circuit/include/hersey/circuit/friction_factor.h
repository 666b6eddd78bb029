#pragma once

namespace hersey::circuit {

/// What a pipe's friction multiplies its laminar loss by, and its derivative.
struct FrictionRatio {
  double value = 1;  ///< f/(64/Re) [-], >= 1
  double slope = 0;  ///< d ln(value) / d ln(Re) [-]
};

/// Returns the Darcy friction factor of a pipe over that of laminar flow, 64/Re: one smooth formula from laminar over
/// transitional to turbulent flow, smooth or rough (circuit.4).
/// @param Re  Reynolds number of mean velocity and diameter [-], >= 0
/// @param roughness  height of the wall's roughness over the diameter [-], >= 0
/// @source Churchill (1977), Chemical Engineering 84(24), 91, eq. 18
/// @verified_by friction_factor_test.cpp
[[nodiscard]] FrictionRatio friction_ratio(double Re, double roughness);

/// Returns the Darcy friction factor itself, as Moody's chart has it [-].
/// @param Re  > 0, otherwise as above
[[nodiscard]] double friction_factor(double Re, double roughness);

}  // namespace hersey::circuit
