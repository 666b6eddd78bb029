#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "commands.h"
#include "exit_code.h"
#include "hersey/core/input_error.h"
#include "standard_streams.h"

namespace hersey::cli {

// Another program does it: this one needs neither a library for archives nor that of the FMU.
int export_command(const ExportArguments& arguments) {
  if (!arguments.loads.format.empty()) return loads_command(arguments);
  if (arguments.fmu.empty() && arguments.ssp.empty())
    throw InputError(Fault{{"", 0, 0},
                           "hersey export",
                           "neither an FMU nor loads are asked for",
                           "`--fmu FILE.fmu` or `--ssp FILE.ssp` with a model, or `--loads calculix|nastran|vtkhdf` "
                           "with results",
                           ""});
  std::vector<std::string> words{"hersey-fmu", arguments.file, "--fmi", std::to_string(arguments.fmi)};
  if (!arguments.fmu.empty()) words.insert(words.end(), {"--fmu", arguments.fmu.string()});
  if (!arguments.ssp.empty()) words.insert(words.end(), {"--ssp", arguments.ssp.string()});
  for (const std::string& change : arguments.overrides) words.insert(words.end(), {"--set", change});
  if (arguments.force) words.emplace_back("--force");
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::error_code ignored;
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path() / "hersey-fmu";
  ::execv(program.c_str(), pointers.data());
  const int reason = errno;
  say("hersey: {} cannot be started ({}): 'make fmu' builds it\n", program.string(), std::strerror(reason));
  return kFailed;
}

}  // namespace hersey::cli
