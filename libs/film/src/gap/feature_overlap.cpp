#include "hersey/film/feature_overlap.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/two_pi.h"

namespace hersey::film {
namespace {

// Half the height of the unit disc at x; 0 beyond it.
double half_chord(double x) { return std::sqrt(std::max(0.0, 1 - x * x)); }

// Height at x of the part of the unit disc between y = 0 and y, with the sign of y.
double height_below(double x, double y) { return std::clamp(y, -half_chord(x), half_chord(x)); }

// Integral of half_chord from 0 to x, |x| <= 1.
double half_disc(double x) { return 0.5 * (x * half_chord(x) + std::asin(x)); }

// Integral of height_below(., y) from -1 to x: the disc's own border outside +-corner, a straight line between.
double area_below(double x, double y) {
  if (y < 0) return -area_below(x, -y);
  x = std::clamp(x, -1.0, 1.0);
  const double corner = half_chord(y);
  double area = half_disc(std::min(x, -corner)) - half_disc(-1);
  if (x > -corner) area += std::min(y, 1.0) * (std::min(x, corner) + corner);
  if (x > corner) area += half_disc(x) - half_disc(corner);
  return area;
}

}  // namespace

// (circuit.12), with lengths around over the hole's half axis and lengths along over the other.
FeatureOverlap overlap_of(const SurfaceFeature& hole, const SurfaceFeature& groove, double phi_journal, double R) {
  const double half_arc = 0.5 * hole.arc, half_length = 0.5 * hole.length;
  const bool hole_turns = hole.surface == Surface::journal;
  const double apart = groove.phi - hole.phi + (hole_turns ? -phi_journal : phi_journal);
  const double middle = std::remainder(apart, two_pi);
  const double below = (groove.z - hole.z - 0.5 * groove.length) / half_length;
  const double above = (groove.z - hole.z + 0.5 * groove.length) / half_length;
  const auto chord = [&](double x) { return height_below(x, above) - height_below(x, below); };
  FeatureOverlap overlap;
  for (const double image : {-two_pi, 0.0, two_pi}) {
    const double first = (middle + image - 0.5 * groove.arc) / half_arc, last = first + groove.arc / half_arc;
    overlap.area +=
        area_below(last, above) - area_below(first, above) - area_below(last, below) + area_below(first, below);
    overlap.slope += chord(last) - chord(first);
  }
  overlap.area = std::max(0.0, overlap.area) * R * half_arc * half_length;
  overlap.slope *= (hole_turns ? -1 : 1) * R * half_length;
  return overlap;
}

}  // namespace hersey::film
