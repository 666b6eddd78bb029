#pragma once

#include <vector>

#include "hersey/bearing/steady_bearing.h"

namespace hersey::bearing {

/// A film on a grid whose lines lie elsewhere.
struct TurnedFilm {
  film::FilmModel model;
  SteadyState state;
};

/// The film of `state` at the same position of the journal on grids whose lines lie further on by a quarter, half and
/// three quarters of a cell, temperatures as they are; those of them that are found.
/// @param model, options  with which `state` was solved
[[nodiscard]] std::vector<TurnedFilm> turned_films(const film::FilmModel& model, const SteadyState& state,
                                                   const SteadyOptions& options);

/// Stiffness and damping of a solved film, their mean over where the lines of its grid may lie (theory manual,
/// bearing.38). Those of one grid jump as the borders of the cavity pass its lines, by an error of first order; of the
/// mean it is of second. Choose those of `SteadyState` where the tangent of just this film is wanted.
[[nodiscard]] DynamicCoefficients phase_averaged_coefficients(const SteadyState& state,
                                                              const std::vector<TurnedFilm>& turned);

/// Does the same without keeping the films on the other grids.
/// @param model, options  with which `state` was solved
[[nodiscard]] DynamicCoefficients phase_averaged_coefficients(const film::FilmModel& model, const SteadyState& state,
                                                              const SteadyOptions& options);

}  // namespace hersey::bearing
