#pragma once

namespace hersey {

/// The file that this thread reads by HDF5 and that nothing vouches for, for whoever is told of a crash: the library
/// trusts what a file says of its structure. Null where there is none. Safe in signal handlers.
[[nodiscard]] const char* untrusted_file();

/// Names such a file as long as it lives.
class DoubtfulFile {
 public:
  /// @param path  kept by the caller; null: nothing is doubtful, and what is named stays named
  explicit DoubtfulFile(const char* path);
  DoubtfulFile(const DoubtfulFile&) = delete;
  DoubtfulFile& operator=(const DoubtfulFile&) = delete;
  ~DoubtfulFile();

 private:
  const char* before_;
};

}  // namespace hersey
