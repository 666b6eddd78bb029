#include "gap/rough_gap.h"

#include <cmath>

namespace hersey::film {

double Roughness::composite_sigma() const { return std::hypot(shell.sigma, journal.sigma); }

bool Roughness::counts() const { return flow_factors != FlowFactors::none && composite_sigma() > 0; }

// Pressure flow depends on both surfaces together: their common ratio is the mean of ln gamma by variance.
RoughGapLaw::Direction RoughGapLaw::direction(const Roughness& roughness, bool axial) {
  const SurfaceRoughness &s = roughness.shell, &j = roughness.journal;
  const double variance = s.sigma * s.sigma + j.sigma * j.sigma;
  const double sign = axial ? -1 : 1;  // along z the ratio is the inverse
  const double both =
      variance > 0 ? (s.sigma * s.sigma * std::log(s.gamma) + j.sigma * j.sigma * std::log(j.gamma)) / variance : 0;
  return {PatirCheng(std::exp(sign * both)), PatirCheng(std::pow(s.gamma, sign)), PatirCheng(std::pow(j.gamma, sign))};
}

RoughGapLaw::RoughGapLaw(const Roughness& roughness)
    : sigma_(roughness.counts() ? roughness.composite_sigma() : 0),
      shell_fraction_(sigma_ > 0 ? std::pow(roughness.shell.sigma / sigma_, 2) : 0),
      journal_fraction_(sigma_ > 0 ? std::pow(roughness.journal.sigma / sigma_, 2) : 0),
      directions_{direction(roughness, false), direction(roughness, true)} {}

ValueAndSlope RoughGapLaw::mean(double h, double roughness) const {
  if (is_smooth()) return {h, 1};
  const double sigma = roughness * sigma_;
  const MeanGap gap = mean_gap(h / sigma);
  return {sigma * gap.value, gap.slope};
}

RoughGap RoughGapLaw::state(double h, double roughness) const {
  RoughGap r;
  if (is_smooth()) {
    r.mean = h;
    return r;
  }
  const double sigma = roughness * sigma_, H = h / sigma;
  const MeanGap gap = mean_gap(H);
  r.mean = sigma * gap.value, r.mean_h = gap.slope, r.mean_hh = gap.curvature / sigma;
  const ValueAndSlope smooth = couette_stress_factor(H);
  for (int k = 0; k < 2; ++k) {
    const Direction& d = directions_[k];
    const ValueAndSlope pressure = d.both.pressure(H);
    r.pressure[k] = pressure.value, r.pressure_h[k] = pressure.slope / sigma;
    r.couette[k] = smooth.value, r.couette_h[k] = smooth.slope / sigma;
    // Each rough surface drags oil with it and adds to the shear (film.43, film.46).
    const auto add = [&](const PatirCheng& surface, double fraction, double sign) {
      if (fraction == 0) return;
      const ValueAndSlope shear = surface.shear(H), stress = surface.stress(H);
      r.drag[k] += sign * fraction * sigma * shear.value, r.drag_h[k] += sign * fraction * shear.slope;
      r.couette[k] += fraction * stress.value, r.couette_h[k] += fraction * stress.slope / sigma;
    };
    add(d.shell, shell_fraction_, 1);
    add(d.journal, journal_fraction_, -1);
  }
  return r;
}

}  // namespace hersey::film
