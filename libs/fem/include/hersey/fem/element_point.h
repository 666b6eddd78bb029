#pragma once

#include "hersey/fem/shape_functions.h"

namespace hersey::fem {

using NodeColumns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_nodes>;  ///< (3, nodes)
using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 * most_nodes, 3 * most_nodes>;
using StrainMatrix = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 3 * most_nodes>;

/// Point of an isoparametric element: gradients of its shape functions in space.
struct ElementPoint {
  NodeGradients gradients;  ///< dN/dx [1/m]
  double jacobian = 0;      ///< det dx/dxi: > 0 unless the element is folded at this point
};

/// Returns the point with shape functions `shape` of an element with nodes at `x`. The gradients are meaningful only
/// where the jacobian is positive.
[[nodiscard]] ElementPoint element_point(const ShapeFunctions& shape, const NodeColumns& x);

/// Returns B with strain = B u, u ordered node by node, (elastic.2).
[[nodiscard]] StrainMatrix strain_matrix(const NodeGradients& gradients);

}  // namespace hersey::fem
