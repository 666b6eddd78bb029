#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "hersey/fem/interface_frame.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// The share of each of `nodes` in the area of the faces whose nodes are all among them; empty if there is no such
/// face.
[[nodiscard]] std::vector<double> face_weights(const Mesh& mesh, const std::vector<int>& nodes);

/// An `average` frame on one node, or on nodes of one line, with the other nodes of the elements around them: these
/// turn the frame, but count for little where it is, so that it stays with the nodes it was given. Any other frame as
/// it is.
[[nodiscard]] InterfaceFrame braced(const Mesh& mesh, InterfaceFrame frame);

/// The centre of the faces whose nodes are all among `nodes`: of a bore a point on its axis, however it is meshed. The
/// mean of the nodes if there is no such face.
[[nodiscard]] Vector3 face_centre(const Mesh& mesh, const std::vector<int>& nodes);

/// (6, 3 n): small rotation and displacement of `frame`, [theta; d], that the displacements of its nodes mean,
/// (elastic.13); its transpose spreads a wrench [tau; f] over the nodes.
[[nodiscard]] Eigen::SparseMatrix<double> frame_motion(const Mesh& mesh, const InterfaceFrame& frame);

}  // namespace hersey::fem
