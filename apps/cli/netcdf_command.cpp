#include <fmt/format.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "exit_code.h"
#include "export_target.h"
#include "hersey/core/version.h"
#include "hersey/results/netcdf_file.h"

namespace hersey::cli {
namespace {

/// A line of a file's history, which begins with the time.
std::string history_line() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[sizeof "2026-01-31T12:34:56Z"];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return fmt::format("{} hersey export --netcdf ({})", text, version());
}

}  // namespace

int netcdf_command(const ExportArguments& arguments) {
  require_results_target(arguments, "--netcdf", arguments.netcdf, ".nc");
  const results::Reader results(arguments.file);
  const results::NetcdfSummary summary = results::write_netcdf(results, arguments.netcdf, history_line());
  if (arguments.json) {
    const nlohmann::json document{{"file", arguments.netcdf.string()},
                                  {"conventions", results::cf_conventions},
                                  {"variables", summary.variables},
                                  {"left_out", summary.left_out}};
    fmt::print("{}\n", document.dump(2));
    return kOk;
  }
  fmt::print("conventions       {}\nvariables         {}\n", results::cf_conventions, summary.variables);
  for (const std::string& path : summary.left_out)
    fmt::print("left out          {}: its columns have different units\n", path);
  fmt::print("wrote             {}\n", arguments.netcdf.string());
  return kOk;
}

}  // namespace hersey::cli
