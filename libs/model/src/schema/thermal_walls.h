#pragma once

#include "hersey/film/thermal_model.h"
#include "schema/vocabulary.h"

namespace hersey::model {

/// What warms steel, per volume [J/(m^3 K)].
inline constexpr double heat_of_steel = 3.6e6;

/// A temperature, or the node of the network that has it.
[[nodiscard]] TypePtr temperature_or_node(const std::string& example);

/// What a shell does with the film's heat: format and reading.
[[nodiscard]] const std::vector<Alternative<film::ShellWall>>& shell_walls();

/// The same of a journal.
[[nodiscard]] const std::vector<Alternative<film::JournalWall>>& journal_walls();

}  // namespace hersey::model
