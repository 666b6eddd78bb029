#include "hersey/core/surface_functions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hersey/core/contract.h"
#include "hersey/core/two_pi.h"

namespace hersey {
namespace {

constexpr int cubic = 3;
using Four = std::array<double, 4>;

/// Functions that are not zero between two knots and their derivatives by the coordinate in which knots have the
/// distance 1.
struct Pieces {
  int first = 0;  ///< index of the first of them
  Four value{}, slope{}, curvature{};
};

/// Uniform periodic cubic B-splines, `count` of them around, at u = 0..count.
Pieces periodic_pieces(double u, int count) {
  const int interval = std::min(static_cast<int>(u), count - 1);
  const double s = u - interval, t = 1 - s;
  return {.first = interval - 1 + count,
          .value = {t * t * t / 6, (4 - 3 * s * s * (2 - s)) / 6, (4 - 3 * t * t * (2 - t)) / 6, s * s * s / 6},
          .slope = {-t * t / 2, s * (3 * s - 4) / 2, -t * (3 * t - 4) / 2, s * s / 2},
          .curvature = {t, 3 * s - 2, 3 * t - 2, s}};
}

/// B-splines of `degree` on uniform knots in [0, intervals] with repeated end knots, by the recurrence of Cox and de
/// Boor and its derivatives.
Pieces clamped_pieces(double x, int degree, int intervals) {
  struct Piece {
    double value = 0, slope = 0, curvature = 0;
    /// Times a + b x, the value of which is `factor`.
    [[nodiscard]] Piece times(double factor, double b) const {
      return {factor * value, factor * slope + b * value, factor * curvature + 2 * b * slope};
    }
    [[nodiscard]] Piece plus(const Piece& other) const {
      return {value + other.value, slope + other.slope, curvature + other.curvature};
    }
  };
  const int interval = std::clamp(static_cast<int>(std::floor(x)), 0, intervals - 1);
  const auto knot = [&](int i) { return static_cast<double>(std::clamp(i, 0, intervals)); };
  std::array<Piece, 4> pieces{Piece{.value = 1}};
  for (int d = 1; d <= degree; ++d) {
    Piece carried;
    for (int r = 0; r < d; ++r) {
      Piece& piece = pieces[static_cast<std::size_t>(r)];
      const double low = knot(interval + 1 + r - d), high = knot(interval + 1 + r), per = 1 / (high - low);
      const Piece rest = piece;
      piece = carried.plus(rest.times((high - x) * per, -per));
      carried = rest.times((x - low) * per, per);
    }
    pieces[static_cast<std::size_t>(d)] = carried;
  }
  Pieces all{.first = interval};
  for (std::size_t i = 0; i < pieces.size(); ++i)
    all.value[i] = pieces[i].value, all.slope[i] = pieces[i].slope, all.curvature[i] = pieces[i].curvature;
  return all;
}

}  // namespace

SurfaceFunctions::SurfaceFunctions(int around, int along, double width, std::optional<SurfaceArc> arc)
    : around_(around), along_(along), width_(width), arc_(arc) {
  HERSEY_REQUIRE(around > cubic, "a cubic spline has four functions or more");
  HERSEY_REQUIRE(along > 0, "there is a function along the axis");
  HERSEY_REQUIRE(width > 0 && std::isfinite(width), "a surface has a width");
  HERSEY_REQUIRE(!arc || (arc->over > 0 && arc->over < two_pi), "an arc is a part of a turn");
}

void SurfaceFunctions::at(double phi, double z, std::vector<SurfaceTerm>& terms) const {
  Pieces round;
  double per_angle = around_ / two_pi;
  if (arc_) {
    const int intervals = around_ - cubic;
    per_angle = intervals / arc_->over;
    const double from_middle = std::remainder(phi - arc_->from - 0.5 * arc_->over, two_pi);
    const bool is_beyond = std::abs(from_middle) > 0.5 * arc_->over;
    round = clamped_pieces(std::clamp(0.5 + from_middle / arc_->over, 0.0, 1.0) * intervals, cubic, intervals);
    if (is_beyond) round.slope.fill(0), round.curvature.fill(0);
  } else {
    const double revolutions = phi / two_pi;
    round = periodic_pieces((revolutions - std::floor(revolutions)) * around_, around_);
  }
  const int degree = std::min(cubic, along_ - 1), intervals = along_ - degree;
  const Pieces on_axis = clamped_pieces(std::clamp(z / width_ + 0.5, 0.0, 1.0) * intervals, degree, intervals);

  terms.clear();
  for (int k = 0; k <= degree; ++k) {
    const double along = on_axis.value[static_cast<std::size_t>(k)];
    if (along == 0) continue;
    for (int i = 0; i <= cubic; ++i) {
      const auto piece = static_cast<std::size_t>(i);
      const int column = (round.first + i) % around_;
      terms.push_back({.index = (on_axis.first + k) * around_ + column,
                       .value = round.value[piece] * along,
                       .by_phi = round.slope[piece] * along * per_angle,
                       .by_phi_phi = round.curvature[piece] * along * per_angle * per_angle});
    }
  }
}

}  // namespace hersey
