#include "interpret/files/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace hersey::model {
namespace {

/// More faults than these in one file say nothing new.
constexpr int most_faults = 10;

struct Cell {
  std::string_view text;
  int column = 1;  ///< where its text starts in the line
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

char separator_of(std::string_view header) {
  for (const char candidate : {';', ',', '\t'}) {
    if (header.find(candidate) != std::string_view::npos) return candidate;
  }
  return ',';
}

std::vector<Cell> cells_of(std::string_view line, char separator) {
  std::vector<Cell> cells;
  for (std::size_t start = 0; start <= line.size();) {
    std::size_t end = line.find(separator, start);
    if (end == std::string_view::npos) end = line.size();
    const std::string_view raw = line.substr(start, end - start);
    const std::string_view text = trimmed(raw);
    const auto offset = text.empty() ? 0 : static_cast<std::size_t>(text.data() - raw.data());
    cells.push_back({text, static_cast<int>(start + offset) + 1});
    start = end + 1;
  }
  return cells;
}

Column header_of(std::string_view text) {
  const auto open = text.find('[');
  if (open == std::string_view::npos || !text.ends_with(']')) return {std::string(text), "", {}};
  const std::string_view unit = text.substr(open + 1, text.size() - open - 2);
  return {std::string(trimmed(text.substr(0, open))), std::string(trimmed(unit)), {}};
}

bool parse_number(std::string_view text, double& number) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(number);
}

class Reader {
 public:
  Reader(std::string file, std::vector<Fault>& faults) : faults_(faults) { table_.file = std::move(file); }

  std::optional<CsvTable> read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
    while (!text.empty() && count_ < most_faults) {
      const auto end = text.find('\n');
      ++line_;
      read_line(text.substr(0, end));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    line_ = std::max(line_, 1);
    if (table_.lines.empty() && count_ == 0) fault(1, "no rows", "a line of column names, then rows of numbers");
    if (count_ > 0) return std::nullopt;
    return std::move(table_);
  }

 private:
  void read_line(std::string_view line) {
    const std::string_view content = trimmed(line);
    if (content.empty() || content.starts_with('#')) return;
    if (table_.columns.empty()) {
      separator_ = separator_of(line);
      for (const Cell& cell : cells_of(line, separator_)) table_.columns.push_back(header_of(cell.text));
      return;
    }
    const std::vector<Cell> cells = cells_of(line, separator_);
    if (cells.size() != table_.columns.size()) {
      return fault(1, std::to_string(cells.size()) + " values",
                   std::to_string(table_.columns.size()) + " as in the header");
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      double number = 0;
      if (!parse_number(cells[i].text, number)) {
        fault(cells[i].column, "'" + std::string(cells[i].text) + "'", "a finite number");
      }
      table_.columns[i].values.push_back(number);
    }
    table_.lines.push_back(line_);
  }

  void fault(int column, std::string found, std::string expected) {
    ++count_;
    faults_.push_back({{table_.file, line_, column}, "", std::move(found), std::move(expected), ""});
  }

  std::vector<Fault>& faults_;
  CsvTable table_;
  char separator_ = ',';
  int line_ = 0;
  int count_ = 0;
};

}  // namespace

const Column* CsvTable::find(const std::string& name) const {
  for (const Column& column : columns) {
    if (column.name == name) return &column;
  }
  return nullptr;
}

std::vector<std::string> CsvTable::names() const {
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(column.name);
  return names;
}

std::optional<CsvTable> parse_csv(const std::string& text, const std::string& file, std::vector<Fault>& faults) {
  return Reader(file, faults).read(text);
}

}  // namespace hersey::model
