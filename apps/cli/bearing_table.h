#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hersey/study/bearing_study.h"
#include "hersey/study/sensitivity.h"

namespace hersey::cli {

/// States whether any rigid rotor is stable on the film, if its mass does not matter; else empty.
[[nodiscard]] std::string whirl_remark(const study::BearingSolution& solution);

/// States, for a film with computed temperatures, whether they follow the motion in stiffness and damping; else empty.
[[nodiscard]] std::string heat_remark(const study::BearingSolution& solution);

/// Describes each surface that deforms: its name, "shell", and the supports of its body.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> surface_remarks(const study::BearingSolution& solution);

/// Every figure of one solution, one a line, with the error of the grid.
[[nodiscard]] std::string bearing_text(const study::BearingSolution& solution);

/// One line per solution with the figures that are compared first.
[[nodiscard]] std::string bearing_comparison_text(const std::vector<study::BearingSolution>& solutions);

/// Every figure of every solution that was found, comma-separated; the first line names figures and units.
[[nodiscard]] std::string bearing_csv(const std::vector<study::BearingSolution>& solutions);

/// The fields of one solution at the nodes, comma-separated.
[[nodiscard]] std::string bearing_fields_csv(const study::BearingSolution& solution);

/// @param sensitivities  of this solution; empty: none requested
[[nodiscard]] nlohmann::json bearing_json(const study::BearingSolution& solution,
                                          const std::vector<study::Sensitivity>& sensitivities = {});

/// By how many percent each figure changes where a parameter grows by one percent, a column a parameter.
[[nodiscard]] std::string sensitivity_text(const study::BearingSolution& solution,
                                           const std::vector<study::Sensitivity>& sensitivities);

}  // namespace hersey::cli
