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

/// Faces of a mesh on which an oil film lies: radial displacement and pressure in smooth functions of the film's own
/// angle and width, independent of the mesh (theory manual, chapter film-surface).
namespace hersey::fem {

/// Returns the outer faces all of whose nodes lie within `tolerance` [m] of the cylinder and which reach into |z| < L /
/// 2.
[[nodiscard]] std::vector<ElementFace> faces_on_cylinder(const Mesh& mesh, const FilmCylinder& cylinder,
                                                         double tolerance);

/// Returns as many functions as a mesh resolves: one per 1.5 node distances, 8 to 32 around (4 or more on an arc) and
/// at most 5 along.
[[nodiscard]] SurfaceFunctions functions_for(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                             const FilmCylinder& cylinder);

/// Surface of a film: a SurfaceMap together with its cylinder, functions and faces.
struct FilmSurface : SurfaceMap {
  FilmCylinder cylinder;
  SurfaceFunctions functions;
  std::vector<ElementFace> faces;  ///< those that reach into the film
  std::optional<int> modes =
      std::nullopt;  ///< largest number of modes that a body keeps, if it differs from ReductionOptions::film_modes
};

/// A film's surface, or a message that says what is wrong with it.
struct [[nodiscard]] FilmSurfaceResult : Outcome {
  std::optional<FilmSurface> surface;
  std::string remedy;
};

/// Integrates T and G over the parts of `faces` within the film. Each face is cut exactly at the edges of the film
/// and divided finely against the functions. Areas are those on the cylinder, R dphi dz, so that faces that cover the
/// cylinder have its area exactly.
/// The function refuses: no faces; nodes off the cylinder by more than `tolerance` [m]; faces whose normal has the
/// wrong direction; a film of which more than 2 % lies on no face; functions that are too fine for the faces.
/// @verified_by film_surface_test.cpp
[[nodiscard]] FilmSurfaceResult film_surface(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                             const FilmCylinder& cylinder, const SurfaceFunctions& functions,
                                             double tolerance);

/// Returns the coefficients of displacements relative to a frame at `origin` whose unit motions [theta; d] are the six
/// columns of U from `first` on: the part that these motions move rigidly is no deformation, (film-surface.6).
[[nodiscard]] Eigen::MatrixXd coefficients_from_frame(const FilmSurface& surface, const Mesh& mesh,
                                                      const Eigen::MatrixXd& U, const Vector3& origin,
                                                      Eigen::Index first);

}  // namespace hersey::fem
