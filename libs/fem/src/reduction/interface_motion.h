#pragma once

#include "hersey/fem/interface_frame.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Displacement of a node that follows `frame`, of the frame's [theta; d].
[[nodiscard]] Eigen::Matrix<double, 3, 6> frame_to_node(const InterfaceFrame& frame, const Vector3& node);

/// What node `i` of the frame counts: all the same without weights.
[[nodiscard]] double weight_of(const InterfaceFrame& frame, std::size_t i);

/// Whether the nodes fix all rotations of the frame: not if they lie on one line.
[[nodiscard]] bool nodes_span_rotations(const Mesh& mesh, const InterfaceFrame& frame);

}  // namespace hersey::fem
