#pragma once

#include <filesystem>

namespace hersey::workbench {

/// A folder for one question to another program, gone with it.
class TemporaryFolder {
 public:
  /// @throws Refused 507 if there is no room for it
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] std::filesystem::path file(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace hersey::workbench
