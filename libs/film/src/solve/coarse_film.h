#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// A film on a grid of half as many nodes in each direction (theory manual, film.34).
struct CoarseFilm {
  FilmModel model;
  SurfaceMotion motion;
  FilmHistory history;
  Eigen::VectorXd u;
};

[[nodiscard]] CoarseFilm coarsened(const FilmModel& model, const SurfaceMotion& motion, const FilmHistory& history,
                                   const Eigen::VectorXd& u);

/// Returns the unknowns of `model` from those of the coarse film: pressures and fill fractions are kept.
[[nodiscard]] Eigen::VectorXd refined(const CoarseFilm& coarse, const FilmModel& model);

}  // namespace hersey::film
