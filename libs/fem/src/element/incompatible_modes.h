#pragma once

#include "hersey/fem/element_point.h"

namespace hersey::fem {

/// The nine incompatible modes of hex8, (elastic.7): displacements lambda_k (1 - xi_k^2), k = 1..3. Their gradients are
/// taken with the Jacobian of the centre, scaled so that they do no work against a constant stress; this allows a
/// distorted element to pass the patch test.
class IncompatibleModes {
 public:
  explicit IncompatibleModes(const NodeColumns& x);

  /// (6, 9): strain of each mode at `xi`, where the element's own Jacobian determinant is `jacobian`.
  [[nodiscard]] Eigen::Matrix<double, 6, 9> strain(const Vector3& xi, double jacobian) const;

  struct Stiffness {
    ElementMatrix K_uu;
    Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, 3 * most_nodes> K_au;
    Eigen::Matrix<double, 9, 9> K_aa;
  };

  /// The blocks before condensation.
  [[nodiscard]] Stiffness stiffness(const NodeColumns& x, const Matrix6& D) const;

  /// Amplitudes at which the modes balance displacements `u` of the nodes and `forces` on the modes themselves: those
  /// that condensation takes out of the stiffness.
  [[nodiscard]] Eigen::Matrix<double, 9, 1> amplitudes(const NodeColumns& x, const Matrix6& D, const NodeColumns& u,
                                                       const Eigen::Matrix<double, 9, 1>& forces) const;

  /// Forces on the modes of a stress [Pa] that goes with a field given at the nodes, (9, nodes): (elastic.28).
  [[nodiscard]] Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, most_nodes> forces(const NodeColumns& x,
                                                                                  const Vector6& stress) const;

 private:
  Matrix3 inverse_;  ///< (dx/dxi)^-1 at the centre
  double centre_jacobian_ = 0;
};

}  // namespace hersey::fem
