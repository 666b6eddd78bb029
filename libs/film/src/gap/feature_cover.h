#pragma once

#include <vector>

#include "gap/grid_geometry.h"
#include "hersey/film/film_model.h"

namespace hersey::film {

/// A share of a node that a feature has, and its derivative with phi_journal [-, 1/rad].
struct CoveredNode {
  int node = 0;
  double share = 0;
  double share_phi = 0;
  double inwards = 0;      ///< how near to the feature's middle, 1, from its border, 0 [-]; below 0 outside
  double mixed_share = 0;  ///< share of the oil passing the node's control volume that passes the feature in it [-]
  double draws = 0;        ///< of the oil that is missing there, what the feature gives [-], and its derivative
  double draws_phi = 0;
};

/// Of a cell: places that lie nearer to each other are the same.
inline constexpr double same_position = 1e-12;

/// The feature without its border, which belongs to the land, also where round-off has moved it or a node on it. One
/// that reaches an edge of the bearing goes on there.
[[nodiscard]] SurfaceFeature without_border(SurfaceFeature feature, const FilmModel& model,
                                            const GridGeometry& geometry);

/// Conductance of a mean cell to its four neighbours, per h^3/(12 mu): what shares refer to [-].
[[nodiscard]] double unit_conductance(const GridGeometry& geometry);

/// Appends the nodes of whose rows a feature holds a share (film.22), with the journal turned by `phi_journal`
/// [rad].
void cover(const FilmModel& model, const GridGeometry& geometry, const SurfaceFeature& feature, double phi_journal,
           std::vector<CoveredNode>& nodes);

/// Appends the nodes of whose control volumes a feature covers a share.
void cover_cells(const FilmModel& model, const GridGeometry& geometry, const SurfaceFeature& feature,
                 double phi_journal, std::vector<CoveredNode>& nodes);

}  // namespace hersey::film
