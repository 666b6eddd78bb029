#include <utility>

#include "balance/flow_balance.h"
#include "hersey/core/contract.h"

// Changes of the balances along changes of the surfaces (film.39).
namespace hersey::film {

// A row is linear in the change of the gap beside it, so that changes of one place at a time give its coefficients.
void FlowBalance::find_prescribed_by_gap() const {
  direction_sliding_.assign(static_cast<std::size_t>(model_.grid.n_z), {});
  by_surfaces_.prescribed.clear();
  const MotionDirection still;
  for (const PrescribedNode& prescribed : prescribed_) {
    const auto by = [&](const GapChangeBesideLine& unit) { return prescribed_along(prescribed, still, unit); };
    RowByGap row{.node = prescribed.node, .weight = 1 - prescribed.chi, .by_node = by({.g = 1})};
    if (prescribed.other >= 0) {
      const std::size_t f = line_face(prescribed);
      row.other = prescribed.other, row.face = static_cast<int>(f);
      row.upstream = flows_[f].couette >= 0 ? faces_[f].a : faces_[f].b;
      row.by_other = by({.g_other = 1}), row.by_bend = by({.bend = 1}), row.by_excess = by({.excess = 1});
      row.by_rate = by({.g_rate = 1});
    }
    by_surfaces_.prescribed.push_back(row);
  }
}

void FlowBalance::find_gap_operator(GapOperator& by_gap) const {
  HERSEY_REQUIRE(restricted_.empty(), "no ports behind restrictors, whose rows take other changes");
  find_changes_by_surfaces();
  find_prescribed_by_gap();
  by_surfaces_.leaks.clear();
  for (const int node : leaking_edge_nodes_) by_surfaces_.leaks.push_back({node, seal_flow(node).g});
  by_gap.take(by_surfaces_);
}

// Directions are many and share these factors.
void FlowBalance::find_changes_by_surfaces() const {
  BySurfaces& by = by_surfaces_;
  if (by.is_found) return;
  for (auto* field : {&by.storage_gap, &by.storage_excess, &by.storage_rate, &by.storage_excess_rate})
    field->resize(size());
  for (int i = 0; i < size(); ++i) {
    by.storage_gap[i] = storage_g(i), by.storage_excess[i] = storage_excess(i);
    by.storage_rate[i] = storage_g_rate(i), by.storage_excess_rate[i] = storage_excess_rate(i);
  }
  by.around.resize(size()), by.axial.resize(size());
  for (std::size_t f = 0; f < faces_.size(); ++f) find_flow_by_surfaces(f, axial(f) ? by.axial : by.around);
  by.is_found = true;
}

void FlowBalance::find_flow_by_surfaces(std::size_t f, FlowsBySurfaces& by) const {
  const Face& face = faces_[f];
  const FaceFlow& flow = flows_[f];
  const Eigen::Index at = face.a;
  const bool cut = is_cut(f);
  by.leaves[at] = !cut || !has_line_row(face.a) ? 1 : 0;
  by.enters[at] = !cut || !has_line_row(face.b) ? 1 : 0;
  by.gap[at] = flow.q_h_a * nodes_[face.a].h_g;
  by.gap_next[at] = flow.q_h_b * nodes_[face.b].h_g;
  if (flow.q_excess != 0) (flow.couette >= 0 ? by.excess : by.excess_next)[at] = flow.q_excess;
  if (!axial(f)) by.bend[at] = flow.q_bend;
  by.journal[at] = flow.q_journal;
  by.mean_speed[at] = face.stretch * flow.q_speed;
  by.half_slip[at] = face.stretch * flow.q_half_slip;
  by.journal_speed[at] = face.stretch * flow.q_journal_speed;
}

void FlowBalance::add_storage_along(const MotionDirection& direction, Eigen::VectorXd& dr) const {
  if (direction.g.size() != 0) {
    interpolation_.bends(direction.g, direction_bends_);
    interpolation_.excesses(direction.g, direction_excesses_);
    dr += by_surfaces_.storage_gap.cwiseProduct(direction.g) +
          by_surfaces_.storage_excess.cwiseProduct(direction_excesses_);
  }
  if (direction.g_rate.size() != 0) {
    interpolation_.excesses(direction.g_rate, direction_rate_excesses_);
    dr += by_surfaces_.storage_rate.cwiseProduct(direction.g_rate) +
          by_surfaces_.storage_excess_rate.cwiseProduct(direction_rate_excesses_);
  }
  if (relief_.has_pockets()) add_turning_pockets(direction, dr);
}

// The last nodes' next ones are the first: so they are around a whole bearing, and elsewhere these flows are zero.
void FlowBalance::add_flows_along(const FlowsBySurfaces& by, Eigen::Index next, const MotionDirection& direction,
                                  const Speeds& speeds, Eigen::VectorXd& dr) const {
  const Eigen::Index n = size(), rest = n - next;
  Eigen::VectorXd& q = direction_flow_;
  q.setZero(n);
  if (direction.g.size() != 0) {
    const Eigen::VectorXd &g = direction.g, &excess = direction_excesses_;
    q += by.gap.cwiseProduct(g) + by.excess.cwiseProduct(excess);
    q.head(rest) +=
        by.gap_next.head(rest).cwiseProduct(g.tail(rest)) + by.excess_next.head(rest).cwiseProduct(excess.tail(rest));
    q.tail(next) +=
        by.gap_next.tail(next).cwiseProduct(g.head(next)) + by.excess_next.tail(next).cwiseProduct(excess.head(next));
    if (&by == &by_surfaces_.around) q += by.bend.cwiseProduct(direction_bends_);
  }
  if (direction.phi_journal != 0) q += direction.phi_journal * by.journal;
  if (speeds.mean != 0) q += speeds.mean * by.mean_speed;
  if (speeds.half_slip != 0) q += speeds.half_slip * by.half_slip;
  if (speeds.journal != 0) q += speeds.journal * by.journal_speed;
  dr += by.leaves.cwiseProduct(q);
  q.array() *= by.enters.array();
  dr.tail(rest) -= q.head(rest);
  dr.head(next) -= q.tail(next);
}

// Oil that thins or turns turbulent as the surfaces slide flows otherwise under the same pressure.
void FlowBalance::add_sliding_along(Eigen::VectorXd& dr) const {
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (flows_[f].q_fluidity == 0) continue;
    const auto [a, b] = std::pair{faces_[f].a, faces_[f].b};
    const double q =
        0.5 * flows_[f].q_fluidity * (flow_of(a, f).along(sliding_along(a)) + flow_of(b, f).along(sliding_along(b)));
    const bool cut = is_cut(f);
    if (!cut || !has_line_row(a)) dr[a] += q;
    if (!cut || !has_line_row(b)) dr[b] -= q;
  }
}

