#pragma once

#include <Eigen/Dense>
#include <optional>
#include <string>
#include <vector>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Surface that carries loads, and shapes of pressure on it.
struct LoadedSurface {
  std::string name;
  Eigen::MatrixXd loads;      ///< nodal forces (3 n, shapes)
  std::vector<int> nodes;     ///< nodes of the surface, indices in the mesh
  std::vector<double> areas;  ///< area that is attributed to each node [m^2]
};

/// Returns the pressures on the surface or node set `name` of `mesh`: on a bore those of bore_pressures with
/// `harmonics`, on any other face a uniform pressure and linear ones along the face. @pre the mesh has faces of that
/// name: see faces_called
[[nodiscard]] LoadedSurface loaded_surface(const Mesh& mesh, const std::string& name, int harmonics);

/// Returns the axis of a bore whose normals are those of `faces`, as the z-axis of a pose; none if the faces are not
/// part of a bore.
[[nodiscard]] std::optional<Pose> bore_of(const Mesh& mesh, const std::vector<ElementFace>& faces);

/// Returns pressures of 1 Pa on a bore as nodal forces: P_l(z/h) cos(k phi) and P_l(z/h) sin(k phi), k = 0..harmonics,
/// l = 0..axial; phi about the z-axis of `X`, z/h from -1 to 1 over the faces. Shape (3 n, (2 harmonics + 1)(axial +
/// 1)), axial <= 2.
[[nodiscard]] Eigen::MatrixXd bore_pressures(const Mesh& mesh, const std::vector<ElementFace>& faces, const Pose& X,
                                             int harmonics, int axial = 1);

}  // namespace hersey::fem
