#pragma once

#include "interpret/bearings/kinds/film_reader.h"

namespace hersey::model {

/// Reads `bore` or `arcs` of a journal bearing, once size, clearance, cavitation and supply are known: the profile of
/// the arcs and the ends of their films. A bearing with neither keeps its whole bore.
void read_arcs(Context& context, const Value& value, Bearing& bearing, FilmReader& reader);

/// Reports features that do not lie within one arc, and what a film of several arcs cannot have.
void check_with_arcs(Context& context, const Value& value, const Bearing& bearing);

}  // namespace hersey::model
