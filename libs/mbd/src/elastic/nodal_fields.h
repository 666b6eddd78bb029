#pragma once

#include <Eigen/Dense>

namespace hersey::mbd {

/// Where the nodes of a NodalBody are and how they move against the body's axes, and their accelerations in space, in
/// these axes.
struct NodalFields {
  Eigen::Matrix3Xd y, y_rate, y_acc, acceleration;
  Eigen::VectorXd u;  ///< displacements of the nodes, of which y holds what round-off of their places leaves
  /// Of the static shapes alone: displacements, rates and accelerations (3 nodes, 3) for these amplitudes of theirs.
  Eigen::MatrixXd carried, amplitudes;

  /// Places, rates and accelerations side by side, (nodes, 9).
  [[nodiscard]] Eigen::MatrixXd side_by_side() const {
    Eigen::MatrixXd all(y.cols(), 9);
    all << y.transpose(), y_rate.transpose(), y_acc.transpose();
    return all;
  }
};

}  // namespace hersey::mbd
