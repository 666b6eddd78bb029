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

}  // namespace hersey
