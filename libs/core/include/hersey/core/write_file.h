#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace hersey {

/// Writes a file beside its place, under its name with ".new", and renames it when it is whole: whoever reads it finds
/// all of the old one or all of the new one, whatever ends the program. Links are followed; devices and pipes are
/// written as they are.
/// @throws std::runtime_error telling why it could not be written; then the old one stays
void write_file(const std::filesystem::path& path, std::initializer_list<std::string_view> parts);

}  // namespace hersey
