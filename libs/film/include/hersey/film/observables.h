#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"
#include "hersey/film/film_observables.h"
#include "hersey/film/film_response.h"

namespace hersey::film {

/// Returns the fields at the nodes for the unknown u.
/// @param viscosity  with which the film was solved; its Reynolds numbers depend on it, nothing else
[[nodiscard]] FilmFields film_fields(const FilmModel& model, const SurfaceMotion& motion, const Eigen::VectorXd& u,
                                     const LayeredViscosity& viscosity = {});

/// Returns the mean depth of features over the control volumes [m], shape (grid.size()), with the journal rotated by
/// `phi_journal` [rad].
[[nodiscard]] Eigen::VectorXd mean_depth(const FilmModel& model, double phi_journal);

/// Returns what a film at `u` shows. The journal's axis, about which its torque is taken, pierces z = 0 at `e` [m] in
/// the grid's frame with the slope `tilt` [-].
[[nodiscard]] FilmObservables observe_film(const FilmModel& model, const SurfaceMotion& motion,
                                           const FilmHistory& history, const Eigen::Vector2d& e,
                                           const Eigen::VectorXd& u,
                                           const Eigen::Vector2d& tilt = Eigen::Vector2d::Zero());

/// Returns what surfaces at these speeds carry in a gap as wide as the clearance `c` [m], around the bearing or along
/// its axis: the scale of flows where a film's own vanish, as without oil [m^3/s].
[[nodiscard]] double sliding_flow(const FilmModel& model, const SurfaceMotion& motion, double c);

/// Returns the oil of a film at `u` with which a run starts: no step has led there, so that flows are undefined.
[[nodiscard]] StepOilBalance oil_at_start(const FilmModel& model, const SurfaceMotion& motion,
                                          const FilmHistory& history, const Eigen::VectorXd& u);

}  // namespace hersey::film
