#pragma once

#include <string>
#include <vector>

#include "hersey/fem/film_cylinder.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Coverage of a film by faces, evaluated at points distributed evenly over the film.
struct FilmCover {
  double missing = 0;                 ///< share of its area that lies on none
  double phi_from = 0, phi_over = 0;  ///< the missing part begins here and goes on over this angle [rad]
  double z_low = 0, z_high = 0;       ///< [m]

  /// "a surface that covers 80 % of the film: nothing at ..."
  [[nodiscard]] std::string text() const;
};

[[nodiscard]] FilmCover film_cover(const Mesh& mesh, const std::vector<ElementFace>& faces,
                                   const FilmCylinder& cylinder, int parts);

}  // namespace hersey::fem
