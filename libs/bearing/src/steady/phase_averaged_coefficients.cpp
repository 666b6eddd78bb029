#include "hersey/bearing/phase_averaged_coefficients.h"

#include "hersey/film/grid_transfer.h"
#include "steady/steady_search.h"

namespace hersey::bearing {
namespace {

// Places of the lines within a cell over which the mean is taken: an error that is a wave along the cell leaves its
// fourth harmonic only, and mirrored bearings have mirrored grids.
constexpr int kPlaces = 4;

Eigen::VectorXd taken_over(const film::GridTransfer& transfer, const Eigen::VectorXd& field) {
  return field.size() > 0 ? transfer(field) : field;
}

film::LayeredViscosity taken_over(const film::GridTransfer& transfer, const film::LayeredViscosity& viscosity) {
  return {taken_over(transfer, viscosity.fluidity), taken_over(transfer, viscosity.shear_fluidity),
          taken_over(transfer, viscosity.skew), taken_over(transfer, viscosity.at_rest),
          taken_over(transfer, viscosity.axial_fluidity)};
}

}  // namespace

std::vector<TurnedFilm> turned_films(const film::FilmModel& model, const SteadyState& state,
                                     const SteadyOptions& options) {
  std::vector<TurnedFilm> films;
  if (!film::closes(model.surface)) return films;
  OperatingPoint fixed = state.point;
  fixed.load.reset();
  fixed.e = state.e;
  for (int place = 1; place < kPlaces; ++place) {
    TurnedFilm film{model, {}};
    film.model.grid = film::turned(model.grid, static_cast<double>(place) / kPlaces);
    const film::GridTransfer transfer = film::GridTransfer::by_position(model.grid, film.model.grid);
    SteadySearch search(film.model, fixed, options);
    search.set_viscosity(taken_over(transfer, state.viscosity));
    search.set_shapes(state.shapes.changed_by(transfer));
    search.begin_at(state.e, transfer(state.u), state.s);
    if (!search.at_given_position().solved()) continue;
    film.state = search.state();
    films.push_back(std::move(film));
  }
  return films;
}

DynamicCoefficients phase_averaged_coefficients(const SteadyState& state, const std::vector<TurnedFilm>& turned) {
  DynamicCoefficients mean = state.coefficients;
  for (const TurnedFilm& film : turned) {
    mean.stiffness += film.state.coefficients.stiffness;
    mean.damping += film.state.coefficients.damping;
  }
  const double count = 1 + static_cast<double>(turned.size());
  mean.stiffness /= count, mean.damping /= count;
  return mean;
}

}  // namespace hersey::bearing
