#pragma once

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <optional>
#include <string>
#include <vector>

#include "hersey/core/outcome.h"
#include "hersey/core/surface_functions.h"
#include "hersey/fem/film_cylinder.h"
#include "hersey/fem/film_modes.h"
#include "hersey/fem/mesh.h"

/// Faces of a mesh that an oil film lies on: radial displacement and pressure in smooth functions of the film's own
/// angle and width, whatever the mesh (theory manual, chapter film-surface).
namespace hersey::fem {

/// Outer faces all of whose nodes lie within `tolerance` [m] of the cylinder and which reach into |z| < L / 2.
[[nodiscard]] std::vector<ElementFace> faces_on_cylinder(const Mesh& mesh, const FilmCylinder& cylinder,
                                                         double tolerance);

/// As many functions as a mesh can tell apart: one per 1.5 distances of nodes, 8 to 32 around and at most 5 along.
[[nodiscard]] SurfaceFunctions functions_for(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                             const FilmCylinder& cylinder);

/// A SurfaceMap with what it is made of.
struct FilmSurface : SurfaceMap {
  FilmCylinder cylinder;
  SurfaceFunctions functions;
  std::vector<ElementFace> faces;           ///< those that reach into the film
  std::optional<int> modes = std::nullopt;  ///< that a body keeps at most, other than ReductionOptions::film_modes
};

/// A surface, or what is wrong with it.
struct [[nodiscard]] FilmSurfaceResult : Outcome {
  std::optional<FilmSurface> surface;
  std::string remedy;
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

}  // namespace hersey::fem
