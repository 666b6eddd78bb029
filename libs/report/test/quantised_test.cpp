#include "quantised.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace hersey::report {
namespace quantised_test {

double decoded(const Quantised& quantised, std::size_t index, std::size_t width) {
  return quantised.low[index / width] + quantised.step[index / width] * quantised.codes[index];
}

TEST_CASE("Quantised_NumbersAreWithinHalfAStep") {
  constexpr std::size_t width = 101;
  std::vector<double> values;
  // Rows of pressures of very different size [Pa]: a quiet instant must not suffer from a loud one.
  for (const double peak : {3e8, 2e5, 1e-3})
    for (std::size_t i = 0; i < width; ++i)
      values.push_back(peak * std::pow(std::sin(0.03 * static_cast<double>(i)), 2));
  const Quantised quantised = quantise(values, width);
  REQUIRE(quantised.codes.size() == values.size());
  for (std::size_t row = 0; row < 3; ++row) {
    double range = 0;
    for (std::size_t i = 0; i < width; ++i) range = std::max(range, values[row * width + i]);
    // Half a step, and what single precision does to the step: 2^-24 of the range.
    const double allowed = range * (0.5 / 65534 + 1.2e-7);
    for (std::size_t i = row * width; i < (row + 1) * width; ++i)
      CHECK(std::abs(decoded(quantised, i, width) - values[i]) <= allowed);
  }
}

TEST_CASE("Quantised_ConstantRowsAreExactAndWhatIsNoNumberStaysNone") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Quantised quantised = quantise(std::vector<double>{0.5, 0.5, nan, nan, nan, nan}, 3);
  CHECK(decoded(quantised, 0, 3) == 0.5);
  CHECK(decoded(quantised, 1, 3) == 0.5);
  for (const std::size_t i : {2, 3, 4, 5}) CHECK(quantised.codes[i] == no_number);
}

}  // namespace quantised_test
}  // namespace hersey::report
