#pragma once

#include <filesystem>
#include <string>

namespace hersey::report {

/// Writes the page of a study: one HTML file, no network.
/// @param data  contents of the page as JSON; its keys are those of StudyText in web/src/data.ts
/// @throws results::WriteError if `data` is not JSON or `out` cannot be written
/// @verified_by tests/study
void write_study_page(const std::string& data, const std::filesystem::path& out);

}  // namespace hersey::report
