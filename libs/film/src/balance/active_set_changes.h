#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Anti-cycling of Newton's method: groups of nodes may cavitate and fill again together for ever, where only a part of
/// them should. Of the nodes that change between full and cavitated from `before` to `u`, about half are kept at the
/// border between both, on the side of their old state; the half alternates with `iteration`. A solution is left as it
/// is. Only for `mass_conserving`.
void limit_active_set_changes(const FilmModel& model, const Eigen::VectorXd& before, int iteration, Eigen::VectorXd& u);

}  // namespace hersey::film
