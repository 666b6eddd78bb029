#pragma once

#include <array>

#include "gap/flow_factors.h"
#include "hersey/film/film_model.h"

namespace hersey::film {

/// Effect of roughness on the gap at one node, with slopes in h. Index 0: along phi, 1: along z. Between smooth
/// surfaces the mean is h itself and the other members keep their initial values.
struct RoughGap {
  double mean = 0, mean_h = 1, mean_hh = 0;  ///< mean of the local gap [m], which contains the oil
  std::array<double, 2> pressure{1, 1};      ///< phi_p: factor of the pressure flow [-]
  std::array<double, 2> pressure_h{};        ///< [1/m]
  std::array<double, 2> drag{};    ///< sigma phi_s: thickness of the oil that sliding drags along with the shell [m]
  std::array<double, 2> drag_h{};  ///< [-]
  std::array<double, 2> couette{1, 1};  ///< factor of Couette shear [-]
  std::array<double, 2> couette_h{};    ///< [1/m]
};

/// Flow factors of both surfaces together (theory manual, film.41 to film.47).
class RoughGapLaw {
 public:
  explicit RoughGapLaw(const Roughness& roughness);

  [[nodiscard]] bool is_smooth() const { return sigma_ == 0; }
  /// @param roughness  over that of the model [-], > 0
  [[nodiscard]] RoughGap state(double h, double roughness = 1) const;
  /// Returns the mean gap [m] at a distance h of the mean planes [m], which may be negative, and its slope.
  [[nodiscard]] ValueAndSlope mean(double h, double roughness = 1) const;

 private:
  struct Direction {
    PatirCheng both, shell, journal;
  };
  static Direction direction(const Roughness& roughness, bool axial);

  double sigma_;
  double shell_fraction_, journal_fraction_;  ///< of the variance
  std::array<Direction, 2> directions_;
};

}  // namespace hersey::film
