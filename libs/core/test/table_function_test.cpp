#include "hersey/core/table_function.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey {
namespace table_function_test {

constexpr double pi = std::numbers::pi;
constexpr double eps = std::numeric_limits<double>::epsilon();

double value(const TableFunction& table, double x) { return table.value(std::array{x}); }

double slope(const TableFunction& table, double x) {
  std::array<double, 1> gradient{};
  table.gradient(std::array{x}, gradient);
  return gradient[0];
}

TableFunction sine_table(int n, Interpolation interpolation) {
  std::vector<double> x, y;
  for (int i = 0; i < n; ++i) x.push_back(2 * pi * i / n), y.push_back(std::sin(x.back()));
  return {x, y, {.interpolation = interpolation, .period = 2 * pi}};
}

double worst_error_of_sine(int n, Interpolation interpolation, double from, double to) {
  const TableFunction table = sine_table(n, interpolation);
  double worst = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double x = from + (to - from) * i / 1000;
    worst = std::max(worst, std::abs(value(table, x) - std::sin(x)));
  }
  return worst;
}

TEST_CASE("LinearTable_IsStraightBetweenItsPoints") {
  const TableFunction table({0, 1, 3}, {0, 2, -2}, {.scale = 10});
  CHECK(value(table, 0) == 0);
  CHECK(value(table, 0.25) == 5);
  CHECK(value(table, 1) == 20);
  CHECK(value(table, 2) == 0);
  CHECK(value(table, 3) == -20);
  CHECK(slope(table, 0.5) == 20);
  CHECK(slope(table, 1) == -20);  // the right-hand slope at a point
  CHECK(table.second_derivative(std::array{0.5}) == 0);
}

TEST_CASE("PeriodicTable_Repeats") {
  // One point per quarter, the last left out: the table closes itself.
  const TableFunction table({0, 1, 2, 3}, {0, 1, 0, -1}, {.period = 4});
  for (const double x : {0.25, 1.5, 3.75}) {
    CAPTURE(x);
    CHECK(value(table, x + 40) == value(table, x));
    CHECK(value(table, x - 8) == value(table, x));
  }
  CHECK(value(table, 3.5) == -0.5);
  CHECK(table.covers(-1e9, 1e9));
}

TEST_CASE("PeriodicTable_WithBothEnds_IsTheSame") {
  const TableFunction open({0, 1, 2, 3}, {0, 1, 0, -1}, {.interpolation = Interpolation::smooth, .period = 4});
  const TableFunction closed({0, 1, 2, 3, 4}, {0, 1, 0, -1, 0}, {.interpolation = Interpolation::smooth, .period = 4});
  for (double x = -4; x < 8; x += 0.125) CHECK(value(open, x) == value(closed, x));
}

TEST_CASE("SmoothTable_NeverOvershoots") {
  // A step: any C2 spline rings here.
  const TableFunction table({0, 1, 2, 3, 4, 5}, {0, 0, 0, 1, 1, 1}, {.interpolation = Interpolation::smooth});
  double before = 0;
  for (double x = 0; x <= 5; x += 1.0 / 64) {
    CHECK(value(table, x) >= before);
    before = value(table, x);
  }
  CHECK(before == 1);
}

TEST_CASE("SmoothTable_FollowsASmoothFunction") {
  // Third order on a monotone stretch; at extrema the slope 0 is right only if the extremum is a point: second order.
  const double order_flank = std::log2(worst_error_of_sine(64, Interpolation::smooth, -1, 1) /
                                       worst_error_of_sine(128, Interpolation::smooth, -1, 1));
  MESSAGE("order on the flank ", order_flank);
  CHECK(order_flank > 2.9);
  const double order_linear = std::log2(worst_error_of_sine(64, Interpolation::linear, 0, 2 * pi) /
                                        worst_error_of_sine(128, Interpolation::linear, 0, 2 * pi));
  CHECK(order_linear == doctest::Approx(2).epsilon(0.025));
}

TEST_CASE("SmoothTable_DerivativesMatchFiniteDifferences") {
  const TableFunction table = sine_table(12, Interpolation::smooth);
  for (const double x : {0.1, 1.0, 2.3, 4.4, 6.2, 9.9}) {  // between points, where the cubic is exact
    CAPTURE(x);
    const double h = 1e-4;
    const double first = (value(table, x + h) - value(table, x - h)) / (2 * h);
    const double second = (value(table, x + h) - 2 * value(table, x) + value(table, x - h)) / (h * h);
    // A cubic's difference errs by h^2 times a third derivative of order 1, plus round-off.
    CHECK(std::abs(slope(table, x) - first) < 10 * h * h);
    CHECK(std::abs(table.second_derivative(std::array{x}) - second) < 10 * eps / (h * h));
  }
}

TEST_CASE("SmoothTable_SlopeIsContinuousOverTheSeam") {
  const TableFunction table = sine_table(12, Interpolation::smooth);
  CHECK(std::abs(slope(table, 2 * pi - 1e-9) - slope(table, 2 * pi + 1e-9)) < 1e-7);  // curvature 1 over 2e-9, tenfold
}

TEST_CASE("RangeOfATable_IsKnownBeforeTheRun") {
  const TableFunction table({0, 0.5}, {1, 2}, {});
  CHECK(table.covers(0, 0.5));
  CHECK(table.covers(0, 0.5 + 1e-12));  // round-off of summed steps
  CHECK_FALSE(table.covers(0, 0.51));
  CHECK_FALSE(table.covers(-0.01, 0.5));
  CHECK_THROWS_WITH_AS((void)value(table, 0.6), "the table covers 0 to 0.5 but was asked for 0.6", TableRangeError);
  CHECK_THROWS_AS((void)value(table, std::numeric_limits<double>::quiet_NaN()), TableRangeError);
}

TEST_CASE("TwoAndOnePoints_AreTablesToo") {
  const TableFunction line({0, 2}, {0, 4}, {.interpolation = Interpolation::smooth});
  CHECK(value(line, 0.5) == 1);
  const TableFunction point({1}, {7}, {});
  CHECK(value(point, 1) == 7);
  CHECK(slope(point, 1) == 0);
}

TEST_CASE("BrokenTables_AreRejected") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(TableFunction({}, {}, {}), ContractError);
  CHECK_THROWS_AS(TableFunction({0, 1}, {0}, {}), ContractError);
  CHECK_THROWS_AS(TableFunction({0, 0}, {0, 1}, {}), ContractError);
  CHECK_THROWS_AS(TableFunction({0, nan}, {0, 1}, {}), ContractError);
  CHECK_THROWS_AS(TableFunction({0, 1}, {0, nan}, {}), ContractError);
  CHECK_THROWS_AS(TableFunction({0, 5}, {0, 0}, {.period = 4}), ContractError);
  CHECK_THROWS_AS(TableFunction({0, 4}, {0, 1}, {.period = 4}), ContractError);
}

}  // namespace table_function_test
}  // namespace hersey
