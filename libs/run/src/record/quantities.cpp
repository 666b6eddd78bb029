#include "hersey/run/quantities.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cycle/cycle_maps.h"
#include "hersey/core/contract.h"
#include "record/header_record.h"
#include "record/results_page.h"
#include "series/beam_record.h"
#include "series/bearing_record.h"
#include "series/body_record.h"
#include "series/circuit_record.h"
#include "series/contact_record.h"
#include "series/effort_record.h"
#include "series/flexible_record.h"
#include "series/fmu_record.h"
#include "series/geometry_record.h"
#include "series/group_record.h"
#include "series/joint_record.h"
#include "series/mesh_record.h"
#include "series/mode_record.h"
#include "series/multiplier_record.h"
#include "series/ring_record.h"
#include "series/surface_load_record.h"
#include "series/system_record.h"
#include "series/thermal_record.h"
#include "series/work_record.h"

namespace hersey::run {
namespace {

QuantityGroup body_group() {
  QuantityGroup group{.path = "/bodies/<b>/", .heading = "of a body", .quantities = {}};
  describe_mass(group);
  BodyRecord::describe(group);
  FlexibleRecord::describe(group);
  BeamRecord::describe(group);
  return group;
}

QuantityGroup shapes_of_bodies() {
  QuantityGroup group = describe_shapes("/bodies/<b>/shapes/<s>/");
  BeamRecord::describe_surface(group);
  return group;
}

QuantityGroup joint_group() {
  QuantityGroup group{.path = "/joints/<j>/", .heading = "of a joint", .quantities = {}};
  describe_joint_position(group);
  JointRecord::describe(group);
  return group;
}

QuantityGroup force_group() {
  QuantityGroup group{.path = "/forces/<f>/", .heading = "of a force between two bodies", .quantities = {}};
  describe_link(group);
  RingRecord::describe(group);
  MeshRecord::describe(group);
  return group;
}

bool has(const QuantityGroup& group, const std::string& name) {
  return std::any_of(group.quantities.begin(), group.quantities.end(),
                     [&](const QuantityInfo& quantity) { return quantity.name == name; });
}

/// Dimensions that are not in a table are the numbers of columns, which the writer adds.
void add_dimensions(QuantityGroup& group) {
  for (std::size_t i = 0; i < group.quantities.size(); ++i) {
    const std::vector<std::string> dimensions = group.quantities[i].dimensions;
    for (const std::string& name : dimensions) {
      if (name.starts_with("../") || has(group, name)) continue;
      const QuantityInfo& of = group.quantities[i];
      group.quantities.push_back({.name = name,
                                  .unit = "1",
                                  .text = "indices in its rows, counted from 0, or their names",
                                  .shape = "[...]",
                                  .note = "dimension of `" + of.name + "`",
                                  .kind = QuantityInfo::Kind::constant});
    }
  }
}

}  // namespace

const std::vector<QuantityGroup>& result_quantities() {
  static const std::vector<QuantityGroup> all = [] {
    std::vector<QuantityGroup> groups;
    const auto add = [&](std::vector<QuantityGroup> more) {
      for (QuantityGroup& group : more) {
        const auto known = std::find_if(groups.begin(), groups.end(), [&](const QuantityGroup& other) {
          return other.path == group.path && other.heading == group.heading;
        });
        if (known == groups.end())
          groups.push_back(std::move(group));
        else
          known->quantities.insert(known->quantities.end(), group.quantities.begin(), group.quantities.end());
      }
    };
    add(describe_header());
    add(describe_work());
    add({describe_step_errors(), SystemRecord::describe(), CycleRecord::describe(), MultiplierRecord::describe()});
    add(BearingRecord::describe());
    add({GroupRecord::describe(), ThermalRecord::describe(), CircuitRecord::describe()});
    add({body_group(), shapes_of_bodies(), describe_ground(), describe_shapes("/ground/shapes/<s>/"), joint_group()});
    add(EffortRecord::describe());
    add({FmuRecord::describe()});
    add({force_group(), ContactRecord::describe(), SurfaceLoadRecord::describe(), ModeRecord::describe()});
    for (QuantityGroup& group : groups) add_dimensions(group);
    return groups;
  }();
  return all;
}

std::vector<QuantityInfo> quantities_of(std::string_view path) {
  std::vector<QuantityInfo> quantities;
  for (const QuantityGroup& group : result_quantities())
    if (group.path == path) quantities.insert(quantities.end(), group.quantities.begin(), group.quantities.end());
  HERSEY_REQUIRE(!quantities.empty(), fmt::format("results hold no group {}", path));
  return quantities;
}

namespace {

const char* text_of(SummaryEntry::Statistic statistic) {
  switch (statistic) {
    case SummaryEntry::Statistic::smallest:
      return "smallest";
    case SummaryEntry::Statistic::largest:
      return "largest";
    case SummaryEntry::Statistic::largest_in_size:
      return "largest in size";
    case SummaryEntry::Statistic::longest:
      return "longest";
    case SummaryEntry::Statistic::mean:
      return "mean over time";
    case SummaryEntry::Statistic::integral:
      return "integral over time";
    case SummaryEntry::Statistic::at_end:
      return "at the end";
  }
  HERSEY_REQUIRE(false, "every way of telling has its words");
  return "";
}

const char* text_of(QuantityInfo::Kind kind) {
  switch (kind) {
    case QuantityInfo::Kind::series:
      return "series";
    case QuantityInfo::Kind::constant:
      return "constant";
    case QuantityInfo::Kind::attribute:
      return "attribute";
  }
  HERSEY_REQUIRE(false, "every kind has its name");
  return "";
}

/// "N|N.m" apart.
std::vector<std::string> units_of(const QuantityInfo& quantity) {
  std::vector<std::string> units;
  std::size_t from = 0;
  for (std::size_t at = 0; at != std::string::npos; from = at + 1) {
    at = quantity.unit.find('|', from);
    units.push_back(quantity.unit.substr(from, at - from));
  }
  return units;
}

nlohmann::ordered_json json_of(const QuantityInfo& quantity) {
  nlohmann::ordered_json entry{{"name", quantity.name},
                               {"kind", text_of(quantity.kind)},
                               {"units", units_of(quantity)},
                               {"shape", quantity.shape},
                               {"text", quantity.text}};
  if (!quantity.symbol.empty()) entry["symbol"] = quantity.symbol;
  if (!quantity.note.empty()) entry["note"] = quantity.note;
  for (const SummaryEntry& summary_entry : quantity.summary_entries)
    entry["told"].push_back({{"name", summary_entry.name}, {"as", text_of(summary_entry.statistic)}});
  return entry;
}

/// Text inside a cell of a table: names in angle brackets are no tags.
std::string cell(const std::string& text) {
  std::string safe;
  bool is_code = false;
  for (const char sign : text) {
    if (sign == '`') is_code = !is_code;
    if (sign == '|')
      safe += "\\|";
    else if (sign == '<' && !is_code)
      safe += "&lt;";
    else
      safe += sign;
  }
  return safe;
}

/// Unit in the form that is printed, "m³/s" for "m^3/s".
std::string printed(std::string unit) {
  for (const auto& [from, to] : {std::pair{"^2", "²"}, std::pair{"^3", "³"}})
    for (auto at = unit.find(from); at != std::string::npos; at = unit.find(from)) unit.replace(at, 2, to);
  return unit;
}

std::string row_of(const QuantityGroup& group, const QuantityInfo& quantity) {
  const std::string name =
      group.path == "/" && quantity.kind != QuantityInfo::Kind::attribute ? "/" + quantity.name : quantity.name;
  const std::string shape = quantity.kind == QuantityInfo::Kind::attribute ? "attribute" : quantity.shape;
  std::vector<std::string> units;
  for (const std::string& unit : units_of(quantity)) units.push_back(printed(unit));
  const std::string symbol = quantity.symbol.empty() ? "" : "`" + quantity.symbol + "`";
  const std::string note = quantity.note.empty() ? "" : (quantity.text.empty() ? "" : "; ") + quantity.note;
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", name, shape, fmt::join(units, ", "), symbol,
                     cell(quantity.text + note));
}

std::string table_of(const QuantityGroup& group) {
  std::string heading = group.heading;
  heading[0] = static_cast<char>(std::toupper(heading[0]));
  std::string text =
      fmt::format("\n### {}\n\n| in `{}` | shape | unit | symbol | |\n|---|---|---|---|---|\n", heading, group.path);
  for (const QuantityInfo& quantity : group.quantities) text += row_of(group, quantity);
  return text;
}

}  // namespace

std::string results_schema_json() {
  nlohmann::ordered_json schema{
      {"format", "hersey-results"}, {"format_version", 1}, {"groups", nlohmann::ordered_json::array()}};
  for (const QuantityGroup& group : result_quantities()) {
    nlohmann::ordered_json entry{
        {"path", group.path}, {"heading", group.heading}, {"quantities", nlohmann::ordered_json::array()}};
    for (const QuantityInfo& quantity : group.quantities) entry["quantities"].push_back(json_of(quantity));
    schema["groups"].push_back(std::move(entry));
  }
  return schema.dump(1) + "\n";
}

std::string results_schema_markdown() {
  std::string page = results_page_introduction;
  for (const QuantityGroup& group : result_quantities()) page += table_of(group);
  return page + results_page_end;
}

}  // namespace hersey::run
