#include "mesh/left_handed.h"

#include <algorithm>

#include "element/element_kind.h"
#include "mesh/label_index.h"

namespace hersey::fem {
namespace {

/// For each node, the node with which it is exchanged when the first two natural coordinates are exchanged.
std::vector<std::size_t> mirrored_nodes(const ElementKind& kind) {
  std::vector<std::size_t> order;
  for (Eigen::Index a = 0; a < kind.nodes; ++a) {
    const Vector3 xi = kind.natural_nodes.col(a), swapped(xi[1], xi[0], xi[2]);
    for (Eigen::Index b = 0; b < kind.nodes; ++b)
      if (kind.natural_nodes.col(b) == swapped) order.push_back(static_cast<std::size_t>(b));
  }
  return order;
}

class Mirror {
 public:
  explicit Mirror(RawMesh& raw) : raw_(raw), index_(raw.node_labels) {}

  void run() {
    for (const RawElement& element : raw_.elements)
      if (kind_of(element.type).shape && is_left_handed(element)) mirror(element);
  }

 private:
  bool is_left_handed(const RawElement& element) const {
    const ElementKind& kind = kind_of(element.type);
    return std::all_of(kind.checked_corners.begin(), kind.checked_corners.end(), [&](const std::array<int, 4>& corner) {
      std::array<Vector3, 4> r;
      for (std::size_t k = 0; k < 4; ++k) {
        const int n = index_.find(raw_.connectivity[element.first + static_cast<std::size_t>(corner[k])]);
        if (n < 0) return false;  // reported with the element
        r[k] = raw_.nodes[static_cast<std::size_t>(n)];
      }
      return (r[1] - r[0]).cross(r[2] - r[0]).dot(r[3] - r[0]) < 0;
    });
  }

  void mirror(const RawElement& element) {
    const auto [mirrored, is_new] = mirrored_.try_emplace(element.type);
    if (is_new) mirrored->second = mirrored_nodes(kind_of(element.type));
    std::vector<long> nodes;
    nodes.reserve(mirrored->second.size());
    for (const std::size_t at : mirrored->second) nodes.push_back(raw_.connectivity[element.first + at]);
    std::copy(nodes.begin(), nodes.end(), raw_.connectivity.begin() + static_cast<std::ptrdiff_t>(element.first));
  }

  RawMesh& raw_;
  LabelIndex index_;
  std::map<ElementType, std::vector<std::size_t>> mirrored_;
};

}  // namespace

void mirror_left_handed(RawMesh& raw) { Mirror(raw).run(); }

}  // namespace hersey::fem
