#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace hersey::run {

/// The numbers of one field of a .vtu file with raw appended data.
inline std::vector<double> field_of(const std::filesystem::path& file, const std::string& name) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)), {});
  const std::size_t at = text.find("Name=\"" + name + "\"");
  REQUIRE(at != std::string::npos);
  const std::size_t offset = std::stoul(text.substr(text.find("offset=\"", at) + 8));
  const std::size_t begin = text.find('_', text.find("<AppendedData")) + 1 + offset;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, text.data() + begin, sizeof(bytes));
  std::vector<double> values(bytes / sizeof(double));
  std::memcpy(values.data(), text.data() + begin + sizeof(bytes), bytes);
  return values;
}

}  // namespace hersey::run
