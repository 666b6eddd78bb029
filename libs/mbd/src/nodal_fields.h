#pragma once

#include "hersey/mbd/nodal_body.h"

namespace hersey::mbd {

/// Where the nodes are and how they move against the body's axes, and their accelerations in space, in these axes.
struct NodalBody::Fields {
  Eigen::Matrix3Xd y, y_rate, y_acc, acceleration;
};

}  // namespace hersey::mbd
