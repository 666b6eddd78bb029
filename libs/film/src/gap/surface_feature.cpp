#include "hersey/film/surface_feature.h"

#include <algorithm>
#include <cmath>

#include "hersey/core/two_pi.h"

namespace hersey::film {
namespace {

constexpr int samples = 50;

}  // namespace

bool contains(const SurfaceFeature& feature, double phi, double z) {
  // A groove all around has no end, wherever its seam lies after rounding.
  const double x = feature.arc >= two_pi ? 0 : std::remainder(phi - feature.phi, two_pi) / (0.5 * feature.arc);
  const double y = (z - feature.z) / (0.5 * feature.length);
  return std::visit([&](const auto& shape) { return shape.contains(x, y); }, feature.shape);
}

bool overlap(const SurfaceFeature& a, const SurfaceFeature& b) {
  const double low = std::max(a.z - 0.5 * a.length, b.z - 0.5 * b.length);
  const double high = std::min(a.z + 0.5 * a.length, b.z + 0.5 * b.length);
  const SurfaceFeature& narrow = a.arc < b.arc ? a : b;
  for (int i = 0; i < samples; ++i) {
    const double phi = narrow.phi + narrow.arc * ((i + 0.5) / samples - 0.5);
    for (int j = 0; j < samples; ++j) {
      const double z = low + (high - low) * (j + 0.5) / samples;
      if (contains(a, phi, z) && contains(b, phi, z)) return true;
    }
  }
  return false;
}

}  // namespace hersey::film
