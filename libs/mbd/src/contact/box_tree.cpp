#include "contact/box_tree.h"

#include <algorithm>
#include <numeric>

#include "hersey/core/contract.h"

namespace hersey::mbd {

BoxTree::BoxTree(const std::vector<Box>& items) : order_(items.size()) {
  HERSEY_REQUIRE(!items.empty(), "a tree has leaves");
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(2 * items.size());
  nodes_.emplace_back();
  split(0, items, 0, static_cast<int>(items.size()));
}

void BoxTree::split(int node, const std::vector<Box>& items, int first, int last) {
  constexpr int leaf_size = 4;
  Box box;
  for (int i = first; i < last; ++i) box.extend(items[order_[i]]);
  nodes_[node].box = box;
  if (last - first <= leaf_size) {
    nodes_[node].first = first;
    nodes_[node].count = last - first;
    return;
  }
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](int i, int j) { return items[i].center()[axis] < items[j].center()[axis]; });
  const int children = static_cast<int>(nodes_.size());
  nodes_[node].first = children;
  nodes_.emplace_back();
  nodes_.emplace_back();
  split(children, items, first, middle);
  split(children + 1, items, middle, last);
}

}  // namespace hersey::mbd
