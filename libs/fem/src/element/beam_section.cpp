#include "hersey/fem/beam_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey::fem {
namespace {

constexpr double pi = std::numbers::pi;

/// Torsion constant of a rectangle with sides a >= b (beams.7):
/// a b^3 (1/3 - (64/pi^5) (b/a) sum over odd n of tanh(n pi a/(2 b))/n^5).
double torsion_constant(double a, double b) {
  double sum = 0;
  for (int n = 1; n < 200; n += 2) sum += std::tanh(n * pi * a / (2 * b)) / std::pow(n, 5);
  return a * b * b * b * (1.0 / 3 - 64 / std::pow(pi, 5) * b / a * sum);
}

}  // namespace

BeamSection circular_section(double diameter, double bore, double nu) {
  HERSEY_REQUIRE(0 <= bore && bore < diameter, "a round section has material");
  const double square = diameter * diameter, inner = bore * bore;
  BeamSection section;
  section.area = pi / 4 * (square - inner);
  section.I_y = section.I_z = pi / 64 * (square * square - inner * inner);
  section.J = 2 * section.I_y;
  const double m = bore / diameter, n = (1 + m * m) * (1 + m * m);
  section.shear_y = section.shear_z = section.area * 6 * (1 + nu) * n / ((7 + 6 * nu) * n + (20 + 12 * nu) * m * m);
  return section;
}

BeamSection rectangular_section(double width, double height, double nu) {
  HERSEY_REQUIRE(width > 0 && height > 0, "a rectangle has sides");
  BeamSection section;
  section.area = width * height;
  section.I_y = width * height * height * height / 12;
  section.I_z = height * width * width * width / 12;
  section.J = torsion_constant(std::max(width, height), std::min(width, height));
  section.shear_y = section.shear_z = section.area * 10 * (1 + nu) / (12 + 11 * nu);
  return section;
}

}  // namespace hersey::fem
