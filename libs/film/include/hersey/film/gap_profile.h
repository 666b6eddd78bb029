#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "hersey/core/table_function.h"
#include "hersey/film/surface_feature.h"

namespace hersey::film {

/// Widening of the gap by a profile at one point [m], with its first and second derivative around the bearing.
struct Opening {
  double value = 0, phi = 0, phi_phi = 0;
};

// Deviations of a surface from its cylinder (film.24), counted as missing metal: they widen the gap at (phi, z), in the
// frame of their surface. A new one is a struct like these and its name in ProfileShape.

/// A surface that falls off towards both edges as a parabola.
struct Barrel {
  double drop = 0;  ///< at the edges [m]
  /// Widening at (phi [rad], z [m]) of a bearing of width L [m].
  [[nodiscard]] Opening opening(double phi, double z, double L) const;
};

/// A gap that opens linearly along the axis and is unchanged at z = 0.
struct Taper {
  double rise = 0;  ///< from z = -L/2 to L/2 [m]
  /// Widening at (phi [rad], z [m]) of a bearing of width L [m].
  [[nodiscard]] Opening opening(double phi, double z, double L) const;
};

/// An ellipse: wider by `amplitude` at `angle` and opposite, narrower by as much in between.
struct Ovality {
  double amplitude = 0;  ///< [m]
  double angle = 0;      ///< [rad]
  /// Widening at (phi [rad], z [m]) of a bearing of width L [m].
  [[nodiscard]] Opening opening(double phi, double z, double L) const;
};

/// Equal circular arcs, each with its centre moved by `offset` away from the middle of its arc. The gap equals the
/// clearance in the middle of an arc and is widest between two arcs. Two arcs make a lemon bore.
struct Lobes {
  int count = 2;      ///< >= 2
  double offset = 0;  ///< [m], >= 0
  double angle = 0;   ///< middle of one arc [rad]
  /// Widening at (phi [rad], z [m]) of a bearing of width L [m].
  [[nodiscard]] Opening opening(double phi, double z, double L) const;
};

/// One of the arcs that a bore is made of: part of a circle about a centre of its own, which lies `offset` from the
/// bearing's axis on the side away from `thinnest`. There the gap of a central journal is least.
struct Arc {
  std::string name;
  double from = 0, to = 0;     ///< the angles at which it begins and ends [rad], from < to
  double thinnest = 0;         ///< [rad]; it may lie beyond the arc's ends
  double offset = 0;           ///< of the arc's centre from the axis [m], c_p - c_b of machined and assembled clearance
  double extra_clearance = 0;  ///< its assembled clearance beyond that of the bearing [m]
};

/// A bore of arcs with grooves between them (film.24): the film of each is a patch of the grid.
struct Arcs {
  std::vector<Arc> arcs;  ///< in ascending order
  /// Widening at (phi [rad], z [m]) of a bearing of width L [m]; between arcs that of the nearest one.
  [[nodiscard]] Opening opening(double phi, double z, double L) const;
};

/// A measured surface: closed smooth curves around the bearing at some heights, straight in between and constant beyond
/// them.
struct MeasuredShape {
  std::vector<double> z;                                       ///< ascending [m]
  std::vector<std::shared_ptr<const TableFunction>> openings;  ///< [m] over phi [rad], one for every z, of period 2 pi
  /// Widening at (phi [rad], z [m]) of a bearing of width L [m].
  [[nodiscard]] Opening opening(double phi, double z, double L) const;
};

using ProfileShape = std::variant<Barrel, Taper, Ovality, Lobes, Arcs, MeasuredShape>;

/// A shape made in one of the surfaces.
struct Profile {
  ProfileShape shape;
  Surface surface = Surface::shell;

  /// True if it makes the gap change as its surface rotates.
  [[nodiscard]] bool varies_around() const;
  /// Widening at (phi [rad], z [m]) in the frame of its surface, in a bearing of width L [m].
  [[nodiscard]] Opening opening(double phi, double z, double L) const;
};

}  // namespace hersey::film
