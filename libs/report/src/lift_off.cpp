#include "lift_off.h"

#include <algorithm>
#include <cmath>

namespace hersey::report {
namespace {

// A journal as slow as this part of its largest speed starts or stops.
constexpr double kSlow = 0.1;

void keep_faster(std::optional<LiftOff>& best, const LiftOff& found) {
  if (!best || found.speed > best->speed) best = found;
}

}  // namespace

LiftOffs find_lift_offs(const std::vector<double>& speed, const std::vector<double>& contact) {
  LiftOffs found;
  const std::size_t rows = std::min(speed.size(), contact.size());
  if (rows < 2) return found;
  const auto [least, most] = std::minmax_element(speed.begin(), speed.end());
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto [slowest, fastest] = std::minmax_element(speed.begin(), speed.end(), smaller);
  const bool swings = std::min(-*least, *most) > kSlow * std::abs(*fastest);
  if (swings || std::abs(*slowest) >= kSlow * std::abs(*fastest)) return found;
  for (std::size_t k = 1; k < rows; ++k) {
    const double before = contact[k - 1] - lifted_off, after = contact[k] - lifted_off;
    if ((before < 0) == (after < 0)) continue;
    const double part = before / (before - after);
    const double at = std::abs(speed[k - 1]) + part * (std::abs(speed[k]) - std::abs(speed[k - 1]));
    const bool rises = std::abs(speed[k]) > std::abs(speed[k - 1]), falls = std::abs(speed[k]) < std::abs(speed[k - 1]);
    if (rises && after < 0) keep_faster(found.lift_off, {at, k});
    if (falls && before < 0) keep_faster(found.touch_down, {at, k});
  }
  return found;
}

}  // namespace hersey::report
