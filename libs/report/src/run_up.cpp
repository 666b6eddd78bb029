#include "run_up.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base64.h"

namespace hersey::report {
namespace {

using nlohmann::json;
using results::Array;
using results::Reader;

constexpr double kOneRevolution = 2 * std::numbers::pi, kHalfTurn = std::numbers::pi;

// A shaft with fewer revolutions has no orders worth tracking; a body that tumbles makes some, too.
constexpr double kFewestRevolutions = 20;
// Speeds that vary by less are a constant speed with its swings.
constexpr double kChange = 1.2;
// A start from rest and the last step say nothing of the speed.
constexpr double kLeftOut = 0.02;
// Windows of half an order hold four of its periods; short runs have windows half as long.
constexpr int kRevolutions = 8, kFewRevolutions = 4;
constexpr double kLongRun = 10.0 * kRevolutions;
// More series than these make a page slow to open; those of bearings come first.
constexpr std::size_t kMostSignals = 16;
// A direction in which a body moves by less than this share of another is the one along its shaft.
constexpr double kAcross = 1e-2;
// Results are stored to seven digits.
constexpr double kSameMotion = 1e-6;
// The cascade shows three orders of the fastest speed and a bit.
constexpr double kHighestOrder = 3.3;
constexpr std::size_t kPieces = 40;

std::vector<double> column_of(const Array& array, std::size_t column) {
  const std::size_t width = array.width();
  std::vector<double> values;
  for (std::size_t k = column; k < array.values.size(); k += width) values.push_back(array.values[k]);
  return values;
}

/// The longest stretch of a run in which the shaft does not turn round; what swings back by less than half a revolution
/// goes on.
Stretch longest_stretch(const std::vector<double>& angle) {
  Stretch longest, now;
  std::size_t farthest = 0;
  double sense = 0;
  const auto length = [&](const Stretch& s) { return s.end == 0 ? 0 : std::abs(angle[s.end - 1] - angle[s.begin]); };
  for (std::size_t k = 0; k < angle.size(); ++k) {
    const double step = angle[k] - angle[farthest];
    if (sense == 0 && std::abs(step) > 0.5 * kHalfTurn) sense = step > 0 ? 1 : -1;
    if (sense == 0) continue;
    if (sense * step >= 0) {
      farthest = k;
      now.end = k + 1;
      if (length(now) > length(longest)) longest = now;
    } else if (-sense * step > kHalfTurn) {
      now = {farthest, k + 1};
      sense = -sense;
      farthest = k;
    }
  }
  return longest;
}

std::vector<double> rows_of(const std::vector<double>& values, const Stretch& stretch) {
  const auto first = values.begin();
  return {first + static_cast<std::ptrdiff_t>(stretch.begin), first + static_cast<std::ptrdiff_t>(stretch.end)};
}

/// How far a shaft rotates one way [rad].
double way(const std::vector<double>& angle) {
  const Stretch stretch = longest_stretch(angle);
  return stretch.end == 0 ? 0 : std::abs(angle[stretch.end - 1] - angle[stretch.begin]);
}

void keep_farther(std::optional<RotatingShaft>& best, RotatingShaft found) {
  if (found.angle.empty() || !std::isfinite(way(found.angle))) return;
  if (!best || way(found.angle) > way(best->angle)) best = std::move(found);
}

/// The angle of a joint's rotation, empty where it has none.
std::vector<double> rotation_of(const Reader& reader, const std::string& joint) {
  const std::string path = joint + "/coordinates";
  if (!reader.has(path)) return {};
  std::vector<std::string> names = reader.list_attribute(path, "coordinate_names");
  if (names.empty()) names = reader.list_attribute(joint, "coordinate_names");
  const auto rotation = std::find(names.begin(), names.end(), "rotation");
  if (rotation == names.end()) return {};
  return column_of(reader.read(path), static_cast<std::size_t>(rotation - names.begin()));
}

/// The angle of a body about the axis of ground that it rotates about most.
std::vector<double> rotation_of_body(const Reader& reader, const std::string& body, const std::vector<double>& time) {
  const std::string path = body + "/angular_velocity";
  std::vector<double> best;
  if (!reader.has(path)) return best;
  const Array omega = reader.read(path);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> rate = column_of(omega, axis);
    std::vector<double> angle{0};
    for (std::size_t k = 1; k < std::min(rate.size(), time.size()); ++k)
      angle.push_back(angle.back() + 0.5 * (rate[k] + rate[k - 1]) * (time[k] - time[k - 1]));
    if (best.empty() || way(angle) > way(best)) best = std::move(angle);
  }
  return best;
}

std::optional<RotatingShaft> find_shaft(const Reader& reader, const std::vector<double>& time) {
  if (reader.has("/crank_angle")) return RotatingShaft{"crank", reader.read("/crank_angle").values};
  std::optional<RotatingShaft> shaft;
  for (const std::string& joint : reader.children("/joints"))
    keep_farther(shaft, {joint, rotation_of(reader, "/joints/" + joint)});
  if (shaft && way(shaft->angle) >= kFewestRevolutions * kOneRevolution) return shaft;
  for (const std::string& body : reader.children("/bodies"))
    keep_farther(shaft, {body, rotation_of_body(reader, "/bodies/" + body, time)});
  return shaft;
}

bool changes_speed(const std::vector<double>& time, const std::vector<double>& angle) {
  constexpr int count = 200;
  const double length = time.back() - time.front();
  std::vector<double> at;
  for (int k = 0; k <= count; ++k) at.push_back(time.front() + length * (kLeftOut + (1 - 2 * kLeftOut) * k / count));
  const std::vector<double> speeds = revolution_speeds(time, angle, at);
  const auto [slowest, fastest] = std::minmax_element(speeds.begin(), speeds.end());
  return *fastest > kChange * *slowest;
}

double range_of(const std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return std::isfinite(*most - *least) ? *most - *least : 0;
}

/// True if something tracked before moves in the same way, as a station of a shaft and the disc on it.
bool is_known(const OrderTracks& tracks, const RunUp& run_up) {
  const auto size = [](const std::complex<double>& a) { return std::abs(a); };
  const auto is_same = [&](const RunUpSignal& other) {
    if (other.tracks.amplitude.size() != tracks.amplitude.size()) return false;
    const std::complex<double> largest = std::ranges::max(tracks.amplitude, {}, size);
    const auto is_near = [&](const auto& a, const auto& b) {
      return std::abs(a - b) <= kSameMotion * std::abs(largest);
    };
    return std::equal(tracks.amplitude.begin(), tracks.amplitude.end(), other.tracks.amplitude.begin(), is_near);
  };
  return std::ranges::any_of(run_up.displacements, is_same);
}

/// Tracks the columns of a dataset in which something moves across the shaft; bodies that move like what has been
/// tracked before are left out.
void add_signals(const Reader& reader, const std::string& path, bool is_body, RunUp& run_up) {
  if (!reader.has(path)) return;
  const Array array = reader.read(path);
  std::vector<std::vector<double>> columns;
  double most = 0;
  for (std::size_t i = 0; i < array.width(); ++i) {
    if (array.info.shape.at(0) < run_up.stretch.end) return;
    columns.push_back(rows_of(column_of(array, i), run_up.stretch));
    most = std::max(most, range_of(columns.back()));
  }
  OrderOptions options;
  options.revolutions = run_up.revolutions;
  for (std::size_t i = 0; i < columns.size() && run_up.displacements.size() < kMostSignals; ++i) {
    if (columns[i].size() != run_up.time.size() || !(range_of(columns[i]) > kAcross * most)) continue;
    OrderTracks tracks = track_orders(run_up.time, run_up.shaft.angle, columns[i], options);
    if (tracks.time.empty() || (is_body && is_known(tracks, run_up))) continue;
    run_up.displacements.push_back({path, i, std::move(tracks)});
  }
}

json numbers(const std::vector<double>& values, const char* unit, std::vector<std::size_t> shape) {
  return {{"unit", unit}, {"type", "f4"}, {"shape", std::move(shape)}, {"data", base64_float32(values)}};
}

json tracks_data(const OrderTracks& tracks) {
  std::vector<double> amplitude, lag;
  for (const std::complex<double>& a : tracks.amplitude) amplitude.push_back(std::abs(a)), lag.push_back(-std::arg(a));
  const std::size_t n = tracks.time.size(), orders = tracks.orders.size();
  return {{"time", numbers(tracks.time, "s", {n})},
          {"speed", numbers(tracks.speed, "rad/s", {n})},
          {"peak_to_peak", numbers(tracks.peak_to_peak, "m", {n})},
          {"amplitude", numbers(amplitude, "m", {n, orders})},
          {"lag", numbers(lag, "rad", {n, orders})}};
}

json cascade_data(const RunUp& run_up, const std::vector<double>& displacement, double fastest) {
  const double highest = kHighestOrder * fastest / kOneRevolution;
  const SpectrumCascade cascade = spectrum_cascade(run_up.time, displacement, highest, kPieces);
  const std::vector<double> speeds = revolution_speeds(run_up.time, run_up.shaft.angle, cascade.time);
  const std::size_t n = cascade.time.size();
  return {{"speed", numbers(speeds, "rad/s", {n})},
          {"frequency", numbers(cascade.frequency, "Hz", {cascade.frequency.size()})},
          {"amplitude", numbers(cascade.amplitude, "m", {n, cascade.frequency.size()})}};
}

}  // namespace

