#pragma once

#include <filesystem>
#include <string>

namespace hersey::report {

/// Writes the page of a study: one HTML file, no network.
/// @param data  what the page shows, as JSON; its keys are those of StudyText in web/src/data.ts
/// @throws results::WriteError if `data` is no JSON or `out` cannot be written
/// @verified_by tests/study
void write_study_page(const std::string& data, const std::filesystem::path& out);

}  // namespace hersey::report
