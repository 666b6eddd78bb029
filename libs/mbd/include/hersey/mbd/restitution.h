#pragma once

namespace hersey::mbd {

/// Returns the coefficient of restitution of Hunt and Crossley's law N = k delta^n (1 + a ddelta/dt) for an impact at
/// `speed` (theory manual eq. (contact.12)): with d = a speed, d (1 + e) = ln((1 + d)/(1 - e d)), independent of k, n
/// and the masses.
/// @param damping  a [s/m], >= 0
/// @param speed    of approach [m/s], > 0
/// @returns e in (0, 1]
/// @verified_by contact_motion_test.cpp: Restitution_IsThatOfHuntAndCrossley
[[nodiscard]] double restitution(double damping, double speed);

/// Returns the damping a [s/m] that gives `restitution` in (0, 1] at `speed`, the inverse of restitution().
[[nodiscard]] double damping_of_restitution(double restitution, double speed);

}  // namespace hersey::mbd
