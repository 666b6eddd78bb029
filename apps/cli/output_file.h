#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::cli {

/// A file that a command writes.
struct OutputFile {
  std::string option;          ///< that names it
  std::filesystem::path path;  ///< empty: it is not asked for
};

/// Refuses to overwrite an input file, under whatever name (another path, a symbolic or a hard link), or to write two
/// outputs into one file.
/// @throws InputError naming option and file.
void require_separate(const std::vector<OutputFile>& outputs, const std::vector<std::filesystem::path>& inputs);

/// A model's own file and all that it names.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const model::Model& model);

}  // namespace hersey::cli
