#include <doctest/doctest.h>

#include "tree/source_tree.h"

namespace hersey::model {
namespace extent_test {

TEST_CASE("Extent_CountsNodesTextKeysAndLevels") {
  const Node leaf{.kind = Node::Kind::scalar, .text = "12 mm"};
  CHECK(extent_of(leaf).nodes == 1);
  CHECK(extent_of(leaf).depth == 1);
  Node list{.kind = Node::Kind::sequence};
  list.items = {leaf, leaf};
  Node mapping{.kind = Node::Kind::mapping};
  mapping.entries.push_back({.key = "width", .value = leaf});
  mapping.entries.push_back({.key = "sizes", .value = list});
  const Extent extent = extent_of(mapping);
  CHECK(extent.nodes == 5);
  CHECK(extent.depth == 3);
  CHECK(extent.text_bytes == 3 * 5);
  CHECK(extent.key_bytes == 2 * 5);
}

}  // namespace extent_test
}  // namespace hersey::model
