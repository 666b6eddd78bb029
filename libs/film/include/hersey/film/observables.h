#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"
#include "hersey/film/film_observables.h"

namespace hersey::film {

/// Fields at the nodes from the unknown u.
[[nodiscard]] FilmFields film_fields(const FilmModel& model, const SurfaceMotion& motion, const Eigen::VectorXd& u);

/// Mean depth of features over the control volumes [m], shape (grid.size()), with the journal turned by `phi_journal`
/// [rad].
[[nodiscard]] Eigen::VectorXd mean_depth(const FilmModel& model, double phi_journal);

/// The journal's axis, about which its torque is taken, pierces z = 0 at `e` [m] in the grid's frame with the slope
/// `tilt` [-].
[[nodiscard]] FilmObservables observe_film(const FilmModel& model, const SurfaceMotion& motion,
                                           const FilmHistory& history, const Eigen::Vector2d& e,
                                           const Eigen::VectorXd& u,
                                           const Eigen::Vector2d& tilt = Eigen::Vector2d::Zero());

}  // namespace hersey::film
