#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hersey::report {

/// Returns names for the runs of these results files: the name of the file, or of its folder if all files have the same
/// name (results.h5), with as many parent folders as make it unique, "monday/rigid" and "tuesday/rigid". A file that is
/// given twice gets a number.
/// @param given names to use instead; none: the derived ones.
/// @returns one name for each run, all of them different.
/// @pre there are no names given, or one for each run and all different.
[[nodiscard]] std::vector<std::string> run_names(const std::vector<std::filesystem::path>& results,
                                                 const std::vector<std::string>& given = {});

}  // namespace hersey::report
