#include "balance/active_set_changes.h"

#include <cstdint>

#include "hersey/core/contract.h"

namespace hersey::film {
namespace {

/// Heads or tails, the same on every machine: the finaliser of Murmur3 (Appleby 2011, public domain).
bool is_heads(std::uint32_t node, std::uint32_t iteration) {
  std::uint32_t x = node * 0x9e3779b9U + iteration * 0x85ebca77U;
  x = (x ^ (x >> 16)) * 0x85ebca6bU;
  x = (x ^ (x >> 13)) * 0xc2b2ae35U;
  return ((x ^ (x >> 16)) & 1U) != 0;
}

}  // namespace

void limit_active_set_changes(const FilmModel& model, const Eigen::VectorXd& before, int iteration,
                              Eigen::VectorXd& u) {
  HERSEY_REQUIRE(before.size() == u.size(), "two states of one film");
  if (!cavitation_law(model).has_fill()) return;
  constexpr double all_but_full = 1e-9;  // on its side of the border, however round-off falls
  for (Eigen::Index node = 0; node < u.size(); ++node) {
    const bool was_cavitated = before[node] < 0;
    if (was_cavitated == (u[node] < 0)) continue;
    if (is_heads(static_cast<std::uint32_t>(node), static_cast<std::uint32_t>(iteration)))
      u[node] = was_cavitated ? -all_but_full * fill_scale(model) : 0;
  }
}

void press_filled_nodes(const FlowBalance& balance, const Eigen::VectorXd& u, Eigen::VectorXd& du) {
  HERSEY_REQUIRE(u.size() == du.size(), "a state of a film and a step from it");
  if (!cavitation_law(balance.model()).loses_oil()) return;
  for (int node = 0; node < balance.size(); ++node) {
    const double after = u[node] + du[node];
    if (u[node] >= 0 || after <= 0) continue;
    double conductance = balance.conductance_scale();
    for (const int f : balance.faces_around(node))
      if (f >= 0) conductance += balance.flows()[static_cast<std::size_t>(f)].K;
    du[node] = balance.conductance_scale() / conductance * after - u[node];
  }
}

}  // namespace hersey::film
