#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hersey/report/report.h"

namespace hersey::cli {

/// Lines of cells in columns; the first is aligned left, the others right, those from `left_from` on left again.
[[nodiscard]] std::string aligned(const std::vector<std::vector<std::string>>& lines, std::size_t left_from);

/// The closing table as text: one block per run, columns aligned.
[[nodiscard]] std::string summary_text(const std::vector<report::SummaryRow>& rows);

/// The same on one screen: where all rows are more than that, the worst figure of each kind and its bearing, a line for
/// each bearing, worst first, and what is not of a bearing. @param more  what prints all rows, "--all"
[[nodiscard]] std::string screen_text(const std::vector<report::SummaryRow>& rows, const std::string& more);

/// One line per run with the figures that are compared first, for a study.
[[nodiscard]] std::string comparison_text(const std::vector<report::SummaryRow>& rows);

}  // namespace hersey::cli
