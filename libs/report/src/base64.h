#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hersey::report {

/// Little-endian IEEE numbers in base64 (RFC 4648), which a browser converts to a typed array without parsing.
[[nodiscard]] std::string base64_float32(std::span<const double> values);
[[nodiscard]] std::string base64_float64(std::span<const double> values);
[[nodiscard]] std::string base64_uint16(std::span<const std::uint16_t> values);

}  // namespace hersey::report
