#pragma once

#include <string>

#include "commands.h"

namespace hersey::cli {

/// True if a file's name ends as those of results do, .h5 or .hdf5.
[[nodiscard]] bool is_results_file(const std::string& file);

/// Refuses what only means something with results. @throws InputError
void require_no_run_options(const SolidArguments& arguments);

}  // namespace hersey::cli
