#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace hersey {

/// Replaces a file atomically: writes a file of the same name with ".new" appended and renames it when it is complete.
/// Readers find either the complete old file or the complete new one, even if the program is interrupted. Links are
/// followed, but for one with ".new", which is replaced; devices and pipes are written directly.
/// @throws std::runtime_error stating why the file could not be written; the old file is then unchanged
void write_file(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

/// Writes a file that must not be there yet, nor a link of its name, also not since a moment ago: two programs that
/// want to make the same file cannot both succeed.
/// @returns false if it is there
/// @throws std::runtime_error stating why the file could not be written; none is left then
[[nodiscard]] bool write_new_file(const std::filesystem::path& path, std::string_view text);

}  // namespace hersey
