#include "hersey/core/sealed_file.h"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "temporary_directory.h"

namespace hersey {
namespace sealed_file_test {

void write(const std::filesystem::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_CASE("Crc64_HasTheCatalogue'sCheckValue") {
  // CRC-64/XZ of "123456789" in the catalogue of parametrised CRC algorithms.
  const std::string digits = "123456789";
  CHECK(crc64(digits) == 0x995DC9BBDF1939FAULL);
  const std::string many(1000, 'x');
  for (std::size_t cut = 0; cut < 20; ++cut)
    CHECK(crc64(std::string_view(many).substr(cut), crc64(std::string_view(many).substr(0, cut))) == crc64(many));
  CHECK(crc64(std::string_view(digits).substr(4), crc64(std::string_view(digits).substr(0, 4))) == crc64(digits));
}

TEST_CASE("ASealedFile_IsIntact_AndItsBytesAreAsTheyWere") {
  const TemporaryDirectory folder;
  for (const std::size_t size : {0UL, 1UL, 5000UL, (1UL << 20) + 3}) {
    const std::string bytes(size, 'x');
    write(folder / "a", bytes);
    CHECK(check_seal(folder / "a") == Seal::none);
    seal_file(folder / "a");
    CHECK(check_seal(folder / "a") == Seal::intact);
    CHECK(content_of(folder / "a") == bytes + seal_of(bytes));
  }
  CHECK(check_seal(folder / "none") == Seal::none);
  CHECK(check_seal(folder / ".") == Seal::none);
  CHECK_THROWS((seal_file(folder / "nowhere" / "a")));
}

TEST_CASE("AnyBitThatFlips_BreaksTheSeal_OrIsInTheSealItself") {
  const TemporaryDirectory folder;
  const std::string bytes = "forty-two bytes of which one bit is flipped", sealed = bytes + seal_of(bytes);
  for (std::size_t bit = 0; bit < 8 * sealed.size(); ++bit) {
    std::string flipped = sealed;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    write(folder / "a", flipped);
    const Seal seal = check_seal(folder / "a");
    CHECK(seal != Seal::intact);
    if (bit < 8 * bytes.size()) CHECK(seal == Seal::broken);
  }
}

TEST_CASE("ALostOrAddedPiece_IsFound") {
  const TemporaryDirectory folder;
  const std::string bytes(3000, 'x'), sealed = bytes + seal_of(bytes);
  write(folder / "a", sealed.substr(0, 1000) + sealed.substr(1001));
  CHECK(check_seal(folder / "a") == Seal::broken);
  write(folder / "a", sealed.substr(0, 2000));
  CHECK(check_seal(folder / "a") == Seal::none);
  write(folder / "a", "y" + sealed);
  CHECK(check_seal(folder / "a") == Seal::broken);
}

}  // namespace sealed_file_test
}  // namespace hersey
