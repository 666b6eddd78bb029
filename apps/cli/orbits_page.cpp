#include "orbits_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "hersey/core/version.h"
#include "page_text.h"

namespace hersey::cli {
namespace {

using nlohmann::json;
using report::CurveChart;
using report::CurveLine;
using report::CurvePage;
using run::Bifurcation;
using run::OrbitAtValue;

const char* bifurcation_word(Bifurcation kind) {
  constexpr std::array<const char*, 4> words{"fold", "branching", "period doubling", "torus"};
  return words.at(static_cast<std::size_t>(kind));
}

double growth_of(const OrbitAtValue& orbit) {
  return orbit.multipliers.empty() ? -std::numeric_limits<double>::infinity()
                                   : std::log(std::abs(orbit.multipliers.front())) / orbit.period;
}

/// Units that people read, and their size in SI.
std::pair<std::string, double> shown_unit(const std::string& si) {
  if (si == "m") return {"um", 1e-6};
  if (si == "Pa") return {"MPa", 1e6};
  if (si == "rad") return {"deg", std::numbers::pi / 180};
  return {si, 1};
}

/// Lines of one quantity: a new one begins where the branch turns stable or unstable, with the point before it.
std::vector<CurveLine> lines_of(const OrbitFindings& found, const std::string& label, std::size_t first,
                                const std::function<double(const OrbitAtValue&)>& value) {
  std::vector<CurveLine> lines;
  for (const OrbitAtValue& orbit : found.branch.orbits) {
    if (lines.empty() || lines.back().is_dashed == orbit.is_stable()) {
      CurveLine line{.label = lines.empty() ? label : "", .x = {}, .y = {}, .is_dashed = !orbit.is_stable()};
      if (!lines.empty()) {
        line.like = first;
        line.x.push_back(lines.back().x.back());
        line.y.push_back(lines.back().y.back());
      }
      lines.push_back(std::move(line));
    }
    lines.back().x.push_back(orbit.value);
    lines.back().y.push_back(value(orbit));
  }
  return lines;
}

void add_lines(const OrbitFindings& found, CurveChart& chart, const std::string& label,
               const std::function<double(const OrbitAtValue&)>& value) {
  for (CurveLine& line : lines_of(found, label, chart.lines.size(), value)) chart.lines.push_back(std::move(line));
  for (const run::BifurcationAt& at : found.branch.bifurcations) {
    const double y = value(found.branch.orbits[at.behind]), next = value(found.branch.orbits[at.behind + 1]);
    chart.marks.push_back({bifurcation_word(at.kind), at.value, (y + next) / 2});
  }
}

CurveChart chart_along(const OrbitFindings& found, std::string title, std::string note, std::string y_name,
                       std::string y_unit) {
  CurveChart chart;
  chart.title = std::move(title), chart.note = std::move(note);
  chart.x_name = found.parameter, chart.x_unit = found.unit.empty() ? "1" : found.unit;
  chart.y_name = std::move(y_name), chart.y_unit = std::move(y_unit);
  chart.y_is_logarithmic = false;
  return chart;
}

/// Part of a quantity's name that says what it is: "h_min" of "bearings.left.h_min".
std::string kind_of(const std::string& name) {
  constexpr std::array<const char*, 4> kinds{"eccentricity", "h_min", "p_max", "coordinates"};
  for (const char* kind : kinds)
    if (name.find(std::string(".") + kind) != std::string::npos) return kind;
  return name;
}

/// A name without the part that all of a chart share: "left.x" of "bearings.left.eccentricity.x".
std::string short_name(const std::string& name, const std::string& kind) {
  std::string text = name.substr(name.find('.') + 1);
  if (const std::size_t at = text.find("." + kind); at != std::string::npos) text.erase(at, kind.size() + 1);
  return text;
}

void add_charts(const OrbitFindings& found, CurvePage& page) {
  const std::vector<run::ObservedQuantity>& observed = found.branch.observed;
  constexpr std::size_t most = 6;                          // lines that one can tell apart
  std::vector<std::pair<std::string, std::string>> kinds;  // and their units
  for (const run::ObservedQuantity& quantity : observed) {
    const std::pair<std::string, std::string> kind{kind_of(quantity.name), quantity.unit};
    if (std::ranges::find(kinds, kind) == kinds.end()) kinds.push_back(kind);
  }
  for (const auto& [kind, si] : kinds) {
    const bool is_lowest = kind == "h_min", is_highest = kind == "p_max";
    std::size_t count = 0;
    CurveChart chart;
    for (std::size_t k = 0; k < observed.size(); ++k) {
      if (kind_of(observed[k].name) != kind || observed[k].unit != si || count++ >= most) continue;
      const auto [unit, size] = shown_unit(observed[k].unit);
      if (chart.lines.empty())
        chart = chart_along(found, kind, "Solid where the motion is stable, dashed where it is not.",
                            is_lowest    ? "smallest in a period"
                            : is_highest ? "largest in a period"
                                         : "peak to peak",
                            unit);
      add_lines(found, chart, short_name(observed[k].name, kind), [&, k, scale = size](const OrbitAtValue& orbit) {
        const run::Excursion& excursion = orbit.excursions[k];
        return (is_lowest ? excursion.lowest : is_highest ? excursion.highest : excursion.peak_to_peak()) / scale;
      });
    }
    page.charts.push_back(std::move(chart));
  }
  CurveChart largest =
      chart_along(found, "Largest Floquet multiplier", "Small deviations grow where it is above 1.", "magnitude", "1");
  add_lines(found, largest, "largest", [](const OrbitAtValue& orbit) {
    return orbit.multipliers.empty() ? 0 : std::abs(orbit.multipliers.front());
  });
  page.charts.push_back(std::move(largest));
  CurveChart period = chart_along(found, "Period", "", "period", "ms");
  add_lines(found, period, "period", [](const OrbitAtValue& orbit) { return 1e3 * orbit.period; });
  page.charts.push_back(std::move(period));
}

CurvePage::Table bifurcations_table(const OrbitFindings& found) {
  CurvePage::Table table{"Where it changes",
                         "A multiplier crosses the unit circle: at a fold the branch turns back and the machine jumps; "
                         "at a torus a second frequency sets in.",
                         {{"what", found.parameter, "frequency"}, {"", found.unit, "Hz"}}};
  for (const run::BifurcationAt& at : found.branch.bifurcations)
    table.lines.push_back({bifurcation_word(at.kind), fmt::format("{:.6g}", at.value),
                           at.kind == Bifurcation::torus ? fmt::format("{:.4g}", at.frequency) : ""});
  return table;
}

CurvePage::Table orbits_table(const OrbitFindings& found) {
  CurvePage::Table table{
      "Orbits",
      "In the order in which they follow each other: extremes over a period, largest multiplier, "
      "growth of small deviations.",
      {{found.parameter, "period", "multiplier", "growth", "stable"}, {found.unit, "ms", "1", "1/s", ""}}};
  for (const run::ObservedQuantity& quantity : found.branch.observed)
    for (const char* extreme : {"lowest", "highest"}) {
      table.lines[0].push_back(fmt::format("{} {}", quantity.name, extreme));
      table.lines[1].push_back(shown_unit(quantity.unit).first);
    }
  for (const OrbitAtValue& orbit : found.branch.orbits) {
    std::vector<std::string> row{
        fmt::format("{:.6g}", orbit.value), fmt::format("{:.5g}", 1e3 * orbit.period),
        orbit.multipliers.empty() ? "-" : fmt::format("{:.4f}", std::abs(orbit.multipliers.front())),
        fmt::format("{:.4g}", growth_of(orbit)), orbit.is_stable() ? "yes" : "no"};
    for (std::size_t k = 0; k < orbit.excursions.size(); ++k) {
      const double size = shown_unit(found.branch.observed[k].unit).second;
      row.push_back(fmt::format("{:.4g}", orbit.excursions[k].lowest / size));
      row.push_back(fmt::format("{:.4g}", orbit.excursions[k].highest / size));
    }
    table.lines.push_back(std::move(row));
  }
  return table;
}

std::vector<CurvePage::Table> tables_of_orbits(const OrbitFindings& found) {
  std::vector<CurvePage::Table> tables;
  if (!found.branch.bifurcations.empty()) tables.push_back(bifurcations_table(found));
  tables.push_back(orbits_table(found));
  return tables;
}

}  // namespace

json orbits_json(const OrbitFindings& found, const std::string& file) {
  json all{{"model", file},           {"parameter", found.parameter},
           {"unit", found.unit},      {"message", found.branch.message},
           {"orbits", json::array()}, {"bifurcations", json::array()}};
  for (const OrbitAtValue& orbit : found.branch.orbits) {
    json one{{"value", orbit.value},
             {"period", orbit.period},
             {"is_stable", orbit.is_stable()},
             {"periods_run", orbit.periods},
             {"multipliers", json::array()}};
    for (const std::complex<double>& multiplier : orbit.multipliers)
      one["multipliers"].push_back({{"re", multiplier.real()}, {"im", multiplier.imag()}});
    for (std::size_t k = 0; k < orbit.excursions.size(); ++k)
      one["quantities"][found.branch.observed[k].name] = {{"lowest", orbit.excursions[k].lowest},
                                                          {"highest", orbit.excursions[k].highest}};
    all["orbits"].push_back(std::move(one));
  }
  for (const run::BifurcationAt& at : found.branch.bifurcations) {
    json one{{"kind", bifurcation_word(at.kind)}, {"value", at.value}, {"behind", at.behind}};
    if (at.kind == Bifurcation::torus) one["frequency"] = at.frequency;
    all["bifurcations"].push_back(std::move(one));
  }
  for (const run::ObservedQuantity& quantity : found.branch.observed) all["units"][quantity.name] = quantity.unit;
  return all;
}

std::string orbits_text(const OrbitFindings& found) {
  return text_of(tables_of_orbits(found)) + "\n" + found.branch.message + "\n";
}

CurvePage orbits_page(const OrbitFindings& found, const model::Model& model, const std::string& file) {
  CurvePage page;
  page.title = model.title.empty() ? file : model.title;
  page.lead = model.description;
  page.facts = {"orbits over " + found.parameter, found.branch.message, file, fmt::format("hersey {}", version())};
  add_charts(found, page);
  page.tables = tables_of_orbits(found);
  return page;
}

}  // namespace hersey::cli
