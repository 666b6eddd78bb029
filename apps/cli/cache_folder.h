#pragma once

#include <filesystem>

namespace hersey::cli {

/// Where this user's programs keep what takes long to compute and can always be computed again: HERSEY_CACHE, else
/// hersey/ in XDG_CACHE_HOME or ~/.cache. Empty with HERSEY_CACHE=off, or where there is no home.
[[nodiscard]] std::filesystem::path cache_folder();

}  // namespace hersey::cli
