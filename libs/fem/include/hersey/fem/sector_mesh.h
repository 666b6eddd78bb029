#pragma once

#include <array>
#include <optional>

#include "hersey/fem/mesh.h"

namespace hersey::fem {

/// Part of the outer face of a sector on which it stands: between two angles [rad], as wide [m], in the middle of the
/// sector's width.
struct SectorSeat {
  double from = 0, to = 0, width = 0;
};

/// Sector of a ring about the z-axis, the middle of its width at z = 0: a pad, half of a sleeve.
struct RingSector {
  double inner = 0, outer = 0;               ///< radii [m], 0 < inner < outer
  double width = 0;                          ///< along the axis [m]
  double from = 0, to = 0;                   ///< angles of its ends from x towards y [rad], less than a turn apart
  std::array<int, 3> elements = {12, 4, 2};  ///< around, along and through it, about: lines pass the seat's borders
  std::optional<SectorSeat> seat = std::nullopt;
};

/// Returns a mesh of quadratic hexahedra whose nodes all lie on their circles. Surfaces and node sets: `inner`,
/// `outer`, `first_end` (at `from`), `last_end`, `low_side` (z < 0), `high_side`; node set `seat`, if it has one.
/// @pre the seat lies within the sector
/// @verified_by sector_mesh_test.cpp
[[nodiscard]] Mesh sector_mesh(const RingSector& sector);

}  // namespace hersey::fem
