#include "hersey/film/restrictor.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace hersey::film {
namespace restrictor_test {

constexpr double kEps = std::numeric_limits<double>::epsilon();
const RestrictorOil kOil{.mu = 0.03, .density = 870};

std::vector<Restrictor> restrictors() {
  return {{Capillary{.length = 0.03, .diameter = 0.6e-3}, kOil},
          {FlowResistance{2e11}, kOil},  // Pa s/m^3
          {Orifice{.diameter = 0.7e-3, .discharge_coefficient = 0.62}, kOil},
          {ConstantFlow{.rate = 3e-6, .relief_band = 2e5}, kOil}};  // 2 bar
}

TEST_CASE("RestrictorFlow_HasTheSlopeOfItsDifference") {
  for (const Restrictor& restrictor : restrictors()) {
    CAPTURE(restrictor.name());
    for (const double drop : {-3e6, -2e3, 0.0, 40.0, 1e5, 4e6}) {  // Pa: through zero, on both sides of the pump's band
      const double step = 1e-3 * (1 + std::abs(drop));             // leaves 1e-6 of a square law, 1e-13 of its value
      const double difference = (restrictor.flow(drop + step).value - restrictor.flow(drop - step).value) / (2 * step);
      CHECK(difference == doctest::Approx(restrictor.flow(drop).slope).epsilon(1e-5));  // as above
      CHECK(restrictor.flow(drop).slope >= 0);
    }
  }
}

TEST_CASE("ThrottledFlow_ReversesWithTheDrop") {
  for (const Restrictor& restrictor : restrictors()) {
    if (!restrictor.throttles()) continue;
    CHECK(restrictor.flow(0).value == 0);
    for (const double drop : {1.0, 1e4, 5e6}) {  // Pa
      CHECK(restrictor.flow(-drop).value == -restrictor.flow(drop).value);
      CHECK(restrictor.flow(-drop).slope == restrictor.flow(drop).slope);
    }
  }
}

// Hagen and Poiseuille by the mean velocity of the parabola, and a measured resistance of the same size.
TEST_CASE("CapillaryFlow_IsAResistanceInProportionToTheViscosity") {
  const Capillary bore{.length = 0.03, .diameter = 0.6e-3};
  const double drop = 2e6, radius = 0.5 * bore.diameter, area = std::numbers::pi * radius * radius;  // 20 bar
  const double mean_velocity = drop / bore.length * radius * radius / (8 * kOil.mu);
  CHECK(bore.flow(drop, kOil).value == doctest::Approx(area * mean_velocity).epsilon(8 * kEps));
  RestrictorOil thick = kOil;
  thick.mu *= 2;
  CHECK(bore.flow(drop, thick).value == doctest::Approx(0.5 * bore.flow(drop, kOil).value).epsilon(8 * kEps));
  const FlowResistance measured{drop / bore.flow(drop, kOil).value};
  CHECK(measured.flow(0.3 * drop, thick).value == doctest::Approx(bore.flow(0.3 * drop, kOil).value).epsilon(8 * kEps));
}

// Creeping flow carries D^3 dp/(24 mu), a jet Cd A sqrt(2 dp/rho); between them the drops of both add up.
TEST_CASE("OrificeFlow_IsBetweenSampsonsAndTorricellis") {
  const Orifice hole{.diameter = 0.7e-3, .discharge_coefficient = 0.62};
  const double area = std::numbers::pi / 4 * hole.diameter * hole.diameter;
  const auto creeping = [&](double drop) { return std::pow(hole.diameter, 3) * drop / (24 * kOil.mu); };
  const auto jet = [&](double drop) { return hole.discharge_coefficient * area * std::sqrt(2 * drop / kOil.density); };
  const double gentle = 1e-4, fierce = 1e11;  // Pa: far beyond either side of where both drops are equal
  CHECK(hole.flow(gentle, kOil).value ==
        doctest::Approx(creeping(gentle)).epsilon(1e-6));                              // 1e-8 of the drop is inertia
  CHECK(hole.flow(fierce, kOil).value == doctest::Approx(jet(fierce)).epsilon(1e-3));  // 1e-4 of it is creeping
  const double drop = 3e4, Q = hole.flow(drop, kOil).value;                            // Pa: both count
  CHECK(Q / creeping(1) + std::pow(Q / jet(1), 2) == doctest::Approx(drop).epsilon(16 * kEps));
  CHECK(Q < 0.99 * creeping(drop));
  CHECK(Q < 0.99 * jet(drop));
}

TEST_CASE("PumpOfConstantFlow_GivesWayOverItsReliefBandOnly") {
  const ConstantFlow pump{.rate = 3e-6, .relief_band = 2e5}, without_limit{.rate = 3e-6};  // 2 bar
  for (const double drop : {2e5, 1e6}) CHECK(pump.flow(drop, kOil).value == pump.rate);    // Pa
  CHECK(pump.flow(1e5, kOil).value == doctest::Approx(0.5 * pump.rate));                   // half of the band
  CHECK(pump.flow(0, kOil).value == 0);
  for (const double drop : {-1e6, 0.0, 1e6}) CHECK(without_limit.flow(drop, kOil).value == pump.rate);  // Pa
}

}  // namespace restrictor_test
}  // namespace hersey::film
