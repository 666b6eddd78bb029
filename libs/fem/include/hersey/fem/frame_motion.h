#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "hersey/fem/interface_frame.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Returns the share of each of `nodes` in the area of the faces whose nodes are all among them; empty if there is no
/// such face.
[[nodiscard]] std::vector<double> face_weights(const Mesh& mesh, const std::vector<int>& nodes);

/// Returns an `average` frame on one node, or on nodes of one line, together with the other nodes of the elements
/// around it. These nodes determine the frame's rotation, but have little weight in its position, so that the frame
/// stays with the nodes it was given. Any other frame is returned unchanged.
[[nodiscard]] InterfaceFrame braced(const Mesh& mesh, InterfaceFrame frame);

/// Returns the centre of the faces whose nodes are all among `nodes`: for a bore a point on its axis, however it is
/// meshed. Without such a face it is the mean of the nodes.
[[nodiscard]] Vector3 face_centre(const Mesh& mesh, const std::vector<int>& nodes);

/// Returns the matrix (6, 3 n) from nodal displacements to the small rotation and displacement [theta; d] of `frame`,
/// (elastic.13); its transpose distributes a wrench [tau; f] over the nodes.
[[nodiscard]] Eigen::SparseMatrix<double> frame_motion(const Mesh& mesh, const InterfaceFrame& frame);

}  // namespace hersey::fem
