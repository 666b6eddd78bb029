#include "hersey/bearing/film_coordinates.h"

namespace hersey::bearing {

FilmCoordinate coordinate_along(const film::FilmModel& model) {
  const film::Grid& grid = model.grid;
  const bool is_round = film::is_round(model.surface);
  FilmCoordinate along = is_round ? FilmCoordinate{"phi", "rad", "bearing angle", {}}
                                  : FilmCoordinate{"y", "m", "position along the sliding direction", {}};
  along.values.resize(grid.n_phi);
  for (int i = 0; i < grid.n_phi; ++i) along.values[i] = (is_round ? 1 : model.R) * grid.phi(i);
  return along;
}

FilmCoordinate coordinate_across(const film::FilmModel& model) {
  const film::Grid& grid = model.grid;
  const bool is_annulus = is_on_annulus(model);
  FilmCoordinate across{is_annulus ? "r" : "z",
                        "m",
                        is_annulus                      ? "radius"
                        : film::is_round(model.surface) ? "place along the axis"
                                                        : "position across the sliding direction",
                        {}};
  across.values.resize(grid.n_z);
  for (int j = 0; j < grid.n_z; ++j) across.values[j] = (is_annulus ? model.R : 0) + model.L * grid.z_over_L(j);
  return across;
}

}  // namespace hersey::bearing
