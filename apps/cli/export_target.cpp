#include "export_target.h"

#include "hersey/core/input_error.h"
#include "hersey/session/output_file.h"
#include "run_stress.h"

namespace hersey::cli {
namespace {

[[noreturn]] void refuse_target(const std::string& option, std::string found, std::string expected) {
  throw InputError(Fault{{"", 0, 0}, option, std::move(found), std::move(expected), ""});
}

}  // namespace

void require_results_target(const ExportArguments& arguments, const std::string& option,
                            const std::filesystem::path& target) {
  if (!arguments.overrides.empty())
    refuse_target("--set", "what is exported are results of a run as it was",
                  "another run with this, then its results");
  if (!is_results_file(arguments.file))
    refuse_target("FILE", "'" + arguments.file + "' is no results file (.h5)", "results of a run, for " + option);
  if (!arguments.loads.output.empty())
    refuse_target("--output", "it is a folder for loads", "the file that " + option + " names, alone");
  session::require_separate({{option, target}}, {arguments.file});
  if (!arguments.force && std::filesystem::exists(target))
    refuse_target(option, target.string() + " exists", "a new file, or --force to replace it");
}

}  // namespace hersey::cli
