#include "hersey/report/order_tracking.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "hersey/core/contract.h"

// Orders of signals that are known (theory manual, rotors.15).
namespace hersey::report {
namespace order_tracking_test {

constexpr double kTurn = 2 * std::numbers::pi;

/// A shaft that runs up evenly from 5 to 45 revolutions a second, in rows that are even in neither time nor angle.
struct RunUpRows {
  std::vector<double> time, angle, signal;

  template <class Signal>
  explicit RunUpRows(Signal signal_at, int rows = 8000, double sense = 1) {
    for (int k = 0; k <= rows; ++k) {
      const double t = 4.0 * (k + 0.3 * std::sin(1.7 * k)) / rows;
      const double theta = kTurn * (5 * t + 5 * t * t);
      time.push_back(t), angle.push_back(sense * theta), signal.push_back(signal_at(t, theta));
    }
  }
};

constexpr double kRounding = 1e-11;  // of a few thousand products of numbers around one

TEST_CASE("OrdersThatAreKnown_AreFoundExactly") {
  const RunUpRows run([](double, double theta) {
    return 3 + 0.002 * theta + 0.7 * std::cos(0.5 * theta - 0.4) + 2 * std::cos(theta - 2.5) +
           0.1 * std::cos(2 * theta + 1.2);
  });
  const OrderTracks found = track_orders(run.time, run.angle, run.signal);
  REQUIRE(found.time.size() == 200);
  for (std::size_t k = 0; k < found.time.size(); ++k) {
    const double expected[3][2] = {{0.7, 0.4}, {2, 2.5}, {0.1, -1.2}};
    for (std::size_t o = 0; o < 3; ++o) {
      CHECK(std::abs(found.at(k, o) - std::polar(expected[o][0], -expected[o][1])) < kRounding);
    }
    CHECK(std::abs(found.mean[k] - 3 - 0.002 * found.angle[k]) < kRounding);
    const double t = found.time[k];
    // Angles lie between rows on straight lines: (speed's rise) (time between rows)^2/8, 2e-6 revolutions.
    CHECK(std::abs(found.angle[k] / kTurn - 5 * t - 5 * t * t) < 1e-5);
    // The revolution around an instant is a little longer before it than after: 1/24 (rise/speed^2)^2 of the speed.
    CHECK(std::abs(found.speed[k] / kTurn / (5 + 10 * t) - 1) < 5e-3);
  }
}

TEST_CASE("ShaftThatRotatesBackwards_HasTheSameOrders") {
  const auto signal = [](double, double theta) { return std::cos(theta - 1) + std::cos(2 * theta); };
  const RunUpRows forwards(signal), backwards(signal, 8000, -1);
  const OrderTracks one = track_orders(forwards.time, forwards.angle, forwards.signal);
  const OrderTracks other = track_orders(backwards.time, backwards.angle, backwards.signal);
  CHECK(one.speed == other.speed);
  CHECK(one.amplitude == other.amplitude);
}

TEST_CASE("PeakToPeak_IsThatOfTheRows") {
  const RunUpRows run([](double, double theta) { return 1 + 2 * std::cos(theta); }, 40000);
  for (const double p : track_orders(run.time, run.angle, run.signal).peak_to_peak) {
    CHECK(p <= 4);
    // Two hundred rows a revolution at the fastest: each extreme is missed by half a row, (pi/200)^2/2 of an amplitude.
    CHECK(p > 4 * (1 - 3e-4));
  }
}

// What rotates at 0.43 times the speed, as an oil whirl does, lies 4.6 lines of a window from order 1: Hann's window
// lets less than 0.4 % of it through there.
TEST_CASE("WhirlBesideTheOrders_LeavesThemAlone") {
  const RunUpRows run([](double, double theta) { return 5 * std::cos(0.43 * theta) + std::cos(theta); });
  const OrderTracks found = track_orders(run.time, run.angle, run.signal, {.orders = {1}});
  REQUIRE(!found.time.empty());
  for (std::size_t k = 0; k < found.time.size(); ++k) CHECK(std::abs(found.at(k, 0) - 1.0) < 4e-3 * 5);
}

TEST_CASE("AmplitudeThatGrowsWithTheAngle_IsThatInTheMiddle") {
  const RunUpRows run([](double, double theta) { return theta * std::cos(theta); });
  const OrderTracks found = track_orders(run.time, run.angle, run.signal, {.orders = {1, 2}});
  REQUIRE(!found.time.empty());
  // The growth in a window is even about its middle; the rows' weights are so to the second order of their distance.
  for (std::size_t k = 0; k < found.time.size(); ++k)
    CHECK(std::abs(found.at(k, 0) / found.angle[k] - 1.0) < 2e-3 + 0.05 / found.angle[k]);
}

TEST_CASE("RowsTooFewForTheHighestOrder_GiveNoWindow") {
  const auto signal = [](double, double theta) { return std::cos(theta); };
  const RunUpRows coarse(signal, 500);  // 24 rows a revolution at the start, three at the end
  const OrderTracks found = track_orders(coarse.time, coarse.angle, coarse.signal);
  REQUIRE(!found.time.empty());
  // Five rows a revolution, as a mean over a window whose middle is faster than its mean.
  for (const double speed : found.speed) CHECK(speed < 1.03 * kTurn * 500 / 4.0 / 5);
  CHECK(track_orders(coarse.time, coarse.angle, coarse.signal, {.orders = {1}}).time.size() > found.time.size());
  CHECK(track_orders({}, {}, {}).time.empty());
  CHECK(track_orders({0, 1}, {0, 1}, {0, 1}).time.empty());
}

TEST_CASE("RowsThatAreNoNumbers_AreLeftOut") {
  RunUpRows run([](double, double theta) { return std::cos(theta); });
  for (std::size_t k = 0; k < run.signal.size(); k += 97) run.signal[k] = std::numeric_limits<double>::quiet_NaN();
  const OrderTracks found = track_orders(run.time, run.angle, run.signal);
  REQUIRE(found.time.size() == 200);
  for (std::size_t k = 0; k < found.time.size(); ++k) CHECK(std::abs(found.at(k, 1) - 1.0) < kRounding);
}

TEST_CASE("OptionsWithoutAWindow_AreRefused") {
  CHECK_THROWS_AS((void)track_orders({0}, {0}, {0}, {.orders = {}}), ContractError);
  CHECK_THROWS_AS((void)track_orders({0}, {0}, {0}, {.orders = {1, 1}}), ContractError);
  CHECK_THROWS_AS((void)track_orders({0}, {0}, {0}, {.orders = {0}}), ContractError);
  CHECK_THROWS_AS((void)track_orders({0}, {0}, {}), ContractError);
}

TEST_CASE("Cascade_HasTheSpeedsLineInEachPiece") {
  const RunUpRows run([](double, double theta) { return 7 + 2 * std::cos(theta); });
  const SpectrumCascade found = spectrum_cascade(run.time, run.signal, 60, 40);
  REQUIRE(found.time.size() == 40);
  REQUIRE(found.amplitude.size() == found.time.size() * found.frequency.size());
  const std::vector<double> speeds = revolution_speeds(run.time, run.angle, found.time);
  for (std::size_t k = 0; k < found.time.size(); ++k) {
    if (speeds[k] < kTurn * 15) continue;  // three periods in a piece
    const double* row = found.amplitude.data() + k * found.frequency.size();
    const auto peak = static_cast<std::size_t>(std::max_element(row, row + found.frequency.size()) - row);
    // In a piece of 0.2 s the speed changes by 2 Hz, and a line of the window is 5 Hz wide.
    CHECK(std::abs(found.frequency[peak] - speeds[k] / kTurn) < 1.3);
    CHECK(row[peak] < 2.01);  // the rows' unevenness
    CHECK(row[peak] > 1.9);   // what a sweep of 0.4 lines takes off the peak, and a place between two lines
    CHECK(row[found.frequency.size() - 1] < (speeds[k] < kTurn * 30 ? 0.03 : 2));  // far from the line
  }
}

TEST_CASE("SpeedOfARevolution_DoesNotSwingWithinIt") {
  std::vector<double> time, angle;
  for (int k = 0; k <= 4000; ++k) {
    time.push_back(1e-3 * k);
    angle.push_back(kTurn * 10 * time.back() + 0.4 * std::sin(kTurn * 10 * time.back()));
  }
  for (const double speed : revolution_speeds(time, angle, {1.0, 1.51, 2.222}))
    CHECK(speed == doctest::Approx(kTurn * 10).epsilon(2e-3));  // angles lie between rows on straight lines
}

}  // namespace order_tracking_test
}  // namespace hersey::report
