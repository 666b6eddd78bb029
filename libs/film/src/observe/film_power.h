#pragma once

#include "balance/flow_balance.h"
#include "hersey/film/film_observables.h"
#include "observe/film_wrench.h"

namespace hersey::film {

/// Adds the terms of the power that the bodies put into a film, by integrals over its fields (theory manual, film.53,
/// film.54). They are independent of the film's wrench, whose power has to equal their sum.
/// @param wrench  evaluated; its relief and boundary friction are used.
void add_powers(const FlowBalance& balance, const SurfaceMotion& motion, const FilmWrench& wrench, FilmObservables& o);

/// Returns the excess of the film's power across each line of nodes over the sum over their volumes [W]: the terms of
/// higher order in integrals across the width.
[[nodiscard]] Eigen::VectorXd power_beyond_volumes(const FlowBalance& balance, const SurfaceMotion& motion,
                                                   const FilmWrench& wrench);

/// Returns the viscous dissipation by sliding, per area at a node [W/m^2].
[[nodiscard]] double sliding_power(const FlowBalance& balance, const FilmWrench& wrench, const SurfaceMotion& motion,
                                   int node);

/// Returns the viscous dissipation by flow along pressure over a face [W].
[[nodiscard]] double pressure_power(const FlowBalance& balance, std::size_t f);

}  // namespace hersey::film
