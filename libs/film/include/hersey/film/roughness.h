#pragma once

namespace hersey::film {

/// Roughness of one surface: a Gaussian height with correlation lengths of its own along phi and along z.
struct SurfaceRoughness {
  double sigma = 0;  ///< rms height [m], >= 0
  double gamma = 1;  ///< Peklenik's ratio, correlation length along phi over that along z [-], in [1/9, 9]
};

enum class FlowFactors { none, patir_cheng };

/// Effect of both surfaces' roughness on flow and shear of the oil. Asperities describes contact.
struct Roughness {
  FlowFactors flow_factors = FlowFactors::none;
  SurfaceRoughness shell, journal;

  [[nodiscard]] double composite_sigma() const;  ///< rms height of both together [m]
  [[nodiscard]] bool counts() const;             ///< true if it changes anything
};

}  // namespace hersey::film
