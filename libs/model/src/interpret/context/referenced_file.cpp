#include <array>
#include <cstdint>
#include <fstream>

#include "hersey/core/input_file.h"
#include "interpret/context/interpret.h"

namespace hersey::model {
namespace {

/// FNV-1a of the file's bytes, 64 bits; 0 for a file that cannot be read.
std::uint64_t digest_of(const std::filesystem::path& path) {
  if (unreadable(path)) return 0;
  std::ifstream stream(path, std::ios::binary);
  std::uint64_t hash = stream ? 0xcbf29ce484222325U : 0;
  std::array<char, 65536> block{};
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    for (std::streamsize i = 0; i < stream.gcount(); ++i) {
      hash ^= static_cast<unsigned char>(block[static_cast<std::size_t>(i)]);
      hash *= 0x100000001b3U;
    }
  }
  return hash;
}

}  // namespace

std::filesystem::path referenced_file(Context& context, const std::string& name) {
  std::filesystem::path path = std::filesystem::path(context.model.file).parent_path() / name;
  context.model.files.emplace(name, digest_of(path));
  return path;
}

}  // namespace hersey::model
