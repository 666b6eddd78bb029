#include "heat/layer_profile.h"

namespace hersey::film {
namespace {

/// Integrals over the whole film of 1, y/h and (y/h)^2, over mu.
struct Moments {
  double I0 = 0, I1 = 0, I2 = 0;
};

Moments moments_of(std::span<const double> mu) {
  const double width = 1.0 / static_cast<double>(mu.size());
  Moments m;
  double below = 0;
  for (const double mu_l : mu) {
    const double middle = below + 0.5 * width, share = width / mu_l;
    m.I0 += share;
    m.I1 += share * middle;
    m.I2 += share * (middle * middle + width * width / 12);
    below += width;
  }
  return m;
}

}  // namespace

LayerProfile profile_of(std::span<const double> mu) {
  const auto [I0, I1, I2] = moments_of(mu);
  return {12 * (I2 - I1 * I1 / I0), I0, 2 * I1 / I0 - 1};
}

// With eta = y/h, G0 and G1 the integrals of 1/mu and eta/mu from the shell up to eta, the velocity is
// u_shell + U G0/I0 + h^2 p' (G1 - (I1/I0) G0). In a layer mu is constant, G0 linear and G1 a parabola.
void find_shares(std::span<const double> mu, LayerShares& shares) {
  const std::size_t n = mu.size();
  for (auto* share :
       {&shares.pressure_flow, &shares.sliding_flow, &shares.sliding_heat, &shares.pressure_heat, &shares.mixed_heat})
    share->resize(n);
  const auto [I0, I1, I2] = moments_of(mu);
  const double width = 1.0 / static_cast<double>(n), centre = I1 / I0, F2 = I2 - I1 * I1 / I0;
  double below = 0, G0 = 0, G1 = 0;
  for (std::size_t l = 0; l < n; ++l) {
    const double above = below + width, middle = below + 0.5 * width, fluidity = 1 / mu[l];
    const double int_G0 = width * (G0 + 0.5 * width * fluidity);
    const double int_G1 =
        width * G1 + 0.5 * fluidity * ((above * above * above - below * below * below) / 3 - below * below * width);
    const double off = middle - centre;
    shares.sliding_flow[l] = int_G0 / I0;
    shares.pressure_flow[l] = (centre * int_G0 - int_G1) / F2;
    shares.sliding_heat[l] = width * fluidity / I0;
    shares.pressure_heat[l] = width * fluidity * (off * off + width * width / 12) / F2;
    shares.mixed_heat[l] = 2 * width * fluidity * off / I0;
    G0 += width * fluidity;
    G1 += width * fluidity * middle;
    below = above;
  }
}

}  // namespace hersey::film
