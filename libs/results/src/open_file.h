#pragma once

#include <filesystem>
#include <string_view>

#include "hdf5_handle.h"
#include "reserving_driver.h"

namespace hersey::results {

/// The file of results as it is written.
struct OpenFile {
  std::filesystem::path path;
  DriverStatus status;
  Handle handle;

  /// Creates it. @throws FileExists, WriteError
  void open(bool overwrite);
  /// Throws one exception for a failed call or a failed driver.
  /// @throws WriteError
  void require(bool good, std::string_view what);
  /// @throws ContractError once it is finished, WriteError
  void require_open();
  /// Syncs flushed data to the disk.
  /// @throws WriteError
  void sync();
  /// Gives it another name, in one piece. @param replace  a file of that name; else @throws FileExists, WriteError
  void rename(const std::filesystem::path& to, bool replace);
  /// Closes the file, whether or not an error occurred: `status` states which.
  void close();
};

}  // namespace hersey::results
