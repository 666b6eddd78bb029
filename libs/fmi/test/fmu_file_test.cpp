#include "hersey/fmi/fmu_file.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

namespace hersey::fmi {
namespace fmu_file_test {

std::string number(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>((value >> (8 * i)) & 0xff);
  return text;
}

/// A ZIP archive of one entry that is stored: APPNOTE.TXT, sections 4.3.7, 4.3.12 and 4.3.16.
std::string archive(const std::string& name, const std::string& content, std::uint32_t checksum) {
  const auto size = static_cast<std::uint32_t>(content.size());
  const std::string common = number(0, 2) + number(0, 2) + number(0, 4) + number(checksum, 4) + number(size, 4) +
                             number(size, 4) + number(static_cast<std::uint32_t>(name.size()), 2) + number(0, 2);
  const std::string local = number(0x04034b50, 4) + number(20, 2) + common + name + content;
  const std::string entry = number(0x02014b50, 4) + number(20, 2) + number(20, 2) + common + number(0, 2) +
                            number(0, 2) + number(0, 2) + number(0, 4) + number(0, 4) + name;
  return local + entry + number(0x06054b50, 4) + number(0, 4) + number(1, 2) + number(1, 2) +
         number(static_cast<std::uint32_t>(entry.size()), 4) + number(static_cast<std::uint32_t>(local.size()), 4) +
         number(0, 2);
}

constexpr std::uint32_t kCheckOfDigits = 0xcbf43926;  // the check value of CRC-32: that of "123456789"

FmuFile opened(const std::string& bytes) {
  const std::filesystem::path path = "one.fmu";
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  return FmuFile(path);
}

TEST_CASE("StoredEntry_IsReadAndChecked") {
  const FmuFile file = opened(archive("binaries/win64/m.dll", "123456789", kCheckOfDigits));
  CHECK(file.has("binaries/win64/m.dll"));
  CHECK(file.content("binaries/win64/m.dll") == "123456789");
  CHECK(file.platforms() == std::vector<std::string>{"win64"});
  CHECK_THROWS_WITH_AS(file.content("modelDescription.xml"), "it has no modelDescription.xml", FmuError);
  const Description description{.version = 2, .model_identifier = "m"};
  CHECK(library_name(description) == "binaries/" + platform(2) + "/m.so");
  CHECK(missing_library(file, description).find("libraries for win64") != std::string::npos);
  file.extract("binaries/", "unpacked");
  CHECK(std::filesystem::file_size("unpacked/binaries/win64/m.dll") == 9);
  const FmuFile damaged = opened(archive("a", "123456780", kCheckOfDigits));
  CHECK_THROWS_WITH_AS(damaged.content("a"), "its content a is damaged", FmuError);
}

TEST_CASE("PlatformsHaveTheStandardsNames") {
#if defined(__x86_64__)
  CHECK(platform(2) == "linux64");
  CHECK(platform(3) == "x86_64-linux");
#else
  CHECK(platform(2) == platform(3));
  CHECK(platform(3) == "aarch64-linux");
#endif
}

TEST_CASE("NamesThatLeadOut_AreRefused") {
  for (const char* name : {"../a", "/a", "a/../../b", "a\\b"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(opened(archive(name, "123456789", kCheckOfDigits)), FmuError);
  }
}

TEST_CASE("ArchivesThatEndAnywhere_AreRefused") {
  const std::string whole = archive("a", "123456789", kCheckOfDigits);
  for (std::size_t size = 0; size < whole.size(); ++size) CHECK_THROWS_AS(opened(whole.substr(0, size)), FmuError);
}

}  // namespace fmu_file_test
}  // namespace hersey::fmi
