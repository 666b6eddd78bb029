#pragma once

#include <cmath>
#include <variant>

#include "hersey/core/spatial.h"

namespace hersey::film {

/// Wrenches on the shell at the origin of a film's frame, [moment; force], of unit tractions at one point: along the
/// normal that points from the film into the shell, along growing phi and along growing z. The three are right-handed
/// (theory manual, film.58), but for a skirt, which is left-handed.
struct UnitTractions {
  Vector6 normal, along, across;
};

/// A line of a film's grid, phi = const: the angle [rad] with its cosine and sine.
struct GridLine {
  double phi = 0, cosine = 1, sine = 0;
};

// The surfaces a film may lie on (film.57), each with two coordinates at right angles: phi, and z from -L/2 to L/2. R
// is a length of the model: speeds and distances along phi are meant there. A new one is a struct like these and an
// alternative of FilmSurface.

/// Around the axis z at the radius R: a journal bearing, wholly or by pads.
struct Cylinder {
  static constexpr bool closes = true;    ///< true if phi and phi + 2 pi are the same line
  static constexpr bool is_round = true;  ///< true if gaps are sums of cos phi and sin phi; else of powers of phi
  /// Length per unit of phi over R [-].
  [[nodiscard]] static double stretch(double /*R*/, double /*z*/) { return 1; }
  /// Wrenches of unit tractions at (phi [rad], z [m]).
  [[nodiscard]] static UnitTractions tractions(double R, const GridLine& line, double z) {
    const double c = line.cosine, s = line.sine;
    UnitTractions t;
    t.normal << -z * s, z * c, 0, c, s, 0;
    t.along << -z * c, -z * s, R, -s, c, 0;
    t.across << R * s, -R * c, 0, 0, 0, 1;
    return t;
  }
};

/// The plane x = 0, y = R phi: a slider, or the pad of a linear guide. R is any length.
struct Plane {
  static constexpr bool closes = false, is_round = false;
  /// Length per unit of phi over R [-].
  [[nodiscard]] static double stretch(double /*R*/, double /*z*/) { return 1; }
  /// Wrenches of unit tractions at (phi [rad], z [m]).
  [[nodiscard]] static UnitTractions tractions(double R, const GridLine& line, double z) {
    const double y = R * line.phi;
    UnitTractions t;
    t.normal << 0, z, -y, 1, 0, 0;
    t.along << -z, 0, 0, 0, 1, 0;
    t.across << y, 0, 0, 0, 0, 1;
    return t;
  }
};

/// The plane at right angles to the axis, R its mean radius and z that beyond it: a thrust bearing. The journal is the
/// runner above it; the film pushes the shell against the axis.
struct Annulus {
  static constexpr bool closes = true, is_round = true;
  /// Length per unit of phi over R [-].
  [[nodiscard]] static double stretch(double R, double z) { return (R + z) / R; }
  /// Wrenches of unit tractions at (phi [rad], z [m]).
  [[nodiscard]] static UnitTractions tractions(double R, const GridLine& line, double z) {
    const double r = R + z, c = line.cosine, s = line.sine;
    UnitTractions t;
    t.normal << -r * s, r * c, 0, 0, 0, -1;
    t.along << 0, 0, r, -s, c, 0;
    t.across << 0, 0, 0, c, s, 0;
    return t;
  }
};

/// Around the axis z at the radius R with the film outside of it: a piston's skirt in its liner. The journal of a
/// film's data is the liner around it; normals point to the axis.
struct Skirt {
  static constexpr bool closes = true, is_round = true;
  /// Length per unit of phi over R [-].
  [[nodiscard]] static double stretch(double /*R*/, double /*z*/) { return 1; }
  /// Wrenches of unit tractions at (phi [rad], z [m]).
  [[nodiscard]] static UnitTractions tractions(double R, const GridLine& line, double z) {
    UnitTractions t = Cylinder::tractions(R, line, z);
    t.normal = -t.normal;
    return t;
  }
};

using FilmSurface = std::variant<Cylinder, Plane, Annulus, Skirt>;

/// True if phi and phi + 2 pi are the same line of the surface.
[[nodiscard]] inline bool closes(const FilmSurface& surface) {
  return std::visit([](const auto& s) { return s.closes; }, surface);
}

/// True if gaps of rigid bodies on the surface are sums of 1, cos phi and sin phi; else of powers of phi.
[[nodiscard]] inline bool is_round(const FilmSurface& surface) {
  return std::visit([](const auto& s) { return s.is_round; }, surface);
}

/// Returns the length along phi at z over that at R [-].
[[nodiscard]] inline double stretch(const FilmSurface& surface, double R, double z) {
  return std::visit([&](const auto& s) { return s.stretch(R, z); }, surface);
}

/// Returns the wrenches of unit tractions at (phi [rad], z [m]).
[[nodiscard]] inline UnitTractions tractions(const FilmSurface& surface, double R, const GridLine& line, double z) {
  return std::visit([&](const auto& s) { return s.tractions(R, line, z); }, surface);
}

}  // namespace hersey::film
