#pragma once

#include <string>
#include <vector>

#include "hersey/model/model.h"
#include "hersey/run/steady_motion.h"

namespace hersey::study {

/// A steady motion of a collar and the pads below it.
struct ThrustPadMotion {
  model::Model alone;  ///< with joints that start where they are sought
  run::SteadyMotion motion = {};
};

/// Coordinates of the collar: film thickness, rotation about x, then about y.
[[nodiscard]] const std::vector<std::string>& collar_coordinates();

/// Where a pad is: its frame, which is the stator's for a pad that does not tilt, in the stator's (thrust.9).
[[nodiscard]] Pose pose_of_pad(const model::Composite& composite, std::size_t k, const ThrustPadMotion& found);

/// Tilts of a pad about the radius through its pivot and about the line across, in this order [rad].
[[nodiscard]] Eigen::Vector2d tilts_of_pad(const model::Composite& composite, std::size_t k,
                                           const ThrustPadMotion& found);

/// Wrench of all films on the stator, at the origin and in the axes of its frame (thrust.10) [N m; N].
[[nodiscard]] Vector6 wrench_of_pads(const model::Composite& composite, const ThrustPadMotion& found);

/// Finds the motion of a thrust bearing of tilting pads at its operating point: collar and pads at once, and if that
/// fails by Newton's method over the film thickness, the pads in balance at each.
[[nodiscard]] ThrustPadMotion find_thrust_motion(const model::Composite& composite, const model::ThrustPoint& point);

/// Small motions about the motion. Where films are cavitated, whose fronts jump from line to line, stiffness and
/// damping are means over four positions of the grids' lines, theory manual eq. (bearing.38).
[[nodiscard]] solver::Linearisation small_motions_of(const ThrustPadMotion& found);

}  // namespace hersey::study
