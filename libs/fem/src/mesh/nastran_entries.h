#pragma once

#include <string_view>

namespace hersey::fem {

/// True if an entry of the bulk data (upper case) generates grid points or elements by a rule, or in a form this reader
/// does not know: without it the mesh would be another one.
[[nodiscard]] bool changes_the_bulk(std::string_view entry);

/// True if an entry is an axisymmetric element, which is no solid.
[[nodiscard]] bool is_axisymmetric(std::string_view entry);

/// True if an entry has no influence on shape, connections, stiffness or mass at rest: loads, supports, solutions,
/// output, tables, optimisation, properties of shells.
[[nodiscard]] bool concerns_no_bulk(std::string_view entry);

/// True if an entry is a material of another kind than the isotropic elastic MAT1.
[[nodiscard]] bool is_other_material(std::string_view entry);

}  // namespace hersey::fem
