#pragma once

#include <vector>

#include "hersey/film/film_model.h"

namespace hersey::film {

/// The part of a node's row that a feature holds (film.25): share of the given pressure and its derivative with
/// phi_journal [-, 1/rad].
struct CoveredNode {
  int node = 0;
  double share = 0;
  double share_phi = 0;
};

/// Conductance between two neighbours over both directions, per h^3/(12 mu): what shares refer to [-].
[[nodiscard]] double unit_conductance(const FilmModel& model);

/// Appends the nodes a feature holds wholly or in part, with the journal turned by `phi_journal` [rad].
void cover(const FilmModel& model, const SurfaceFeature& feature, double phi_journal, std::vector<CoveredNode>& nodes);

}  // namespace hersey::film
