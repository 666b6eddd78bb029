#pragma once

#include <Eigen/Dense>
#include <vector>

#include "hersey/fem/film_surface.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Pressure on a film's surface in the functions by which it acts on the mesh: forces f_k that push outward at points
/// of the film become
///     p(phi, z) = sum_j psi_j p_j,    G p = sum_k psi(phi_k, z_k) f_k,    nodal forces T p.       (film-surface.8)
/// @verified_by film_pressure_test.cpp
class SurfacePressure {
 public:
  /// Factorises G of `surface`, which lies on `mesh`.
  SurfacePressure(const Mesh& mesh, const FilmSurface& surface);

  /// Returns p_j, shape (functions) [Pa], for forces at (phi, z) on the cylinder; all three arguments have one size.
  [[nodiscard]] Eigen::VectorXd coefficients(const Eigen::VectorXd& phi, const Eigen::VectorXd& z,
                                             const Eigen::VectorXd& forces) const;

  /// Adds the pressure at the surface's nodes within the film's width to `at_nodes`, shape (n).
  void add(const Eigen::VectorXd& coefficients, Eigen::VectorXd& at_nodes) const;

 private:
  SurfaceFunctions functions_;
  Eigen::LLT<Eigen::MatrixXd> G_;
  std::vector<int> nodes_;  ///< nodes of the surface within the film's width
  Eigen::MatrixXd psi_;     ///< functions at these nodes, shape (nodes, functions)
};

}  // namespace hersey::fem
