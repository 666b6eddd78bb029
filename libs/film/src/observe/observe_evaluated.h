#pragma once

#include <Eigen/Dense>

#include "balance/flow_balance.h"
#include "hersey/film/film_observables.h"
#include "observe/film_wrench.h"

namespace hersey::film {

/// Returns observe_film() of a film whose `balance` and `wrench` have been evaluated at `motion` and `u` already.
[[nodiscard]] FilmObservables observe_evaluated(const FlowBalance& balance, const FilmWrench& wrench,
                                                const SurfaceMotion& motion, const Eigen::Vector2d& e,
                                                const Eigen::VectorXd& u, const Eigen::Vector2d& tilt);

/// Returns film_fields() of a film whose `balance` has been evaluated already.
[[nodiscard]] FilmFields fields_of(const FlowBalance& balance);

/// The model whose friction is observed: torques of shear are shown where they do not act, too.
[[nodiscard]] FilmModel with_torque(FilmModel model);

}  // namespace hersey::film
