#include "quantised.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hersey/core/contract.h"

namespace hersey::report {

Quantised quantise(std::span<const double> values, std::size_t width) {
  HERSEY_REQUIRE(width > 0 && values.size() % width == 0, "rows of one width");
  constexpr double codes = no_number - 1;
  Quantised quantised;
  quantised.codes.reserve(values.size());
  for (std::size_t first = 0; first < values.size(); first += width) {
    const std::span<const double> row = values.subspan(first, width);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double value : row) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (low > high) low = high = 0;  // no number in the row
    // The page has both in single precision: codes are counted from what it has.
    const double from = static_cast<float>(low);
    const double step = static_cast<float>((high - from) / codes);
    for (const double value : row) {
      const double code = step > 0 ? std::round((value - from) / step) : 0;
      quantised.codes.push_back(std::isfinite(value) ? static_cast<std::uint16_t>(std::clamp(code, 0.0, codes))
                                                     : no_number);
    }
    quantised.low.push_back(from);
    quantised.step.push_back(step);
  }
  return quantised;
}

}  // namespace hersey::report
