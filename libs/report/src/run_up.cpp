#include "run_up.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

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
// What is on a shaft rotates as far as it but for what its joints, couplings and deformations leave.
constexpr double kSameShaft = kHalfTurn;
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

/// What rotates, by its angle at every row of the run.
struct Rotation {
  std::string name;
  std::vector<double> angle;  ///< [rad]
};

void keep_farther(std::optional<Rotation>& best, Rotation found) {
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

/// The integral of a rate over the time, 0 at the first row.
std::vector<double> integral_of(const std::vector<double>& rate, const std::vector<double>& time) {
  std::vector<double> sum{0};
  for (std::size_t k = 1; k < std::min(rate.size(), time.size()); ++k)
    sum.push_back(sum.back() + 0.5 * (rate[k] + rate[k - 1]) * (time[k] - time[k - 1]));
  return sum;
}

/// The angle of a body about the axis of ground that it rotates about most.
std::vector<double> rotation_of_body(const Reader& reader, const std::string& body, const std::vector<double>& time) {
  const std::string path = body + "/angular_velocity";
  std::vector<double> best;
  if (!reader.has(path)) return best;
  const Array omega = reader.read(path);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> angle = integral_of(column_of(omega, axis), time);
    if (best.empty() || way(angle) > way(best)) best = std::move(angle);
  }
  return best;
}

/// The angle of a body about the axis that it has where it is fastest, however that lies in space.
std::vector<double> rotation_about_own_axis(const Reader& reader, const std::string& body,
                                            const std::vector<double>& time) {
  const std::string path = body + "/angular_velocity";
  if (!reader.has(path)) return {};
  const Array omega = reader.read(path);
  std::array<std::vector<double>, 3> of;
  for (std::size_t axis = 0; axis < 3; ++axis) of[axis] = column_of(omega, axis);
  const auto speed = [&](std::size_t k) { return std::hypot(of[0][k], of[1][k], of[2][k]); };
  std::size_t fastest = 0;
  for (std::size_t k = 0; k < of[0].size(); ++k)
    if (speed(k) > speed(fastest)) fastest = k;
  std::vector<double> rate;
  if (of[0].empty() || !(speed(fastest) > 0)) return rate;
  for (std::size_t k = 0; k < of[0].size(); ++k) {
    double along = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) along += of[axis][k] * of[axis][fastest] / speed(fastest);
    rate.push_back(along);
  }
  return integral_of(rate, time);
}

std::vector<Rotation> rotations_of_joints(const Reader& reader) {
  std::vector<Rotation> rotations;
  for (const std::string& joint : reader.children("/joints"))
    rotations.push_back({joint, rotation_of(reader, "/joints/" + joint)});
  return rotations;
}

