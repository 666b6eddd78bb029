#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "table.h"

namespace hersey::cli {
namespace {

using report::SummaryRow;
using Lines = std::vector<std::vector<std::string>>;

constexpr std::size_t kScreen = 40;        // lines of the whole table that may stay as they are
constexpr std::size_t kMostBearings = 10;  // reported line by line
constexpr std::size_t kMostOthers = 10;

/// A figure of bearings of which the smallest or the largest is the worst.
struct FigureKind {
  const char* name;     // of the row
  const char* heading;  // of its column; empty: not in the table of bearings
  bool is_least_worst = false;
};

constexpr std::array<FigureKind, 7> kKinds{{{"minimum film thickness (MOFT)", "MOFT", true},
                                            {"peak film pressure (POFP)", "POFP"},
                                            {"largest load", "load"},
                                            {"hottest oil", "hottest"},
                                            {"mean power loss in the film", "film loss"},
                                            {"mean power loss in asperity contact", "contact loss"},
                                            {"worst mass-balance error of the film", ""}}};

std::string figure_text(double value) { return fmt::format("{:.4g}", value); }

bool is_of_bearing(const std::vector<SummaryRow>& rows, const std::string& group) {
  return std::any_of(rows.begin(), rows.end(),
                     [&](const SummaryRow& row) { return row.group == group && row.name == kKinds.front().name; });
}

const SummaryRow* find(const std::vector<SummaryRow>& rows, const std::string& group, const char* name) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const SummaryRow& row) { return row.group == group && row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

const SummaryRow* worst(const std::vector<SummaryRow>& rows, const FigureKind& kind) {
  const SummaryRow* worst = nullptr;
  for (const SummaryRow& row : rows) {
    if (row.name != kind.name || !std::isfinite(row.value)) continue;
    const bool is_worse =
        worst == nullptr || (kind.is_least_worst ? row.value < worst->value : row.value > worst->value);
    if (is_worse) worst = &row;
  }
  return worst;
}

std::vector<std::string> bearings_of(const std::vector<SummaryRow>& rows) {
  std::vector<std::string> names;
  for (const SummaryRow& row : rows) {
    if (std::find(names.begin(), names.end(), row.group) == names.end() && is_of_bearing(rows, row.group))
      names.push_back(row.group);
  }
  const auto moft = [&](const std::string& name) { return find(rows, name, kKinds.front().name)->value; };
  std::stable_sort(names.begin(), names.end(),
                   [&](const std::string& a, const std::string& b) { return moft(a) < moft(b); });
  return names;
}

std::string worst_text(const std::vector<SummaryRow>& rows) {
  Lines lines;
  for (const FigureKind& kind : kKinds) {
    const SummaryRow* row = worst(rows, kind);
    // A contact loss that no bearing has is not reported.
    if (row == nullptr || (row->value == 0 && !kind.is_least_worst)) continue;
    lines.push_back({kind.name, figure_text(row->value), row->unit, row->group, row->where});
  }
  return lines.empty() ? "" : "\nworst of all bearings\n" + aligned(lines, 2);
}

std::string bearings_text(const std::vector<SummaryRow>& rows) {
  const std::vector<std::string> names = bearings_of(rows);
  Lines lines{{"bearing"}};
  std::vector<const FigureKind*> columns;
  for (const FigureKind& kind : kKinds) {
    const SummaryRow* any = worst(rows, kind);
    if (any == nullptr || std::string(kind.heading).empty()) continue;
    columns.push_back(&kind);
    lines.front().push_back(fmt::format("{} [{}]", kind.heading, any->unit));
  }
  for (std::size_t i = 0; i < std::min(names.size(), kMostBearings); ++i) {
    std::vector<std::string> line{names[i]};
    for (const FigureKind* kind : columns) {
      const SummaryRow* row = find(rows, names[i], kind->name);
      line.push_back(row == nullptr ? "-" : figure_text(row->value));
    }
    lines.push_back(std::move(line));
  }
  std::string text = "\nbearings, the thinnest film first\n" + aligned(lines, 99);
  if (names.size() > kMostBearings) text += fmt::format("  and {} more\n", names.size() - kMostBearings);
  return text;
}

bool is_of_films(const SummaryRow& row) { return row.group.starts_with("films of "); }

/// Bearings of several films, a line each.
std::string groups_text(const std::vector<SummaryRow>& rows) {
  constexpr std::array<std::pair<const char*, const char*>, 5> columns{{{"smallest film of all", "MOFT"},
                                                                        {"largest pressure of all films", "POFP"},
                                                                        {"largest load on all films", "load"},
                                                                        {"mean power loss in all films", "film loss"},
                                                                        {"mean side flow of all films", "side flow"}}};
  Lines lines;
  std::string last;
  for (const SummaryRow& of : rows) {
    if (!is_of_films(of) || of.group == last) continue;
    last = of.group;
    if (lines.empty()) lines.push_back({"bearing"});
    std::vector<std::string> line{of.group.substr(std::string("films of ").size())};
    for (const auto& [name, heading] : columns) {
      const SummaryRow* row = find(rows, of.group, name);
      line.push_back(row == nullptr ? "-" : figure_text(row->value));
      if (lines.size() == 1 && row != nullptr) lines.front().push_back(fmt::format("{} [{}]", heading, row->unit));
    }
    lines.push_back(std::move(line));
  }
  return lines.empty() ? "" : "\nbearings of several films\n" + aligned(lines, 99);
}

/// Name of a figure; with that of its ring, contact or gear mesh, of which a machine has several.
std::string name_on_screen(const SummaryRow& row) {
  const bool is_one_of_several =
      row.group.starts_with("ring ") || row.group.starts_with("contact ") || row.group.starts_with("gear mesh ");
  return is_one_of_several ? row.group + ": " + row.name : row.name;
}

std::string others_text(const std::vector<SummaryRow>& rows) {
  Lines lines;
  std::size_t left_out = 0;
  for (const SummaryRow& row : rows) {
    if (row.group == "computing" || is_of_films(row) || is_of_bearing(rows, row.group)) continue;
    if (lines.size() < kMostOthers) {
      lines.push_back({name_on_screen(row), figure_text(row.value), row.unit, row.where});
    } else {
      ++left_out;
    }
  }
  std::string text = lines.empty() ? "" : "\nmachine\n" + aligned(lines, 2);
  return left_out == 0 ? text : text + fmt::format("  and {} more\n", left_out);
}

}  // namespace

std::string screen_text(const std::vector<SummaryRow>& rows, const std::string& more) {
  std::string all = summary_text(rows);
  const bool fits = static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n')) <= kScreen;
  if (fits || bearings_of(rows).empty()) return all;
  return worst_text(rows) + bearings_text(rows) + groups_text(rows) + others_text(rows) +
         fmt::format("\n{} figures in all: {}\n", rows.size(), more);
}

}  // namespace hersey::cli
