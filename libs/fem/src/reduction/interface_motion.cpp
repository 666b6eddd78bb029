#include "reduction/interface_motion.h"

#include <Eigen/Eigenvalues>

namespace hersey::fem {

Eigen::Matrix<double, 3, 6> frame_to_node(const InterfaceFrame& frame, const Vector3& node) {
  Eigen::Matrix<double, 3, 6> T;
  T << -skew(node - frame.origin), Matrix3::Identity();
  return T;
}

double weight_of(const InterfaceFrame& frame, std::size_t i) { return frame.weights.empty() ? 1 : frame.weights[i]; }

bool nodes_span_rotations(const Mesh& mesh, const InterfaceFrame& frame) {
  double sum = 0;
  Vector3 middle = Vector3::Zero();
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    sum += weight_of(frame, i);
    middle += weight_of(frame, i) * mesh.nodes[static_cast<std::size_t>(frame.nodes[i])];
  }
  if (!(sum > 0)) return false;
  middle /= sum;
  Matrix3 S = Matrix3::Zero();
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const Vector3 r = mesh.nodes[static_cast<std::size_t>(frame.nodes[i])] - middle;
    S += weight_of(frame, i) * r * r.transpose();
  }
  // Points on a line have one moment only: a rotation about the line moves none of them.
  const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(S, Eigen::EigenvaluesOnly).eigenvalues();
  return moments[1] > 1e-10 * moments[2];
}

}  // namespace hersey::fem
