#pragma once

#include <string_view>

namespace hersey::fem {

/// Whether an entry of the bulk data (upper case) writes grid points or elements by a rule, or in a form this reader
/// does not know: a mesh read without following it would be another one.
[[nodiscard]] bool changes_the_bulk(std::string_view entry);

/// Whether an entry is an element of a section that turns about an axis: of no solid.
[[nodiscard]] bool is_axisymmetric(std::string_view entry);

/// Whether an entry says nothing of shape, connections, stiffness or mass at rest: loads, supports, solutions, output,
/// tables, optimisation, properties of shells.
[[nodiscard]] bool concerns_no_bulk(std::string_view entry);

/// Whether an entry is a material of another kind than the isotropic elastic MAT1.
[[nodiscard]] bool is_other_material(std::string_view entry);

}  // namespace hersey::fem
