#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hersey/model/model.h"

namespace hersey::fmu {

/// A file that the FMU takes along.
struct PackedFile {
  std::filesystem::path from;
  std::string name;  ///< in the archive
};

/// A model packed in an FMU: its text, overrides and the files it names, below resources/.
struct PackedModel {
  std::string text;
  std::vector<std::string> overrides;
  std::vector<PackedFile> files;
};

/// Files beside or below the model keep their names; others get one of their own, and the model names that.
/// @throws InputError where a file is named in a way that cannot be changed
[[nodiscard]] PackedModel pack(const model::Model& model, const std::string& text,
                               const std::vector<std::string>& overrides);

/// Returns the shared libraries that `library` needs besides those of every Linux, with the names by which it finds
/// them.
/// @throws std::runtime_error if one of them is missing
[[nodiscard]] std::vector<PackedFile> libraries_of(const std::filesystem::path& library);

/// Returns the licence texts of Debian's packages of these files, for the folder documentation/licenses; nothing if
/// files come from elsewhere.
[[nodiscard]] std::vector<PackedFile> licences_of(const std::vector<PackedFile>& files);

/// Writes a ZIP archive of texts and files; all of it or nothing.
/// @throws std::runtime_error where it cannot be written
void write_zip(const std::filesystem::path& path, const std::vector<std::pair<std::string, std::string>>& texts,
               const std::vector<PackedFile>& files);

}  // namespace hersey::fmu
