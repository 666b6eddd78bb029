#include <algorithm>
#include <nlohmann/json.hpp>

#include "hersey/core/contract.h"
#include "hersey/report/report.h"
#include "page_file.h"
#include "run_data.h"
#include "run_names.h"
#include "summary.h"

namespace hersey::report {
namespace {

using nlohmann::json;

constexpr std::size_t fewest_series_rows = 300;  // still a smooth curve on a screen

json page_data(const std::vector<std::filesystem::path>& results, const ReportOptions& options) {
  const Budget budget{std::max(fewest_series_rows, options.series_rows / results.size()),
                      options.field_bytes / results.size(), options.series_bytes / results.size()};
  json data;
  data["runs"] = json::array();
  const std::vector<std::string> names = run_names(results, options.names);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const results::Reader reader(results[i]);
    json run = run_data(reader, budget);
    run["name"] = names[i];
    run["summary"] = json::array();
    for (const SummaryRow& row : summarise(reader, names[i]))
      run["summary"].push_back(
          {{"group", row.group}, {"name", row.name}, {"value", row.value}, {"unit", row.unit}, {"where", row.where}});
    data["runs"].push_back(std::move(run));
  }
  data["title"] = options.title;
  return data;
}

}  // namespace

void write_html(const std::vector<std::filesystem::path>& results, const std::filesystem::path& out,
                const ReportOptions& options) {
  HERSEY_REQUIRE(!results.empty(), "a report shows at least one run");
  HERSEY_REQUIRE(options.series_rows > 0, "a report shows at least one row");
  write_page(page_data(results, options), out);
}

}  // namespace hersey::report
