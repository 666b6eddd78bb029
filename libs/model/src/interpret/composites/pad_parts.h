#pragma once

#include <string>
#include <vector>

#include "check/check.h"
#include "tree/source_tree.h"

// What pads that tilt have in common, around a journal and below a collar.
namespace hersey::model {

/// Mass, centre and moments of inertia of a sector of a ring [SI].
struct PadInertia {
  double mass = 0;
  double centre = 0;      ///< distance of its centre of mass from the ring's axis, towards its middle
  double radial = 0;      ///< moments of inertia about its centre: about the line from the axis to its middle,
  double tangential = 0;  ///< at right angles to that and to the axis,
  double axial = 0;       ///< and along the axis
};

/// Sector between the radii r and r + t, of the angle `arc`, theory manual eq. (pads.1). All in SI units.
[[nodiscard]] PadInertia sector_of_ring(double r, double t, double arc, double width, double density);

/// The same of another mass.
[[nodiscard]] PadInertia with_mass(PadInertia pad, double mass);

/// Reports balls that do not fit what they lie in.
void check_pivot(const Value& pivot, std::vector<Fault>& faults);

/// Force of a pivot that yields, as the keys of a `sliding_spring`: linear, or by Hertz.
[[nodiscard]] std::string pivot_law(const Value& pivot);

/// Parts of a composite, written as a model file has them, as a tree whose faults are at `position`.
[[nodiscard]] Node parts_tree(const std::string& text, const SourcePosition& position);

}  // namespace hersey::model
