#include "heat/layer_shear.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hersey/film/rising_stress.h"

// Layers of one film share a stress that is linear across it, whatever shear leaves of their viscosities (thermal.25).
namespace hersey::film {
namespace layer_shear_test {

using Eigen::Vector2d;

constexpr int layers = 12;

// Newton's method ends at a change of 1e-4, which leaves its square; the iteration of the other end leaves far less.
constexpr double by_squares = 1e-7;

std::vector<double> thinned(const ShearThinning& oil, const std::vector<double>& mu_n, const ShearOfGap& shear) {
  LayerShear layer_shear(oil, layers);
  std::vector<double> left(layers, 1.0);
  layer_shear.thin(mu_n, shear, left);
  return left;
}

/// The largest difference between what shear leaves and what the rates leave that these viscosities take, relative.
double inconsistency(const ShearThinning& oil, const std::vector<double>& mu_n, const ShearOfGap& shear,
                     const std::vector<double>& left) {
  const Layering& across = layering_of(layers);
  const auto beyond = [&](std::size_t l) { return Vector2d((across.middle(l) - 0.5) * shear.fall); };
  double sum = 0, worst = 0;
  Vector2d by_pressure = Vector2d::Zero();
  for (std::size_t l = 0; l < layers; ++l) {
    const double fluidity = across.width(l) / (mu_n[l] * left[l]);
    sum += fluidity, by_pressure += fluidity * beyond(l);
  }
  const Vector2d mean = (shear.rate - by_pressure) / sum;
  for (std::size_t l = 0; l < layers; ++l) {
    const double rate = ((mean + beyond(l)) / (mu_n[l] * left[l])).norm();
    worst = std::max(worst, std::abs(oil.ratio(rate, mu_n[l]).value / left[l] - 1));
  }
  return worst;
}

/// Hotter and thinner towards the journal.
std::vector<double> viscosities() {
  std::vector<double> mu;
  for (int l = 0; l < layers; ++l) mu.push_back(0.02 * std::exp(-0.1 * l));
  return mu;
}

TEST_CASE("ShearOfLayers_IsWhatTheirOwnStressTakes") {
  const std::vector<double> mu_n = viscosities();
  for (const double exponent : {0.9, 0.5}) {
    const ShearThinning oil{.law = Carreau{.limit = 0.1, .exponent = exponent}, .critical_rate = 1e5};
    for (const ShearOfGap& shear : {ShearOfGap{{1e6, 0}, {0, 0}}, ShearOfGap{{1e5, 2e4}, {-3e4, 1e4}}}) {
      const std::vector<double> left = thinned(oil, mu_n, shear);
      CHECK(inconsistency(oil, mu_n, shear, left) < by_squares);
      CHECK(*std::max_element(left.begin(), left.end()) < 1);
      // The other way round everything is the same.
      CHECK(thinned(oil, mu_n, {-shear.rate, -shear.fall}) == left);
    }
  }
}

// The stress hardly rises with the rate any more, however suddenly it stops, in oils that are much thinner on one side:
// Newton's method converges there only with shortened steps.
TEST_CASE("ShearOfLayersThatYieldAtOnce_IsFound") {
  constexpr double of_rates = 1e-5;  // a rate's change of 1e-6 changes the stress by next to nothing
  for (const double thinner : {0.0, 0.1, 0.4, 1.0}) {
    std::vector<double> mu_n;
    for (int l = 0; l < layers; ++l) mu_n.push_back(0.1 * std::exp(-thinner * l));
    for (const double limit : {0.1, 1e-2, 1e-3, 1e-5, 0.0}) {
      for (const double transition : {0.5, 2.0, 20.0}) {
        CAPTURE(thinner);
        CAPTURE(limit);
        CAPTURE(transition);
        const Carreau law{.limit = limit, .exponent = limit > 0 ? 0.0 : 0.1, .transition = transition};
        const ShearThinning oil{.law = law, .critical_rate = 1e3};
        REQUIRE(has_rising_stress(oil));
        for (const double rate : {0.0, 1.0, 1e3, 1e6, 1e8}) {
          for (const Vector2d& fall : {Vector2d(0, 0), Vector2d(10, 1), Vector2d(0, 1e3), Vector2d(1e5, 0)})
            CHECK(inconsistency(oil, mu_n, {{rate, 0}, fall}, thinned(oil, mu_n, {{rate, 0}, fall})) < of_rates);
        }
      }
    }
  }
}

// Layers that hardly move have the viscosity of their own rate, too.
TEST_CASE("LayersThatHardlyMove_HaveTheViscosityOfTheirStress") {
  std::vector<double> mu_n;
  for (int l = 0; l < layers; ++l) mu_n.push_back(0.1 * std::exp(-0.4 * l));
  const ShearThinning oil{.law = Carreau{.limit = 0.1, .exponent = 0, .transition = 0.5}, .critical_rate = 1e3};
  const ShearOfGap shear{{1e6, 0}, {1e3, 0}};
  CHECK(inconsistency(oil, mu_n, shear, thinned(oil, mu_n, shear)) < by_squares);  // it was 0.2
}

// Oils whose stress does not rise any more have no rates of their own, and none are computed.
TEST_CASE("StressThatStopsRising_IsRecognised") {
  CHECK(has_rising_stress(ShearThinning{.law = Newtonian{}}));
  CHECK(has_rising_stress(ShearThinning{.law = Carreau{.limit = 0, .exponent = 0.1}}));
  CHECK(has_rising_stress(ShearThinning{.law = Carreau{.limit = 1e-5, .exponent = 0}}));
  CHECK_FALSE(has_rising_stress(ShearThinning{.law = Carreau{.limit = 1e-6, .exponent = 0.05}}));
  CHECK(has_rising_stress(ShearThinning{.law = Cross{.limit = 0, .exponent = 0.9}}));
  CHECK(has_rising_stress(ShearThinning{.law = Cross{.limit = 1e-5, .exponent = 1}}));
  CHECK_FALSE(has_rising_stress(ShearThinning{.law = Cross{.limit = 0, .exponent = 1}}));
}

TEST_CASE("OilThatNothingShears_IsAsAtRest") {
  const ShearThinning oil{.law = Carreau{.limit = 0.1, .exponent = 0.5}, .critical_rate = 1e5};
  const std::vector<double> mu_n = viscosities();
  LayerShear layer_shear(oil, layers);
  std::vector<double> left(layers, 0.5);
  layer_shear.thin(mu_n, {}, left);
  CHECK(std::all_of(left.begin(), left.end(), [](double one) { return one == 1; }));
  CHECK(layer_shear.flow_factors() == Vector2d::Ones());
}

}  // namespace layer_shear_test
}  // namespace hersey::film
