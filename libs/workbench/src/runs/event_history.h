#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace hersey::workbench {

/// The events of a run for pages that draw its course: of their file, which may be gigabytes, a few megabytes. Steps
/// are thinned out evenly to at most `most`, all other lines too; of each kind the first and the last are there. Of a
/// file of more than 32 MB only its first line, its last 16 kB and lines at `most` places that lie evenly in it are
/// read.
/// @verified_by event_history_test.cpp, tests/workbench/runs_test.py
[[nodiscard]] std::string thinned_events(const std::filesystem::path& file, std::size_t most);

}  // namespace hersey::workbench
