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
namespace {

void require_one_export(const ExportArguments& arguments) {
  const char* const expected =
      "`--fmu FILE.fmu` or `--ssp FILE.ssp` with a model, or with results one of `--loads calculix|nastran|vtkhdf`, "
      "`--films FILE.vtkhdf` "
      "and `--netcdf FILE.nc`";
  std::vector<std::string> asked;
  if (!arguments.fmu.empty()) asked.emplace_back("--fmu");
  if (!arguments.ssp.empty()) asked.emplace_back("--ssp");
  if (!arguments.loads.format.empty()) asked.emplace_back("--loads");
  if (!arguments.films.empty()) asked.emplace_back("--films");
  if (!arguments.netcdf.empty()) asked.emplace_back("--netcdf");
  if (asked.empty()) throw InputError(Fault{{"", 0, 0}, "hersey export", "nothing is asked for", expected, ""});
  if (asked.size() > 1) throw InputError(Fault{{"", 0, 0}, asked[0], "it stands beside " + asked[1], expected, ""});
  if (!arguments.surface.empty() && arguments.films.empty())
    throw InputError(Fault{{"", 0, 0}, "--surface", "it stands without --films", "--films FILE.vtkhdf with it", ""});
}

}  // namespace

// Another program does it: this one needs neither a library for archives nor that of the FMU.
int export_command(const ExportArguments& arguments) {
  require_one_export(arguments);
  if (!arguments.loads.format.empty()) return loads_command(arguments);
  if (!arguments.films.empty()) return films_command(arguments);
  if (!arguments.netcdf.empty()) return netcdf_command(arguments);
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
