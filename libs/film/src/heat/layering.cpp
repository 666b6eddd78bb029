#include "heat/layering.h"

#include <cmath>
#include <numbers>

#include "hersey/film/thermal_model.h"

namespace hersey::film {
namespace {

// Blend of equal layers (0) and those between Chebyshev's points (1). A fifth makes the outer two of five layers 0.18
// thick and the middle one 0.22: there five layers have the smallest error in load, and shells as little as with equal
// layers.
constexpr double grading = 0.2;

}  // namespace

Layering::Layering(std::size_t layers) {
  const double n = static_cast<double>(layers);
  const auto boundary = [&](std::size_t l) {
    const double even = static_cast<double>(l) / n;
    return (1 - grading) * even + grading * 0.5 * (1 - std::cos(std::numbers::pi * even));
  };
  for (std::size_t l = 0; l < layers; ++l) {
    widths_.push_back(boundary(l + 1) - boundary(l));
    middles_.push_back(0.5 * (boundary(l + 1) + boundary(l)));
  }
}

// With T - T_wall = a y + b y^2 the means of layers w_1 and w_2 thick are a w_1/2 + b w_1^2/3 and
// a (w_1 + w_2/2) + b (w_1^2 + w_1 w_2 + w_2^2/3).
Layering::Slope Layering::slope_at_wall(std::size_t layer) const {
  const double w = width(layer);
  if (size() == 1) return {2 / w, 0};
  const double v = width(layer == 0 ? 1 : layer - 1);
  const double by_a1 = w / 2, by_b1 = w * w / 3, by_a2 = w + v / 2, by_b2 = w * w + w * v + v * v / 3;
  const double size = by_a1 * by_b2 - by_a2 * by_b1;
  return {by_b2 / size, by_b1 / size};
}

const Layering& layering_of(std::size_t layers) {
  static const std::vector<Layering> all = [] {
    std::vector<Layering> made;
    for (std::size_t n = 1; n <= most_layers; ++n) made.emplace_back(n);
    return made;
  }();
  return all[layers - 1];
}

}  // namespace hersey::film
