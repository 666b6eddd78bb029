#include "hersey/circuit/laws.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "hersey/circuit/aerated_oil.h"
#include "hersey/circuit/friction_factor.h"

namespace hersey::circuit {
namespace laws_test {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kOpenArea = 3e-6;  // m^2, of a hole of 2 mm that is nearly all open
const Oil kOil{.mu = 0.01, .density = 860};

Flow flow_of(const Law& law, double drop, double speed = 300) {
  return std::visit(
      [&](const auto& of) { return of.flow(drop, kOil, Setting{.speed = speed, .open_area = kOpenArea}); }, law);
}

const Drilling kRough{.length = 0.06, .diameter = 5e-3, .roughness = 2e-5, .loss_coefficient = 1.7};

// 5e-4 m^3/s less what grows with the square of the rise.
class Falling final : public ScalarFunction {
 public:
  [[nodiscard]] double value(std::span<const double> x) const override {
    return 5e-4 - 5e-16 * x[0] * std::abs(x[0]);  // 4.55e-4 m^3/s at 3 bar
  }
  void gradient(std::span<const double> x, std::span<double> gradient) const override {
    gradient[0] = -1e-15 * std::abs(x[0]);  // of the same
  }
  [[nodiscard]] double second_derivative(std::span<const double> /*x*/) const override { return 0; }
};

std::vector<Law> laws() {
  return {kRough,
          Drilling{.length = 0.08, .diameter = 4e-3, .friction = Friction::laminar},
          Orifice{.diameter = 1.5e-3, .discharge_coefficient = 0.7},
          Resistance{3e9},  // Pa s/m^3
          ReliefValve{.opening_pressure = 4e5, .conductance = 2e-9},
          DisplacementPump{.displacement = 2e-6, .leakage = 3e-11},
          PumpCurve{std::make_shared<Falling>()},
          GivenFlow{2e-4},
          HoleOverGroove{.discharge_coefficient = 0.65}};
}

TEST_CASE("FlowOfEachLaw_HasTheSlopeOfItsDifference_WhichIsNowhereNegative") {
  for (const Law& law : laws()) {
    CAPTURE(law.index());
    for (const double drop : {-7e5, -2e5, -3e3, -1.0, 0.0, 40.0, 1.1e4, 9e4, 5e5}) {  // Pa: laminar to turbulent
      const double step = 1e-4 * (1 + std::abs(drop));  // leaves 1e-8 of a square law, 1e-12 of its value
      const double difference = (flow_of(law, drop + step).value - flow_of(law, drop - step).value) / (2 * step);
      CHECK(difference == doctest::Approx(flow_of(law, drop).slope).epsilon(2e-6));  // as above, and of sharp bends
      CHECK(flow_of(law, drop).slope >= 0);
    }
  }
}

TEST_CASE("DrillingFlow_HasTheDropOfDarcyAndItsBends") {
  const double area = std::numbers::pi / 4 * kRough.diameter * kRough.diameter;
  for (const double drop : {1e-3, 10.0, 1e3, 2e4, 1e6}) {  // Pa: creeping to turbulent
    const double v = flow_of(kRough, drop).value / area, Re = kOil.density * v * kRough.diameter / kOil.mu;
    const double pressure = 0.5 * kOil.density * v * v;
    const double f = friction_factor(Re, kRough.roughness / kRough.diameter);
    CHECK((f * kRough.length / kRough.diameter + kRough.loss_coefficient) * pressure ==
          doctest::Approx(drop).epsilon(64 * kEps));
    CHECK(flow_of(kRough, -drop).value == -flow_of(kRough, drop).value);
  }
  const Drilling laminar{.length = 0.08, .diameter = 5e-3, .friction = Friction::laminar};
  const double poiseuille = std::numbers::pi * std::pow(5e-3, 4) / (128 * kOil.mu * 0.08);
  CHECK(flow_of(laminar, 3e5).value == doctest::Approx(3e5 * poiseuille).epsilon(8 * kEps));
}

TEST_CASE("OrificeFlow_IsTorricellisAtLargeDropsAndSampsonsAtSmallOnes") {
  const Orifice hole{.diameter = 1.5e-3, .discharge_coefficient = 0.7};
  const double area = std::numbers::pi / 4 * 1.5e-3 * 1.5e-3;
  const double large = 3e5, small = 1e-2;  // Pa
  // The change over is at 18 Pa: 18/3e5 squared, 1e-2/18 squared.
  CHECK(flow_of(hole, large).value == doctest::Approx(0.7 * area * std::sqrt(2 * large / kOil.density)).epsilon(4e-9));
  // 1e-2/18 squared
  CHECK(flow_of(hole, small).value == doctest::Approx(std::pow(1.5e-3, 3) / (24 * kOil.mu) * small).epsilon(1e-6));
}

// Of a whole hole it is that hole's orifice; as it shuts the flow goes to nothing, with its slopes.
TEST_CASE("HoleOverGroove_IsAnOrificeOfItsOpenArea") {
  const HoleOverGroove hole{.discharge_coefficient = 0.65};
  const auto open = [&](double drop, double area) { return hole.flow(drop, kOil, {.open_area = area}); };
  for (const double drop : {-4e5, 1e-2, 20.0, 3e3, 2e5})  // Pa: creeping flow to a jet
    for (const double diameter : {1e-4, 1.5e-3, 6e-3}) {
      const double area = std::numbers::pi / 4 * diameter * diameter, step = 1e-5 * area;
      const Flow orifice = Orifice{diameter, 0.65}.flow(drop, kOil, {}), flow = open(drop, area);
      CHECK(flow.value == doctest::Approx(orifice.value).epsilon(64 * kEps));
      CHECK(flow.slope == doctest::Approx(orifice.slope).epsilon(64 * kEps));
      const double difference = (open(drop, area + step).value - open(drop, area - step).value) / (2 * step);
      CHECK(flow.by_area == doctest::Approx(difference).epsilon(1e-8));  // of steps of 1e-5
    }
  CHECK(open(2e5, 0).value == 0);
  CHECK(open(2e5, 0).slope == 0);
  CHECK(open(2e5, 1e-18).value < 1e-18);      // of a hole of a nanometre: m^3/s
  CHECK(open(2e5, 1e-300).by_area < 1e-100);  // as the square root of the area
}

TEST_CASE("Pumps_GiveTheirDisplacementLessWhatLeaks") {
  const DisplacementPump pump{.displacement = 2e-6, .leakage = 3e-11};
  CHECK(flow_of(pump, -5e5, 300).value == doctest::Approx(2e-6 * 300 - 3e-11 * 5e5).epsilon(4 * kEps));
  CHECK(flow_of(PumpCurve{std::make_shared<Falling>()}, -3e5).value == doctest::Approx(4.55e-4).epsilon(4 * kEps));
}

// Coolers one behind the other share their conductance.
TEST_CASE("CoolerOfSmallPieces_IsOneCooler") {
  for (const double rate : {10.0, 300.0, 5000.0}) {  // W/K
    const Cooler whole{.resistance = 1e8, .conductance = 250}, part{.resistance = 2.5e7, .conductance = 62.5};
    CHECK(whole.remaining(rate) == doctest::Approx(std::pow(part.remaining(rate), 4)).epsilon(128 * kEps));
    CHECK(flow_of(whole, 4e5).value == doctest::Approx(flow_of(part, 1e5).value).epsilon(4 * kEps));
  }
  const Cooler large{.conductance = 1e9};
  CHECK(large.remaining(1) == 0);
  CHECK(large.remaining(0) == 0);
}

TEST_CASE("ContentOfAStore_HasTheSlopeOfItsDifference_AndBubblesYieldAsAGas") {
  const Storage bubbly{.volume = 2e-4, .wall_compliance = 1e-13, .free_air = 0.05, .solubility = 0.09};
  for (const double p : {-9.5e4, -3e4, 0.0, 2e4, 5e5}) {  // Pa: little air, much, and all dissolved
    const double step = 1;
    const double difference =
        (bubbly.content(p + step, standard_atmosphere).value - bubbly.content(p - step, standard_atmosphere).value) /
        (2 * step);
    CHECK(bubbly.content(p, standard_atmosphere).slope == doctest::Approx(difference).epsilon(1e-6));  // of 1 Pa in 1e5
  }
  CHECK(bubbly.content(0, standard_atmosphere).value == doctest::Approx(0.95 * 2e-4).epsilon(4 * kEps));
  // Without solubility: 1/K of the mixture is that of its oil and x/p of its gas (Wood).
  const Storage gas{.volume = 1, .free_air = 0.02, .solubility = 0};
  const double compliance = gas.content(0, standard_atmosphere).slope / gas.content(0, standard_atmosphere).value;
  CHECK(compliance == doctest::Approx(1 / 1.5e9 + 0.02 / standard_atmosphere).epsilon(1e-12));  // a sum, and a quotient
  const Storage stiff{.volume = 1};
  CHECK(stiff.content(1e6, standard_atmosphere).value == doctest::Approx(1 + 1e6 / 1.5e9).epsilon(4 * kEps));
}

}  // namespace laws_test
}  // namespace hersey::circuit
