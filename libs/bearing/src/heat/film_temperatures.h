#pragma once

#include <Eigen/Dense>

#include "hersey/film/film_heat.h"

namespace hersey::bearing {

/// Returns the temperatures of a film on which its pressure depends, as unknowns of the alternate solution of film and
/// heat (thermal.16): rises of the layers over the supply's, how far the layers thin by shear as if it were one [K],
/// and rises of the oil that ends of patches draw in.
[[nodiscard]] Eigen::VectorXd film_temperatures(const film::FilmHeat& heat);

/// Number of the first of these that stand for layers, and of the next that stand for shear.
[[nodiscard]] Eigen::Index layer_temperatures(const film::FilmHeat& heat);
[[nodiscard]] Eigen::Index shear_temperatures(const film::FilmHeat& heat);

/// Sets the state of a film's heat to `x`, no layer colder or hotter than trials may be.
void set_film_temperatures(const Eigen::VectorXd& x, film::FilmHeat& heat);

}  // namespace hersey::bearing
