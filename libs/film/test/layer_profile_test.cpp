#include "heat/layer_profile.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "heat/layering.h"

namespace hersey::film {
namespace layer_profile_test {

// Sums of a few terms of order 1.
constexpr double round_off = 1e-14;

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST_CASE("LayersBesideWalls_AreThinner") {
  const Layering& layers = layering_of(5);
  double above = 0;
  for (std::size_t l = 0; l < 5; ++l) {
    CHECK(layers.middle(l) == doctest::Approx(above + 0.5 * layers.width(l)).epsilon(round_off));
    CHECK(layers.width(l) == doctest::Approx(layers.width(4 - l)).epsilon(round_off));
    above += layers.width(l);
  }
  CHECK(above == doctest::Approx(1).epsilon(round_off));
  CHECK(layers.width(0) < layers.width(1));
  CHECK(layers.width(1) < layers.width(2));
}

TEST_CASE("SlopeAtTheWall_IsThatOfTheParabola") {
  // T = 3 + 5 y - 7 y^2 from either wall, by the means of two layers.
  for (const std::size_t n : {2, 3, 5, 16}) {
    const Layering& layers = layering_of(n);
    const double w = layers.width(0), both = w + layers.width(1);
    const auto integral = [](double y) { return 5 * y * y / 2 - 7 * y * y * y / 3; };
    const double first = integral(w) / w, second = (integral(both) - integral(w)) / (both - w);
    for (const std::size_t wall : {std::size_t{0}, n - 1}) {
      const auto [beside, next] = layers.slope_at_wall(wall);
      CHECK(beside * first - next * second == doctest::Approx(5).epsilon(1e-13));  // a difference of like numbers
    }
  }
}

TEST_CASE("OneViscosity_IsThatOfTheParabola") {
  const std::array<double, 4> mu{0.02, 0.02, 0.02, 0.02};
  const LayerProfile profile = profile_of(mu);
  CHECK(profile.fluidity * 0.02 == doctest::Approx(1).epsilon(round_off));
  CHECK(profile.shear_fluidity * 0.02 == doctest::Approx(1).epsilon(round_off));
  CHECK(std::abs(profile.skew) < round_off);
  LayerFractions fractions;
  find_fractions(mu, WithinLayers::linear, fractions);
  double a = 0;
  for (std::size_t l = 0; l < 4; ++l) {
    const double width = layering_of(4).width(l), b = a + width;
    // Integrals of 6 eta (1 - eta) and of eta over the layer.
    CHECK(fractions.pressure_flow[l] ==
          doctest::Approx(3 * (b * b - a * a) - 2 * (b * b * b - a * a * a)).epsilon(round_off));
    CHECK(fractions.sliding_flow[l] == doctest::Approx((b * b - a * a) / 2).epsilon(round_off));
    CHECK(fractions.sliding_heat[l] == doctest::Approx(width).epsilon(round_off));
    a = b;
  }
}

// A fluidity that is linear across the film is exact in layers.
TEST_CASE("FluidityThatIsALine_IsIntegratedExactly") {
  for (const std::size_t n : {2, 3, 5}) {
    std::vector<double> mu(n);
    for (std::size_t l = 0; l < n; ++l) mu[l] = 1 / (30 + 90 * layering_of(n).middle(l));
    const LayerProfile profile = profile_of(mu);
    const double I0 = 30 + 90.0 / 2, I1 = 30.0 / 2 + 90.0 / 3, I2 = 30.0 / 3 + 90.0 / 4;
    CHECK(profile.fluidity == doctest::Approx(12 * (I2 - I1 * I1 / I0)).epsilon(round_off));
    CHECK(profile.shear_fluidity == doctest::Approx(I0).epsilon(round_off));
    CHECK(profile.skew == doctest::Approx(2 * I1 / I0 - 1).epsilon(round_off));
  }
}

// The velocity by itself: tau = tau_0 + p' y, du/dy = tau/mu, summed in fine strips (midpoints of second order).
TEST_CASE("FractionsOfLayers_AreIntegralsOfTheVelocity") {
  constexpr std::size_t n = 5, strips = 4000;
  const Layering& layers = layering_of(n);
  const std::array<double, n> jagged{0.03, 0.008, 0.02, 0.011, 0.005};
  std::array<double, n> line{};
  for (std::size_t l = 0; l < n; ++l) line[l] = 1 / (30 + 170 * layers.middle(l));
  struct Case {
    WithinLayers within;
    std::array<double, n> mu;
    double slope;  ///< of 1/mu within layers
  };
  for (const auto& [within, mu, slope_within] :
       {Case{WithinLayers::constant, jagged, 0}, Case{WithinLayers::linear, line, 170}}) {
    const LayerProfile profile = profile_of(mu, within);
    LayerFractions fractions;
    find_fractions(mu, within, fractions);
    CHECK(sum(fractions.pressure_flow) == doctest::Approx(1).epsilon(round_off));
    CHECK(sum(fractions.sliding_flow) == doctest::Approx((1 - profile.skew) / 2).epsilon(round_off));
    CHECK(sum(fractions.sliding_heat) == doctest::Approx(1).epsilon(round_off));
    CHECK(sum(fractions.pressure_heat) == doctest::Approx(1).epsilon(round_off));
    CHECK(std::abs(sum(fractions.mixed_heat)) < round_off);

    struct Strip {
      std::size_t layer;
      double eta, width, fluidity;
    };
    std::vector<Strip> across;
    double I0 = 0, I1 = 0;
    for (std::size_t l = 0; l < n; ++l) {
      for (std::size_t k = 0; k < strips; ++k) {
        const double width = layers.width(l) / strips;
        const double off = (static_cast<double>(k) + 0.5) * width - 0.5 * layers.width(l);
        across.push_back({l, layers.middle(l) + off, width, 1 / mu[l] + slope_within * off});
        I0 += across.back().fluidity * width, I1 += across.back().eta * across.back().fluidity * width;
      }
    }
    const auto velocity = [&, I0 = I0, I1 = I1](double slope, double top) {
      const double tau_0 = (top - slope * I1) / I0;
      std::array<double, n> flow{}, lead{}, heat{};
      double u = 0;
      for (const Strip& at : across) {
        const double tau = tau_0 + slope * at.eta, rate = tau * at.fluidity;
        flow[at.layer] += (u + 0.5 * rate * at.width) * at.width;
        lead[at.layer] += (u + 0.5 * rate * at.width) * at.width * (at.eta - layers.middle(at.layer));
        heat[at.layer] += tau * rate * at.width;
        u += rate * at.width;
      }
      return std::tuple(flow, lead, heat);
    };
    const auto [by_pressure, lead_by_pressure, heat_by_pressure] = velocity(1, 0);
    const auto [by_sliding, lead_by_sliding, heat_by_sliding] = velocity(0, 1);
    const auto [by_both, lead_by_both, heat_by_both] = velocity(1, 1);
    constexpr double strip = 1e-7;  // second order in 1/strips
    for (std::size_t l = 0; l < n; ++l) {
      CHECK(by_pressure[l] ==
            doctest::Approx(-fractions.pressure_flow[l] * profile.fluidity / 12).epsilon(strip).scale(1));
      CHECK(by_sliding[l] == doctest::Approx(fractions.sliding_flow[l]).epsilon(strip));
      CHECK(lead_by_pressure[l] ==
            doctest::Approx(-fractions.pressure_lead[l] * profile.fluidity / 12).epsilon(strip).scale(1));
      CHECK(lead_by_sliding[l] == doctest::Approx(fractions.sliding_lead[l]).epsilon(strip).scale(1));
      CHECK(heat_by_pressure[l] ==
            doctest::Approx(fractions.pressure_heat[l] * profile.fluidity / 12).epsilon(strip).scale(1));
      CHECK(heat_by_sliding[l] == doctest::Approx(fractions.sliding_heat[l] / profile.shear_fluidity).epsilon(strip));
      const double mixed = heat_by_both[l] - heat_by_pressure[l] - heat_by_sliding[l];
      CHECK(mixed == doctest::Approx(fractions.mixed_heat[l]).epsilon(strip).scale(1));
    }
  }
}

}  // namespace layer_profile_test
}  // namespace hersey::film
