#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace hersey {

/// Text files of more are told, not read: a file with holes may have any size [bytes].
inline constexpr std::uintmax_t kLargestTextFile = std::uintmax_t{1} << 31;

/// What keeps a path from being read as a file, in words that follow "found: "; nothing where it can be read. Only
/// files are: a pipe that nobody writes into would be waited for without end, and a device may never end.
/// @param most [bytes]
[[nodiscard]] std::optional<std::string> unreadable(const std::filesystem::path& path,
                                                    std::uintmax_t most = UINTMAX_MAX);

/// Content of a file that the user names, or why there is none.
struct InputFile {
  std::string content;
  std::string fault;  ///< empty: it was read
};
/// The whole file as it stands; a file of more than `most` bytes is a fault.
[[nodiscard]] InputFile read_input_file(const std::filesystem::path& path, std::uintmax_t most = kLargestTextFile);

}  // namespace hersey
