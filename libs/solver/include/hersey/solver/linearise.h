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
/// M, C and K of shape (free, free) are the matrices of the equations projected by Z. They include the geometric
/// stiffness of the multipliers and the response of condensed unknowns within `dt`. Theory manual eq. (integrator.27).
struct [[nodiscard]] Linearisation : Outcome {
  Eigen::MatrixXd Z;  ///< shape (nv, free)
  Eigen::MatrixXd M, C, K;
};

/// Linearises the equations about `state`.
/// @param dt  length of the step within which condensed unknowns respond [s]; > 0 keeps those of the last step, 0
/// solves them instantaneously. Exact about rest and about motions in which the free directions are constant in the
/// coordinates, such as a rotor driven about its axis, but not about a configuration that a loop passes through.
/// @param released  velocity components that drives prescribe and that are linearised as if they were free
[[nodiscard]] Linearisation linearise(Equations& equations, const State& state, double dt,
                                      const std::vector<Equations::Index>& released = {});

/// Natural mode y = shape exp(s t).
struct Mode {
  std::complex<double> s;       ///< eigenvalue [1/s]; the one with a positive imaginary part of a conjugate pair
  double frequency = 0;         ///< |s|/(2 pi) [Hz]
  double damped_frequency = 0;  ///< Im s/(2 pi) [Hz]
  double damping_ratio = 0;     ///< -Re s/|s|; negative: the motion grows; 0 for a free motion
  Eigen::VectorXcd shape;       ///< amplitudes of the velocity components, shape (nv), the largest entry is 1
};

struct [[nodiscard]] Modes : Outcome {
  std::vector<Mode> modes;  ///< modes by ascending frequency; motions without stiffness and damping have frequency 0
  bool stable = true;       ///< no motion grows; a free motion does not count as growing
};

/// Computes all modes: eigenvalues of [0 I; -M^-1 K -M^-1 C]. @cost O(free^3)
[[nodiscard]] Modes find_modes(const Linearisation& linearisation);

}  // namespace hersey::solver
