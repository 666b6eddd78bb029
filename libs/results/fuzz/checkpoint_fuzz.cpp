// libFuzzer target: whatever bytes of a checkpoint change, it is read as it was written or refused.
// longest: 64
#include <cstdlib>

#include "damaged_file.h"
#include "hersey/results/checkpoint.h"

namespace {

using namespace hersey::results;

hersey::Archive::Content written() {
  hersey::Archive::Content content;
  content.numbers["state/t"] = {{}, {0.1}};
  content.numbers["state/q"] = {{3}, {1, -2, 3}};
  content.numbers["bearing main/p"] = {{2, 2}, {1, 2, 3, 4}};
  content.numbers["bearing main/none"] = {{0}, {}};
  content.texts["identity/model"] = "hersey: 1\n";
  return content;
}

std::string real_file() {
  const std::filesystem::path path = scratch_file("real.checkpoint");
  write_checkpoint(path, written());
  std::string content = content_of(path);
  std::filesystem::remove(path);
  return content;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string real = real_file();
  static const std::filesystem::path path = scratch_file("run.checkpoint");
  write_content(path, damaged(real, data, size));
  try {
    const hersey::Archive::Content content = read_checkpoint(path);
    if (content.numbers != written().numbers || content.texts != written().texts) std::abort();
  } catch (const ReadError&) {
    // the expected answer to nearly every input
  }
  return 0;
}
