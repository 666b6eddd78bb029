#pragma once

#include "hersey/film/value_and_slope.h"

namespace hersey::film {

/// Flow factors of Gaussian roughness with one Peklenik ratio, correlation length in the direction of the flow over
/// that across it. Values and slopes against H = h/sigma > 0; linear in ln gamma between the tabulated ratios and
/// continued smoothly where H lies outside the fits' range (film.43 to film.45).
/// @see Patir & Cheng (1978), J. Lubr. Technol. 100, 12-17; (1979), J. Lubr. Technol. 101, 220-230.
class PatirCheng {
 public:
  /// @throws ContractError for gamma outside [1/9, 9], give or take what two digits of it round to.
  explicit PatirCheng(double gamma);

  [[nodiscard]] ValueAndSlope pressure(double H) const;  ///< phi_x: pressure flow over that between smooth surfaces
  [[nodiscard]] ValueAndSlope shear(double H) const;     ///< Phi_s: flow dragged along in the roughness of one surface
  [[nodiscard]] ValueAndSlope stress(double H) const;    ///< Phi_fs: shear stress from flow over it

 private:
  template <class Fit>
  [[nodiscard]] ValueAndSlope interpolated(Fit&& fit) const;

  int row_ = 0;        ///< of the tables, below gamma
  double weight_ = 0;  ///< of the next row
};

/// Returns phi_f, the mean of h over the local gap, for Couette shear; gaps below sigma/100 count as sigma/100
/// (film.45). It does not depend on gamma.
[[nodiscard]] ValueAndSlope couette_stress_factor(double H);

/// Returns the mean of the local gap over sigma, 0 where the surfaces overlap, with slope and curvature in H (film.42).
struct MeanGap {
  double value = 0, slope = 0, curvature = 0;
};
[[nodiscard]] MeanGap mean_gap(double H);

}  // namespace hersey::film
