#pragma once

#include <filesystem>

#include "hersey/results/error.h"

namespace hersey::results {

/// Another run is writing the file.
class FileBusy : public FileError {
 public:
  using FileError::FileError;
};

/// Locks a results file for the run that writes it, from before its first byte until after its last. The system's lock
/// is on the file FILE.lock beside it and ends with its process: the lock file of a killed run blocks nobody. On a file
/// system without locks nothing is locked.
/// @verified_by output_lock_test.cpp
class OutputLock {
 public:
  /// Locks nothing.
  OutputLock() = default;
  /// @param results  empty: nothing is locked
  /// @throws FileBusy if another run has the lock, of this process or of another one
  explicit OutputLock(const std::filesystem::path& results);
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;
  /// Gives it back.
  ~OutputLock();

 private:
  std::filesystem::path lock_;
  int fd_ = -1;
};

/// @throws FileBusy if a run has locked the file.
void require_idle(const std::filesystem::path& results);

}  // namespace hersey::results
