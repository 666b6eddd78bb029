#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "hersey/film/restrictor.h"

namespace hersey::film {

enum class Surface { shell, journal };

// Outlines of features in phi x z. Positions x, y are relative: 0 in the middle, 1 at the end of half the extent. A new
// outline is a struct like these and an alternative of FeatureShape; fractions of control volumes that it covers
// (feature_cover.cpp) and words for it (assumptions.cpp) do not compile without it.

struct Rectangle {
  static constexpr bool has_straight_ends = true;
  /// Extent in one direction at the position `across` in the other, |across| < 1, over the largest extent [-].
  [[nodiscard]] static double reach(double /*across*/) { return 1; }
  /// Derivative of reach().
  [[nodiscard]] static double reach_slope(double /*across*/) { return 0; }
  /// True if a point lies within.
  [[nodiscard]] static bool contains(double x, double y) { return std::abs(x) < 1 && std::abs(y) < 1; }
};

struct Ellipse {
  static constexpr bool has_straight_ends = false;
  /// Extent in one direction at the position `across` in the other, |across| < 1, over the largest extent [-].
  [[nodiscard]] static double reach(double across) { return std::sqrt(1 - across * across); }
  /// Derivative of reach().
  [[nodiscard]] static double reach_slope(double across) { return -across / reach(across); }
  /// True if a point lies within.
  [[nodiscard]] static bool contains(double x, double y) { return x * x + y * y < 1; }
};

using FeatureShape = std::variant<Rectangle, Ellipse>;

/// A hole, groove or pocket in one of the surfaces: an outline in phi x z, in the frame of that surface. A feature of
/// the journal travels over the grid with SurfaceMotion::phi_journal. Its depth is a step down from the surface and no
/// part of the gap. A fed feature has the pressure of its supply, and its depth only reduces the shear; a feature
/// without a feed is a thicker film.
struct SurfaceFeature {
  std::string name;
  FeatureShape shape = Rectangle{};
  Surface surface = Surface::shell;
  double phi = 0;                          ///< its middle [rad]
  double z = 0;                            ///< its middle [m]
  double arc = 2 * std::numbers::pi / 18;  ///< whole extent around the bearing [rad], in (0, 2 pi]
  double length = 1e-3;                    ///< whole extent along the axis [m], > 0
  double pressure = 0;                     ///< [Pa]; SurfaceMotion::feature_pressure overrides it
  bool is_fed = true;                      ///< without it the pressure means nothing
  /// A circuit feeds it, which may have too little oil: below p_cav `pressure` is none, but p_cav + u, u < 0, says by
  /// (film.5) how full the feature is. Otherwise a supply below p_cav counts as one at p_cav.
  bool may_lack_oil = false;
  double depth = 0;  ///< [m], >= 0
  /// Through which it is fed: `pressure` is then the supply's, before the restrictor, and the pressure in the feature
  /// an unknown of the film. Unset: the feature has the pressure of its supply.
  std::optional<Restrictor> restrictor = {};
};

/// True if its outline ends with straight borders.
[[nodiscard]] inline bool has_straight_ends(const SurfaceFeature& feature) {
  return std::visit([](const auto& shape) { return shape.has_straight_ends; }, feature.shape);
}

/// True if a point, given in the frame of the feature's surface [rad, m], lies within the feature.
[[nodiscard]] bool contains(const SurfaceFeature& feature, double phi, double z);

/// True if two features of one surface overlap, to a fiftieth of their size.
[[nodiscard]] bool overlap(const SurfaceFeature& a, const SurfaceFeature& b);

}  // namespace hersey::film
