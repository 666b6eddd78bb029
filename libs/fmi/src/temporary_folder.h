#pragma once

#include <filesystem>

namespace hersey::fmi {

/// A folder for this program alone, which vanishes with the object. Folders of programs that have been killed or have
/// crashed vanish as the next one is made by the same user. What they hold is locked while its program lives, wherever
/// that runs: the number of a process says nothing in a container that shares the folder of temporary files.
/// @verified_by temporary_folder_test.cpp
class TemporaryFolder {
 public:
  /// @throws std::filesystem::filesystem_error
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace hersey::fmi
