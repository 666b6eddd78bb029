#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hersey::report {

/// Numbers in two bytes each, as multiples of a step between the extremes of their row: value = low[row] + step[row]
/// code.
struct Quantised {
  std::vector<std::uint16_t> codes;
  std::vector<double> low, step;  ///< of each row
};

/// Code of a value that is not a number.
inline constexpr std::uint16_t no_number = 65535;

/// Rows of `width` numbers. Each is wrong by at most half a step, 1/131068 of its row's range.
/// @pre width > 0 divides the number of values.
/// @verified_by quantised_test.cpp
[[nodiscard]] Quantised quantise(std::span<const double> values, std::size_t width);

}  // namespace hersey::report
