#pragma once

namespace hersey::mbd {

/// Force between two surfaces that overlap by delta > 0 (theory manual eqs. (contact.6) to (contact.8)):
///
///     N = stiffness delta^exponent (1 + damping ddelta/dt), never below 0,
///     friction = -friction N v_t / sqrt(v_t^2 + slip_speed^2).
struct ContactLaw {
  double stiffness = 0;   ///< [N/m^exponent]; of a mesh's corners on a solid [Pa/m^exponent]; > 0
  double exponent = 1.5;  ///< >= 1
  double damping = 0;     ///< damping of Hunt and Crossley [s/m], >= 0
  double friction = 0;    ///< coefficient of Coulomb friction, >= 0
  double slip_speed =
      0;  ///< speed of the regularised friction law below which the surfaces creep [m/s]; > 0 with friction
};

}  // namespace hersey::mbd
