#include "hersey/film/feature_overlap.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "hersey/core/two_pi.h"

namespace hersey::film {
namespace feature_overlap_test {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kR = 0.025;  // m

SurfaceFeature hole(double length = 5e-3) {
  return {.name = "hole", .shape = Ellipse{}, .surface = Surface::journal, .phi = 0.4, .arc = 0.2, .length = length};
}

SurfaceFeature groove(double arc = 2.1, double z = 0.7e-3) {
  return {.name = "groove", .shape = Rectangle{}, .phi = 5.9, .z = z, .arc = arc, .length = 4e-3};
}

double area_of(const SurfaceFeature& ellipse) { return std::numbers::pi / 4 * kR * ellipse.arc * ellipse.length; }

// Narrow and wide grooves, one that ends over the hole, one that goes all around.
std::vector<SurfaceFeature> grooves() { return {groove(), groove(0.05), groove(0.3, -2e-3), groove(two_pi)}; }

// By columns of the hole, each as long as lies in the groove.
TEST_CASE("OverlapOfHoleAndGroove_IsTheAreaOfBoth") {
  const int columns = 20000;
  for (const SurfaceFeature& of : grooves()) {
    CAPTURE(of.arc);
    for (double phi = -7; phi < 7; phi += 0.037) {
      const SurfaceFeature round = hole();
      double sum = 0;
      for (int k = 0; k < columns; ++k) {
        const double x = -1 + (2 * k + 1.0) / columns, half = 0.5 * round.length * std::sqrt(1 - x * x);
        const double at = std::remainder(round.phi + phi + 0.5 * round.arc * x - of.phi, two_pi);
        if (std::abs(at) > 0.5 * of.arc) continue;
        const double top = std::min(half, of.z + 0.5 * of.length), bottom = std::max(-half, of.z - 0.5 * of.length);
        sum += std::max(0.0, top - bottom) * kR * round.arc / columns;
      }
      // a column at each end of the groove, and the sum's own error
      CHECK(std::abs(overlap_of(round, of, phi, kR).area - sum) < 3 * area_of(round) / columns);
    }
  }
}

TEST_CASE("OverlapOfHoleAndGroove_HasTheSlopeOfItsDifference") {
  const double step = 1e-6;  // rad: leaves 1e-10 of the slope but where a border passes, there its root
  for (const SurfaceFeature& of : grooves())
    for (double phi = -7; phi < 7; phi += 0.0173) {
      const auto area = [&](double at) { return overlap_of(hole(), of, at, kR).area; };
      const double difference = (area(phi + step) - area(phi - step)) / (2 * step);
      // of a hole's length, as far as a border moves it within the difference
      CHECK(std::abs(overlap_of(hole(), of, phi, kR).slope - difference) < 1e-2 * kR * hole().length);
    }
}

// Over a revolution every point of the hole is over the groove for its arc.
TEST_CASE("MeanOverlapOverARevolution_IsTheHolesAreaTimesTheGroovesShare") {
  const double z_inside = 0;
  const SurfaceFeature small = hole(3e-3);  // within the groove's length
  for (const double arc : {0.05, 0.7, 3.0}) {
    const int steps = 4000;
    double sum = 0;
    for (int k = 0; k < steps; ++k) sum += overlap_of(small, groove(arc, z_inside), two_pi * k / steps, kR).area;
    // equal steps over a period: of the fourth order where borders pass
    CHECK(sum / steps == doctest::Approx(area_of(small) * arc / two_pi).epsilon(1e-6));
  }
  CHECK(overlap_of(small, groove(two_pi, z_inside), 1.3, kR).area ==
        doctest::Approx(area_of(small)).epsilon(64 * kEps));
}

TEST_CASE("OverlapIsTheSame_MirroredTurnedAndWithSurfacesExchanged") {
  for (double phi = -3; phi < 3; phi += 0.041) {
    SurfaceFeature a = hole(), b = groove();
    const FeatureOverlap as_is = overlap_of(a, b, phi, kR);
    const double sums = 1e3 * kEps * area_of(a);  // differences of areas of the whole disc
    SurfaceFeature mirrored_a = a, mirrored_b = b;
    mirrored_a.phi = -a.phi, mirrored_b.phi = -b.phi, mirrored_b.z = -b.z;
    CHECK(std::abs(overlap_of(mirrored_a, mirrored_b, -phi, kR).area - as_is.area) < sums);
    CHECK(std::abs(overlap_of(a, b, phi + two_pi, kR).area - as_is.area) < 10 * sums);  // of the angle, too
    a.surface = Surface::shell, b.surface = Surface::journal;
    CHECK(std::abs(overlap_of(a, b, -phi, kR).area - as_is.area) < sums);
    CHECK(std::abs(overlap_of(a, b, -phi, kR).slope + as_is.slope) < 1e3 * kEps * kR * a.length);  // as above
  }
}

}  // namespace feature_overlap_test
}  // namespace hersey::film
