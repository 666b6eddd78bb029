// libFuzzer target: any text is read as the description of an FMU or refused by an FmuError.
#include <cstdint>
#include <string>

#include "hersey/fmi/description.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    (void)hersey::fmi::read_description(std::string(reinterpret_cast<const char*>(data), size));
  } catch (const hersey::fmi::FmuError&) {
    // the expected answer to nearly every input
  }
  return 0;
}
