#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "hersey/core/contract.h"
#include "hersey/report/report.h"
#include "report_page.h"
#include "run_data.h"
#include "summary.h"

namespace hersey::report {
namespace {

using nlohmann::json;

constexpr std::size_t fewest_series_rows = 300;  // still a smooth curve on a screen

json page_data(const std::vector<std::filesystem::path>& results, const ReportOptions& options) {
  const Budget budget{std::max(fewest_series_rows, options.series_rows / results.size()),
                      options.field_bytes / results.size()};
  json data;
  data["runs"] = json::array();
  for (const auto& path : results) {
    const results::Reader reader(path);
    json run = run_data(reader, budget);
    run["summary"] = json::array();
    for (const SummaryRow& row : summarise(reader))
      run["summary"].push_back(
          {{"group", row.group}, {"name", row.name}, {"value", row.value}, {"unit", row.unit}, {"where", row.where}});
    data["runs"].push_back(std::move(run));
  }
  data["title"] = options.title;
  return data;
}

/// Inside a script element only "<" could end it or start a comment; JSON may spell it as an escape.
std::string script_safe(const std::string& text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace

void write_html(const std::vector<std::filesystem::path>& results, const std::filesystem::path& out,
                const ReportOptions& options) {
  HERSEY_REQUIRE(!results.empty(), "a report shows at least one run");
  HERSEY_REQUIRE(options.series_rows > 0, "a report shows at least one row");
  static constexpr std::string_view slot = R"(<script id="hersey-data" type="application/json"></script>)";
  const std::string_view page = report_page();
  const std::size_t at = page.find(slot);
  HERSEY_REQUIRE(at != std::string_view::npos, "the page has a place for its data");
  const std::size_t end_of_opening = at + slot.find("</script>");

  // Text in a results file may hold any bytes: what is not UTF-8 is replaced, not refused.
  const std::string data =
      script_safe(page_data(results, options).dump(-1, ' ', false, json::error_handler_t::replace));
  std::ofstream file(out, std::ios::binary);
  file << page.substr(0, end_of_opening) << data << page.substr(end_of_opening);
  file.close();
  if (!file) throw results::WriteError(out, std::string("cannot write the report: ") + std::strerror(errno));
}

}  // namespace hersey::report
