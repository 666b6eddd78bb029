#pragma once

#include <numbers>
#include <string>

namespace hersey::film {

enum class Surface { shell, journal };
enum class FeatureShape { rectangle, ellipse };

/// A hole, groove or pocket in one of the surfaces: a rectangle or an ellipse in phi x z, seen in the frame of that
/// surface. One in the journal travels over the grid with SurfaceMotion::phi_journal. Where it is fed the film has its
/// pressure. Its depth steps down from the surface and is no part of the gap: without a feed it is film like any other,
/// only thicker, with one it holds the pressure of the supply and only thins the shear.
struct SurfaceFeature {
  std::string name;
  FeatureShape shape = FeatureShape::rectangle;
  Surface surface = Surface::shell;
  double phi = 0;                          ///< its middle [rad]
  double z = 0;                            ///< its middle [m]
  double arc = 2 * std::numbers::pi / 18;  ///< whole extent around the bearing [rad], in (0, 2 pi]
  double length = 1e-3;                    ///< whole extent along the axis [m], > 0
  double pressure = 0;                     ///< [Pa]; SurfaceMotion::feature_pressure takes its place
  bool is_fed = true;                      ///< without it the pressure means nothing
  double depth = 0;                        ///< [m], >= 0
};

/// Whether a place seen in the frame of its surface [rad, m] lies within a feature.
[[nodiscard]] bool contains(const SurfaceFeature& feature, double phi, double z);

/// Whether two features of one surface have a part in common, to a fiftieth of their size.
[[nodiscard]] bool overlap(const SurfaceFeature& a, const SurfaceFeature& b);

}  // namespace hersey::film
