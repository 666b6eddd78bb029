#include "hersey/film/gap_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hersey::film {

Opening Barrel::opening(double /*phi*/, double z, double L) const { return {drop * std::pow(2 * z / L, 2)}; }

Opening Taper::opening(double /*phi*/, double z, double L) const { return {rise * z / L}; }

Opening Ovality::opening(double phi, double /*z*/, double /*L*/) const {
  const double C = amplitude * std::cos(2 * (phi - angle)), S = amplitude * std::sin(2 * (phi - angle));
  return {C, -2 * S, -4 * C};
}

Opening Lobes::opening(double phi, double /*z*/, double /*L*/) const {
  const double from_middle = std::remainder(phi - angle, 2 * std::numbers::pi / count);
  const double C = offset * std::cos(from_middle);
  return {offset - C, offset * std::sin(from_middle), C};
}

namespace {

/// Angle from a point to the nearest end of an arc [rad]; negative within it.
double beyond(const Arc& arc, double phi) {
  const double half = 0.5 * (arc.to - arc.from);
  return std::abs(std::remainder(phi - arc.from - half, 2 * std::numbers::pi)) - half;
}

}  // namespace

Opening Arcs::opening(double phi, double /*z*/, double /*L*/) const {
  if (arcs.empty()) return {};
  const auto nearest = std::min_element(arcs.begin(), arcs.end(),
                                        [phi](const Arc& a, const Arc& b) { return beyond(a, phi) < beyond(b, phi); });
  const double C = nearest->offset * std::cos(phi - nearest->thinnest);
  return {nearest->extra_clearance + nearest->offset - C, nearest->offset * std::sin(phi - nearest->thinnest), C};
}

Opening MeasuredShape::opening(double phi, double height, double /*L*/) const {
  const auto along = [&](std::size_t k) {
    Opening o{openings[k]->value({&phi, 1})};
    openings[k]->gradient({&phi, 1}, {&o.phi, 1});
    o.phi_phi = openings[k]->second_derivative({&phi, 1});
    return o;
  };
  const auto above = static_cast<std::size_t>(std::upper_bound(z.begin(), z.end(), height) - z.begin());
  if (above == 0) return along(0);
  if (above == z.size()) return along(z.size() - 1);
  const double t = (height - z[above - 1]) / (z[above] - z[above - 1]);
  const Opening low = along(above - 1), high = along(above);
  return {(1 - t) * low.value + t * high.value, (1 - t) * low.phi + t * high.phi,
          (1 - t) * low.phi_phi + t * high.phi_phi};
}

bool Profile::varies_around() const {
  return !std::holds_alternative<Barrel>(shape) && !std::holds_alternative<Taper>(shape);
}

Opening Profile::opening(double phi, double z, double L) const {
  return std::visit([&](const auto& s) { return s.opening(phi, z, L); }, shape);
}

}  // namespace hersey::film
