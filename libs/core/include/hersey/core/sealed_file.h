#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace hersey {

/// CRC-64 of bytes (ECMA-182, reflected, as in .xz): differs wherever up to 64 bits in a row do, so wherever one does.
/// @param before the checksum of the bytes before, 0 at the beginning
[[nodiscard]] std::uint64_t crc64(std::span<const char> bytes, std::uint64_t before = 0);

/// A seal ends a file: a line of text with the length and the checksum of all bytes before it. HDF5 passes over what
/// stands behind its own end, so that other programs read sealed files as they are; one that changes a file cuts the
/// seal off.
enum class Seal {
  none,    ///< the file does not end in one
  intact,  ///< every byte is as it was when the file was sealed
  broken,  ///< bytes have changed since, or are missing
};

/// The seal for a file of these bytes, to be written behind them.
[[nodiscard]] std::string seal_of(std::span<const char> bytes);

/// Seals a file that is complete.
/// @throws std::runtime_error if it cannot be read or written
void seal_file(const std::filesystem::path& path);

/// @returns `none` for a file that cannot be read, too
[[nodiscard]] Seal check_seal(const std::filesystem::path& path);

}  // namespace hersey
