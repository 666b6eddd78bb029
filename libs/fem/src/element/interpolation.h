#pragma once

#include <array>
#include <span>

#include "hersey/fem/shape_functions.h"

namespace hersey::fem {

using Edge = std::array<int, 2>;   ///< a midside node's corners
using Signs = std::array<int, 3>;  ///< natural coordinates of a corner of a square or cube, each -1 or 1

[[nodiscard]] ShapeFunctions sized(int nodes);  ///< without values

/// L_0 = 1 - sum xi_k, L_k = xi_k over the first `dimension` coordinates, and their constant gradients.
struct Barycentric {
  Eigen::Vector4d L = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 4, 3> dL = Eigen::Matrix<double, 4, 3>::Zero();

  Barycentric(const Vector3& xi, int dimension);
};

/// N_a = L_a.
[[nodiscard]] ShapeFunctions linear_simplex(const Barycentric& b, int corners);

/// N_a = L_a (2 L_a - 1) at corners, 4 L_i L_j on edges.
[[nodiscard]] ShapeFunctions quadratic_simplex(const Barycentric& b, int corners, std::span<const Edge> edges);

/// prod (1 + s_k xi_k)/2 over the first d coordinates.
[[nodiscard]] ShapeFunctions multilinear(int d, std::span<const Signs> corners, const Vector3& xi);

/// Multilinear at corners times what vanishes on their edges' middles; at those 1 - xi_k^2 along the edge.
[[nodiscard]] ShapeFunctions serendipity(int d, std::span<const Signs> corners, std::span<const Edge> edges,
                                         const Vector3& xi);

/// Natural coordinates of corners, and behind them of the middles of edges, (3, nodes).
[[nodiscard]] Eigen::Matrix3Xd with_middles(const Eigen::Matrix3Xd& corners, std::span<const Edge> edges);

}  // namespace hersey::fem
