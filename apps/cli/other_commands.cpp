#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.h"
#include "exit_code.h"
#include "fault_json.h"
#include "hersey/core/input_error.h"
#include "hersey/core/write_file.h"
#include "hersey/model/read.h"
#include "hersey/model/schema.h"
#include "hersey/report/latest_film.h"
#include "hersey/report/report.h"
#include "hersey/results/reader.h"
#include "hersey/run/quantities.h"
#include "hersey/session/output_file.h"
#include "hersey/session/session.h"
#include "hersey/study/quantities_page.h"
#include "standard_streams.h"
#include "table.h"

namespace hersey::cli {
namespace {

std::string contents(const model::Model& model, std::size_t runs) {
  return fmt::format("{} bodies, {} joints, {} drives, {} forces, {} bearings, {} {}", model.bodies.size(),
                     model.joints.size(), model.drives.size(), model.forces.size(), model.bearings.size(), runs,
                     runs == 1 ? "run" : "runs");
}

/// One for each file, and no two the same.
void require_names(const ReportArguments& arguments) {
  const std::vector<std::string>& names = arguments.names;
  if (names.empty()) return;
  if (names.size() != arguments.results.size())
    throw InputError(Fault{{"--names", 0, 0},
                           "",
                           fmt::format("names: {}, results files: {}", names.size(), arguments.results.size()),
                           "a name for each file, with commas between them",
                           ""});
  for (auto name = names.begin(); name != names.end(); ++name)
    if (name->empty() || std::find(names.begin(), name, *name) != name)
      throw InputError(Fault{{"--names", 0, 0},
                             "",
                             name->empty() ? "an empty name" : "'" + *name + "' twice",
                             "names that distinguish the runs",
                             ""});
}

/// @throws InputError for files of other commands, whose pages these write themselves
void require_runs(const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files)
    if (const std::optional<std::string> kind = results::Reader(file).text_attribute("/", "kind"))
      throw InputError(Fault{{file.string(), 0, 0},
                             "",
                             "results of another kind: " + *kind,
                             "results of `hersey run`",
                             "`hersey rotor --report` writes the page of a rotor"});
}

}  // namespace

void warn(const std::vector<Fault>& warnings) {
  for (const Fault& warning : warnings) say("warning: {}\n", warning.text());
}

int check_command(const CheckArguments& arguments) {
  if (arguments.expanded) {
    fmt::print("{}", model::expanded_text(arguments.model, arguments.overrides));
    return kOk;
  }
  nlohmann::json document{
      {"model", arguments.model}, {"faults", nlohmann::json::array()}, {"warnings", nlohmann::json::array()}};
  try {
    const session::Session session(arguments.model, arguments.overrides);
    const session::Check check = session.check();
    for (const Fault& warning : check.warnings) document["warnings"].push_back(fault_json(warning));
    if (!arguments.json) {
      warn(check.warnings);
      fmt::print("{}: good ({})\n", arguments.model, contents(session.model(), check.runs));
    }
  } catch (const InputError& error) {
    if (!arguments.json) throw;
    for (const Fault& fault : error.faults()) document["faults"].push_back(fault_json(fault));
    fmt::print("{}\n", document.dump(2));
    return kWrongInput;
  }
  if (arguments.json) fmt::print("{}\n", document.dump(2));
  return kOk;
}

int report_command(const ReportArguments& arguments) {
  require_runs(arguments.results);
  const std::filesystem::path page =
      arguments.output.empty() ? arguments.results.front().parent_path() / "report.html" : arguments.output;
  require_names(arguments);
  session::require_separate({{"--output", page}}, arguments.results);
  report::write_html(arguments.results, page, {.names = arguments.names});
  if (arguments.json) {
    fmt::print("{}\n", report::summary_json(arguments.results, arguments.names));
    return kOk;
  }
  const std::vector<report::SummaryRow> rows = report::summary_table(arguments.results, arguments.names);
  const std::string table = arguments.results.size() > 1 ? comparison_text(rows)
                            : arguments.all              ? summary_text(rows)
                                                         : screen_text(rows, "--all");
  fmt::print("{}\nreport: {}\n", table, page.string());
  return kOk;
}

int film_command(const FilmArguments& arguments) {
  const results::Reader reader(arguments.results);
  write_file(arguments.output, {report::latest_film_json(reader, arguments.bearing)});
  return kOk;
}

int schema_command(const SchemaArguments& arguments) {
  if (arguments.of_quantities)
    fmt::print("{}", study::quantities_markdown());
  else if (arguments.of_results)
    fmt::print("{}", arguments.markdown ? run::results_schema_markdown() : run::results_schema_json());
  else
    fmt::print("{}", arguments.markdown ? model::schema_markdown() : model::schema_json());
  return kOk;
}

}  // namespace hersey::cli
