#pragma once

#include <Eigen/Dense>

#include "balance/flow_balance.h"

namespace hersey::film {

/// A Newton step takes every full node to pass on a full gap. Where the step has emptied one, all those downstream that
/// live on its oil would follow only one per iteration: they are emptied here in one sweep with the flow (film.33).
/// Nodes whose neighbours hold them full stay as they are, and so does a solution. For `mass_conserving`.
void advance_rupture_front(const FlowBalance& balance, Eigen::VectorXd& u);

}  // namespace hersey::film