std::optional<Rotation> find_shaft(const Reader& reader, const std::vector<Rotation>& joints,
                                   const std::vector<double>& time) {
  if (reader.has("/crank_angle")) return Rotation{"crank", reader.read("/crank_angle").values};
  std::optional<Rotation> shaft;
  for (const Rotation& joint : joints) keep_farther(shaft, joint);
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

/// The shaft over its longest stretch; unset where it makes too few revolutions there, or hardly changes its speed.
std::optional<RotatingShaft> run_up_of(const Rotation& rotation, const std::vector<double>& time) {
  if (rotation.angle.size() != time.size()) return std::nullopt;
  const double revolutions = way(rotation.angle) / kOneRevolution;
  if (!(revolutions >= kFewestRevolutions)) return std::nullopt;
  RotatingShaft shaft;
  shaft.name = rotation.name;
  shaft.stretch = longest_stretch(rotation.angle);
  shaft.time = rows_of(time, shaft.stretch);
  shaft.angle = rows_of(rotation.angle, shaft.stretch);
  shaft.revolutions = revolutions < kLongRun ? kFewRevolutions : kRevolutions;
  if (!changes_speed(shaft.time, shaft.angle)) return std::nullopt;
  return shaft;
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

/// Collects the displacements of a run-up, each with the shaft that it rotates with.
class SignalCollector {
 public:
  SignalCollector(const Reader& reader, const std::vector<double>& time, const std::vector<Rotation>& joints,
                  const Rotation& main, RunUp& run_up)
      : reader_(reader), time_(time), joints_(joints), main_(main), run_up_(run_up) {
    for (const std::string& body : reader.children("/bodies"))
      bodies_.push_back({body, rotation_about_own_axis(reader, "/bodies/" + body, time)});
  }

  void add_bearings() {
    for (const std::string& bearing : reader_.children("/bearings")) {
      const std::string path = "/bearings/" + bearing, speed = path + "/speed";
      Rotation journal;
      if (reader_.has(speed)) journal.angle = integral_of(reader_.read(speed).values, time_);
      add_signals(path + "/eccentricity", false, shaft_of(journal));
    }
  }

  void add_bodies() {
    for (const Rotation& body : bodies_) add_signals("/bodies/" + body.name + "/position", true, shaft_of(body));
  }

 private:
  [[nodiscard]] static bool rotate_alike(const Rotation& a, const Rotation& b) {
    return std::abs(way(a.angle) - way(b.angle)) <= kSameShaft;
  }

  /// The shaft of the run, but for what rotates at another speed: its joint, else the body itself; unset where that
  /// makes no run-up, so that it has no orders.
  [[nodiscard]] std::optional<std::size_t> shaft_of(const Rotation& own) {
    if (way(own.angle) <= kHalfTurn || rotate_alike(own, main_)) return 0;
    if (way(own.angle) < kFewestRevolutions * kOneRevolution) return std::nullopt;
    const auto is_it = [&](const Rotation& other) { return rotate_alike(own, other); };
    auto found = std::ranges::find_if(joints_, is_it);
    if (found == joints_.end()) found = std::ranges::find_if(std::as_const(bodies_), is_it);
    if (found == bodies_.end()) return 0;
    const auto known = std::ranges::find(run_up_.shafts, found->name, &RotatingShaft::name);
    if (known != run_up_.shafts.end()) return static_cast<std::size_t>(known - run_up_.shafts.begin());
    std::optional<RotatingShaft> shaft = run_up_of(*found, time_);
    if (!shaft) return std::nullopt;
    run_up_.shafts.push_back(std::move(*shaft));
    return run_up_.shafts.size() - 1;
  }

  /// Tracks the columns of a dataset in which something moves across the shaft; bodies that move like what has been
  /// tracked before are left out.
  void add_signals(const std::string& path, bool is_body, std::optional<std::size_t> shaft_index) {
    if (!shaft_index || !reader_.has(path)) return;
    const RotatingShaft& shaft = run_up_.shafts[*shaft_index];
    const Array array = reader_.read(path);
    std::vector<std::vector<double>> columns;
    double most = 0;
    for (std::size_t i = 0; i < array.width(); ++i) {
      if (array.info.shape.at(0) < shaft.stretch.end) return;
      columns.push_back(rows_of(column_of(array, i), shaft.stretch));
      most = std::max(most, range_of(columns.back()));
    }
    OrderOptions options;
    options.revolutions = shaft.revolutions;
    for (std::size_t i = 0; i < columns.size() && run_up_.displacements.size() < kMostSignals; ++i) {
      if (columns[i].size() != shaft.time.size() || !(range_of(columns[i]) > kAcross * most)) continue;
      OrderTracks tracks = track_orders(shaft.time, shaft.angle, columns[i], options);
      if (tracks.time.empty() || (is_body && is_known(tracks, run_up_))) continue;
      run_up_.displacements.push_back({path, i, *shaft_index, std::move(tracks)});
    }
  }

  const Reader& reader_;
  const std::vector<double>& time_;
  const std::vector<Rotation>& joints_;
  const Rotation& main_;
  RunUp& run_up_;
  std::vector<Rotation> bodies_;
};

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

json cascade_data(const RotatingShaft& shaft, const std::vector<double>& displacement, double fastest) {
  const double highest = kHighestOrder * fastest / kOneRevolution;
  const SpectrumCascade cascade = spectrum_cascade(shaft.time, displacement, highest, kPieces);
  const std::vector<double> speeds = revolution_speeds(shaft.time, shaft.angle, cascade.time);
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
  const std::vector<double> time = reader.read("/time").values;
  if (time.size() < 2) return std::nullopt;
  const std::vector<Rotation> joints = rotations_of_joints(reader);
  const std::optional<Rotation> main = find_shaft(reader, joints, time);
  if (!main) return std::nullopt;
  std::optional<RotatingShaft> shaft = run_up_of(*main, time);
  if (!shaft) return std::nullopt;
  RunUp run_up;
  run_up.shafts.push_back(std::move(*shaft));
  SignalCollector collector(reader, time, joints, *main, run_up);
  collector.add_bearings();
  collector.add_bodies();
  if (run_up.displacements.empty()) return std::nullopt;
  return run_up;
}

json run_up_data(const Reader& reader) {
  const std::optional<RunUp> run_up = find_run_up(reader);
  if (!run_up) return nullptr;
  const RotatingShaft& main = run_up->shafts.front();
  json data{
      {"shaft", main.name}, {"revolutions", main.revolutions}, {"orders", run_up->displacements.front().tracks.orders}};
  data["displacements"] = json::array();
  for (const RunUpSignal& displacement : run_up->displacements) {
    const RotatingShaft& shaft = run_up->shafts[displacement.shaft];
    const std::vector<double>& speed = displacement.tracks.speed;
    const std::vector<double> values =
        rows_of(column_of(reader.read(displacement.path), displacement.column), shaft.stretch);
    json entry = tracks_data(displacement.tracks);
    entry["path"] = displacement.path;
    entry["column"] = displacement.column;
    entry["shaft"] = shaft.name;
    entry["revolutions"] = shaft.revolutions;
    entry["cascade"] = cascade_data(shaft, values, *std::max_element(speed.begin(), speed.end()));
    data["displacements"].push_back(std::move(entry));
  }
  return data;
}

}  // namespace hersey::report
