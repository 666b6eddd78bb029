#pragma once

#include <limits>
#include <string>
#include <vector>

#include "hersey/fem/film_surface.h"
#include "hersey/fem/load_shapes.h"

namespace hersey::fem {

struct ReductionOptions {
  int modes = 20;  ///< number of fixed-interface modes, and those with the last one's frequency
  double highest = std::numeric_limits<double>::infinity();  ///< highest angular frequency of these modes [rad/s]
  /// Nodal forces (3 n, loads) whose static displacement the reduced body represents exactly: each adds one mode.
  Eigen::MatrixXd loads;
  std::vector<LoadedSurface> surfaces;
  /// Largest admissible error of the static displacement of a surface under each of its pressures, all frames at rest,
  /// over the largest of these displacements: static shapes are added until it is met. Infinity: the error is computed
  /// only.
  double static_error = std::numeric_limits<double>::infinity();
  std::vector<FilmSurface> film_surfaces;  ///< surfaces under oil films: their film modes are added
  std::vector<std::vector<ElementFace>>
      contact_faces;             ///< faces that touch other bodies: their contact_modes are added
  int film_modes = 60;           ///< largest number of film modes of each surface that gives none itself
  double film_tolerance = 1e-6;  ///< smallest compliance of a film mode, over the largest
};

/// Error of a reduced body's static displacement of a surface, all frames at rest, (elastic.16).
struct StaticError {
  std::string surface;
  int shapes = 0;      ///< number of pressures
  double modes = 0;    ///< largest error of the fixed-interface modes alone, over the largest displacement
  double reduced = 0;  ///< error of the reduced body
};

}  // namespace hersey::fem
