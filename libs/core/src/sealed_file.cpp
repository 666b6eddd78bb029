#include "hersey/core/sealed_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

using Table = std::array<std::uint64_t, 256>;

/// Remainders of every byte with 0 to 7 bytes of zero behind it: eight bytes are divided at a time.
constexpr std::array<Table, 8> remainders() {
  std::array<Table, 8> tables{};
  for (std::uint64_t byte = 0; byte < 256; ++byte) {
    std::uint64_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit)
      remainder = (remainder & 1) != 0 ? (remainder >> 1) ^ 0xC96C5795D7870F42ULL : remainder >> 1;
    tables[0][byte] = remainder;
  }
  for (std::size_t k = 1; k < tables.size(); ++k)
    for (std::size_t byte = 0; byte < 256; ++byte)
      tables[k][byte] = tables[0][tables[k - 1][byte] & 0xFF] ^ (tables[k - 1][byte] >> 8);
  return tables;
}

std::string line(std::uint64_t length, std::uint64_t checksum) {
  return fmt::format("{}{:016x} {:016x}\n", kBegin, length, checksum);
}

/// Checksum of the first `length` bytes; none where there are fewer.
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
  static constexpr std::array<Table, 8> tables = remainders();
  const auto at = [&bytes](std::size_t place) {
    return static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[place]));
  };
  std::uint64_t value = ~before;
  std::size_t place = 0;
  for (; place + 8 <= bytes.size(); place += 8) {
    for (std::size_t k = 0; k < 8; ++k) value ^= at(place + k) << (8 * k);
    std::uint64_t next = 0;
    for (std::size_t k = 0; k < 8; ++k) next ^= tables[7 - k][(value >> (8 * k)) & 0xFF];
    value = next;
  }
  for (; place < bytes.size(); ++place) value = tables[0][(value ^ at(place)) & 0xFF] ^ (value >> 8);
  return ~value;
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
  // A pipe would be waited for as soon as it is opened.
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
