#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hersey {

/// Size of the largest text file that is read [bytes]; a larger one is reported as a fault. A sparse file may declare
/// any size.
inline constexpr std::uintmax_t kLargestTextFile = std::uintmax_t{1} << 31;

/// Returns why a path cannot be read as a file, in words that follow "found: "; nothing if it can be read. Only regular
/// files are read: reading a pipe without a writer would block forever, and a device may never end.
/// @param most  largest size accepted [bytes]
[[nodiscard]] std::optional<std::string> unreadable(const std::filesystem::path& path,
                                                    std::uintmax_t most = UINTMAX_MAX);

/// Content of a file named by the user, or the reason why it could not be read.
struct InputFile {
  std::string content;
  std::string fault;  ///< why the file could not be read; empty if it was
};
/// Reads the whole file; a file of more than `most` bytes is a fault.
[[nodiscard]] InputFile read_input_file(const std::filesystem::path& path, std::uintmax_t most = kLargestTextFile);

}  // namespace hersey
