#include "balance/flow_balance.h"

// Inertia of the oil to first order in the squeeze Reynolds number.
namespace hersey::film {

// Momentum: -dp/dx = 12 mu q/h^3 + beta rho (dq/dt)/h (damper.5). Over a face the second term takes a part of the
// pressure's drop, which then drives less flow (damper.6). A face that a supply line cuts has the pressure of the line
// in its middle: its short flow tubes count as without inertia, as does a seal.
void FlowBalance::inertia_residual(const Eigen::Ref<const Eigen::VectorXd>& du, double momentum_factor,
                                   Eigen::VectorXd& dr) const {
  dr.setZero(size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    if (face.width == 0 || is_cut(f)) continue;
    const double K = flows_[f].K, gap = 0.5 * (oil_gap(face.a) + oil_gap(face.b));
    const double q_rate = K * (nodes_[face.a].p_u * du[face.a] - nodes_[face.b].p_u * du[face.b]);
    const double drop = momentum_factor * model_.lubricant.density * face.length / (face.width * gap) * q_rate;
    dr[face.a] -= K * drop;
    dr[face.b] += K * drop;
  }
  std::vector<double> ports(restricted_.size(), 0.0);
  for (std::size_t k = 0; k < ports.size(); ++k)
    for (const PrescribedNode& prescribed : prescribed_)
      if (prescribed.feature == restricted_[k].feature) ports[k] += dr[prescribed.node];
  for (const PrescribedNode& prescribed : prescribed_) dr[prescribed.node] *= 1 - prescribed.chi;
  for (std::size_t k = 0; k < ports.size(); ++k) dr[restricted_[k].node] = ports[k];
  for (const int node : prescribed_edge_nodes_) dr[node] = 0;
}

}  // namespace hersey::film
