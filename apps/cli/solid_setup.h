#pragma once

#include <vector>

#include "commands.h"
#include "hersey/fem/constrained_stiffness.h"
#include "hersey/fem/elastic_body.h"

namespace hersey::cli {

/// The body that `modes` and `stress` compute with. Warnings of the mesh go to stderr.
/// @param needs_mass whether a body without mass is of no use
/// @throws InputError: the mesh is unfit, or E, nu or rho are missing or impossible
[[nodiscard]] fem::ElasticBody solid_of(const SolidArguments& arguments, bool needs_mass);

/// Degrees of freedom that --hold names. @throws InputError naming an unknown set or axis
[[nodiscard]] std::vector<int> fixed_dofs_of(const SolidArguments& arguments, const fem::Mesh& mesh);

/// Nodal forces (3 n) of --pressure and --gravity. @throws InputError: an unknown surface, a value that is none, no
/// load at all
[[nodiscard]] Eigen::VectorXd loads_of(const SolidArguments& arguments, const fem::ElasticBody& body);

}  // namespace hersey::cli
