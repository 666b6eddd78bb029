#include "hersey/core/surface_functions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hersey/core/contract.h"

namespace hersey {
namespace {

constexpr int cubic = 3;
using Four = std::array<double, 4>;

/// Uniform cubic B-splines that are not zero between two knots, at s = 0..1 between them, and their derivatives by s.
struct CubicPieces {
  Four value, slope, curvature;
};

CubicPieces cubic_pieces(double s) {
  const double t = 1 - s;
  return {.value = {t * t * t / 6, (4 - 3 * s * s * (2 - s)) / 6, (4 - 3 * t * t * (2 - t)) / 6, s * s * s / 6},
          .slope = {-t * t / 2, s * (3 * s - 4) / 2, -t * (3 * t - 4) / 2, s * s / 2},
          .curvature = {t, 3 * s - 2, 3 * t - 2, s}};
}

/// B-splines of `degree` on uniform knots in [0, intervals] with repeated end knots, by the recurrence of Cox and de
/// Boor: those that are not zero in the interval of x; the first of them has the index `first`.
struct ClampedPieces {
  int first = 0;
  Four value{};
};

ClampedPieces clamped_pieces(double x, int degree, int intervals) {
  const int interval = std::clamp(static_cast<int>(std::floor(x)), 0, intervals - 1);
  const auto knot = [&](int i) { return static_cast<double>(std::clamp(i, 0, intervals)); };
  ClampedPieces pieces{.first = interval};
  pieces.value[0] = 1;
  for (int d = 1; d <= degree; ++d) {
    double carried = 0;
    for (int r = 0; r < d; ++r) {
      double& value = pieces.value[static_cast<std::size_t>(r)];
      const double low = knot(interval + 1 + r - d), high = knot(interval + 1 + r);
      const double share = value / (high - low);
      value = carried + (high - x) * share;
      carried = (x - low) * share;
    }
    pieces.value[static_cast<std::size_t>(d)] = carried;
  }
  return pieces;
}

}  // namespace

SurfaceFunctions::SurfaceFunctions(int around, int along, double width)
    : around_(around), along_(along), width_(width) {
  HERSEY_REQUIRE(around > cubic, "a periodic cubic spline has four functions or more");
  HERSEY_REQUIRE(along > 0, "there is a function along the axis");
  HERSEY_REQUIRE(width > 0 && std::isfinite(width), "a surface has a width");
}

void SurfaceFunctions::at(double phi, double z, std::vector<SurfaceTerm>& terms) const {
  const double per_angle = around_ / (2 * std::numbers::pi);
  const double revolutions = phi / (2 * std::numbers::pi);
  const double u = (revolutions - std::floor(revolutions)) * around_;
  const int interval = std::min(static_cast<int>(u), around_ - 1);
  const CubicPieces on_circle = cubic_pieces(u - interval);

  const int degree = std::min(cubic, along_ - 1), intervals = along_ - degree;
  const ClampedPieces on_axis = clamped_pieces(std::clamp(z / width_ + 0.5, 0.0, 1.0) * intervals, degree, intervals);

  terms.clear();
  for (int k = 0; k <= degree; ++k) {
    const double along = on_axis.value[static_cast<std::size_t>(k)];
    if (along == 0) continue;
    for (int i = 0; i <= cubic; ++i) {
      const auto piece = static_cast<std::size_t>(i);
      const int column = (interval - 1 + i + around_) % around_;
      terms.push_back({.index = (on_axis.first + k) * around_ + column,
                       .value = on_circle.value[piece] * along,
                       .by_phi = on_circle.slope[piece] * along * per_angle,
                       .by_phi_phi = on_circle.curvature[piece] * along * per_angle * per_angle});
    }
  }
}

}  // namespace hersey
