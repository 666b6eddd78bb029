#pragma once

#include <string>

#include "hersey/fem/solid_material.h"

namespace hersey::cli {

/// The material of --orthotropic: E_1, E_2, E_3, nu_12, nu_23, nu_13, G_12, G_23, G_13 with units, commas between,
/// along the mesh's axes. @throws InputError: not nine values, or constants of no material
[[nodiscard]] fem::SolidMaterial orthotropic_material(const std::string& text, double density);

}  // namespace hersey::cli
