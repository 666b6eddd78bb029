#pragma once

#include "hersey/core/spatial.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

constexpr int most_nodes = 20;  ///< largest number of nodes of one element

using NodeValues = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_nodes, 1>;
using NodeGradients = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, most_nodes, 3>;
using FaceGradients = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, 8, 2>;

/// Shape functions at one point of a solid element, (elastic.1).
struct ShapeFunctions {
  NodeValues N;      ///< (nodes)
  NodeGradients dN;  ///< (nodes, 3): derivatives by the natural coordinates
};

/// Returns the shape functions of solid `type` at natural coordinates `xi`: tetrahedra 0 <= xi_i, sum <= 1; wedges the
/// same for the first two and |xi_3| <= 1; hexahedra |xi_i| <= 1; pyramids 0 <= xi_3 <= 1 and |xi_1|, |xi_2| <= 1 -
/// xi_3.
/// @throws ContractError for a beam. @see Bathe (2014), Finite Element Procedures, Fig. 5.5 and Tab. 5.3; Abaqus' order
/// of nodes.
/// @verified_by shape_functions_test.cpp
[[nodiscard]] ShapeFunctions shape_functions(ElementType type, const Vector3& xi);

/// Returns the natural coordinates of the element's nodes, (3, nodes).
[[nodiscard]] Eigen::Matrix3Xd natural_nodes(ElementType type);

/// Shape functions of a face.
struct FaceShape {
  NodeValues N;
  FaceGradients dN;
};

/// Returns the shape functions of a face with 3 or 6 nodes (triangle: 0 <= xi, eta, sum <= 1), or 4 or 8 (|xi|, |eta|
/// <= 1), ordered as in `face_nodes`.
[[nodiscard]] FaceShape face_shape(int nodes, double xi, double eta);

}  // namespace hersey::fem
