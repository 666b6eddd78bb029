#include "export_target.h"

#include <utility>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/session/output_file.h"
#include "run_stress.h"

namespace hersey::cli {
namespace {

[[noreturn]] void refuse_target(const std::string& option, std::string found, std::string expected) {
  throw InputError(Fault{{"", 0, 0}, option, std::move(found), std::move(expected), ""});
}

/// Options that were given, and mean nothing without loads; films may be chosen as theirs are.
std::vector<const char*> options_of_loads(const LoadsArguments& loads, bool may_choose) {
  const std::vector<std::pair<const char*, bool>> options{{"--output", !loads.output.empty()},
                                                          {"--body", !loads.body.empty()},
                                                          {"--bearing", !loads.bearings.empty() && !may_choose},
                                                          {"--instant", !loads.instants.empty() && !may_choose},
                                                          {"--hold", !loads.hold.empty()},
                                                          {"--mesh", !loads.mesh.empty()},
                                                          {"--conductivity", !loads.conductivity.empty()},
                                                          {"--expansion", !loads.expansion.empty()},
                                                          {"--temperature", !loads.temperature.empty()},
                                                          {"--cooling", !loads.cooling.empty()},
                                                          {"--model", !loads.model_file.empty()}};
  std::vector<const char*> given;
  for (const auto& [name, is_given] : options)
    if (is_given) given.push_back(name);
  return given;
}

}  // namespace

void require_results_target(const ExportArguments& arguments, const std::string& option,
                            const std::filesystem::path& target, const std::string& ending) {
  if (!arguments.overrides.empty())
    refuse_target("--set", "what is exported are results of a run as it was",
                  "another run with this, then its results");
  if (!is_results_file(arguments.file))
    refuse_target("FILE", "'" + arguments.file + "' is no results file (.h5)", "results of a run, for " + option);
  for (const char* name : options_of_loads(arguments.loads, option == "--films"))
    refuse_target(name, "it stands with " + option, "it with --loads alone");
  if (target.extension() != ending)
    refuse_target(option, "'" + target.string() + "'", "a name that ends in " + ending + ": readers go by it");
  session::require_separate({{option, target}}, {arguments.file});
  session::require_writable({{option, target}});
  if (!arguments.force && std::filesystem::exists(target))
    refuse_target(option, target.string() + " exists", "a new file, or --force to replace it");
}

}  // namespace hersey::cli
