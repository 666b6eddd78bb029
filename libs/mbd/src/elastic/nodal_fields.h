#pragma once

#include <Eigen/Dense>

namespace hersey::mbd {

/// Positions and velocities of the nodes of a NodalBody relative to the body's axes, and their absolute accelerations
/// in these axes.
struct NodalFields {
  Eigen::Matrix3Xd y, y_rate, y_acc, acceleration;
  Eigen::VectorXd u;  ///< displacements of the nodes; y contains them with the round-off of positions
  /// Displacements, rates and accelerations of the static shapes alone (3 nodes, 3) for these amplitudes.
  Eigen::MatrixXd carried, amplitudes;

  /// Positions, rates and accelerations side by side, (nodes, 9).
  [[nodiscard]] Eigen::MatrixXd side_by_side() const {
    Eigen::MatrixXd all(y.cols(), 9);
    all << y.transpose(), y_rate.transpose(), y_acc.transpose();
    return all;
  }
};

}  // namespace hersey::mbd
