#pragma once

#include <Eigen/Dense>

namespace hersey::bearing {

/// Position of one surface of a bearing relative to the other in the coordinates of its kind, or a force on these: of a
/// journal (e_x, e_y), of a plane slider the single distance along the normal [m; N].
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;

/// Offset of a journal's axis from that of its bore [m]; zero for kinds without an axis.
[[nodiscard]] inline Eigen::Vector2d axis_offset(const Coordinates& e) {
  return e.size() == 2 ? Eigen::Vector2d(e) : Eigen::Vector2d::Zero();
}

}  // namespace hersey::bearing
