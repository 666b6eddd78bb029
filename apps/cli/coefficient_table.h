#pragma once

#include <string>
#include <vector>

#include "hersey/study/bearing_study.h"

namespace hersey::cli {

/// The program that a table of bearing coefficients is written for.
enum class TableReader { hersey, ross, ansys };

/// Returns stiffness and damping over the speed of the shaft as a file for that program: for hersey a CSV table that
/// `type: bearing_table` reads (XLTRC2 and spreadsheets take it, too), for ROSS a TOML file of `BearingElement.load`,
/// for Ansys the file of bearing characteristics that its macro for COMBI214 imports.
/// Axes are those of the bearing's frame.
/// @param solutions  of one bearing, all solved, in any order
/// @throws InputError where they are no coefficients over positive speeds that differ
[[nodiscard]] std::string coefficient_table(const std::vector<study::BearingSolution>& solutions,
                                            const std::string& bearing, const std::string& model, TableReader reader);

}  // namespace hersey::cli
