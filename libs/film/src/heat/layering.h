#pragma once

#include <cstddef>
#include <vector>

namespace hersey::film {

/// Where the layers of a film lie across its thickness, as shares of it from the shell (0) to the journal (1): thinner
/// beside the walls, where temperatures change fastest (theory manual, thermal.50).
class Layering {
 public:
  explicit Layering(std::size_t layers);

  [[nodiscard]] std::size_t size() const { return widths_.size(); }
  /// Of the film's thickness [-]; sum 1.
  [[nodiscard]] double width(std::size_t layer) const { return widths_[layer]; }
  [[nodiscard]] double middle(std::size_t layer) const { return middles_[layer]; }
  /// The slope at a wall of the parabola through its temperature and the means of the two layers beside it, 1 and 2, of
  /// which 1 is this layer (0 or the last): beside (T_1 - T_wall) - next (T_2 - T_wall). Between two walls one layer
  /// has the slope over half of it.
  struct Slope {
    double beside = 0, next = 0;
  };
  [[nodiscard]] Slope slope_at_wall(std::size_t layer) const;
  /// From the middle of a layer to that of the next.
  [[nodiscard]] double to_next(std::size_t layer) const { return middles_[layer + 1] - middles_[layer]; }

 private:
  std::vector<double> widths_, middles_;
};

/// That of a film in so many layers, 1 to most_layers; made once.
[[nodiscard]] const Layering& layering_of(std::size_t layers);

}  // namespace hersey::film
