#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace hersey::results {

/// A fault of a results file: what() contains the file and the reason, path() the file.
class FileError : public std::runtime_error {
 public:
  /// what() is "path: reason".
  FileError(std::filesystem::path path, const std::string& reason)
      : std::runtime_error(path.string() + ": " + reason), path_(std::move(path)), reason_(reason) {}
  /// The file.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// The reason without the name of the file.
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::filesystem::path path_;
  std::string reason_;
};

/// The file to be written exists already and was left untouched.
class FileExists : public FileError {
 public:
  /// Constructs the error for the file at `path`.
  explicit FileExists(std::filesystem::path path)
      : FileError(std::move(path), "the results file exists already and was kept") {}
};

/// Rows could not be written (disk full, no permission, a file size limit). All rows flushed before stay readable.
class WriteError : public FileError {
 public:
  using FileError::FileError;
};

/// A file is missing, is not a results file of this program, or lacks the requested data.
class ReadError : public FileError {
 public:
  using FileError::FileError;
};

}  // namespace hersey::results
