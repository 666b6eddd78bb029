#pragma once

#include "hersey/bearing/operating_point.h"
#include "hersey/bearing/rigid_surfaces.h"

namespace hersey::bearing {

/// Surfaces of a film around a journal at `e`.
[[nodiscard]] film::SurfaceMotion steady_surfaces(const film::FilmModel& model, const OperatingPoint& point,
                                                  const Coordinates& e);
/// Returns the same by an object made for `model`, for repeated use.
[[nodiscard]] film::SurfaceMotion steady_surfaces(RigidSurfaces& surfaces, const film::FilmModel& model,
                                                  const OperatingPoint& point, const Coordinates& e);

/// Position of rigid bodies and their motion with the journal at `e`.
[[nodiscard]] ParameterVector parameters_of(const film::FilmModel& model, const OperatingPoint& point,
                                            const Coordinates& e);

}  // namespace hersey::bearing
