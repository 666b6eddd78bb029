#pragma once

#include <filesystem>
#include <string>

#include "commands.h"

namespace hersey::cli {

/// Requires results, a file of their own that may be written, and no option of loads, for an export of results into one
/// file. Its name must end in `ending`, by which its readers know what it is.
/// @throws InputError naming `option`
void require_results_target(const ExportArguments& arguments, const std::string& option,
                            const std::filesystem::path& target, const std::string& ending);

}  // namespace hersey::cli
