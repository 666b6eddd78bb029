#pragma once

#include <string>
#include <vector>

#include "hersey/core/spatial.h"

namespace hersey::fem {

/// How a frame is tied to its nodes.
enum class Connection {
  rigid,   ///< the nodes follow the frame: nothing strains among them
  average  ///< the frame follows the nodes' mean displacement and rotation, its wrench is spread over them
};

/// A frame that joints and forces attach to, axes parallel to the mesh's.
struct InterfaceFrame {
  std::string name;
  Vector3 origin = Vector3::Zero();  ///< in the mesh's axes [m]
  std::vector<int> nodes;            ///< places in the mesh
  Connection connection = Connection::rigid;
  std::vector<double> weights;  ///< of the nodes, for `average`; empty: all the same. See `face_weights`.
};

}  // namespace hersey::fem
