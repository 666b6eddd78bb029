#pragma once

#include "balance/flow_balance.h"
#include "hersey/film/film_observables.h"
#include "observe/film_wrench.h"

namespace hersey::film {

/// Adds where the power that the bodies put into a film goes, by integrals over its fields (theory manual, film.53,
/// film.54). They know nothing of the film's wrench, whose power has to be their sum.
/// @param wrench  evaluated: what it knows of relief and boundary friction.
void add_powers(const FlowBalance& balance, const SurfaceMotion& motion, const FilmWrench& wrench, FilmObservables& o);

/// By what the film's power across each line of nodes exceeds the sum over their volumes [W]: what integrals across the
/// width have that are of higher order.
[[nodiscard]] Eigen::VectorXd power_beyond_volumes(const FlowBalance& balance, const SurfaceMotion& motion,
                                                   const FilmWrench& wrench);

/// Viscous dissipation by sliding, per area at a node [W/m^2].
[[nodiscard]] double sliding_power(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion,
                                   int node);

/// Viscous dissipation by flow along pressure over a face [W].
[[nodiscard]] double pressure_power(const FlowBalance& balance, std::size_t f);

}  // namespace hersey::film
