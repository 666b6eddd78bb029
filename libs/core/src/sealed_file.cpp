#include "hersey/core/sealed_file.h"

#include <fmt/format.h>
#include <lzma.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace hersey {
namespace {

constexpr std::string_view kBegin = "\nhersey seal 1 ";
constexpr std::size_t kDigits = 16;
constexpr std::size_t kSize = kBegin.size() + kDigits + 1 + kDigits + 1;  // length, blank, checksum, end of line
constexpr std::size_t kBlock = std::size_t{1} << 20;

std::string line(std::uint64_t length, std::uint64_t checksum) {
  return fmt::format("{}{:016x} {:016x}\n", kBegin, length, checksum);
}

/// Returns the checksum of the first `length` bytes; nothing if the file is shorter.
std::optional<std::uint64_t> checksum_of(std::ifstream& file, std::uint64_t length) {
  std::vector<char> block(kBlock);
  std::uint64_t checksum = 0;
  file.seekg(0);
  while (length > 0) {
    const std::size_t size = static_cast<std::size_t>(std::min<std::uint64_t>(length, block.size()));
    if (!file.read(block.data(), static_cast<std::streamsize>(size))) return std::nullopt;
    checksum = crc64({block.data(), size}, checksum);
    length -= size;
  }
  return checksum;
}

}  // namespace

std::uint64_t crc64(std::span<const char> bytes, std::uint64_t before) {
  return lzma_crc64(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), before);
}

std::string seal_of(std::span<const char> bytes) { return line(bytes.size(), crc64(bytes)); }

void seal_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t length = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  const std::optional<std::uint64_t> checksum = error || !file ? std::nullopt : checksum_of(file, length);
  std::ofstream end(path, std::ios::binary | std::ios::app);
  if (!checksum || !(end << line(length, *checksum)).flush()) throw std::runtime_error("cannot be sealed");
}

Seal check_seal(const std::filesystem::path& path) {
  std::error_code error;
  // Opening a pipe would block.
  if (!std::filesystem::is_regular_file(path, error)) return Seal::none;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file || size < kSize) return Seal::none;
  const std::uint64_t length = size - kSize;
  std::string end(kSize, '\0');
  file.seekg(static_cast<std::streamoff>(length));
  if (!file.read(end.data(), static_cast<std::streamsize>(end.size())) || !end.starts_with(kBegin)) return Seal::none;
  const std::optional<std::uint64_t> checksum = checksum_of(file, length);
  return checksum && end == line(length, *checksum) ? Seal::intact : Seal::broken;
}

}  // namespace hersey
