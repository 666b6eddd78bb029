#pragma once

#include <Eigen/Dense>

#include "hersey/core/surface_functions.h"

namespace hersey::bearing {

/// A bearing surface that deforms: its radial displacement away from the bearing's axis, relative to its frame,
///
///     d(phi, z) = sum over j of psi_j(phi, z) (D s)_j,
///
/// s being the amplitudes of its body's shapes, phi and z in its frame (theory manual, film-surface).
struct ElasticSurface {
  SurfaceFunctions functions;
  Eigen::MatrixXd D;  ///< (functions, amplitudes) [m] per unit amplitude
};

}  // namespace hersey::bearing
