#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hersey::report {

/// What to call the runs of these results files: each by its file, or by its folder where the file has the name that
/// every run's has (results.h5); with as many folders before it as tell it from the others, "monday/rigid" and
/// "tuesday/rigid". A file that is given twice gets a number.
/// @param given names to take instead; none: these.
/// @returns a name each, all of them different.
/// @pre there are no names given, or one for each run and all different.
[[nodiscard]] std::vector<std::string> run_names(const std::vector<std::filesystem::path>& results,
                                                 const std::vector<std::string>& given = {});

}  // namespace hersey::report