RunUpSignal::Peak RunUpSignal::peak() const {
  const auto order = std::find(tracks.orders.begin(), tracks.orders.end(), 1.0) - tracks.orders.begin();
  Peak best;
  for (std::size_t k = 0; k < tracks.time.size(); ++k) {
    const std::complex<double> a = tracks.at(k, static_cast<std::size_t>(order));
    if (std::abs(a) > best.size) best = {std::abs(a), tracks.speed[k], tracks.time[k], -std::arg(a)};
  }
  return best;
}

std::optional<RunUp> find_run_up(const Reader& reader) {
  if (!reader.has("/time")) return std::nullopt;
  RunUp run_up;
  run_up.time = reader.read("/time").values;
  if (run_up.time.size() < 2) return std::nullopt;
  std::optional<RotatingShaft> shaft = find_shaft(reader, run_up.time);
  if (!shaft || shaft->angle.size() != run_up.time.size()) return std::nullopt;
  const double revolutions = way(shaft->angle) / kOneRevolution;
  run_up.stretch = longest_stretch(shaft->angle);
  run_up.time = rows_of(run_up.time, run_up.stretch);
  shaft->angle = rows_of(shaft->angle, run_up.stretch);
  if (!(revolutions >= kFewestRevolutions) || !changes_speed(run_up.time, shaft->angle)) return std::nullopt;
  run_up.revolutions = revolutions < kLongRun ? kFewRevolutions : kRevolutions;
  run_up.shaft = std::move(*shaft);
  for (const std::string& bearing : reader.children("/bearings"))
    add_signals(reader, "/bearings/" + bearing + "/eccentricity", false, run_up);
  for (const std::string& body : reader.children("/bodies"))
    add_signals(reader, "/bodies/" + body + "/position", true, run_up);
  if (run_up.displacements.empty()) return std::nullopt;
  return run_up;
}

json run_up_data(const Reader& reader) {
  const std::optional<RunUp> run_up = find_run_up(reader);
  if (!run_up) return nullptr;
  const OrderTracks& first = run_up->displacements.front().tracks;
  const double fastest = *std::max_element(first.speed.begin(), first.speed.end());
  json data{{"shaft", run_up->shaft.name}, {"revolutions", run_up->revolutions}, {"orders", first.orders}};
  data["displacements"] = json::array();
  for (const RunUpSignal& displacement : run_up->displacements) {
    const std::vector<double> values =
        rows_of(column_of(reader.read(displacement.path), displacement.column), run_up->stretch);
    json entry = tracks_data(displacement.tracks);
    entry["path"] = displacement.path;
    entry["column"] = displacement.column;
    entry["cascade"] = cascade_data(*run_up, values, fastest);
    data["displacements"].push_back(std::move(entry));
  }
  return data;
}

}  // namespace hersey::report
