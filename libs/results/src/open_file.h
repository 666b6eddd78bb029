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
  /// Turns a failed call or a failed driver into the one exception the caller sees. @throws WriteError
  void require(bool good, std::string_view what);
  /// @throws ContractError once it is finished, WriteError
  void require_open();
  /// Puts what is flushed onto the disk. @throws WriteError
  void sync();
  /// Gives it another name, in one piece. @param replace  a file of that name; else @throws FileExists, WriteError
  void rename(const std::filesystem::path& to, bool replace);
  /// In order or not: `status` tells.
  void close();
};

}  // namespace hersey::results
