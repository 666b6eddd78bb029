#pragma once

#include <array>

namespace hersey::film {

/// Heat from a film into a wall at one node, by the temperatures of the two layers beside the wall and of the wall
/// (theory manual, thermal.53): beside T_1 - next T_2 - wall() T_wall.
struct WallFlux {
  double beside = 0;  ///< by the layer beside the wall [W/K]
  double next = 0;    ///< by the layer after that [W/K]
  [[nodiscard]] double wall() const { return beside - next; }

  WallFlux& operator+=(const WallFlux& other) {
    beside += other.beside, next += other.next;
    return *this;
  }
};

}  // namespace hersey::film
