#pragma once

#include "hersey/film/surface_feature.h"

namespace hersey::film {

/// Area that two features have in common, on the unrolled surface.
struct FeatureOverlap {
  double area = 0;   ///< [m^2]
  double slope = 0;  ///< derivative by the angle of the journal [m^2/rad]; continuous, as the area is
};

/// Returns the area that a hole of one surface and a groove of the other have in common (circuit.12), in closed form.
/// @param hole  an ellipse
/// @param groove  a rectangle, in the other surface
/// @param phi_journal  rotation of the journal over the shell [rad]
/// @param R  radius of the bearing [m], > 0
/// @verified_by feature_overlap_test.cpp
[[nodiscard]] FeatureOverlap overlap_of(const SurfaceFeature& hole, const SurfaceFeature& groove, double phi_journal,
                                        double R);

}  // namespace hersey::film
