#pragma once

#include <vector>

#include "grid_geometry.h"
#include "hersey/film/film_model.h"

namespace hersey::film {

/// The part of a node's row that a feature holds (film.25): share of the given pressure and its derivative with
/// phi_journal [-, 1/rad].
struct CoveredNode {
  int node = 0;
  double share = 0;
  double share_phi = 0;
};

/// Conductance of a mean cell to its four neighbours, per h^3/(12 mu): what shares refer to [-].
[[nodiscard]] double unit_conductance(const GridGeometry& geometry);

/// Appends the nodes a feature holds wholly or in part, with the journal turned by `phi_journal` [rad].
void cover(const FilmModel& model, const GridGeometry& geometry, const SurfaceFeature& feature, double phi_journal,
           std::vector<CoveredNode>& nodes);

}  // namespace hersey::film
