#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hersey::film {

/// Positions of a film's layers across its thickness, as fractions of it from the shell (0) to the journal (1): layers
/// are thinner beside the walls, where temperatures change fastest (theory manual, thermal.50).
class Layering {
 public:
  explicit Layering(std::size_t layers);

  [[nodiscard]] std::size_t size() const { return widths_.size(); }
  /// Width of a layer over the film's thickness [-]; sum 1.
  [[nodiscard]] double width(std::size_t layer) const { return widths_[layer]; }
  [[nodiscard]] double middle(std::size_t layer) const { return middles_[layer]; }
  /// Slope at a wall of the parabola through its temperature and the means of the two layers beside it, 1 and 2, where
  /// 1 is this layer (0 or the last): beside (T_1 - T_wall) - next (T_2 - T_wall). One layer between two walls has the
  /// slope over half of it.
  struct Slope {
    double beside = 0, next = 0;
  };
  [[nodiscard]] Slope slope_at_wall(std::size_t layer) const;
  /// Distance from the middle of a layer to that of the next.
  [[nodiscard]] double to_next(std::size_t layer) const { return middles_[layer + 1] - middles_[layer]; }
  /// Slope in the middle of a layer of the parabola through the means of it and of both beside it; beside a wall, of it
  /// and of the next two. @param value  of a layer
  template <class Values>
  [[nodiscard]] double slope(std::size_t layer, Values&& value) const {
    const auto step = [&](std::size_t l) { return (value(l + 1) - value(l)) / to_next(l); };
    if (size() < 3) return size() < 2 ? 0 : step(0);
    const std::size_t k = std::clamp<std::size_t>(layer, 1, size() - 2);
    const double a = to_next(k - 1), b = to_next(k), before = step(k - 1), after = step(k);
    const double bend = (after - before) / (a + b), in_middle = before + a * bend;
    return in_middle + 2 * bend * (middle(layer) - middle(k));
  }

 private:
  std::vector<double> widths_, middles_;
};

/// Returns the layering of a film of so many layers, 1 to most_layers; it is made once.
[[nodiscard]] const Layering& layering_of(std::size_t layers);

}  // namespace hersey::film
