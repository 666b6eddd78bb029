#pragma once

#include <array>
#include <functional>
#include <vector>

#include "hersey/fem/film_cylinder.h"
#include "hersey/fem/mesh.h"
#include "hersey/fem/shape_functions.h"

namespace hersey::fem {

/// One point of integration on a film's surface.
struct FilmPoint {
  const std::vector<int>& nodes;  ///< nodes of the face, indices in the mesh
  const NodeValues& N;            ///< their shape functions
  double phi = 0, z = 0;          ///< in the film's axes [rad], [m]
  Vector3 outward;                ///< e_r, away from the axis, in the mesh's axes
  double area = 0;                ///< its share of R dphi dz; < 0 where the face's normal points towards the axis [m^2]
};

/// Calls `visit` at points on `face` within the film, after dividing the face into `parts` along each edge and cutting
/// off the parts beyond width and arc.
void visit_film_points(const Mesh& mesh, ElementFace face, const FilmCylinder& cylinder, int parts,
                       const std::function<void(const FilmPoint&)>& visit);

/// A corner of a piece of a face.
struct FilmCorner {
  Eigen::Vector2d xi;     ///< natural coordinates in the face
  double phi = 0, z = 0;  ///< [rad], continuous over the face; [m]
};

/// The triangles that a face is divided into, before cutting.
[[nodiscard]] std::vector<std::array<FilmCorner, 3>> film_triangles(const Mesh& mesh, ElementFace face,
                                                                    const FilmCylinder& cylinder, int parts);

}  // namespace hersey::fem
