#pragma once

#include <cstddef>

#include "tree/source_tree.h"

namespace hersey::model {

/// How much a copy of a value would be.
struct Extent {
  std::size_t nodes = 1, depth = 1;
  std::size_t text_bytes = 0, key_bytes = 0;  ///< of its scalars, and of the keys in it
};

[[nodiscard]] Extent extent_of(const Node& node);

}  // namespace hersey::model
