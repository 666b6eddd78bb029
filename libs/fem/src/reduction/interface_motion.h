#pragma once

#include "hersey/fem/interface_frame.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Returns the displacement of a node that follows `frame`, by the frame's [theta; d].
[[nodiscard]] Eigen::Matrix<double, 3, 6> frame_to_node(const InterfaceFrame& frame, const Vector3& node);

/// Returns the weight of node `i` of the frame: all the same where the frame has no weights.
[[nodiscard]] double weight_of(const InterfaceFrame& frame, std::size_t i);

/// True if the nodes determine all rotations of the frame: not if they lie on one line.
[[nodiscard]] bool nodes_span_rotations(const Mesh& mesh, const InterfaceFrame& frame);

}  // namespace hersey::fem
