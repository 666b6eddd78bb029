#include "mesh/midside_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "element/element_kind.h"
#include "mesh/label_index.h"

namespace hersey::fem {
namespace {

using EdgeKey = std::array<long, 2>;  // labels of the corners, ascending
using LocalEdge = std::array<std::size_t, 2>;

/// Corners of each mid-side node, one node after the other.
std::vector<LocalEdge> edges_of_midside_nodes(const ElementKind& kind) {
  std::vector<LocalEdge> edges;
  const Eigen::Matrix3Xd& xi = kind.natural_nodes;
  for (Eigen::Index m = kind.corners; m < kind.nodes; ++m)
    for (Eigen::Index a = 0; a < kind.corners; ++a)
      for (Eigen::Index b = a + 1; b < kind.corners; ++b)
        if (2 * xi.col(m) == xi.col(a) + xi.col(b))
          edges.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(b)});
  return edges;
}

/// All edges of an element of first order.
std::vector<LocalEdge> edges_of_corners(const ElementKind& kind) {
  std::set<LocalEdge> edges;
  for (const std::vector<int>& face : kind.faces)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const auto a = static_cast<std::size_t>(face[k]), b = static_cast<std::size_t>(face[(k + 1) % face.size()]);
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  return {edges.begin(), edges.end()};
}

class MidsideNodes {
 public:
  explicit MidsideNodes(RawMesh& raw) : raw_(raw) {}

  std::vector<StraightNode> add() {
    if (!any_left_out()) return {};
    index_neighbours();
    last_ = *std::max_element(raw_.node_labels.begin(), raw_.node_labels.end());
    const LabelIndex nodes(raw_.node_labels);
    for (const RawElement& element : raw_.elements) fill(element, nodes);
    raw_.warn(first_, fmt::format("{} mid-side {} left out", made_, made_ == 1 ? "node" : "nodes"),
              "all nodes of an element of second order, or its corners alone",
              "they are put into the middle of straight edges");
    return std::move(straight_);
  }

 private:
  [[nodiscard]] bool any_left_out() const {
    return !raw_.node_labels.empty() &&
           std::any_of(raw_.elements.begin(), raw_.elements.end(), [&](const RawElement& e) {
             const auto first = raw_.connectivity.begin() + static_cast<std::ptrdiff_t>(e.first);
             const ElementKind& kind = kind_of(e.type);
             return kind.shape && std::find(first + kind.corners, first + kind.nodes, kLeftOut) != first + kind.nodes;
           });
  }

  [[nodiscard]] EdgeKey key_of(const RawElement& element, const LocalEdge& edge) const {
    const long a = raw_.connectivity[element.first + edge[0]], b = raw_.connectivity[element.first + edge[1]];
    return {std::min(a, b), std::max(a, b)};
  }

  const std::vector<LocalEdge>& edges_of(ElementType type) {
    const auto [edges, is_new] = edges_.try_emplace(type);
    const ElementKind& kind = kind_of(type);
    if (is_new && kind.shape)
      edges->second = has_midside_nodes(type) ? edges_of_midside_nodes(kind) : edges_of_corners(kind);
    return edges->second;
  }

  void index_neighbours() {
    for (const RawElement& element : raw_.elements) {
      const std::vector<LocalEdge>& edges = edges_of(element.type);
      const auto corners = static_cast<std::size_t>(kind_of(element.type).corners);
      for (std::size_t k = 0; k < edges.size(); ++k) {
        if (!has_midside_nodes(element.type)) {
          straight_edges_.insert(key_of(element, edges[k]));
          continue;
        }
        const long given = raw_.connectivity[element.first + corners + k];
        if (given != kLeftOut) node_on_.try_emplace(key_of(element, edges[k]), given);
      }
    }
  }

  void fill(const RawElement& element, const LabelIndex& nodes) {
    if (!has_midside_nodes(element.type)) return;
    const std::vector<LocalEdge>& edges = edges_of(element.type);
    const auto corners = static_cast<std::size_t>(kind_of(element.type).corners);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      long& node = raw_.connectivity[element.first + corners + k];
      if (node != kLeftOut) continue;
      const EdgeKey key = key_of(element, edges[k]);
      const auto [known, is_new] = node_on_.try_emplace(key, 0);
      if (is_new) known->second = make(key, element, nodes);
      node = known->second;
    }
  }

  long make(const EdgeKey& key, const RawElement& element, const LabelIndex& nodes) {
    if (last_ == std::numeric_limits<long>::max())
      raw_.fail(element.location,
                fmt::format("element {} without its mid-side nodes, and a node {}", element.label, last_),
                "smaller numbers of nodes: those that are left out get the next ones");
    const int a = nodes.find(key[0]), b = nodes.find(key[1]);
    Vector3 middle = Vector3::Zero();  // a missing corner is reported with its element
    if (a >= 0 && b >= 0)
      middle = (raw_.nodes[static_cast<std::size_t>(a)] + raw_.nodes[static_cast<std::size_t>(b)]) / 2;
    if (made_++ == 0) first_ = element.location;
    raw_.add_node(++last_, middle, element.location);
    if (straight_edges_.contains(key)) straight_.push_back({last_, key});
    return last_;
  }

  RawMesh& raw_;
  std::map<ElementType, std::vector<LocalEdge>> edges_;
  std::map<EdgeKey, long> node_on_;
  std::set<EdgeKey> straight_edges_;  ///< edges of elements of first order
  std::vector<StraightNode> straight_;
  FileLocation first_;
  long last_ = 0;
  int made_ = 0;
};

}  // namespace

std::vector<StraightNode> add_midside_nodes(RawMesh& raw) { return MidsideNodes(raw).add(); }

}  // namespace hersey::fem
