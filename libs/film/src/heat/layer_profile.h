#pragma once

#include <span>
#include <vector>

namespace hersey::film {

/// Variation of the fluidity 1/mu within a layer (theory manual, thermal.51): linear through its mean, with the slope
/// that its neighbours give it; or constant, in layers whose shear is known (thermal.26).
enum class WithinLayers { linear, constant };

/// Flow and shear coefficients of one node where viscosities differ across the film, at the cavitation pressure (theory
/// manual, thermal.4, thermal.5). Layers are counted from the shell to the journal (Layering).
struct LayerProfile {
  double fluidity = 0;        ///< 12 F2/h^3: of the flow along pressure [1/(Pa s)]
  double shear_fluidity = 0;  ///< F0/h: of sliding [1/(Pa s)]
  double skew = 0;            ///< 2 F1/(F0 h) - 1: by which sliding surfaces carry more with the shell [-]
};

/// Integrates the layers' viscosities [Pa s].
[[nodiscard]] LayerProfile profile_of(std::span<const double> mu, WithinLayers within = WithinLayers::linear);

/// Fractions of each layer in flow and heat, all without dimension but `mixed`.
struct LayerFractions {
  std::vector<double> pressure_flow;  ///< of the flow along pressure; sum 1
  std::vector<double>
      sliding_flow;  ///< of U h, which the journal's speed U relative to the shell carries; sum (1 - skew)/2
  /// First moments of both about each layer's middle: excess of the flow on the journal's side over the layer's mean.
  std::vector<double> pressure_lead, sliding_lead;
  std::vector<double> sliding_heat;   ///< of the dissipation by sliding; sum 1
  std::vector<double> pressure_heat;  ///< of that by flow along pressure; sum 1
  std::vector<double> mixed_heat;     ///< by both at once, over h U dp/dx; sum 0
};

/// Computes the fractions of the layers; the vectors get the size of `mu`.
void find_fractions(std::span<const double> mu, WithinLayers within, LayerFractions& fractions);

}  // namespace hersey::film
