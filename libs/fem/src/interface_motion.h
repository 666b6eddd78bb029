#pragma once

#include "hersey/fem/reduction.h"

namespace hersey::fem {

/// Displacement of a node that follows `frame`, of the frame's [theta; d].
[[nodiscard]] Eigen::Matrix<double, 3, 6> frame_to_node(const InterfaceFrame& frame, const Vector3& node);

/// Whether the nodes fix all rotations of the frame: not if they lie on one line.
[[nodiscard]] bool nodes_span_rotations(const Mesh& mesh, const InterfaceFrame& frame);

/// Areas of `faces` shared out among `count` nodes, node a at place[a], in the proportions of int N_a^2 dA on each
/// face: positive, which int N_a dA is not in the corners of quadratic faces.
[[nodiscard]] std::vector<double> nodal_areas(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                              const std::vector<int>& place, std::size_t count);

}  // namespace hersey::fem
