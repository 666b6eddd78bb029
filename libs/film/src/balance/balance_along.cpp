#include "balance/flow_balance.h"
#include "hersey/core/contract.h"

// Changes of the balances along changes of the surfaces (film.39).
namespace hersey::film {

// Directions are many and share these factors.
void FlowBalance::find_changes_by_surfaces() const {
  BySurfaces& by = by_surfaces_;
  if (by.is_found) return;
  for (auto* field : {&by.storage_g, &by.storage_excess, &by.storage_rate, &by.storage_excess_rate})
    field->resize(size());
  for (int i = 0; i < size(); ++i) {
    by.storage_g[i] = storage_g(i), by.storage_excess[i] = storage_excess(i);
    by.storage_rate[i] = storage_g_rate(i), by.storage_excess_rate[i] = storage_excess_rate(i);
  }
  by.flows.resize(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    const FaceFlow& flow = flows_[f];
    const bool cut = is_cut(f);
    by.flows[f] = {.a = face.a,
                   .b = face.b,
                   .from = flow.couette >= 0 ? face.a : face.b,
                   .leaves_a = !cut || !has_line_row(face.a),
                   .enters_b = !cut || !has_line_row(face.b),
                   .g_a = flow.q_h_a * nodes_[face.a].h_g,
                   .g_b = flow.q_h_b * nodes_[face.b].h_g,
                   .bend = axial(f) ? 0 : flow.q_bend,
                   .excess = flow.q_excess,
                   .journal = flow.q_journal};
  }
  by.is_found = true;
}

void FlowBalance::add_storage_along(const MotionDirection& direction, Eigen::VectorXd& dr) const {
  if (direction.g.size() != 0) {
    interpolation_.bends(direction.g, direction_bends_);
    interpolation_.excesses(direction.g, direction_excesses_);
    dr += by_surfaces_.storage_g.cwiseProduct(direction.g) +
          by_surfaces_.storage_excess.cwiseProduct(direction_excesses_);
  }
  if (direction.g_rate.size() != 0) {
    interpolation_.excesses(direction.g_rate, direction_rate_excesses_);
    dr += by_surfaces_.storage_rate.cwiseProduct(direction.g_rate) +
          by_surfaces_.storage_excess_rate.cwiseProduct(direction_rate_excesses_);
  }
  if (relief_.has_pockets()) add_turning_pockets(direction, dr);
}

void FlowBalance::add_flows_along(const MotionDirection& direction, bool slides, Eigen::VectorXd& dr) const {
  const bool gap = direction.g.size() != 0;
  const double rotation = direction.phi_journal;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const FlowBySurfaces& by = by_surfaces_.flows[f];
    double q = by.journal * rotation;
    if (gap) {
      q += by.g_a * direction.g[by.a] + by.g_b * direction.g[by.b] + by.excess * direction_excesses_[by.from];
      if (by.bend != 0) q += by.bend * direction_bends_[static_cast<Eigen::Index>(f)];
    }
    if (slides) q += flow_along_speeds(f, direction);
    if (by.leaves_a) dr[by.a] += q;
    if (by.enters_b) dr[by.b] -= q;
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
  if (gap || slides || rotates) add_flows_along(direction, slides, dr);
  for (const int node : leaking_edge_nodes_) {
    const SealFlow leaks = seal_flow(node);
    const SlidingChange& sliding = sliding_along(node);
    dr[node] += leaks.rate * sliding.rate + leaks.rotation * sliding.rotation;
    if (gap) dr[node] += leaks.g * direction.g[node];
  }
  if (direction.w_journal != 0) bring_layers_along(direction.w_journal, dr);
}

}  // namespace hersey::film
