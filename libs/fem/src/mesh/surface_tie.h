#pragma once

#include <optional>
#include <vector>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

struct SurfaceTieOptions {
  std::optional<double> tolerance;  ///< largest distance [of the mesh]; none: a share of the faces' size
  bool adjusts = true;              ///< puts the nodes on the faces, so that a rigid motion stays one
};

struct SurfaceTie {
  std::vector<MeshTie> ties;
  std::vector<int> loose;  ///< nodes that are farther away than the tolerance
  double moved = 0;        ///< farthest that a node was moved
  double tolerance = 0;
};

/// Ties each of `nodes` to the nearest point of `faces`: it moves as that point of the face does, u = sum N_a u_a.
/// Nodes that faces have themselves are ignored. Cost: nodes times faces, of which most are only looked at by their
/// boxes.
[[nodiscard]] SurfaceTie tie_to_faces(Mesh& mesh, const std::vector<int>& nodes, const std::vector<ElementFace>& faces,
                                      const SurfaceTieOptions& options);

}  // namespace hersey::fem
