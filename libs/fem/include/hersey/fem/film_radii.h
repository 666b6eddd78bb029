#pragma once

#include <Eigen/Dense>

#include "hersey/fem/film_surface.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Where the nodes of a film's surface put it: its radius less the cylinder's, over angle and width. Between nodes it
/// is taken as the elements take displacements, so that flat faces between nodes on a circle count as round.
struct SurfaceRadii {
  static constexpr int around = 144, along = 24;  ///< fields of the raster

  Eigen::MatrixXd deviation;  ///< in each field the smallest of a bore, the largest of a journal, (around, along) [m]
  double mean = 0;            ///< over the area [m]
  double width = 0;           ///< of the film [m]

  /// The field that holds a place of the film; z beyond the width belongs to its edge.
  [[nodiscard]] double at(double phi, double z) const;
  [[nodiscard]] static double phi_of(int i);  ///< in the middle of a field, 0..2 pi
};

/// @verified_by film_radii_test.cpp
[[nodiscard]] SurfaceRadii surface_radii(const Mesh& mesh, const FilmSurface& surface);

}  // namespace hersey::fem
