#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hersey/report/curve_page.h"

namespace hersey::cli {

/// Tables of a page for a terminal: titles, and columns aligned right.
[[nodiscard]] std::string text_of(const std::vector<report::CurvePage::Table>& tables);

/// Writes a file that the user has named. @throws results::WriteError
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace hersey::cli
