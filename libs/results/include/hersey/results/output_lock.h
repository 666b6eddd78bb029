#pragma once

#include <filesystem>

#include "hersey/results/error.h"

namespace hersey::results {

/// Another run is writing the file.
class FileBusy : public FileError {
 public:
  using FileError::FileError;
};

/// Holds a results file for the run that writes it, from before its first byte until after its last. The system's lock
/// is on the file FILE.lock beside it and goes with the process that holds it: what a killed run leaves of it blocks
/// nobody. Where the file system has no locks nothing is held.
/// @verified_by output_lock_test.cpp
class OutputLock {
 public:
  /// Holds nothing.
  OutputLock() = default;
  /// @param results  empty: holds nothing
  /// @throws FileBusy where another run holds it, of this process or of another one
  explicit OutputLock(const std::filesystem::path& results);
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;
  /// Gives it back.
  ~OutputLock();

 private:
  std::filesystem::path lock_;
  int fd_ = -1;
};

/// @throws FileBusy where a run holds the file.
void require_idle(const std::filesystem::path& results);

}  // namespace hersey::results
