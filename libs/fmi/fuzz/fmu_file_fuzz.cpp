// libFuzzer target: any bytes are read as the file of an FMU, with all that is in it, or refused by an FmuError.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "hersey/fmi/fmu_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("hersey-fuzz-" + std::to_string(::getpid()) + ".fmu");
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    (void)hersey::fmi::FmuFile(path).description();
  } catch (const hersey::fmi::FmuError&) {
    // the expected answer to nearly every input
  }
  return 0;
}
