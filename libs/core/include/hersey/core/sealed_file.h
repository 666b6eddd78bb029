#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace hersey {

/// Returns the CRC-64 of bytes (ECMA-182, reflected, as in .xz). It detects every change within 64 successive bits,
/// hence every change of a single bit.
/// @param before  checksum of the preceding bytes, 0 at the beginning
[[nodiscard]] std::uint64_t crc64(std::span<const char> bytes, std::uint64_t before = 0);

/// State of the seal of a file. A seal is the last line of a file: a text with the length and the checksum of all bytes
/// before it. HDF5 ignores bytes behind its own end, so that other programs read sealed files unchanged; a program that
/// modifies a file removes the seal.
enum class Seal {
  none,    ///< the file has no seal
  intact,  ///< no byte has changed since the file was sealed
  broken,  ///< bytes have changed since, or are missing
};

/// Returns the seal for a file of these bytes, to be written behind them.
[[nodiscard]] std::string seal_of(std::span<const char> bytes);

/// Appends the seal to a complete file.
/// @throws std::runtime_error if it cannot be read or written
void seal_file(const std::filesystem::path& path);

/// Returns the state of the seal of a file; `none` also if the file cannot be read.
[[nodiscard]] Seal check_seal(const std::filesystem::path& path);

}  // namespace hersey
