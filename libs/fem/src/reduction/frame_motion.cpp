#include "hersey/fem/frame_motion.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/fem/load_distributions.h"
#include "hersey/fem/load_vectors.h"
#include "reduction/interface_motion.h"

namespace hersey::fem {

std::vector<double> face_weights(const Mesh& mesh, const std::vector<int>& nodes) {
  std::vector<int> index(mesh.nodes.size(), -1);
  for (std::size_t i = 0; i < nodes.size(); ++i) index[static_cast<std::size_t>(nodes[i])] = static_cast<int>(i);
  const std::vector<ElementFace> faces = outer_faces(mesh, nodes);
  if (faces.empty()) return {};
  return nodal_areas(mesh, faces, index, nodes.size());
}

Vector3 face_centre(const Mesh& mesh, const std::vector<int>& nodes) {
  HERSEY_REQUIRE(!nodes.empty(), "a set of nodes has a centre");
  std::vector<double> weights = face_weights(mesh, nodes);
  if (weights.empty()) weights.assign(nodes.size(), 1.0);
  Vector3 sum = Vector3::Zero();
  double total = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    sum += weights[i] * mesh.nodes[static_cast<std::size_t>(nodes[i])];
    total += weights[i];
  }
  return sum / total;
}

InterfaceFrame braced(const Mesh& mesh, InterfaceFrame frame) {
  constexpr double share = 1e-4;  // of a neighbour's weight in that of a node of the frame's own
  if (frame.connection != Connection::average || frame.nodes.empty() || nodes_span_rotations(mesh, frame)) return frame;
  std::vector<char> is_own(mesh.nodes.size(), 0), is_near(mesh.nodes.size(), 0);
  for (const int node : frame.nodes) is_own[static_cast<std::size_t>(node)] = 1;
  for (const Element& element : mesh.elements) {
    const int* const first = mesh.nodes_of(element);
    const int* const last = first + node_count(element.type);
    if (std::none_of(first, last, [&](int node) { return is_own[static_cast<std::size_t>(node)] != 0; })) continue;
    std::for_each(first, last, [&](int node) { is_near[static_cast<std::size_t>(node)] = 1; });
  }
  frame.weights.assign(frame.nodes.size(), 1.0);
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (is_near[node] == 0 || is_own[node] != 0) continue;
    frame.nodes.push_back(static_cast<int>(node));
    frame.weights.push_back(share);
  }
  return frame;
}

Eigen::SparseMatrix<double> frame_motion(const Mesh& mesh, const InterfaceFrame& frame) {
  HERSEY_REQUIRE(nodes_span_rotations(mesh, frame), "the nodes do not lie on one line");
  HERSEY_REQUIRE(frame.weights.empty() || frame.weights.size() == frame.nodes.size(), "one weight per node");
  Matrix6 TWT = Matrix6::Zero();
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const auto T = frame_to_node(frame, mesh.nodes[static_cast<std::size_t>(frame.nodes[i])]);
    TWT += weight_of(frame, i) * T.transpose() * T;
  }
  const Eigen::LDLT<Matrix6> solver(TWT);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(18 * frame.nodes.size());
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const auto T = frame_to_node(frame, mesh.nodes[static_cast<std::size_t>(frame.nodes[i])]);
    const Eigen::Matrix<double, 6, 3> C = weight_of(frame, i) * solver.solve(T.transpose());
    for (int row = 0; row < 6; ++row)
      for (int k = 0; k < 3; ++k) entries.emplace_back(row, 3 * frame.nodes[i] + k, C(row, k));
  }
  Eigen::SparseMatrix<double> C(6, 3 * static_cast<Eigen::Index>(mesh.nodes.size()));
  C.setFromTriplets(entries.begin(), entries.end());
  return C;
}

}  // namespace hersey::fem
