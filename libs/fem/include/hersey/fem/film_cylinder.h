#pragma once

#include "hersey/core/spatial.h"

namespace hersey::fem {

/// Cylinder on which a film lies in a mesh: |z| <= L / 2 about the z-axis of `X`.
struct FilmCylinder {
  Pose X;               ///< pose of the film's axes in the mesh's, origin in the middle of the width [m]
  double R = 0;         ///< radius [m], > 0
  double L = 0;         ///< width [m], > 0
  bool is_bore = true;  ///< true: the solid lies around the film (a bore); false: within it (a journal)
};

}  // namespace hersey::fem
