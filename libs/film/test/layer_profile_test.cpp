#include "heat/layer_profile.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numeric>

namespace hersey::film {
namespace layer_profile_test {

// Sums of a few terms of order 1.
constexpr double round_off = 1e-14;

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST_CASE("OneViscosity_IsThatOfTheParabola") {
  const std::array<double, 4> mu{0.02, 0.02, 0.02, 0.02};
  const LayerProfile profile = profile_of(mu);
  CHECK(profile.fluidity * 0.02 == doctest::Approx(1).epsilon(round_off));
  CHECK(profile.shear_fluidity * 0.02 == doctest::Approx(1).epsilon(round_off));
  CHECK(std::abs(profile.skew) < round_off);
  LayerShares shares;
  find_shares(mu, shares);
  for (int l = 0; l < 4; ++l) {
    const double a = l / 4.0, b = (l + 1) / 4.0;
    // Integrals of 6 eta (1 - eta) and of eta over the layer.
    CHECK(shares.pressure_flow[l] ==
          doctest::Approx(3 * (b * b - a * a) - 2 * (b * b * b - a * a * a)).epsilon(round_off));
    CHECK(shares.sliding_flow[l] == doctest::Approx((b * b - a * a) / 2).epsilon(round_off));
    CHECK(shares.sliding_heat[l] == doctest::Approx(0.25).epsilon(round_off));
  }
}

TEST_CASE("SharesOfLayers_AreIntegralsOfTheVelocity") {
  const std::array<double, 5> mu{0.03, 0.008, 0.02, 0.011, 0.005};
  const LayerProfile profile = profile_of(mu);
  LayerShares shares;
  find_shares(mu, shares);
  CHECK(sum(shares.pressure_flow) == doctest::Approx(1).epsilon(round_off));
  CHECK(sum(shares.sliding_flow) == doctest::Approx((1 - profile.skew) / 2).epsilon(round_off));
  CHECK(sum(shares.sliding_heat) == doctest::Approx(1).epsilon(round_off));
  CHECK(sum(shares.pressure_heat) == doctest::Approx(1).epsilon(round_off));
  CHECK(std::abs(sum(shares.mixed_heat)) < round_off);

  // The velocity by itself: tau = tau_0 + p' y, du/dy = tau/mu, summed in fine strips (midpoints, exact where tau is
  // linear and mu constant but for the last integration).
  constexpr int strips = 20000;
  const auto velocity = [&](double slope, double top) {
    double I0 = 0, I1 = 0;
    for (int k = 0; k < strips; ++k) {
      const double eta = (k + 0.5) / strips;
      I0 += 1 / mu[k * 5 / strips] / strips, I1 += eta / mu[k * 5 / strips] / strips;
    }
    const double tau_0 = (top - slope * I1) / I0;
    std::array<double, 5> flow{}, heat{};
    double u = 0;
    for (int k = 0; k < strips; ++k) {
      const double tau = tau_0 + slope * (k + 0.5) / strips, rate = tau / mu[k * 5 / strips];
      flow[k * 5 / strips] += (u + 0.5 * rate / strips) / strips;
      heat[k * 5 / strips] += tau * rate / strips;
      u += rate / strips;
    }
    return std::pair(flow, heat);
  };
  const auto [by_pressure, heat_by_pressure] = velocity(1, 0);
  const auto [by_sliding, heat_by_sliding] = velocity(0, 1);
  const auto [by_both, heat_by_both] = velocity(1, 1);
  constexpr double strip = 1e-7;  // second order in 1/strips
  for (int l = 0; l < 5; ++l) {
    CHECK(by_pressure[l] == doctest::Approx(-shares.pressure_flow[l] * profile.fluidity / 12).epsilon(strip).scale(1));
    CHECK(by_sliding[l] == doctest::Approx(shares.sliding_flow[l]).epsilon(strip));
    CHECK(heat_by_pressure[l] ==
          doctest::Approx(shares.pressure_heat[l] * profile.fluidity / 12).epsilon(strip).scale(1));
    CHECK(heat_by_sliding[l] == doctest::Approx(shares.sliding_heat[l] / profile.shear_fluidity).epsilon(strip));
    const double mixed = heat_by_both[l] - heat_by_pressure[l] - heat_by_sliding[l];
    CHECK(mixed == doctest::Approx(shares.mixed_heat[l]).epsilon(strip).scale(1));
  }
}

}  // namespace layer_profile_test
}  // namespace hersey::film
