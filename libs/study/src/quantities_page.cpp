#include "hersey/study/quantities_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "hersey/bearing/quantities.h"
#include "hersey/run/quantities.h"
#include "hersey/study/bearing_study.h"

namespace hersey::study {
namespace {

constexpr const char* kIntroduction = R"md(# Quantities of a bearing

`hersey schema --quantities` makes this page from the table by which the program names what it reports of a bearing. An
id means the same, in the same unit, wherever it is printed:

- *steady*: `hersey bearing` on the screen, with `--json` and `--csv`, its sensitivities, and `solution["h_min"]` in
  [Python](python.md).
- *run*: the series `/bearings/<bearing>/<id>` of the [results file](results-file.md), which
  [figures of a study](studies.md), Python and, for single numbers, the outputs of an [FMU](fmu.md) draw from.

Units are those of JSON, CSV in SI, results files and Python; the screen shows µm, MPa and degrees. The results file's
page lists what other things (bodies, joints, forces) report, and the extremes of each cycle.
)md";

/// Names of the series that a run writes of a bearing.
std::vector<std::string> ids_of_runs() {
  std::vector<std::string> ids;
  for (const run::QuantityInfo& quantity : run::quantities_of("/bearings/<b>/")) ids.push_back(quantity.name);
  return ids;
}

std::string mark(const std::vector<std::string>& ids, std::string_view id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end() ? "yes" : "";
}

std::string code(std::string_view text) { return text.empty() ? "" : fmt::format("`{}`", text); }

/// `|` would end the cell of a table.
std::string cell(std::string text) {
  for (std::size_t bar = text.find('|'); bar != std::string::npos; bar = text.find('|', bar + 2))
    text.insert(bar, "\\");
  return text;
}

}  // namespace

std::string quantities_markdown() {
  const std::vector<std::string> steady = figure_keys(), runs = ids_of_runs();
  std::string page = kIntroduction;
  for (const bearing::QuantityList& list : bearing::bearing_quantities()) {
    page += fmt::format("\n## {}\n\n| id | symbol | unit | what it is | steady | run |\n|---|---|---|---|---|---|\n",
                        list.heading);
    for (const bearing::Quantity& q : list.quantities)
      page += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(q.id), code(q.symbol), q.unit, cell(q.definition()),
                          mark(steady, q.id), mark(runs, q.id));
  }
  return page;
}

}  // namespace hersey::study
