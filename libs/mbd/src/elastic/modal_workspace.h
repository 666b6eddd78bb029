#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "elastic/relative_deformation.h"

namespace hersey::mbd {

/// Sum over material points of y x z for the matrix N = sum of y z^T.
inline Vector3 cross_moment(const Matrix3& N) { return {N(1, 2) - N(2, 1), N(2, 0) - N(0, 2), N(0, 1) - N(1, 0)}; }

/// Everything of a ModalBody at one motion. The unknowns of the body in its own axes are [frame 0 (6); amplitudes].
struct ModalWorkspace {
  Eigen::VectorXd q, rate, acceleration;            // amplitudes, with q_0 = 1 for the points themselves
  std::array<Eigen::VectorXd, 9> h, h_rate, h_acc;  // sums over b of G_ab q_b, component by component
  std::vector<Matrix3> H, H_rate, H_acc;            // the same per shape: sums of rho Y_a y^T
  std::vector<RelativeDeformation> interfaces;
  Eigen::VectorXd force, magnitude, elastic, viscous;
  Eigen::VectorXd load;  // one nodal load of value 1 on the unknowns
  Matrix3 load_moment;   // sum over nodes of y f^T
  Eigen::MatrixXd K, C, M;
  Eigen::MatrixXd Z, Z_rate_X, Z_acc_X, Z_acc_V, product;

  Vector3 a_true, S, S_rate, S_acc;      // acceleration of frame 0's origin; first moment and its rates
  Matrix3 Omega;                         // alpha~ + omega~ omega~
  Matrix3 Gamma, Gamma_rate, Gamma_acc;  // sums of rho y y^T, y y_rate^T, y y_acc^T
};

}  // namespace hersey::mbd