void FlowBalance::balance_along(const MotionDirection& direction, Eigen::VectorXd& dr) const {
  const int n = size();
  const bool gap = direction.g.size() != 0;
  HERSEY_REQUIRE(!gap || direction.g.size() == n, "direction of shape (grid.size()) or empty");
  HERSEY_REQUIRE(direction.g_rate.size() == 0 || direction.g_rate.size() == n,
                 "direction of shape (grid.size()) or empty");
  dr.setZero(n);
  find_changes_by_surfaces();
  add_storage_along(direction, dr);
  const bool slides =
      direction.u_shell != 0 || direction.u_journal != 0 || direction.w_shell != 0 || direction.w_journal != 0;
  direction_sliding_.assign(static_cast<std::size_t>(model_.grid.n_z), {});
  for (int j = 0; slides && j < model_.grid.n_z; ++j)
    direction_sliding_[static_cast<std::size_t>(j)] = change_of_sliding(direction, j);
  const bool rotates = direction.phi_journal != 0 && relief_.has_pockets();
  if (gap || slides || rotates) {
    add_flows_along(by_surfaces_.around, model_.grid.n_z, direction, around_speeds(direction), dr);
    add_flows_along(by_surfaces_.axial, 1, direction, axial_speeds(direction), dr);
  }
  if (slides && has_sliding_viscosity()) add_sliding_along(dr);
  for (const int node : leaking_edge_nodes_) {
    const SealFlow leaks = seal_flow(node);
    const SlidingChange& sliding = sliding_along(node);
    dr[node] += leaks.rate * sliding.rate + leaks.rotation * sliding.rotation;
    if (gap) dr[node] += leaks.g * direction.g[node];
  }
  if (direction.w_journal != 0) bring_layers_along(direction.w_journal, dr);
}

}  // namespace hersey::film
