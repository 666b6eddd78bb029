#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "hersey/fem/constrained_stiffness.h"

namespace hersey::fem {

/// Maps between a film's surface and a mesh. With radial displacement d = sum_j psi_j d_j and pressure p = sum_j psi_j
/// p_j,
///     f = T p,    G d = T^T u:    u . f = d . G p = int d p dA,                       (film-surface.3 to 5)
/// so that nodal forces do the same work as the pressure, and nodal displacements the same work as the radial
/// displacement.
struct SurfaceMap {
  Eigen::SparseMatrix<double> T;  ///< int psi_j e_r N_a dA, shape (3 n, functions) [m^2]
  Eigen::MatrixXd G;              ///< int psi_j psi_l dA, shape (functions, functions) [m^2]

  /// Returns the radial displacement outward, G^-1 T^T U (functions, columns), of nodal displacements U (3 n, columns).
  [[nodiscard]] Eigen::MatrixXd coefficients(const Eigen::MatrixXd& U) const;
  /// Returns T^T K^-1 T, symmetric, shape (functions, functions) [m^3/Pa]: G d by the pressures.
  [[nodiscard]] Eigen::MatrixXd compliance(const ConstrainedStiffness& stiffness) const;
};

/// Static displacements of a body under film pressures, the most compliant ones first: pressures p_k and displacements
///     (T^T K^-1 T) p_k = lambda_k G p_k,    u_k = K^-1 T p_k,    p_k . G p_l = 0 for k != l.          (film-surface.7)
struct FilmModes {
  Eigen::MatrixXd shapes;      ///< displacements u_k, frames at rest, shape (3 n, m)
  Eigen::MatrixXd loads;       ///< nodal forces T p_k that cause them, shape (3 n, m)
  Eigen::MatrixXd pressures;   ///< p_k, shape (functions, m), p_k . G p_k = 1
  Eigen::VectorXd compliance;  ///< lambda_k: radial displacement over pressure, descending, shape (m) [m/Pa]
  double lost = 0;             ///< largest compliance left out over the largest kept
};

/// Computes at most `most` film modes, those with a compliance above `tolerance` times the largest; none if nothing
/// deforms.
/// @param stiffness  factorised, its frames fixed
/// @cost one solution per function of the surface and one per mode
/// @verified_by film_modes_test.cpp
[[nodiscard]] FilmModes film_modes(const ConstrainedStiffness& stiffness, const SurfaceMap& surface, int most,
                                   double tolerance);

}  // namespace hersey::fem
