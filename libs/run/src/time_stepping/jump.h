#pragma once

namespace hersey::run {

/// Effect of a changed input on the integrator.
enum class Jump {
  none,      ///< acts through a film's own unknowns, which are computed anew in every step, or is continuous
  of_force,  ///< accelerations jump
  of_speed,  ///< velocities do
};

}  // namespace hersey::run
