#include "hersey/study/rotor_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "hersey/core/input_error.h"
#include "hersey/core/task_pool.h"

namespace hersey::study {
namespace {

using run::Orbit;
using run::Whirl;
using run::WhirlMode;

constexpr double kAlikeShapes = 0.3;  // least likeness of the shapes of one mode at neighbouring speeds, 0 to 1

/// Likeness of the axis in two modes, 0 to 1 (modal assurance criterion).
double likeness(const WhirlMode& a, const WhirlMode& b) {
  std::complex<double> both = 0;
  double of_a = 0, of_b = 0;
  for (std::size_t k = 0; k < std::min(a.orbits.size(), b.orbits.size()); ++k) {
    both += std::conj(a.orbits[k].x) * b.orbits[k].x + std::conj(a.orbits[k].y) * b.orbits[k].y;
    of_a += std::norm(a.orbits[k].x) + std::norm(a.orbits[k].y);
    of_b += std::norm(b.orbits[k].x) + std::norm(b.orbits[k].y);
  }
  return of_a > 0 && of_b > 0 ? std::norm(both) / (of_a * of_b) : 0;
}

/// True if the rotor differs in its speed alone: neighbours are points of one curve.
bool is_over_speeds(const std::vector<RotorAtSpeed>& rotor) {
  double last = 0;
  for (const RotorAtSpeed& at : rotor) {
    if (!at.state.solved()) continue;
    if (!(at.state.speed > last)) return false;
    last = at.state.speed;
  }
  return true;
}

/// How alike two modes at neighbouring speeds are: shape times frequency, 0 to 1.
double similarity_of(const WhirlMode& a, const WhirlMode& b) {
  const double f = a.mode.damped_frequency, g = b.mode.damped_frequency;
  return likeness(a, b) * std::min(f, g) / std::max(f, g);
}

void follow(const RotorAtSpeed& before, RotorAtSpeed& now, int& next_track) {
  struct Match {
    double similarity;
    std::size_t from, to;
  };
  std::vector<Match> matches;
  for (std::size_t i = 0; i < before.modes.size(); ++i)
    for (std::size_t k = 0; k < now.modes.size(); ++k)
      if (const double similarity = similarity_of(before.modes[i], now.modes[k]); similarity > kAlikeShapes)
        matches.push_back({similarity, i, k});
  std::stable_sort(matches.begin(), matches.end(),
                   [](const Match& a, const Match& b) { return a.similarity > b.similarity; });
  std::vector<bool> taken(before.modes.size(), false);
  now.tracks.assign(now.modes.size(), -1);
  for (const Match& match : matches) {
    if (taken[match.from] || now.tracks[match.to] >= 0) continue;
    taken[match.from] = true;
    now.tracks[match.to] = before.tracks[match.from];
  }
  for (int& track : now.tracks)
    if (track < 0) track = next_track++;
}

/// Parabola through three points, for x between them.
double parabola_through(const std::array<double, 3>& x, const std::array<double, 3>& z, double at) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum += z[i] * (at - x[j]) * (at - x[k]) / ((x[i] - x[j]) * (x[i] - x[k]));
  }
  return sum;
}

/// Where a curve falls to `level` on the way from index `peak` in direction `step`; nothing if it rises above the peak
/// before. Between the points 1/y^2, which near a resonance is a parabola, is one.
std::optional<double> flank(const std::vector<double>& x, const std::vector<double>& y, std::size_t peak, int step,
                            double level) {
  const auto inverse = [](double value) { return 1 / (value * value); };
  for (auto k = static_cast<std::ptrdiff_t>(peak);; k += step) {
    const std::ptrdiff_t next = k + step, before = k - step;
    if (next < 0 || next >= static_cast<std::ptrdiff_t>(y.size())) return std::nullopt;
    const auto h = static_cast<std::size_t>(before), i = static_cast<std::size_t>(k),
               j = static_cast<std::size_t>(next);
    if (y[j] > y[peak]) return std::nullopt;
    if (y[j] > level) continue;
    double inside = x[i], outside = x[j];
    for (int halvings = 0; halvings < 50; ++halvings) {
      const double middle = (inside + outside) / 2;
      const double z = parabola_through({x[h], x[i], x[j]}, {inverse(y[h]), inverse(y[i]), inverse(y[j])}, middle);
      (z < inverse(level) ? inside : outside) = middle;
    }
    return outside;
  }
}

