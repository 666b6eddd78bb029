#pragma once

#include <functional>
#include <vector>

#include "mesh/midside_nodes.h"
#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// Access to the nodes that ties name.
struct TiedNodes {
  std::function<int(long)> index_of;             ///< index in the mesh by label; -1: of no element, or not in the file
  std::function<const Vector3*(long)> position;  ///< position in the file; null: it has no such node
};

/// Creates the mesh's ties from all ties of the file: equations, rigid bodies, surfaces, mid-side nodes on straight
/// edges. Rotations and nodes of no element are eliminated; equations that follow from others are dropped.
void add_ties(RawMesh& raw, Mesh& mesh, const TiedNodes& nodes, const std::vector<StraightNode>& straight);

}  // namespace hersey::fem
