#include "tree/tree.h"

#include "hersey/core/contract.h"

namespace hersey::mbd {

int column_of(const Tree& tree, const CoordinateRef& coordinate) {
  const JointIndices& indices = tree.joints[coordinate.joint.index];
  HERSEY_REQUIRE(0 <= coordinate.value && coordinate.value < indices.value_count,
                 "the joint has a coordinate of that number");
  const Link& link = tree.links[indices.values[coordinate.value].link];
  HERSEY_REQUIRE(link.motion != Motion::ball, "orientations are not scalar coordinates");
  return link.first_v;
}

}  // namespace hersey::mbd