/// Of the whirls that are not much faster than the shaft: fast bending that hardly moves the journals is damped little
/// and not what a fluid drives. Where all are faster, of the slowest one with the one that circles the other way, and
/// of those at the same frequency, whose order is one of round-off.
double least_log_decrement(const run::RotorState& rotor) {
  constexpr double fastest = 1.25;         // of the speed
  constexpr double same_frequency = 1e-3;  // relative: a pair that cross-coupling parts by damping alone
  double least = std::numeric_limits<double>::infinity(), last = 0;
  int taken = 0;
  bool are_backward = true, has_slow = false;
  for (const WhirlMode& mode : run::whirl_modes(rotor)) {
    if (mode.whirl == Whirl::none) continue;
    if (mode.whirl == Whirl::diverging) return mode.log_decrement;
    const double frequency = mode.mode.s.imag();
    const bool is_fast = frequency > fastest * rotor.speed;
    const bool is_pair = taken >= 2 && !are_backward;
    if (is_fast && (has_slow || is_pair) && frequency > (1 + same_frequency) * last) break;
    least = std::min(least, mode.log_decrement), last = frequency;
    ++taken;
    are_backward = are_backward && mode.whirl == Whirl::backward;
    has_slow = has_slow || !is_fast;
  }
  return least;
}

}  // namespace

std::vector<RotorAtSpeed> rotor_over_speeds(const ModelReader& read, const std::vector<model::StudyRun>& runs,
                                            const std::vector<std::string>& stations) {
  std::vector<RotorAtSpeed> rotor(runs.size());
  std::vector<std::optional<InputError>> refused(runs.size());
  TaskPool::shared().run(runs.size(), [&](std::size_t i) {
    RotorAtSpeed& at = rotor[i];
    at.label = runs[i].label, at.values = runs[i].values;
    try {
      at.state = run::find_rotor_state(read(runs[i].overrides), stations);
    } catch (const InputError& error) {
      at.state.fail(error.what());
      refused[i] = error;
    }
    if (at.state.solved()) {
      at.modes = run::whirl_modes(at.state);
      if (at.state.unbalances > 0) at.response = run::unbalance_response(at.state);
    }
  });
  if (std::none_of(rotor.begin(), rotor.end(), [](const RotorAtSpeed& at) { return at.state.solved(); }))
    for (const std::optional<InputError>& error : refused)
      if (error) throw InputError(*error);
  std::stable_sort(rotor.begin(), rotor.end(),
                   [](const RotorAtSpeed& a, const RotorAtSpeed& b) { return a.state.speed < b.state.speed; });
  const RotorAtSpeed none;
  const RotorAtSpeed* before = &none;
  int next_track = 0;
  for (RotorAtSpeed& at : rotor) {
    if (!at.state.solved()) continue;
    follow(*before, at, next_track);
    before = &at;
  }
  return rotor;
}

std::vector<DampedCriticalSpeed> damped_critical_speeds(const std::vector<RotorAtSpeed>& rotor) {
  if (!is_over_speeds(rotor)) return {};
  std::vector<DampedCriticalSpeed> found;
  const RotorAtSpeed* before = nullptr;
  for (const RotorAtSpeed& at : rotor) {
    if (!at.state.solved()) continue;
    for (std::size_t k = 0; before != nullptr && k < at.modes.size(); ++k) {
      const auto same = std::find(before->tracks.begin(), before->tracks.end(), at.tracks[k]);
      if (same == before->tracks.end() || (at.modes[k].whirl == Whirl::none && !at.state.is_geared)) continue;
      const WhirlMode& from = before->modes[static_cast<std::size_t>(same - before->tracks.begin())];
      const double from_gap = from.mode.s.imag() - before->state.speed,
                   gap = at.modes[k].mode.s.imag() - at.state.speed;
      if (!(from_gap > 0 && gap <= 0) && !(from_gap < 0 && gap >= 0)) continue;
      const double share = from_gap / (from_gap - gap);
      found.push_back({at.tracks[k], before->state.speed + share * (at.state.speed - before->state.speed),
                       from.log_decrement + share * (at.modes[k].log_decrement - from.log_decrement),
                       at.modes[k].whirl});
    }
    before = &at;
  }
  return found;
}

