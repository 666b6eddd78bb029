#pragma once

#include <vector>

#include "hersey/mbd/mechanism.h"
#include "hersey/model/model.h"

namespace hersey::run {

/// Sources and sinks of the power of the whole machine at one instant [W] (theory manual eq. (mechanisms.22)).
struct PowerBalance {
  double drives = 0;    ///< put in by drives
  double loads = 0;     ///< put in by applied forces and torques
  double gravity = 0;   ///< put in by gravity
  double springs = 0;   ///< given to the bodies by springs and dampers
  double contacts = 0;  ///< given to the bodies by contacts
  double bearings = 0;  ///< given to the bodies by the films' forces; negative: the films take it
  double films = 0;    ///< the same from the films' own integrals: minus the power that they dissipate, store and carry
                       ///< out
  double elastic = 0;  ///< given back by flexible bodies: minus the rate of their strain energy, minus damping
  double kinetic_rate = 0;  ///< d(kinetic energy)/dt
  /// drives + loads + gravity + springs + contacts + bearings + elastic - kinetic_rate: the residual power of the
  /// equations of motion, zero but for the tolerance of the time step and the drift of the velocity constraints,
  /// whatever the forces are.
  [[nodiscard]] double error() const {
    return drives + loads + gravity + springs + contacts + bearings + elastic - kinetic_rate;
  }
  /// The residual with the films' own integrals in place of their forces' power: a remainder means a force that does
  /// not do the work of its losses.
  [[nodiscard]] double unexplained() const { return error() - bearings + films; }
  /// The largest of the powers, the reference of `error`.
  [[nodiscard]] double largest() const;
};

/// Kind of a two-body force of the mechanism.
enum class ForceKind { spring, contact, bearing };

/// @param kinds  of each two-body force of the mechanism
[[nodiscard]] PowerBalance power_balance(const mbd::MechanismSpec& spec, const mbd::Observation& observation,
                                         const std::vector<ForceKind>& kinds);

}  // namespace hersey::run
