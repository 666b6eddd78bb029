#pragma once

#include <Eigen/Dense>

#include "gap/grid_geometry.h"
#include "hersey/film/film_model.h"

namespace hersey::film {

/// Smallest thickness of a film and where it is [m, rad, m].
struct Thinnest {
  double value = 0, phi = 0, z = 0;
  double in_the_middle = 0;  ///< smallest along z = 0 [m]
  double in_features = 0;    ///< over features with depth, that included [m]; NaN without any
};

/// The smallest of all nodes outside features with depth, each row interpolated around the bearing between nodes that
/// lie outside, and of those features' borders (theory manual, film.30).
[[nodiscard]] Thinnest thinnest_film(const FilmModel& model, const GridGeometry& at, const Eigen::VectorXd& h,
                                     double phi_journal);

}  // namespace hersey::film
