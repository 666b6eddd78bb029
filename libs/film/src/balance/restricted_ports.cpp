// Features that are fed through restrictors: the pressure in each is an unknown of the film (hydrostatic.1).
#include <algorithm>

#include "balance/flow_balance.h"

namespace hersey::film {

// The node that the feature covers most, and of these the one nearest to its middle: there u is the feature's own. -1:
// a feature that reaches no node but those of edges, whose pressure is given.
int FlowBalance::main_node(const std::vector<CoveredNode>& covered) const {
  const CoveredNode* best = nullptr;
  for (const CoveredNode& node : covered) {
    if (is_on_prescribed_edge(node.node) || is_on_open_edge(node.node)) continue;
    const bool is_better = best == nullptr || node.fraction > best->fraction ||
                           (node.fraction == best->fraction && node.centrality > best->centrality);
    if (is_better) best = &node;
  }
  return best == nullptr ? -1 : best->node;
}

// Of two features with the same middle, which meet as the journal rotates, one has the node.
void FlowBalance::keep_restricted_ports() {
  std::erase_if(restricted_, [&](const RestrictedPort& port) {
    const PrescribedNode* prescribed = prescribed_at(port.node);
    return prescribed == nullptr || prescribed->feature != port.feature;
  });
}

// A recess that lacks oil has the cavitation pressure.
ValueAndSlope FlowBalance::restrictor_flow(const RestrictedPort& port) const {
  const Restrictor& restrictor = *model_.features[static_cast<std::size_t>(port.feature)].restrictor;
  return restrictor.flow(port.supply - (port.has_pressure ? port.u : 0));
}

// (hydrostatic.1)
void FlowBalance::replace_restricted_rows() {
  for (const RestrictedPort& port : restricted_) {
    double& row = residual_[port.node];
    const double through_restrictor = restrictor_flow(port).value;
    row = slack(port.node) - through_restrictor;
    for (int i = 0; i < size(); ++i)
      if (feature_at(i) == port.feature) row += supply(i);
    throughput_[port.node] = std::max(throughput_[port.node], std::abs(through_restrictor));
  }
}

// (hydrostatic.5)
void FlowBalance::find_restricted(Eigen::MatrixXd& rows, Eigen::MatrixXd& columns) const {
  const auto count = static_cast<Eigen::Index>(restricted_.size());
  rows.setZero(size(), count), columns.setZero(size(), count);
  if (count == 0) return;
  Eigen::MatrixXd flow_by_u;
  find_port_flows_by_u(flow_by_u);
  for (Eigen::Index k = 0; k < count; ++k) {
    const RestrictedPort& port = restricted_[static_cast<std::size_t>(k)];
    rows.col(k) = flow_by_u.col(port.feature);
    rows(port.node, k) += slack_u(port.node) + (port.has_pressure ? restrictor_flow(port).slope : 0);
    for (const PrescribedNode& prescribed : prescribed_) {
      const int i = prescribed.node;
      if (prescribed.feature != port.feature || (u_[i] > 0 && only_fills(i))) continue;
      columns(i, k) = -tie(prescribed).k * prescribed.by_port * (prescribed.u < 0 ? draws(i) : 1);
    }
    columns(port.node, k) = -values_[diagonal_slot_[port.node]];
  }
}

void FlowBalance::find_restricted_along(const MotionDirection& direction, const Eigen::VectorXd& balance,
                                        Eigen::VectorXd& dr) const {
  Eigen::VectorXd change;
  find_port_flows_along(direction, balance, change);
  for (const RestrictedPort& port : restricted_) {
    dr[port.node] = change[port.feature];
    if (direction.port_pressure.size() == 0) continue;
    dr[port.node] -= restrictor_flow(port).slope * port.by_supply * direction.port_pressure[port.feature];
  }
}

}  // namespace hersey::film
