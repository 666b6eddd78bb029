#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// Newton steps that go round and round have groups of nodes break and fill again together, where part of them should.
/// Of the nodes that go from full to cavitated or back between `before` and `u`, about half stay at the border between
/// both, on their side; another half for each `turn`. For `mass_conserving`; a solution stays as it is.
void limit_active_set_changes(const FilmModel& model, const Eigen::VectorXd& before, int turn, Eigen::VectorXd& u);

}  // namespace hersey::film
