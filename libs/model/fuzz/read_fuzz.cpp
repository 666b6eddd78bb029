// libFuzzer target: whatever the bytes, the reader either returns a model or throws InputError.
// seeds: examples/paper_big_end examples/slider_crank tests/cli
#include <cstddef>
#include <cstdint>
#include <string>

#include "hersey/model/read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  try {
    (void)hersey::model::read_text(text, "fuzz.yaml");
  } catch (const hersey::InputError&) {
    // the expected answer to nearly every input
  }
  return 0;
}
