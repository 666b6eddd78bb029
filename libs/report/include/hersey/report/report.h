#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hersey::report {

/// One line of the closing table: a number in the units engineers use, and where or when it occurred.
struct SummaryRow {
  std::string run;    ///< by file or folder, different for each run of a table
  std::string group;  ///< a bearing, "contact NAME", "gear mesh NAME", "ring NAME", "modes", "run" or another part
  std::string name;   ///< e.g. "minimum film thickness (MOFT)"
  double value = 0;   ///< in `unit`
  std::string unit;   ///< e.g. "µm"; "" for a pure number
  std::string where;  ///< e.g. "t = 12.35 ms, φ = 173.2°, z = 0.00 mm"; may be empty
};

/// The numbers an engineer asks for first, from every row of the results files (definitions: docs/results-file.md).
/// @param names of the runs, one each and all different; empty: by their files and folders.
/// @throws results::ReadError if a file cannot be read.
/// @verified_by summary_test.cpp
[[nodiscard]] std::vector<SummaryRow> summary_table(const std::vector<std::filesystem::path>& results,
                                                    const std::vector<std::string>& names = {});

/// The same as JSON, in SI: [{"run", "group", "name", "value", "unit", "where"}, ...].
[[nodiscard]] std::string summary_json(const std::vector<std::filesystem::path>& results,
                                       const std::vector<std::string>& names = {});

struct ReportOptions {
  std::string title;               ///< empty: the first file's title
  std::size_t series_rows = 4000;  ///< most rows of a time series shown per run; more are thinned evenly
  std::vector<std::string> names;  ///< of the runs, as for summary_table
  std::size_t field_bytes = std::size_t{4} << 20;  ///< most bytes of the films' fields in the page; else fewer instants
  std::size_t beside_bytes = std::size_t{256} << 20;  ///< most bytes of them in files beside it, read when asked for
  std::size_t series_bytes = std::size_t{32} << 20;   ///< most bytes for all time series together; else fewer rows
};

/// Writes one HTML file that shows a run, or several as a study: no network, no other file, any browser.
///
/// If the page contains only some instants of the films, all of them are stored beside it, in the folder OUT_fields
/// (OUT without its extension), a script for each film that the page loads at the press of a button. The page works
/// without them. Time series and fields are thinned to the options' limits (the page states it); the summary is
/// computed from every row. Fields have two bytes per number, accurate to 1/131068 of the range of their instant.
/// @throws results::ReadError if a results file cannot be read; results::WriteError if `out` cannot be written.
/// @pre results is not empty.
/// @verified_by report_test.cpp, tests/report_browser
void write_html(const std::vector<std::filesystem::path>& results, const std::filesystem::path& out,
                const ReportOptions& options = {});

}  // namespace hersey::report
