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

/// Refuses files that could not be written, before anything is computed for them: in a folder that is missing or
/// read-only, or over a file that is. Nothing is written.
/// @throws InputError naming option, file and reason.
void require_writable(const std::vector<OutputFile>& outputs);

}  // namespace hersey::session
