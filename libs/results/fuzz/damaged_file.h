#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace hersey::results {

/// A file of this process in memory, for readers that want a path.
inline std::filesystem::path scratch_file(const char* name) {
  const std::filesystem::path memory = "/dev/shm";
  const auto folder = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
  return folder / ("hersey_fuzz_" + std::to_string(::getpid()) + "_" + name);
}

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The content damaged in one of two ways. Bytes changed: the input names offsets and new bytes alternately, four bytes
/// each. Or cut short, if the first byte is odd: at the offset that the next three name.
inline std::string damaged(std::string content, const std::uint8_t* data, std::size_t size) {
  const auto offset_at = [&](std::size_t at) {
    return (data[at] | std::size_t{data[at + 1]} << 8 | std::size_t{data[at + 2]} << 16) % content.size();
  };
  if (size >= 4 && data[0] % 2 == 1) return content.substr(0, offset_at(1));
  for (std::size_t k = 1; k + 4 <= size; k += 4) content[offset_at(k)] = static_cast<char>(data[k + 3]);
  return content;
}

inline void write_content(const std::filesystem::path& path, const std::string& content) {
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return;
  std::fwrite(content.data(), 1, content.size(), file);
  std::fclose(file);
}

}  // namespace hersey::results