std::vector<ResponsePeak> peaks_of(const std::vector<double>& x, const std::vector<double>& y, std::size_t station) {
  std::vector<ResponsePeak> peaks;
  for (std::size_t k = 1; k + 1 < y.size(); ++k) {
    if (!(y[k] > y[k - 1] && y[k] >= y[k + 1])) continue;
    // The parabola of 1/y^2 through the highest point and its neighbours.
    const auto inverse = [&](std::size_t i) { return 1 / (y[i] * y[i]); };
    const double a = x[k] - x[k - 1], b = x[k + 1] - x[k];
    const double left = (inverse(k) - inverse(k - 1)) / a, right = (inverse(k + 1) - inverse(k)) / b;
    const double bend = (right - left) / (a + b), slope = (left * b + right * a) / (a + b);
    ResponsePeak peak{.station = station};
    double shift = bend > 0 ? std::clamp(-slope / (2 * bend), -a / 2, b / 2) : 0;
    // Of a peak that is sharp beside the distance of the speeds the parabola falls below zero: its speed is the
    // nearest.
    if (inverse(k) + shift * (slope + bend * shift) <= 0) shift = 0, peak.is_resolved = false;
    peak.speed = x[k] + shift, peak.amplitude = 1 / std::sqrt(inverse(k) + shift * (slope + bend * shift));
    peak.before = x[k - 1], peak.after = x[k + 1];
    const double level = peak.amplitude / std::sqrt(2);
    const auto low = flank(x, y, k, -1, level), high = flank(x, y, k, 1, level);
    // Three points of which the highest is alone above the level say little of the curve between them.
    if (y[k - 1] < level || y[k + 1] < level) peak.is_resolved = false;
    if (low && high && peak.is_resolved) peak.amplification = peak.speed / (*high - *low);  // (rotors.13)
    peaks.push_back(peak);
  }
  return peaks;
}

std::vector<ResponsePeak> response_peaks(const std::vector<RotorAtSpeed>& rotor) {
  if (!is_over_speeds(rotor)) return {};
  const auto first = std::find_if(rotor.begin(), rotor.end(), [](const auto& at) { return at.state.solved(); });
  std::vector<ResponsePeak> all;
  for (std::size_t s = 0; first != rotor.end() && s < first->state.stations.size(); ++s) {
    std::vector<double> speeds, amplitudes;
    for (const RotorAtSpeed& at : rotor) {
      const auto place = at.state.places.find(first->state.stations[s].name);
      if (!at.response || place == at.state.places.end()) continue;
      speeds.push_back(at.state.speed), amplitudes.push_back(at.response->stations[place->second].major());
    }
    for (const ResponsePeak& peak : peaks_of(speeds, amplitudes, s)) all.push_back(peak);
  }
  return all;
}

// (rotors.14)
SeparationMargin separation_margin(double speed, double amplification, const OperatingRange& range) {
  constexpr double kCriticallyDamped = 2.5;
  SeparationMargin margin;
  const double af = std::isnan(amplification) ? std::numeric_limits<double>::infinity() : amplification;
  const double falling = 1 - 1 / (af - 1.5);
  if (speed < range.low) {
    margin.actual = (range.low - speed) / range.low;
    margin.required = std::min(0.17 * falling, 0.16);
  } else if (speed > range.high) {
    margin.actual = (speed - range.high) / range.high;
    margin.required = std::min(0.10 + 0.17 * falling, 0.26);
  } else {
    margin.required = 0.16;
  }
  if (af < kCriticallyDamped) margin.required = 0;
  return margin;
}

StabilityScreening screen_stability(const run::RotorState& rotor, const run::CrossCoupling& anticipated) {
  constexpr int points = 21;
  constexpr double farthest = 10;  // times Q_A
  const auto at = [&](double Q) {
    return least_log_decrement(run::with_cross_coupling(rotor, {anticipated.station, Q}));
  };
  StabilityScreening screening;
  screening.anticipated = anticipated.Q;
  screening.at_anticipated = at(anticipated.Q);
  for (int k = 0; k < points; ++k) {
    const double Q = farthest * anticipated.Q * k / (points - 1), decrement = at(Q);
    if (!std::isfinite(screening.threshold) && decrement <= 0) {
      double stable = k == 0 ? 0 : screening.Q.back(), unstable = Q;
      for (int i = 0; i < 40 && k > 0; ++i) {
        const double middle = (stable + unstable) / 2;
        (at(middle) > 0 ? stable : unstable) = middle;
      }
      screening.threshold = unstable;
    }
    screening.Q.push_back(Q);
    screening.log_decrement.push_back(decrement);
  }
  return screening;
}

CriticalSpeedMap critical_speed_map(const run::RotorState& rotor, double low, double high, int points) {
  CriticalSpeedMap map;
  for (int k = 0; k < points; ++k) {
    map.stiffness.push_back(low * std::pow(high / low, points > 1 ? static_cast<double>(k) / (points - 1) : 0));
    map.criticals.push_back(run::undamped_critical_speeds(rotor, map.stiffness.back()));
  }
  return map;
}

}  // namespace hersey::study
