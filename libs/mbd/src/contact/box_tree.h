#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <vector>

namespace hersey::mbd {

/// Tree of axis-aligned boxes around many small items, for searches that examine few of them.
class BoxTree {
 public:
  using Box = Eigen::AlignedBox3d;

  /// @param items  the box around each item; not empty
  explicit BoxTree(const std::vector<Box>& items);

  /// Calls see(item) for each item below boxes for which `enter` returns true; the box of the item itself is not
  /// tested.
  template <class Enter, class See>
  void visit(Enter enter, See see) const {
    visit_below(0, enter, see);
  }

  [[nodiscard]] const Box& bounds() const { return nodes_.front().box; }

 private:
  /// A leaf holds order_[first, first + count); an inner node, count 0, has its children at first and first + 1.
  struct Node {
    Box box;
    int first = 0;
    int count = 0;
  };

  void split(int node, const std::vector<Box>& items, int first, int last);

  template <class Enter, class See>
  void visit_below(int at, Enter& enter, See& see) const {
    const Node& node = nodes_[at];
    if (!enter(node.box)) return;
    if (node.count == 0) {
      visit_below(node.first, enter, see);
      visit_below(node.first + 1, enter, see);
    }
    for (int i = node.first; i < node.first + node.count; ++i) see(order_[i]);
  }

  std::vector<Node> nodes_;
  std::vector<int> order_;
};

}  // namespace hersey::mbd
