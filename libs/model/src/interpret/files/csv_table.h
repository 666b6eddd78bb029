#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"

namespace hersey::model {

/// One column of a table file: "angle [deg]" and its numbers.
struct Column {
  std::string name;
  std::string unit;  ///< empty where the header gives none
  std::vector<double> values;
};

struct CsvTable {
  std::string file;
  std::vector<Column> columns;
  std::vector<int> lines;  ///< line of the file for each row

  [[nodiscard]] const Column* find(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names() const;
};

/// Reads a table of numbers: a header "angle [deg], pressure [bar]", then one row a line; separated by commas,
/// semicolons or tabs; blank lines and lines beginning with # are skipped.
/// @returns nothing where a row has too few or too many values, or a value is no finite number; `faults` says where.
[[nodiscard]] std::optional<CsvTable> parse_csv(const std::string& text, const std::string& file,
                                                std::vector<Fault>& faults);

}  // namespace hersey::model
