#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "hersey/report/curve_chart.h"

namespace hersey::report {

/// A page of curves in one file without scripts.
struct CurvePage {
  std::string title, lead;
  std::vector<std::string> facts;                               ///< one line under the title
  std::vector<std::pair<std::string, std::string>> conditions;  ///< name and text
  std::vector<CurveChart> charts;
  std::vector<std::vector<std::string>> table;  ///< names, units, then rows
  /// A further table with a heading.
  struct Table {
    std::string title, note;
    std::vector<std::vector<std::string>> lines;  ///< names, units, then rows; empty: the title says why there is none
  };
  std::vector<Table> tables;
};

/// Writes it. @throws results::WriteError
void write_html(const CurvePage& page, const std::filesystem::path& out);

}  // namespace hersey::report
