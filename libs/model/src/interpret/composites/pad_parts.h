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

/// Moving surface of a composite that all of its films warm.
struct WarmedByPads {
  std::string key;      ///< of its wall in `thermal`: "journal"
  std::string node;     ///< of the thermal network that it is, where it has one free temperature
  double capacity = 0;  ///< [J/K], unless the wall has one
};

/// True if the films of a composite have temperatures.
[[nodiscard]] bool has_warm_films(const Value& bearing);

/// The section `thermal` of a composite's parts: the moving surface, where it is free, and grooves between the pads in
/// the order of their angles.
/// @pre has_warm_films
[[nodiscard]] std::string thermal_of_pads(const Value& bearing, const WarmedByPads& moving, const std::string& name,
                                          const std::vector<std::string>& pads, const std::vector<double>& angles);

/// Makes the wall of the moving surface a node in the `thermal` of each film of `tree`, where it is free.
/// @pre has_warm_films
void set_moving_wall(const Value& bearing, const WarmedByPads& moving, const SourcePosition& position, Node& tree);

/// Makes the moving surface that the film of a pad wears one that all pads wear, unless the model names it.
/// @param moving  key of that surface, "journal"
/// @param film  with the keys of the composite
void set_worn_group(const std::string& moving, const std::string& name, Node& film);

/// Parts of a composite, written as a model file has them, as a tree whose faults are at `position`.
[[nodiscard]] Node parts_tree(const std::string& text, const SourcePosition& position);

}  // namespace hersey::model
