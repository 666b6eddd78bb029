#include "hersey/mbd/hertz.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey::mbd {
namespace {

/// Principal curvatures of a shape where a round partner touches it, larger first.
std::array<double, 2> curvatures(const ShapeGeometry& shape) {
  if (const auto* ball = std::get_if<Sphere>(&shape)) return {1 / ball->radius, 1 / ball->radius};
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return {1 / capsule->radius, 0};
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return {1 / cylinder->radius, 0};
  return {0, 0};
}

/// R'/R'' of an ellipse with semi-axes ratio b/a = sqrt(1 - e^2); 1 at e = 0, growing with e.
struct Ellipse {
  explicit Ellipse(double axes_ratio)
      : axes(axes_ratio),
        e2(1 - axes_ratio * axes_ratio),
        K(std::comp_ellint_1(std::sqrt(e2))),
        E(std::comp_ellint_2(std::sqrt(e2))) {}
  double axes, e2, K, E;
  [[nodiscard]] double across() const { return E / (axes * axes) - K; }
  [[nodiscard]] double along() const { return K - E; }
  [[nodiscard]] double radii_ratio() const { return across() / along(); }
};

/// The ratio b/a that belongs to a ratio of radii > 1, by bisection in its logarithm.
double axes_ratio(double radii_ratio) {
  double low = -14, high = std::log(1 - 1e-5);
  for (int i = 0; i < 200 && high - low > 1e-15 * std::abs(low); ++i) {
    const double middle = 0.5 * (low + high);
    (Ellipse(std::exp(middle)).radii_ratio() > radii_ratio ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace

std::optional<std::array<double, 2>> relative_radii(const ShapeGeometry& a, const ShapeGeometry& b) {
  const auto is_ball = [](const ShapeGeometry& s) { return std::holds_alternative<Sphere>(s); };
  const auto is_end_on_plane = [](const ShapeGeometry& s, const ShapeGeometry& plane) {
    return std::holds_alternative<Capsule>(s) && std::holds_alternative<HalfSpace>(plane);
  };
  if (is_end_on_plane(a, b)) return relative_radii(Sphere{Vector3::Zero(), std::get<Capsule>(a).radius}, b);
  if (is_end_on_plane(b, a)) return relative_radii(b, a);
  if (!is_ball(a) && !is_ball(b)) return std::nullopt;
  const std::array<double, 2> of_a = curvatures(a), of_b = curvatures(b);
  // One of them is a sphere, so the principal directions are those of the other.
  return std::array<double, 2>{1 / (of_a[1] + of_b[1]), 1 / (of_a[0] + of_b[0])};
}

double hertz_stiffness(double composite_modulus, const std::array<double, 2>& radii) {
  HERSEY_REQUIRE(composite_modulus > 0 && radii[0] >= radii[1] && radii[1] > 0, "modulus and radii are positive");
  const double mean = std::sqrt(radii[0] * radii[1]);
  const double round = 4.0 / 3.0 * composite_modulus * std::sqrt(mean);
  const double ratio = radii[0] / radii[1];
  if (ratio < 1 + 1e-4) return round;  // F2 differs from 1 by the square of the difference only
  const Ellipse ellipse(axes_ratio(ratio));
  const double F1 = std::cbrt(4 / (std::numbers::pi * ellipse.e2)) * std::sqrt(ellipse.axes) *
                    std::pow(ellipse.across() * ellipse.along(), 1.0 / 6.0);
  const double F2 = 2 / std::numbers::pi * std::sqrt(ellipse.axes) / F1 * ellipse.K;
  return round / std::pow(F2, 1.5);
}

}  // namespace hersey::mbd
