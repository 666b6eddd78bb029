#pragma once

#include <vector>

#include "mesh/raw_mesh.h"

namespace hersey::fem {

/// A mid-side node that the file left out and that an element of first order shares the edge of: there it stays on the
/// straight line between the corners.
struct StraightNode {
  long node = 0;
  std::array<long, 2> corners{};
};

/// Puts nodes into the middle of straight edges where elements of second order leave theirs out (kLeftOut), one for all
/// elements around an edge; where a neighbour has a node on the edge it is that one. Tells how many.
[[nodiscard]] std::vector<StraightNode> add_midside_nodes(RawMesh& raw);

}  // namespace hersey::fem
