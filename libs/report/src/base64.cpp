#include "base64.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace hersey::report {
namespace {

static_assert(std::endian::native == std::endian::little, "the page expects little-endian numbers");

std::string encode(std::span<const unsigned char> bytes) {
  static constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* next = text.data();  // most of a page is written here: a look at the string's end for each letter shows
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < n ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k <= n; ++k) next[k] = alphabet[group >> (18 - 6 * k) & 63];
    next += 4;
  }
  return text;
}

}  // namespace

std::string base64_float32(std::span<const double> values) {
  const std::vector<float> narrow(values.begin(), values.end());
  return encode({reinterpret_cast<const unsigned char*>(narrow.data()), narrow.size() * sizeof(float)});
}

std::string base64_float64(std::span<const double> values) {
  return encode({reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(double)});
}

std::string base64_uint16(std::span<const std::uint16_t> values) {
  return encode({reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(std::uint16_t)});
}

}  // namespace hersey::report
