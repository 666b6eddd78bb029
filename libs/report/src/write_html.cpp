#include <algorithm>
#include <nlohmann/json.hpp>

#include "hersey/core/contract.h"
#include "hersey/report/report.h"
#include "page_file.h"
#include "run_data.h"
#include "run_names.h"
#include "run_up.h"
#include "summary.h"

namespace hersey::report {
namespace {

using nlohmann::json;

constexpr std::size_t fewest_series_rows = 300;  // still a smooth curve on a screen

/// Folder beside a page with the fields that it loads on request.
std::filesystem::path folder_of_fields(const std::filesystem::path& out) {
  return out.parent_path() / (out.stem().string() + "_fields");
}

/// Writes all instants of the films of a run if the page contains only some, and returns their files for the page.
json fields_beside(const results::Reader& reader, const json& run, std::size_t index, std::size_t budget,
                   const std::filesystem::path& out) {
  json list = json::array();
  if (run["field_stride"] == 1) return list;
  const std::string bearings = "/bearings/";
  for (const std::string& group : reader.groups()) {
    if (!group.starts_with(bearings) || group.find('/', bearings.size()) != std::string::npos) continue;
    const std::string bearing = group.substr(bearings.size());
    const std::string time = group + "/fields/time";
    const json datasets = film_fields(reader, bearing, budget);
    if (!datasets.contains(time) || datasets[time]["shape"] == run["datasets"][time]["shape"]) continue;
    std::error_code exists_or_fails;  // the writing below reports a failure
    std::filesystem::create_directory(folder_of_fields(out), exists_or_fails);
    const std::filesystem::path file =
        folder_of_fields(out) / (std::to_string(index) + "_" + std::to_string(list.size()) + ".js");
    write_script("herseyFields", {{"run", run["name"]}, {"datasets", datasets}}, file);
    list.push_back({{"bearing", bearing},
                    {"file", (file.parent_path().filename() / file.filename()).generic_string()},
                    {"bytes", std::filesystem::file_size(file)},
                    {"instants", datasets[time]["shape"][0]}});
  }
  return list;
}

json page_data(const std::vector<std::filesystem::path>& results, const std::filesystem::path& out,
               const ReportOptions& options) {
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
    if (json run_up = run_up_data(reader); !run_up.is_null()) run["run_up"] = std::move(run_up);
    run["beside"] = fields_beside(reader, run, i, options.beside_bytes / results.size(), out);
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
  write_page(page_data(results, out, options), out);
}

}  // namespace hersey::report
