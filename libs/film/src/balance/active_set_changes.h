#pragma once

#include <Eigen/Dense>

#include "balance/flow_balance.h"

namespace hersey::film {

/// In `reynolds` D0 u is the oil that a cavitated node lacks. Where a step `du` from `u`, the state of the last
/// evaluation, finds more than enough, the node is full in the next, and its u the pressure that presses the excess
/// out: over conductances that are many thousand times D0 in a deep pocket. By D0, laws of viscosity would see
/// pressures that are none, and Newton's method would cycle. Where all laws are constant the next step does not depend
/// on it.
void press_filled_nodes(const FlowBalance& balance, const Eigen::VectorXd& u, Eigen::VectorXd& du);

}  // namespace hersey::film
