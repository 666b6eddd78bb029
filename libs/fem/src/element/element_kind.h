#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hersey/fem/quadrature.h"
#include "hersey/fem/shape_functions.h"

namespace hersey::fem {

/// Names of a type in files, "" or 0 where they have none; `order`: for each node in our order its index in theirs,
/// empty where it is the same.
struct ElementInFiles {
  const char* abaqus = "";   ///< without variants: C3D8R, C3D8I and C3D8H are C3D8
  const char* nastran = "";  ///< one entry for first and second order
  std::vector<std::size_t> nastran_order;
  long gmsh = 0;
  std::vector<std::size_t> gmsh_order;
  std::uint8_t vtk = 0;  ///< nodes as ours
};

/// Properties of one type of element. A beam has only its name, its nodes and its names in files.
struct ElementKind {
  ElementType type = ElementType::tet4;
  const char* name = "";
  int nodes = 0, corners = 0;           ///< corners come first
  std::vector<std::vector<int>> faces;  ///< nodes of each face, as in `face_nodes`
  ElementInFiles files;

  /// Shape functions at natural coordinates, (elastic.1).
  ShapeFunctions (*shape)(const Vector3& xi) = nullptr;
  Eigen::Matrix3Xd natural_nodes;  ///< (3, nodes)
  /// Points of integration, `reduced_points` of `Integration::reduced`.
  std::vector<QuadraturePoint> stiffness_points, reduced_points, mass_points;
  /// Terms of the polynomial that continues a stress: constant, linear or trilinear, as many as `stiffness_points` and
  /// `reduced_points` determine.
  Eigen::VectorXd (*stress_terms)(const Vector3& xi) = nullptr;

  /// Corners whose shape is checked, each with three neighbours in right-handed order.
  std::vector<std::array<int, 4>> checked_corners;
  Matrix3 ideal_edges = Matrix3::Identity();  ///< edges of the ideal corner, as columns
};

/// All types, as enumerated.
[[nodiscard]] const std::vector<ElementKind>& element_kinds();

[[nodiscard]] const ElementKind& kind_of(ElementType type);

[[nodiscard]] inline bool has_midside_nodes(ElementType type) { return kind_of(type).nodes > kind_of(type).corners; }

}  // namespace hersey::fem
