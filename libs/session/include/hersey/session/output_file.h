#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hersey::session {

/// A file that a client writes.
struct OutputFile {
  std::string option;          ///< that names it
  std::filesystem::path path;  ///< empty: it is not asked for
};

/// Refuses to overwrite an input file, under whatever name (another path, a symbolic or a hard link), or to write two
/// outputs into one file.
/// @throws InputError naming option and file.
void require_separate(const std::vector<OutputFile>& outputs, const std::vector<std::filesystem::path>& inputs);

}  // namespace hersey::session
