#pragma once

#include <span>
#include <vector>

namespace hersey::film {

/// What is made of the fluidity 1/mu within a layer (theory manual, thermal.51): a straight line through its mean, with
/// the slope that those beside it give it; or one value, as of layers whose shear is known (thermal.26).
enum class WithinLayers { linear, constant };

/// What viscosities that differ across the film make of its flow and shear at one place, at the cavitation pressure
/// (theory manual, thermal.4, thermal.5). Layers from the shell to the journal (Layering).
struct LayerProfile {
  double fluidity = 0;        ///< 12 F2/h^3: of the flow along pressure [1/(Pa s)]
  double shear_fluidity = 0;  ///< F0/h: of sliding [1/(Pa s)]
  double skew = 0;            ///< 2 F1/(F0 h) - 1: by which sliding surfaces carry more with the shell [-]
};

/// Integrals of the layers' viscosities [Pa s].
[[nodiscard]] LayerProfile profile_of(std::span<const double> mu, WithinLayers within = WithinLayers::linear);

/// What of flow and heat belongs to each layer, all without dimension but `mixed`.
struct LayerShares {
  std::vector<double> pressure_flow;  ///< of the flow along pressure; sum 1
  std::vector<double> sliding_flow;  ///< of U h, which the journal's speed U over the shell's carries; sum (1 - skew)/2
  /// First moments of both about each layer's middle: how much faster than its mean a layer flows on the journal's
  /// side.
  std::vector<double> pressure_lead, sliding_lead;
  std::vector<double> sliding_heat;   ///< of the dissipation by sliding; sum 1
  std::vector<double> pressure_heat;  ///< of that by flow along pressure; sum 1
  std::vector<double> mixed_heat;     ///< by both at once, over h U dp/dx; sum 0
};

/// Shares of the layers; the vectors are made as long as `mu`.
void find_shares(std::span<const double> mu, WithinLayers within, LayerShares& shares);

}  // namespace hersey::film
