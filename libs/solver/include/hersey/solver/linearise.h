#pragma once

#include <Eigen/Dense>
#include <complex>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/solver/equations.h"

namespace hersey::solver {

/// Small motions y about a state, along the directions the constraints leave free: dq = Z y and
///
///     M y'' + C y' + K y = 0,
///
/// M, C and K of shape (free, free), those of the equations projected by Z; K holds the geometric stiffness of the
/// multipliers, condensed unknowns their answer within `dt`. Theory manual eq. (integrator.27).
struct [[nodiscard]] Linearisation : Outcome {
  Eigen::MatrixXd Z;  ///< shape (nv, free)
  Eigen::MatrixXd M, C, K;
};

/// @param dt  length of the step within which condensed unknowns answer [s]; > 0 keeps those of the last step, 0 solves
///            them instantaneously.
/// Exact about rest, and about motions in which the free directions keep still in the coordinates: a rotor driven about
/// its axis, but not a loop that is passing by.
[[nodiscard]] Linearisation linearise(Equations& equations, const State& state, double dt);

/// One small motion y = shape exp(s t).
struct Mode {
  std::complex<double> s;       ///< eigenvalue [1/s]; of a conjugate pair the one with a positive imaginary part
  double frequency = 0;         ///< |s|/(2 pi) [Hz]
  double damped_frequency = 0;  ///< Im s/(2 pi) [Hz]
  double damping_ratio = 0;     ///< -Re s/|s|; negative: the motion grows; 0 for a free motion
  Eigen::VectorXcd shape;       ///< of the velocity components, shape (nv), the largest entry 1
};

struct [[nodiscard]] Modes : Outcome {
  std::vector<Mode> modes;  ///< by rising frequency; motions without stiffness and damping have frequency 0
  bool stable = true;       ///< no motion grows; a free motion does not count as growing
};

/// All small motions: eigenvalues of [0 I; -M^-1 K  -M^-1 C]. @cost O(free^3)
[[nodiscard]] Modes find_modes(const Linearisation& linearisation);

}  // namespace hersey::solver
