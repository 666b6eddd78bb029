#include "page_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "hersey/core/write_file.h"
#include "hersey/results/error.h"

namespace hersey::cli {

std::string text_of(const std::vector<report::CurvePage::Table>& tables) {
  std::string text;
  for (const report::CurvePage::Table& table : tables) {
    std::vector<std::size_t> widths(table.lines.empty() ? 0 : table.lines[0].size(), 0);
    for (const auto& line : table.lines)
      for (std::size_t k = 0; k < line.size(); ++k) widths[k] = std::max(widths[k], line[k].size());
    text += (text.empty() ? "" : "\n") + table.title + "\n";
    for (const auto& line : table.lines) {
      std::string row;
      for (std::size_t k = 0; k < line.size(); ++k) row += fmt::format("{:>{}}", line[k], widths[k] + 2);
      text += row + "\n";
    }
  }
  return text;
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  try {
    write_file(path, {text});
  } catch (const std::runtime_error& error) {
    throw results::WriteError(path, std::string("the file cannot be written: ") + error.what());
  }
}

}  // namespace hersey::cli
