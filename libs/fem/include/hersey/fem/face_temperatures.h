#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "hersey/fem/face_pressures.h"
#include "hersey/solver/symmetric_factor.h"

namespace hersey::fem {

/// Film temperature at the nodes of a mesh, the boundary condition that heat programs take (`*BOUNDARY` 11, `SPC`): the
/// temperatures whose interpolation on the faces differs least from the film's, with the film's mean (theory manual,
/// film-surface.13, film-surface.14).
/// @verified_by face_temperatures_test.cpp
class FaceTemperatures {
 public:
  /// @param mesh   outlives this
  /// @param faces  those that reach into the film, as film_surface leaves them; what lies beside the film counts, too:
  ///               the field goes on there
  /// @throws std::runtime_error where the faces' nodes do not allow the least difference: a face without area
  FaceTemperatures(const Mesh& mesh, const std::vector<ElementFace>& faces, const FilmCylinder& cylinder);

  /// Nodes of the faces, indices in the mesh, ascending.
  [[nodiscard]] const std::vector<int>& nodes() const { return nodes_; }

  /// Temperatures of these nodes that follow `field` and have the mean `mean` over the faces, in the field's unit,
  /// shape (nodes).
  [[nodiscard]] Eigen::VectorXd of(const FilmField& field, double mean) const;

  /// Mean over the faces of what nodal values interpolate, with the area of the film's cylinder, (film-surface.4).
  [[nodiscard]] double mean(const Eigen::VectorXd& nodal) const;

 private:
  [[nodiscard]] Eigen::Index index_of(int node) const;

  const Mesh& mesh_;
  std::vector<ElementFace> faces_;
  FilmCylinder cylinder_;  ///< without ends: all of a face counts
  std::vector<int> nodes_;
  Eigen::VectorXd areas_;  ///< int N_a dA [m^2]
  solver::SymmetricFactor factor_;
};

}  // namespace hersey::fem
