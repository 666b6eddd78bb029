// libFuzzer target: whatever is given after --set, an override a line, the model is either read or refused by
// InputError. seeds: libs/model/fuzz/seeds/overrides longest: 1024
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "../test/good_model.h"
#include "hersey/model/read.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines(std::string(data, data + size));
  std::vector<std::string> overrides;
  for (std::string line; std::getline(lines, line);) overrides.push_back(line);
  try {
    (void)hersey::model::read_text(hersey::model::good_model, "fuzz.yaml", overrides);
  } catch (const hersey::InputError&) {
    // the expected answer to nearly every input
  }
  return 0;
}
