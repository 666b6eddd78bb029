#pragma once

#include "check/vocabulary.h"
#include "hersey/film/thermal_model.h"

namespace hersey::model {

/// Heat capacity of steel per volume [J/(m^3 K)].
inline constexpr double heat_of_steel = 3.6e6;

/// A temperature, or the node of the network that has it.
[[nodiscard]] TypePtr temperature_or_node(const std::string& example);

/// Thermal models of a shell: format and reading.
[[nodiscard]] const std::vector<Alternative<film::ShellWall>>& shell_walls();

/// Thermal models of a journal: format and reading.
[[nodiscard]] const std::vector<Alternative<film::JournalWall>>& journal_walls();

/// Thermal models of pads and of a stator: format and reading.
[[nodiscard]] const std::vector<Alternative<film::ShellWall>>& pad_walls();

/// Thermal models of a runner: format and reading.
[[nodiscard]] const std::vector<Alternative<film::JournalWall>>& runner_walls();

}  // namespace hersey::model
