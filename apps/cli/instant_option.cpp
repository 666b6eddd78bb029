#include "instant_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "hersey/core/input_error.h"
#include "hersey/core/units.h"

namespace hersey::cli {
namespace {

[[noreturn]] void refuse_instant(const std::string& text, const std::string& expected) {
  throw InputError(Fault{{"", 0, 0}, "--instant", "'" + text + "'", expected, ""});
}

// An instant that is named may lie half a distance beyond the first or last one.
std::size_t nearest(const std::string& text, double value, const std::vector<double>& values,
                    const std::string& range) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double slack = (*high - *low) / static_cast<double>(2 * std::max<std::size_t>(values.size() - 1, 1));
  if (!(value >= *low - slack && value <= *high + slack)) refuse_instant(text, range);
  const auto distance = [value](double a, double b) { return std::abs(a - value) < std::abs(b - value); };
  return static_cast<std::size_t>(std::min_element(values.begin(), values.end(), distance) - values.begin());
}

}  // namespace

std::vector<std::size_t> named_instants(const std::vector<std::string>& texts, const std::vector<double>& times,
                                        const std::vector<double>& crank_angles) {
  constexpr double milli = 1e-3, degree = std::numbers::pi / 180;
  std::string range = fmt::format("a time from {:.6g} ms to {:.6g} ms", times.front() / milli, times.back() / milli);
  if (!crank_angles.empty())
    range += fmt::format(", or a crank angle from {:.6g} deg to {:.6g} deg", crank_angles.front() / degree,
                         crank_angles.back() / degree);
  range += ", or all";
  std::set<std::size_t> chosen;
  for (const std::string& text : texts) {
    if (text == "all") {
      for (std::size_t k = 0; k < times.size(); ++k) chosen.insert(k);
      continue;
    }
    try {
      chosen.insert(nearest(text, parse_quantity(text, "s"), times, range));
      continue;
    } catch (const QuantityError&) {
      if (crank_angles.empty()) refuse_instant(text, range);
    }
    try {
      chosen.insert(nearest(text, parse_quantity(text, "rad"), crank_angles, range));
    } catch (const QuantityError&) {
      refuse_instant(text, range);
    }
  }
  return {chosen.begin(), chosen.end()};
}

}  // namespace hersey::cli
