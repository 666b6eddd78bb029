#pragma once

#include <vector>

#include "gap/grid_geometry.h"
#include "hersey/film/film_model.h"

namespace hersey::film {

/// Fraction of a node that a feature covers, and its derivative by phi_journal [-, 1/rad].
struct CoveredNode {
  int node = 0;
  double fraction = 0;
  double fraction_journal = 0;
  double centrality = 0;  ///< one less the distance from the middle over the half size [-]; below 0 outside
  double mixed_fraction =
      0;             ///< fraction of the oil passing the node's control volume that passes the feature in it [-]
  double draws = 0;  ///< fraction of the missing oil that the feature supplies [-], and its derivative
  double draws_journal = 0;
};

/// Fraction of a cell's length within which two positions count as the same.
inline constexpr double same_position = 1e-12;

/// Returns the feature without its border, which belongs to the land, also where round-off has moved the border or a
/// node on it. A feature that reaches an edge of the bearing is extended beyond it.
[[nodiscard]] SurfaceFeature without_border(SurfaceFeature feature, const FilmModel& model,
                                            const GridGeometry& geometry);

/// Returns the conductance of a mean cell to its four neighbours per h^3/(12 mu), to which the fractions refer [-].
[[nodiscard]] double unit_conductance(const GridGeometry& geometry);

/// Appends the nodes in whose rows a feature has a part (film.22), with the journal rotated by `phi_journal` [rad].
void cover(const FilmModel& model, const GridGeometry& geometry, const SurfaceFeature& feature, double phi_journal,
           std::vector<CoveredNode>& nodes);

/// Appends the nodes whose control volumes a feature covers in part or wholly.
void cover_cells(const FilmModel& model, const GridGeometry& geometry, const SurfaceFeature& feature,
                 double phi_journal, std::vector<CoveredNode>& nodes);

}  // namespace hersey::film
