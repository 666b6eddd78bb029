#include "hersey/report/curve_page.h"

#include <fmt/format.h>

#include <stdexcept>

#include "hersey/core/write_file.h"
#include "hersey/results/error.h"
#include "svg_chart.h"

namespace hersey::report {
namespace {

// Colours and letters of the report of a run (web/src/style.css).
constexpr const char* style = R"(
:root { --ink: #1b1f24; --soft: #5a6470; --line: #e6e8eb; --paper: #ffffff; --ground: #f6f6f3; color-scheme: light dark;
  --s0: #1f65a7; --s1: #d2691e; --s2: #2a8f6d; --s3: #8e5aa8; --s4: #b08900; --s5: #5b6b7b; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e7ea; --soft: #a3adb8; --line: #2b3138; --paper: #171b20;
  --ground: #101317; --s0: #6fb1ee; --s1: #f0a060; --s2: #66cdaa; --s3: #c79be0; --s4: #e0c04c; --s5: #a3b1bf; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); font-variant-numeric: tabular-nums;
  font: 15px/1.5 "Inter", system-ui, -apple-system, "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1240px; margin: 0 auto; padding: 36px 28px; }
h1 { font: 600 30px/1.2 "Source Serif 4", Charter, Cambria, Georgia, serif; margin: 0 0 6px; }
h2 { font-size: 16px; margin: 0 0 2px; }
p { margin: 0; } .lead { max-width: 75ch; } .facts, .note { color: var(--soft); font-size: 13px; }
.charts { display: grid; gap: 18px; grid-template-columns: repeat(auto-fit, minmax(min(460px, 100%), 1fr)); margin: 24px 0; }
section { background: var(--paper); border: 1px solid var(--line); border-radius: 8px; padding: 16px 18px; min-width: 0; }
svg { width: 100%; height: auto; display: block; margin-top: 8px; }
.grid { stroke: var(--line); } .frame { fill: none; stroke: var(--soft); stroke-width: 0.8; }
.tick, .axis, .label { font-size: 12px; fill: var(--soft); } .axis { fill: var(--ink); }
.line { fill: none; stroke-width: 2; stroke-linejoin: round; } .dot { fill: transparent; }
.dashed { stroke-dasharray: 6 4; } .mark { fill: var(--ink); }
.dot:hover { fill: currentColor; fill-opacity: 0.6; }
.c0 { stroke: var(--s0); color: var(--s0); } .c1 { stroke: var(--s1); color: var(--s1); }
.c2 { stroke: var(--s2); color: var(--s2); } .c3 { stroke: var(--s3); color: var(--s3); }
.c4 { stroke: var(--s4); color: var(--s4); } .c5 { stroke: var(--s5); color: var(--s5); }
.dot, .label { stroke: none; } .label { fill: currentColor; font-weight: 600; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 4px 18px; margin: 18px 0 0; }
dt { color: var(--soft); } dd { margin: 0; }
.wide { overflow-x: auto; } table { border-collapse: collapse; width: 100%; }
th, td { padding: 4px 10px; text-align: right; white-space: nowrap; } th { font-weight: 600; }
thead tr + tr th { color: var(--soft); font-weight: 400; border-bottom: 1px solid var(--soft); padding-bottom: 6px; }
tbody tr + tr td { border-top: 1px solid var(--line); }
)";

/// Units as they are printed.
std::string typeset(std::string text) {
  const std::vector<std::pair<std::string, std::string>> words{
      {"^2", "²"}, {"^3", "³"}, {"degC", "°C"}, {"mPa.s", "mPa·s"}};
  for (const auto& [from, to] : words)
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  return escaped(text);
}

std::string row_of(const std::vector<std::string>& cells, const char* element) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) row += fmt::format("<{0}>{1}</{0}>", element, typeset(cell));
  return row + "</tr>";
}

std::string table_of(const std::vector<std::vector<std::string>>& lines, const std::string& heading = "") {
  if (lines.size() < 2) return heading.empty() ? "" : "<section class=\"wide\">" + heading + "</section>";
  std::string table =
      "<section class=\"wide\">" + heading + "<table><thead>" + row_of(lines[0], "th") + row_of(lines[1], "th");
  table += "</thead><tbody>";
  for (std::size_t k = 2; k < lines.size(); ++k) table += row_of(lines[k], "td");
  return table + "</tbody></table></section>";
}

std::string chart_of(const CurveChart& chart) {
  return fmt::format("<section><h2>{}</h2><p class=\"note\">{}</p>{}</section>", escaped(chart.title),
                     escaped(chart.note), svg_of(chart));
}

}  // namespace

void write_html(const CurvePage& page, const std::filesystem::path& out) {
  std::string body =
      fmt::format("<h1>{}</h1><p class=\"lead\">{}</p><p class=\"facts\">{}</p><dl>", escaped(page.title),
                  escaped(page.lead), typeset(fmt::format("{}", fmt::join(page.facts, " · "))));
  for (const auto& [name, text] : page.conditions)
    body += fmt::format("<dt>{}</dt><dd>{}</dd>", escaped(name), typeset(text));
  body += "</dl><div class=\"charts\">";
  for (const CurveChart& chart : page.charts) body += chart_of(chart);
  body += "</div>" + table_of(page.table);
  for (const CurvePage::Table& table : page.tables)
    body += table_of(table.lines,
                     fmt::format("<h2>{}</h2><p class=\"note\">{}</p>", escaped(table.title), escaped(table.note)));
  const std::string head = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><title>{} · hersey</title><style>",
      escaped(page.title));
  try {
    write_file(out, {head, style, "</style></head><body><main>", body, "</main></body></html>\n"});
  } catch (const std::runtime_error& error) {
    throw results::WriteError(out, std::string("cannot write the report: ") + error.what());
  }
}

}  // namespace hersey::report
