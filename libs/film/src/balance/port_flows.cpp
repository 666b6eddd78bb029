// Oil that enters through the features of a film, its ports, with derivatives.
#include <array>

#include "balance/flow_balance.h"

namespace hersey::film {

// As supply(), for nodes in whose rows a feature has a share, and over_land().
void FlowBalance::find_port_flows(Eigen::VectorXd& flow) const {
  flow.setZero(port_count());
  for (int i = 0; i < size(); ++i)
    if (const int port = feature_at(i); port >= 0) flow[port] += supply(i);
}

void FlowBalance::find_port_flows_by_u(Eigen::MatrixXd& by_u) const {
  by_u.setZero(size(), port_count());
  for (const PrescribedNode& prescribed : prescribed_) {
    const int i = prescribed.node;
    if (prescribed.feature < 0 || returns_to_edge(i)) continue;
    auto column = by_u.col(prescribed.feature);
    column[i] += storage_u(i) + (is_on_open_edge(i) ? 1 : 1 - draws(i)) * slack_u(i);
    if (is_on_leaking_edge(i)) column[i] += seal_flow(i).u;
    for (const int f : faces_around(i)) {
      if (f < 0) continue;
      const Face& face = faces_[static_cast<std::size_t>(f)];
      const auto [by_a, by_b] = flow_by_u(static_cast<std::size_t>(f));
      const double sign = face.a == i ? 1 : -1;
      column[face.a] += sign * by_a;
      column[face.b] += sign * by_b;
    }
  }
  for (const Land& land : lands_) {
    const int port = feature_at(land.node);
    if (port < 0) continue;
    const LandTie tie = tie_over_land(land);
    auto column = by_u.col(port);
    column[land.node] += tie.k_u[0] * drop_over_land(land.node);
    column[land.inside] += tie.k_u[1] * drop_over_land(land.node);
    for (const RestrictedPort& restricted : restricted_)
      if (restricted.feature == land.feature && restricted.has_pressure) column[restricted.node] += tie.k;
  }
}

void FlowBalance::find_port_flows_along(const MotionDirection& direction, Eigen::VectorXd& change) const {
  balance_along(direction, direction_balance_);
  find_port_flows_along(direction, direction_balance_, change);
}

void FlowBalance::find_port_flows_along(const MotionDirection& direction, const Eigen::VectorXd& db,
                                        Eigen::VectorXd& change) const {
  change.setZero(port_count());
  for (const PrescribedNode& prescribed : prescribed_) {
    const int i = prescribed.node;
    if (prescribed.feature < 0 || returns_to_edge(i)) continue;
    change[prescribed.feature] += db[i];
    if (!is_on_open_edge(i) && !cavitation_.has_tension())
      change[prescribed.feature] -= prescribed.draws_journal * direction.phi_journal * slack(i);
  }
  for (const Land& land : lands_) {
    const int port = feature_at(land.node);
    if (port < 0) continue;
    const LandTie tie = tie_over_land(land);
    double k = tie.k_journal * direction.phi_journal;
    for (const std::size_t side : {0U, 1U}) {
      const int at = side == 0 ? land.node : land.inside;
      const SlidingChange& sliding = sliding_along(at);
      k += tie.k_rate[side] * sliding.rate + tie.k_rotation[side] * sliding.rotation;
      if (direction.g.size() != 0) k += tie.k_g[side] * direction.g[at];
    }
    change[port] += k * drop_over_land(land.node) + tie.k * port_along(land.feature, land.u, direction);
  }
}

}  // namespace hersey::film
