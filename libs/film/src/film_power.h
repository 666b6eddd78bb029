#pragma once

#include "flow_balance.h"
#include "hersey/film/observables.h"

namespace hersey::film {

/// Adds where the power that the bodies put into a film goes, by integrals over its fields (theory manual, film.21,
/// film.67). They know nothing of the film's wrench, whose power has to be their sum.
/// @param friction  boundary friction's power per contact pressure and area [m/s].
void add_powers(const FlowBalance& balance, const SurfaceMotion& motion, double friction, FilmObservables& o);

}  // namespace hersey::film
