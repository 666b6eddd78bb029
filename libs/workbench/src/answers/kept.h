#pragma once

#include <filesystem>
#include <string>

#include "hersey/workbench/answers.h"

namespace hersey::workbench {

/// What is kept from one answer to the next.
struct Answers::Impl {
  explicit Impl(std::filesystem::path root) : root_(std::filesystem::absolute(root).lexically_normal()) {
    if (!root_.has_filename()) root_ = root_.parent_path();  // "folder/"
  }

  [[nodiscard]] std::string folder() const { return root_.string(); }
  /// The file that a request names. @throws Refused with the status 403 for one outside the folder
  [[nodiscard]] std::string file(const std::string& path) const;

 private:
  std::filesystem::path root_;
};

}  // namespace hersey::workbench
