#pragma once

#include <Eigen/Dense>

#include "gap/grid_geometry.h"
#include "hersey/film/film_model.h"

namespace hersey::film {

/// Smallest thickness of a film and its position [m, rad, m].
struct Thinnest {
  double value = 0, phi = 0, z = 0;
  double in_the_middle = 0;  ///< smallest along z = 0 [m]
  double in_features = 0;    ///< smallest thickness over features with depth, depth included [m]; NaN without any
};

/// Returns the smallest thickness at all nodes outside features with depth, with each row interpolated around the
/// bearing between nodes that lie outside, and on those features' borders (theory manual, film.30).
/// @param patch  of the grid to look at; -1: all
[[nodiscard]] Thinnest thinnest_film(const FilmModel& model, const GridGeometry& at, const Eigen::VectorXd& h,
                                     double phi_journal, int patch = -1);

}  // namespace hersey::film
