#pragma once

#include <limits>
#include <string>
#include <vector>

#include "hersey/fem/film_surface.h"
#include "hersey/fem/load_shapes.h"

namespace hersey::fem {

struct ReductionOptions {
  int modes = 20;                                            ///< fixed-interface modes at most
  double highest = std::numeric_limits<double>::infinity();  ///< up to this angular frequency [rad/s]
  /// Nodal forces (3 n, loads) whose static displacement the reduced body shall have exactly: one mode more for each.
  Eigen::MatrixXd loads;
  std::vector<LoadedSurface> surfaces;
  /// Largest error of the static displacement of a surface under each of its pressures, all frames at rest, over the
  /// largest of these displacements: static shapes are added until it holds. Infinity: the error is told alone.
  double static_error = std::numeric_limits<double>::infinity();
  std::vector<FilmSurface> film_surfaces;               ///< that oil films press on: their film modes are added
  std::vector<std::vector<ElementFace>> contact_faces;  ///< that touch other bodies: likewise, with contact_modes
  int film_modes = 60;                                  ///< of each of them at most that does not say so itself
  double film_tolerance = 1e-6;                         ///< smallest compliance of a film mode, over the largest
};

/// How well a reduced body meets the static displacement of a surface, all frames at rest, (elastic.16).
struct StaticError {
  std::string surface;
  int shapes = 0;      ///< pressures looked at
  double modes = 0;    ///< largest error of the fixed-interface modes alone, over the largest displacement
  double reduced = 0;  ///< of the reduced body
};

}  // namespace hersey::fem
