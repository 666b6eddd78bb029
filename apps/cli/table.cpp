#include "table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hersey::cli {
namespace {

using report::SummaryRow;

// Columns on the screen, not bytes: continuation bytes of UTF-8 take no room.
std::size_t columns(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool right = false) {
  const std::string blank(width > columns(text) ? width - columns(text) : 0, ' ');
  return right ? blank + text : text + blank;
}

std::string number(double value) { return fmt::format("{:.5g}", value); }

}  // namespace

std::string aligned(const std::vector<std::vector<std::string>>& lines, std::size_t left_from) {
  std::vector<std::size_t> widths;
  for (const auto& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], columns(line[i]));
  }
  std::string text;
  for (const auto& line : lines) {
    std::string row = "  ";
    for (std::size_t i = 0; i < line.size(); ++i) row += padded(line[i], widths[i], i > 0 && i < left_from) + "  ";
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

// Name of a group of rows in the summary table (report::SummaryRow::group).
std::string heading_of(const SummaryRow& row) {
  if (row.group == "run") return row.run;
  if (row.group == "modes") return "small motions";
  if (row.group == "run-up") return "run-up or coast-down";
  if (row.group == "computing") return "computing time";
  if (row.group == "cycles" || row.group == "thermal network" || row.group == "circuit" ||
      row.group.starts_with("contact ") || row.group.starts_with("ring ") || row.group.starts_with("gear mesh ") ||
      row.group.starts_with("films of "))
    return row.group;
  return "bearing " + row.group;
}

std::string summary_text(const std::vector<SummaryRow>& rows) {
  std::string text, group;
  std::vector<std::vector<std::string>> lines;
  const auto close_block = [&] {
    if (!lines.empty()) text += "\n" + group + "\n" + aligned(lines, 2);
    lines.clear();
  };
  for (const SummaryRow& row : rows) {
    const std::string name = heading_of(row);
    if (name != group) close_block();
    group = name;
    lines.push_back({row.name, number(row.value), row.unit, row.where});
  }
  close_block();
  return text;
}

std::string comparison_text(const std::vector<SummaryRow>& rows) {
  // What a study is read for: the state it ends in and the extremes on the way.
  struct Figure {
    const char* name;
    const char* heading;
  };
  const std::array<Figure, 5> wanted{{{"eccentricity ratio at the end", "ecc. ratio"},
                                      {"attitude angle at the end", "attitude"},
                                      {"minimum film thickness at the end", "h_min"},
                                      {"peak film pressure at the end", "p_max"},
                                      {"minimum film thickness (MOFT)", "MOFT"}}};
  std::vector<std::vector<std::string>> lines{{"at the end", "bearing"}};
  for (const Figure& figure : wanted) {
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const SummaryRow& row) { return row.name == figure.name; });
    const std::string unit = found == rows.end() || found->unit.empty() ? "" : " [" + found->unit + "]";
    lines.front().push_back(figure.heading + unit);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && rows[i].run == rows[i - 1].run && rows[i].group == rows[i - 1].group) continue;
    std::vector<std::string> line{rows[i].run, rows[i].group};
    bool is_of_bearing = false;
    for (const Figure& figure : wanted) {
      const auto found = std::find_if(rows.begin(), rows.end(), [&](const SummaryRow& row) {
        return row.run == rows[i].run && row.group == rows[i].group && row.name == figure.name;
      });
      line.push_back(found == rows.end() ? "-" : number(found->value));
      is_of_bearing = is_of_bearing || found != rows.end();
    }
    if (is_of_bearing) lines.push_back(std::move(line));
  }
  return "\n" + aligned(lines, 99);
}

}  // namespace hersey::cli
