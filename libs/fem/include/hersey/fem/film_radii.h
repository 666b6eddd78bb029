#pragma once

#include <Eigen/Dense>

#include "hersey/fem/film_surface.h"
#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Radius of a film's surface less that of the cylinder, over angle and width, as the mesh's nodes give it. Between
/// nodes the deviation is interpolated as the elements interpolate displacements, so that flat faces between nodes on a
/// circle count as round.
struct SurfaceRadii {
  static constexpr int around = 144, along = 24;  ///< fields of the raster

  Eigen::MatrixXd
      deviation;     ///< smallest radius deviation in each field of a bore, largest of a journal, (around, along) [m]
  double mean = 0;   ///< mean over the area [m]
  double width = 0;  ///< width of the film [m]

  /// Returns the deviation in the field that contains (phi, z); z beyond the width belongs to the edge.
  [[nodiscard]] double at(double phi, double z) const;
  [[nodiscard]] static double phi_of(int i);  ///< angle of the middle of a field, 0..2 pi
};

/// Computes the radii of `surface` on `mesh`. @verified_by film_radii_test.cpp
[[nodiscard]] SurfaceRadii surface_radii(const Mesh& mesh, const FilmSurface& surface);

}  // namespace hersey::fem
