#include "hersey/report/order_tracking.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "hersey/core/contract.h"

namespace hersey::report {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kRevolution = 2 * std::numbers::pi;

// Two rows in a period cannot tell a sine from a cosine; with a half more the rows of a window can.
constexpr double kRowsInPeriod = 2.5;

// A line of Hann's window is two of its lines wide on each side: between two lines the drawn peak is at most 1 % low.
constexpr double kLinesBetween = 4;
constexpr std::size_t kMostLines = 400;

// A piece has to hold some periods of what its spectrum shows.
constexpr std::size_t kFewestRowsOfPiece = 16;

struct Rows {
  std::vector<double> time, angle, signal;  // the angle rises
};

Rows rising_rows(const std::vector<double>& time, const std::vector<double>& angle, const std::vector<double>& signal) {
  Rows rows;
  if (angle.empty()) return rows;
  const double sign = angle.back() < angle.front() ? -1 : 1;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const bool is_finite = std::isfinite(time[k]) && std::isfinite(angle[k]) && std::isfinite(signal[k]);
    const bool rises = rows.time.empty() || (sign * angle[k] > rows.angle.back() && time[k] > rows.time.back());
    if (!is_finite || !rises) continue;
    rows.time.push_back(time[k]);
    rows.angle.push_back(sign * angle[k]);
    rows.signal.push_back(signal[k]);
  }
  return rows;
}

/// y at x, linear between the ascending rows and constant beyond them.
double between(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  const auto after = std::lower_bound(xs.begin(), xs.end(), x);
  if (after == xs.begin()) return ys.front();
  if (after == xs.end()) return ys.back();
  const auto k = static_cast<std::size_t>(after - xs.begin());
  return ys[k - 1] + (x - xs[k - 1]) / (xs[k] - xs[k - 1]) * (ys[k] - ys[k - 1]);
}

/// Half the distance from the row before to the row after, within [from, to].
double share_of(const std::vector<double>& xs, std::size_t k, double from, double to) {
  const double before = k > 0 ? std::max(0.5 * (xs[k - 1] + xs[k]), from) : from;
  const double after = k + 1 < xs.size() ? std::min(0.5 * (xs[k] + xs[k + 1]), to) : to;
  return std::max(after - before, 0.0);
}

double hann(double x, double middle, double width) { return 0.5 + 0.5 * std::cos(kRevolution * (x - middle) / width); }

/// Mean speed over the revolution around an angle.
double speed_around(const Rows& rows, double middle) {
  const double from = std::max(middle - 0.5 * kRevolution, rows.angle.front());
  const double to = std::min(middle + 0.5 * kRevolution, rows.angle.back());
  return (to - from) / (between(rows.angle, rows.time, to) - between(rows.angle, rows.time, from));
}

class WindowFit {
 public:
  WindowFit(const Rows& rows, const OrderOptions& options)
      : rows_(rows), orders_(options.orders), width_(kRevolution * options.revolutions) {
    const double highest = *std::max_element(orders_.begin(), orders_.end());
    const auto unknowns = static_cast<double>(unknown_count());
    fewest_ = std::max(kRowsInPeriod * highest * options.revolutions, unknowns + 1);
  }

  /// Adds the window around an angle to the tracks if it has the rows for it.
  void add_window(double time, double middle, OrderTracks& tracks) const {
    const auto first = std::lower_bound(rows_.angle.begin(), rows_.angle.end(), middle - 0.5 * width_);
    const auto last = std::upper_bound(first, rows_.angle.end(), middle + 0.5 * width_);
    if (static_cast<double>(last - first) < fewest_) return;
    const auto begin = static_cast<std::size_t>(first - rows_.angle.begin());
    const auto end = static_cast<std::size_t>(last - rows_.angle.begin());
    const VectorXd found = solve(middle, begin, end);
    if (!found.allFinite()) return;
    const auto low = rows_.signal.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto high = rows_.signal.begin() + static_cast<std::ptrdiff_t>(end);
    const auto [least, most] = std::minmax_element(low, high);
    tracks.time.push_back(time);
    tracks.angle.push_back(middle);
    tracks.speed.push_back(speed_around(rows_, middle));
    tracks.mean.push_back(found[0]);
    tracks.peak_to_peak.push_back(*most - *least);
    for (Index o = 0; o < static_cast<Index>(orders_.size()); ++o)
      tracks.amplitude.emplace_back(found[2 + 2 * o], -found[3 + 2 * o]);
  }

 private:
  [[nodiscard]] std::size_t unknown_count() const { return 2 + 2 * orders_.size(); }

  // (rotors.15)
  [[nodiscard]] VectorXd solve(double middle, std::size_t begin, std::size_t end) const {
    const auto n = static_cast<Index>(unknown_count()), m = static_cast<Index>(end - begin);
    Eigen::MatrixXd A(m, n);
    VectorXd b(m);
    for (std::size_t k = begin; k < end; ++k) {
      const auto row = static_cast<Index>(k - begin);
      const double theta = rows_.angle[k];
      const double share = share_of(rows_.angle, k, middle - 0.5 * width_, middle + 0.5 * width_);
      const double weight = std::sqrt(hann(theta, middle, width_) * share);
      A(row, 0) = 1, A(row, 1) = (theta - middle) / width_;
      for (Index o = 0; o < static_cast<Index>(orders_.size()); ++o) {
        const double phase = orders_[static_cast<std::size_t>(o)] * theta;
        A(row, 2 + 2 * o) = std::cos(phase), A(row, 3 + 2 * o) = std::sin(phase);
      }
      A.row(row) *= weight;
      b[row] = weight * rows_.signal[k];
    }
    return A.colPivHouseholderQr().solve(b);
  }

