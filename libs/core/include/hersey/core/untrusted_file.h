#pragma once

namespace hersey {

/// Returns the path of the HDF5 file that this thread is reading and whose integrity is not verified; null if there is
/// none. HDF5 trusts the structure that a file declares, so that a damaged file may crash the library; handlers of the
/// crash name this file. Safe in signal handlers.
[[nodiscard]] const char* untrusted_file();

/// Marks a file as the untrusted one of this thread as long as the object exists.
class UntrustedFile {
 public:
  /// @param path  must outlive the object; null leaves the present mark unchanged
  explicit UntrustedFile(const char* path);
  UntrustedFile(const UntrustedFile&) = delete;
  UntrustedFile& operator=(const UntrustedFile&) = delete;
  ~UntrustedFile();

 private:
  const char* before_;
};

/// Returns the path of the file whose code this thread runs, a library that others have made; null if there is none.
/// Handlers of a crash name it. Safe in signal handlers.
[[nodiscard]] const char* foreign_code();

/// Marks calls of a library that others have made as long as the object exists.
class ForeignCode {
 public:
  /// @param path  of its file, must outlive the object
  explicit ForeignCode(const char* path);
  ForeignCode(const ForeignCode&) = delete;
  ForeignCode& operator=(const ForeignCode&) = delete;
  ~ForeignCode();
};

}  // namespace hersey
