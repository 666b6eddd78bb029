#include "balance/flow_balance.h"
#include "hersey/core/contract.h"
#include "hersey/film/active_set.h"

namespace hersey::film {

void ActiveSet::press_filled_nodes(const Eigen::VectorXd& u, Eigen::VectorXd& du) const {
  const FlowBalance& balance = *balance_;
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
