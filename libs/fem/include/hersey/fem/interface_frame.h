#pragma once

#include <string>
#include <vector>

#include "hersey/core/spatial.h"

namespace hersey::fem {

/// Connection of a frame to its nodes.
enum class Connection {
  rigid,   ///< the nodes follow the frame as a rigid body
  average  ///< the frame follows the nodes' mean displacement and rotation, its wrench is distributed over them
};

/// Frame to which joints and forces attach, axes parallel to the mesh's.
struct InterfaceFrame {
  std::string name;
  Vector3 origin = Vector3::Zero();  ///< position in the mesh's axes [m]
  std::vector<int> nodes;            ///< indices of the nodes in the mesh
  Connection connection = Connection::rigid;
  std::vector<double> weights;  ///< weights of the nodes, for `average`; empty: all the same. See `face_weights`.
};

}  // namespace hersey::fem
