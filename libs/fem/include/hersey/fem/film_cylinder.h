#pragma once

#include <optional>

#include "hersey/core/spatial.h"
#include "hersey/core/surface_functions.h"

namespace hersey::fem {

/// Cylinder on which a film lies in a mesh: |z| <= L / 2 about the z-axis of `X`, all around or on an arc.
struct FilmCylinder {
  Pose X;               ///< pose of the film's axes in the mesh's, origin in the middle of the width [m]
  double R = 0;         ///< radius [m], > 0
  double L = 0;         ///< width [m], > 0
  bool is_bore = true;  ///< true: the solid lies around the film (a bore); false: within it (a journal)
  std::optional<SurfaceArc> arc = std::nullopt;  ///< of the film; unset: all around
};

}  // namespace hersey::fem
