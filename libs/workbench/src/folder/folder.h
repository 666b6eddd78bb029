#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "hersey/workbench/refused.h"

namespace hersey::workbench {

struct FileEntry {
  std::string path;  ///< relative to the folder
  std::string kind;  ///< model, mesh, table, results, report, text or other
  std::uintmax_t size = 0;
  double changed = 0;  ///< seconds since 1970
};

/// Content of a file with the mark by which changes of it are noticed.
struct FileText {
  std::string text;
  std::string etag;  ///< quoted, as HTTP wants it
};

/// The file has been changed by someone else since its text was read.
struct ChangedFile {
  FileText now;
};

/// The files of one folder: nothing outside of it is read or written, under whatever name. A file is replaced as a
/// whole or not at all.
/// @verified_by folder_test.cpp
class Folder {
 public:
  /// @throws std::runtime_error if it is no folder that can be read
  explicit Folder(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Where a file of the folder is, links followed; it need not exist.
  /// @param relative  with slashes; refused (403) if it is absolute, hidden, has `..` or control characters, or leads
  ///                  out of the folder
  [[nodiscard]] std::filesystem::path resolve(const std::string& relative) const;

  /// Files down to four folders deep, hidden ones left out, at most 2000, by name.
  [[nodiscard]] std::vector<FileEntry> list() const;
  /// @throws Refused 404 where there is none, 413 above the size that pages edit, 415 if it is not UTF-8
  [[nodiscard]] FileText read(const std::string& relative) const;
  /// Replaces a file whose content still has the mark `etag`, through a temporary file beside it.
  /// @returns the new mark @throws ChangedFile if the content differs; Refused 507 on a full disk, 403 where nothing
  /// may be written; the old file is whole then
  std::string replace(const std::string& relative, const std::string& text, const std::string& etag);
  /// A page of the folder, to be shown as a report is. @throws Refused 422 for other files, 404 where there is none
  [[nodiscard]] std::filesystem::path page(const std::string& relative) const;
  /// Writes a file that does not exist. @returns its mark @throws ChangedFile if it exists; Refused as `replace`
  std::string create(const std::string& relative, const std::string& text);

 private:
  struct KnownKind {
    std::uintmax_t size = 0;
    double changed = 0;
    std::string kind;
  };
  [[nodiscard]] std::string kind_of(const std::filesystem::path& file, const FileEntry& entry) const;

  std::filesystem::path path_;
  std::mutex writing_;
  mutable std::mutex kinds_mutex_;
  mutable std::map<std::string, KnownKind> kinds_;  // of files that are opened to find out
};

}  // namespace hersey::workbench
