#include "heat/layer_profile.h"

#include <algorithm>
#include <array>

#include "heat/layering.h"
#include "hersey/film/thermal_model.h"

namespace hersey::film {
namespace {

// Largest fraction of a layer's fluidity that its slope removes at one end.
constexpr double steepest = 0.9;

/// Fluidities 1/mu across the film, in each layer f + s (eta - middle).
class Fluidities {
 public:
  Fluidities(std::span<const double> mu, WithinLayers within) : across_(layering_of(mu.size())) {
    const std::size_t n = mu.size();
    for (std::size_t l = 0; l < n; ++l) lines_[l] = {1 / mu[l], 0};
    if (n == 1 || within == WithinLayers::constant) return;
    for (std::size_t l = 0; l < n; ++l) {
      const double bound = steepest * lines_[l].f / (0.5 * across_.width(l));
      lines_[l].s = std::clamp(across_.slope(l, [&](std::size_t k) { return lines_[k].f; }), -bound, bound);
    }
  }

  /// Fluidity of a layer and its slope.
  struct Line {
    double f, s;
  };
  [[nodiscard]] const Line& operator()(std::size_t l) const { return lines_[l]; }

 private:
  const Layering& across_;
  std::array<Line, most_layers> lines_;  // as many as there are layers
};

/// Integrals over the whole film of 1, y/h and (y/h)^2, over mu.
struct Moments {
  double I0 = 0, I1 = 0, I2 = 0;
};

Moments moments_of(std::size_t n, const Fluidities& fluidity) {
  const Layering& layers = layering_of(n);
  Moments m;
  for (std::size_t l = 0; l < n; ++l) {
    const auto& [f, s] = fluidity(l);
    const double width = layers.width(l), middle = layers.middle(l), bent = width * width * width / 12;
    m.I0 += width * f;
    m.I1 += width * f * middle + bent * s;
    m.I2 += f * (width * middle * middle + bent) + 2 * bent * s * middle;
  }
  return m;
}

}  // namespace

LayerProfile profile_of(std::span<const double> mu, WithinLayers within) {
  const auto [I0, I1, I2] = moments_of(mu.size(), Fluidities(mu, within));
  return {12 * (I2 - I1 * I1 / I0), I0, 2 * I1 / I0 - 1};
}

// With eta = y/h, G0 and G1 the integrals of 1/mu and eta/mu from the shell up to eta, the velocity is
// u_shell + U G0/I0 + h^2 p' (G1 - (I1/I0) G0). In a layer 1/mu is linear, G0 a parabola and G1 a cubic.
void find_fractions(std::span<const double> mu, WithinLayers within, LayerFractions& fractions) {
  const std::size_t n = mu.size();
  for (auto* fraction :
       {&fractions.pressure_flow, &fractions.sliding_flow, &fractions.pressure_lead, &fractions.sliding_lead,
        &fractions.sliding_heat, &fractions.pressure_heat, &fractions.mixed_heat})
    fraction->resize(n);
  const Layering& layers = layering_of(n);
  const Fluidities fluidity(mu, within);
  const auto [I0, I1, I2] = moments_of(n, fluidity);
  const double centre = I1 / I0, F2 = I2 - I1 * I1 / I0;
  double G0 = 0, G1 = 0;
  for (std::size_t l = 0; l < n; ++l) {
    const auto& [f, s] = fluidity(l);
    const double width = layers.width(l), middle = layers.middle(l), bent = width * width * width / 12;
    const double int_G0 = width * (G0 + 0.5 * width * f) - bent * s;
    const double int_G1 = width * (G1 + 0.5 * width * middle * f) - bent * (f + middle * s) + 0.5 * width * bent * s;
    const double off = middle - centre;
    fractions.sliding_flow[l] = int_G0 / I0;
    fractions.pressure_flow[l] = (centre * int_G0 - int_G1) / F2;
    fractions.sliding_lead[l] = bent * f / I0;
    fractions.pressure_lead[l] = -(bent * off * f + width * width * bent * s / 20) / F2;
    fractions.sliding_heat[l] = width * f / I0;
    fractions.pressure_heat[l] = (f * (width * off * off + bent) + 2 * bent * s * off) / F2;
    fractions.mixed_heat[l] = 2 * (width * f * off + bent * s) / I0;
    G0 += width * f;
    G1 += width * f * middle + bent * s;
  }
}

}  // namespace hersey::film
