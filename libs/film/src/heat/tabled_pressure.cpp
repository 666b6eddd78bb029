#include <algorithm>
#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/film/viscosity_law.h"

namespace hersey::film {
namespace {

/// Returns the interval of an ascending axis in which `at` lies, or the nearest one, by its end.
std::size_t end_of_interval(const std::vector<double>& axis, double at) {
  return static_cast<std::size_t>(std::upper_bound(axis.begin() + 1, axis.end() - 1, at) - axis.begin());
}

}  // namespace

// Rows are found by their viscosity at p = 0, which falls from row to row. Beyond the first and the last row the effect
// of pressure is that of the nearest row.
ValueAndSlope TabledPressure::log_ratio(double at, double mu0) const {
  const std::size_t columns = p.size(), rows = log_mu.size() / columns;
  HERSEY_REQUIRE(rows >= 2 && columns >= 2 && log_mu.size() == rows * columns, "two rows and columns at least");
  const double wanted = std::log(mu0);
  std::size_t below = 1;
  while (below + 1 < rows && log_mu[below * columns] > wanted) ++below;
  const std::size_t above = below - 1, end = end_of_interval(p, at);
  const double first = log_mu[above * columns], fraction = (wanted - first) / (log_mu[below * columns] - first);
  const double colder = 1 - std::clamp(fraction, 0.0, 1.0), width = p[end] - p[end - 1];
  const auto of_row = [&](std::size_t row) {
    const double* mu = &log_mu[row * columns];
    const double slope = (mu[end] - mu[end - 1]) / width;
    return ValueAndSlope{mu[end - 1] - mu[0] + slope * (at - p[end - 1]), slope};
  };
  const ValueAndSlope cold = of_row(above), warm = of_row(below);
  return {colder * cold.value + (1 - colder) * warm.value, colder * cold.slope + (1 - colder) * warm.slope};
}

}  // namespace hersey::film
