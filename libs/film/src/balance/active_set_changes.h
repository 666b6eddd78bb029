#pragma once

#include <Eigen/Dense>

#include "balance/flow_balance.h"
#include "hersey/film/film_model.h"

namespace hersey::film {

/// Anti-cycling of Newton's method: groups of nodes may cavitate and fill again together for ever, where only a part of
/// them should. Of the nodes that change between full and cavitated from `before` to `u`, about half are kept at the
/// border between both, on the side of their old state; the half alternates with `iteration`. A solution is left as it
/// is. Only for `mass_conserving`.
void limit_active_set_changes(const FilmModel& model, const Eigen::VectorXd& before, int iteration, Eigen::VectorXd& u);

/// In `reynolds` D0 u is the oil that a cavitated node lacks. Where a step `du` from `u`, the state of the last
/// evaluation, finds more than enough, the node is full in the next, and its u the pressure that presses the excess
/// out: over conductances that are many thousand times D0 in a deep pocket. By D0, laws of viscosity would see
/// pressures that are none, and Newton's method would cycle. Where all laws are constant the next step does not depend
/// on it.
void press_filled_nodes(const FlowBalance& balance, const Eigen::VectorXd& u, Eigen::VectorXd& du);

}  // namespace hersey::film