  const Rows& rows_;
  const std::vector<double>& orders_;
  double width_;   // of a window [rad]
  double fewest_;  // rows of a window
};

/// Even times at most `count`, of which the first and the last are `from` and `to`.
std::vector<double> even_times(double from, double to, std::size_t count) {
  if (count == 1) return {0.5 * (from + to)};
  std::vector<double> times;
  for (std::size_t k = 0; k < count; ++k)
    times.push_back(from + (to - from) * static_cast<double>(k) / static_cast<double>(count - 1));
  return times;
}

/// Amplitudes of a piece of a series at the frequencies, added to `amplitude`.
void add_spectrum(const std::vector<double>& time, const std::vector<double>& signal, double middle, double length,
                  const std::vector<double>& frequency, std::vector<double>& amplitude) {
  const double from = middle - 0.5 * length, to = middle + 0.5 * length;
  const auto first = std::lower_bound(time.begin(), time.end(), from);
  const auto last = std::upper_bound(first, time.end(), to);
  const auto begin = static_cast<std::size_t>(first - time.begin()),
             end = static_cast<std::size_t>(last - time.begin());
  std::vector<double> weight;
  double sum = 0, mean = 0;
  for (std::size_t k = begin; k < end; ++k) {
    weight.push_back(hann(time[k], middle, length) * share_of(time, k, from, to));
    sum += weight.back(), mean += weight.back() * signal[k];
  }
  mean /= sum;
  // The lines are multiples of the first: each is the one before times a rotation.
  const double step = frequency[1];
  std::vector<std::complex<double>> lines(frequency.size());
  for (std::size_t k = begin; k < end; ++k) {
    std::complex<double> term = weight[k - begin] * (signal[k] - mean);
    const std::complex<double> rotation = std::polar(1.0, -kRevolution * step * (time[k] - middle));
    for (std::complex<double>& line : lines) line += term, term *= rotation;
  }
  for (const std::complex<double>& line : lines) amplitude.push_back(2 * std::abs(line) / sum);
}

}  // namespace

OrderTracks track_orders(const std::vector<double>& time, const std::vector<double>& angle,
                         const std::vector<double>& signal, const OrderOptions& options) {
  HERSEY_REQUIRE(time.size() == angle.size() && time.size() == signal.size(), "rows have time, angle and signal");
  HERSEY_REQUIRE(options.revolutions > 0 && options.windows > 0 && !options.orders.empty(), "there is a window");
  HERSEY_REQUIRE(*std::min_element(options.orders.begin(), options.orders.end()) > 0, "orders are positive");
  HERSEY_REQUIRE(std::set<double>(options.orders.begin(), options.orders.end()).size() == options.orders.size(),
                 "orders differ");
  OrderTracks tracks;
  tracks.orders = options.orders;
  const Rows rows = rising_rows(time, angle, signal);
  const double half = 0.5 * kRevolution * options.revolutions;
  if (rows.time.empty() || rows.angle.back() - rows.angle.front() < 2 * half) return tracks;
  const double from = between(rows.angle, rows.time, rows.angle.front() + half);
  const double to = between(rows.angle, rows.time, rows.angle.back() - half);
  const WindowFit fit(rows, options);
  for (const double t : even_times(from, to, options.windows))
    fit.add_window(t, between(rows.time, rows.angle, t), tracks);
  return tracks;
}

std::vector<double> revolution_speeds(const std::vector<double>& time, const std::vector<double>& angle,
                                      const std::vector<double>& at) {
  HERSEY_REQUIRE(time.size() == angle.size(), "rows have time and angle");
  const Rows rows = rising_rows(time, angle, angle);
  HERSEY_REQUIRE(rows.time.size() > 1, "the shaft rotates");
  std::vector<double> speeds;
  for (const double t : at) speeds.push_back(speed_around(rows, between(rows.time, rows.angle, t)));
  return speeds;
}

SpectrumCascade spectrum_cascade(const std::vector<double>& time, const std::vector<double>& signal, double highest,
                                 std::size_t pieces) {
  HERSEY_REQUIRE(time.size() == signal.size(), "rows have time and signal");
  HERSEY_REQUIRE(pieces > 0, "there is a piece");
  SpectrumCascade cascade;
  const Rows rows = rising_rows(time, time, signal);
  if (rows.time.size() < kFewestRowsOfPiece) return cascade;
  const double duration = rows.time.back() - rows.time.front();
  const auto most = std::max<std::size_t>(1, 2 * rows.time.size() / kFewestRowsOfPiece - 1);
  const std::size_t count = std::min(pieces, most);
  const double length = 2 * duration / static_cast<double>(count + 1);
  const double rate = static_cast<double>(rows.time.size() - 1) / duration;
  const double top = std::min(highest, rate / kRowsInPeriod);
  const auto lines = std::clamp<std::size_t>(static_cast<std::size_t>(kLinesBetween * top * length), 8, kMostLines);
  for (std::size_t k = 0; k <= lines; ++k)
    cascade.frequency.push_back(top * static_cast<double>(k) / static_cast<double>(lines));
  cascade.time = even_times(rows.time.front() + 0.5 * length, rows.time.back() - 0.5 * length, count);
  for (const double t : cascade.time)
    add_spectrum(rows.time, rows.signal, t, length, cascade.frequency, cascade.amplitude);
  return cascade;
}

}  // namespace hersey::report
