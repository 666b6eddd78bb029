#include <algorithm>

#include "balance/flow_balance.h"

// Oil that reaches an edge at p_cav by a given flow (film.64) or in a layer on the journal (film.65).
namespace hersey::film {

// Along the end of a patch the oil comes evenly, over each node's width of the nodes that belong to it (film.64).
void FlowBalance::spread_given_flows() {
  const Grid& grid = model_.grid;
  for (int i = 0; i < grid.n_phi; ++i) {
    if (!grid.is_end(i)) continue;
    const PatchEnds& ends = model_.ends[static_cast<std::size_t>(grid.patch_of(i))];
    const Edge& end = grid.begins_patch(i) ? ends.first : ends.last;
    const auto takes = [&](int j) {
      const EdgeNode& at = edges_[grid.index(i, j)];
      return at.of_patch && at.kind == EdgeNode::Kind::open;
    };
    double width = 0;
    for (int j = 0; j < grid.n_z; ++j) width += takes(j) ? geometry_.width_z[j] : 0;
    for (int j = 0; end.flow && j < grid.n_z; ++j)
      if (takes(j)) edges_[grid.index(i, j)].flow = *end.flow * geometry_.width_z[j] / width;
  }
}

double FlowBalance::inward_speed(int node) const {
  return node % model_.grid.n_z == 0 ? speeds_.w_journal : -speeds_.w_journal;
}

bool FlowBalance::brings_layer(int node) const { return edges_[node].has_layer && inward_speed(node) > 0; }

double FlowBalance::layer_flow(int node) const {
  return brings_layer(node) ? edges_[node].layer * inward_speed(node) : 0;
}

// The row of a node on an edge has the oil that a layer brings (film.65).
void FlowBalance::bring_layers_along(double w_journal, Eigen::VectorXd& dr) const {
  const Grid& grid = model_.grid;
  for (const int j : {0, grid.n_z - 1}) {
    const double inwards = j == 0 ? w_journal : -w_journal;
    for (int i = 0; i < grid.n_phi; ++i) {
      const int node = grid.index(i, j);
      if (brings_layer(node)) dr[node] -= edges_[node].layer * inwards;
    }
  }
}

}  // namespace hersey::film
