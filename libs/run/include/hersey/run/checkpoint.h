#pragma once

#include <filesystem>

namespace hersey::run {

/// Path of the checkpoint of a results file: results.checkpoint beside results.h5.
[[nodiscard]] std::filesystem::path checkpoint_file(const std::filesystem::path& results);

}  // namespace hersey::run
