#include "tree/extent.h"

#include <algorithm>

namespace hersey::model {

Extent extent_of(const Node& node) {
  Extent extent{.text_bytes = node.text.size()};
  const auto add = [&extent](const Extent& part) {
    extent.nodes += part.nodes;
    extent.text_bytes += part.text_bytes;
    extent.key_bytes += part.key_bytes;
    extent.depth = std::max(extent.depth, 1 + part.depth);
  };
  for (const Node& item : node.items) add(extent_of(item));
  for (const Entry& entry : node.entries) {
    add(extent_of(entry.value));
    extent.key_bytes += entry.key.size();
  }
  return extent;
}

}  // namespace hersey::model
