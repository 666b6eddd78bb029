#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <optional>
#include <string>
#include <vector>

#include "hersey/core/surface_functions.h"
#include "hersey/fem/held_stiffness.h"
#include "hersey/fem/mesh.h"

/// Faces of a mesh that an oil film lies on: radial displacement and pressure in smooth functions of the film's own
/// angle and width, whatever the mesh (theory manual, chapter film-surface).
namespace hersey::fem {

/// Where a film lies in a mesh: |z| <= L / 2 of a cylinder about the z-axis of `X`.
struct FilmCylinder {
  Pose X;               ///< of the film's axes in the mesh's, origin in the middle of the width [m]
  double R = 0;         ///< radius [m], > 0
  double L = 0;         ///< width [m], > 0
  bool is_bore = true;  ///< the solid lies around the film; false: within it, a journal
};

/// Outer faces all of whose nodes lie within `tolerance` [m] of the cylinder and which reach into |z| < L / 2.
[[nodiscard]] std::vector<ElementFace> faces_on_cylinder(const Mesh& mesh, const FilmCylinder& cylinder,
                                                         double tolerance);

/// As many functions as a mesh can tell apart: one per 1.5 distances of nodes, 8 to 32 around and at most 5 along.
[[nodiscard]] SurfaceFunctions functions_for(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                             const FilmCylinder& cylinder);

/// A film's surface on a mesh. With radial displacement d = sum_j psi_j d_j and pressure p = sum_j psi_j p_j,
///     f = T p,    G d = T^T u:    u . f = d . G p = int d p dA,                       (film-surface.3 to 5)
/// so that forces go over to the nodes, and displacements to the film, with the same work.
struct SurfaceMap {
  Eigen::SparseMatrix<double> T;  ///< int psi_j e_r N_a dA, shape (3 n, functions) [m^2]
  Eigen::MatrixXd G;              ///< int psi_j psi_l dA, shape (functions, functions) [m^2]

  /// Radial displacement outward, G^-1 T^T U (functions, columns), of nodal displacements U (3 n, columns).
  [[nodiscard]] Eigen::MatrixXd coefficients(const Eigen::MatrixXd& U) const;
};

/// The same with what it is made of.
struct FilmSurface : SurfaceMap {
  FilmCylinder cylinder;
  SurfaceFunctions functions;
  std::vector<ElementFace> faces;           ///< those that reach into the film
  std::optional<int> modes = std::nullopt;  ///< that a body keeps at most, other than ReductionOptions::film_modes
};

/// A surface, or why there is none.
struct FilmSurfaceResult {
  std::optional<FilmSurface> surface;
  std::string message;  ///< what is wrong
  std::string remedy;
  /// Whether there is one.
  [[nodiscard]] bool ok() const { return surface.has_value(); }
};

/// Integrals over the parts of `faces` with |z| <= L / 2, each cut exactly there and divided finely against the
/// functions. Areas are those on the cylinder, R dphi dz, so that faces that cover it have its area exactly.
/// Refused: no faces; nodes off the cylinder by more than `tolerance` [m]; faces that look the wrong way; a film of
/// which more than 2 % lies on no face; functions too fine for what is there.
/// @verified_by film_surface_test.cpp
[[nodiscard]] FilmSurfaceResult film_surface(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                             const FilmCylinder& cylinder, const SurfaceFunctions& functions,
                                             double tolerance);

/// The same seen from a frame at `origin` whose unit motions [theta; d] are the six columns of U from `first` on: what
/// they move rigidly is no deformation, (film-surface.6).
[[nodiscard]] Eigen::MatrixXd coefficients_from_frame(const FilmSurface& surface, const Mesh& mesh,
                                                      const Eigen::MatrixXd& U, const Vector3& origin,
                                                      Eigen::Index first);

/// Static answers of a body to film pressures, the most compliant ones first: pressures p_k and displacements
///     (T^T K^-1 T) p_k = lambda_k G p_k,    u_k = K^-1 T p_k,    p_k . G p_l = 0 for k != l.          (film-surface.7)
struct FilmModes {
  Eigen::MatrixXd shapes;      ///< displacements u_k, frames at rest, shape (3 n, m)
  Eigen::MatrixXd loads;       ///< nodal forces T p_k that they answer, shape (3 n, m)
  Eigen::MatrixXd pressures;   ///< p_k, shape (functions, m), p_k . G p_k = 1
  Eigen::VectorXd compliance;  ///< lambda_k: radial displacement over pressure, descending, shape (m) [m/Pa]
  double lost = 0;             ///< largest compliance left out over the largest kept
};

/// At most `most` of them, those with a compliance above `tolerance` times the largest. None if nothing gives way.
/// @param stiffness  factorised, its frames held
/// @cost one solution per function of the surface and one per mode
/// @verified_by film_modes_test.cpp
[[nodiscard]] FilmModes film_modes(const HeldStiffness& stiffness, const SurfaceMap& surface, int most,
                                   double tolerance);

}  // namespace hersey::fem
