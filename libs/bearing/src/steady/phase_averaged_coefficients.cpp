#include "hersey/bearing/phase_averaged_coefficients.h"

#include <algorithm>

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

// Residual to which a film on another grid is solved. Its coefficients err by some times this; with edges in oil under
// pressure, whose flow is the scale of the residual, by some thousand times.
constexpr double kOnOtherGrids = 1e-9;

// Calls take(model, search) for each grid, with a search that begins at the film of `state`.
template <class Take>
void for_turned_films(const film::FilmModel& model, const SteadyState& state, const SteadyOptions& options,
                      const Take& take) {
  if (!film::closes(model.surface)) return;
  OperatingPoint fixed = state.point;
  fixed.load.reset();
  fixed.e = state.e;
  film::FilmModel turned = model;
  for (int place = 1; place < kPlaces; ++place) {
    turned.grid = film::turned(model.grid, static_cast<double>(place) / kPlaces);
    const film::GridTransfer transfer = film::GridTransfer::by_position(model.grid, turned.grid);
    SteadySearch search(turned, fixed, options);
    search.set_tolerance(std::max(options.rtol, kOnOtherGrids));
    search.set_viscosity(taken_over(transfer, state.viscosity));
    search.set_shapes(state.shapes.changed_by(transfer));
    search.begin_at(state.e, transfer(state.u), state.s);
    take(turned, search);
  }
}

DynamicCoefficients mean_of(DynamicCoefficients sum, int count) {
  sum.stiffness /= count, sum.damping /= count;
  return sum;
}

void add(const DynamicCoefficients& more, DynamicCoefficients& sum) {
  sum.stiffness += more.stiffness;
  sum.damping += more.damping;
}

}  // namespace

std::vector<TurnedFilm> turned_films(const film::FilmModel& model, const SteadyState& state,
                                     const SteadyOptions& options) {
  std::vector<TurnedFilm> films;
  for_turned_films(model, state, options, [&](const film::FilmModel& turned, SteadySearch& search) {
    if (search.at_given_position().solved()) films.push_back({turned, search.state()});
  });
  return films;
}

DynamicCoefficients phase_averaged_coefficients(const SteadyState& state, const std::vector<TurnedFilm>& turned) {
  DynamicCoefficients sum = state.coefficients;
  for (const TurnedFilm& film : turned) add(film.state.coefficients, sum);
  return mean_of(sum, 1 + static_cast<int>(turned.size()));
}

DynamicCoefficients phase_averaged_coefficients(const film::FilmModel& model, const SteadyState& state,
                                                const SteadyOptions& options) {
  DynamicCoefficients sum = state.coefficients;
  int count = 1;
  for_turned_films(model, state, options, [&](const film::FilmModel&, SteadySearch& search) {
    if (!search.prepare_coefficients()) return;
    add(search.coefficients(), sum);
    ++count;
  });
  return mean_of(sum, count);
}

}  // namespace hersey::bearing
