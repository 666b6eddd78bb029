// libFuzzer target: whatever the text, it is either a function that can be evaluated or throws ExpressionError.
// seeds: libs/core/fuzz/seeds/expressions
// longest: 512
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hersey/core/expression.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  (void)hersey::variables_of(text);
  try {
    const hersey::ExpressionFunction function(text, {"t", "main.rotation"});
    for (const double t : {0.0, 1e-3, -2.0}) {
      const std::array<double, 2> x{t, 0.5};
      std::array<double, 2> gradient{};
      (void)function.value(x);
      function.gradient(x, gradient);
      (void)function.second_derivative(x);
    }
  } catch (const hersey::ExpressionError&) {
    // the expected answer to nearly every input
  }
  return 0;
}
