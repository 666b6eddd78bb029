#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "hersey/bearing/steady_bearing.h"
#include "relative.h"

// A bearing of two pads of 176 degrees (D 0.4 m, 263 mm wide, c 195 um, 900 rpm) under 113 kN on the middle of the
// lower one, against what another program has for it: ROSS (github.com/petrobras/ross, 631a249a), whose tests keep
// fixed_isoviscous.json and fixed_adiabatic.json in tests/data/fluid_film. Its film has 20 x 10 elements to the pad.
namespace hersey::bearing {
namespace two_pad_bearing_test {

/// Between the pads, grooves over the whole width that feed oil without pressure.
film::FilmModel two_pads(int n_phi = 180) {
  film::FilmModel model{.R = 0.1999996, .L = 0.263144, .c = 194.564e-6, .grid = {.n_phi = n_phi, .n_z = 17}};
  const double mu = 0.01901574061455835, T = 322.98333333333335;
  const double beta = std::log(mu / 0.007715233411055399) / 30;
  model.lubricant.temperature_law = film::ExponentialViscosity{.mu_ref = mu, .T_ref = T, .beta = beta};
  model.lubricant.density = 854.9516142561059, model.lubricant.specific_heat = 1951.5014953944717;
  model.lubricant.conductivity = 0.1499998037782677;
  model.lubricant = film::at_temperature(model.lubricant, 323);
  model.shear_force = film::ShearForce::torque_only;
  const double pi = std::numbers::pi;
  for (const double phi : {0.0, pi})
    model.features.push_back({.name = phi == 0 ? "to the upper pad" : "to the lower pad",
                              .phi = phi,
                              .z = 0,
                              .arc = pi / 45,
                              .length = model.L,
                              .pressure = 0,
                              .depth = 5e-3});
  return model;
}

/// What the program says [-, rad, W, m^3/s, m].
struct Reference {
  double load, epsilon, attitude, power, side_flow, h_min;
};

/// Bars: 1 % and half a degree, for its grid; this one is within 0.1 % of twice as many nodes.
SteadyState compare(const Reference& ref, const SteadyOptions& options) {
  const OperatingPoint point{.journal_speed = 94.24777960769379, .load = Eigen::Vector2d(0, -ref.load)};
  const film::FilmModel model = scaled_for(two_pads(), point);
  SteadyState state;
  REQUIRE(solve_steady(model, point, options, state).solved());
  CHECK(state.e.norm() / model.c == relative(ref.epsilon).epsilon(0.01));
  CHECK(std::abs(std::atan2(state.e.x(), -state.e.y()) - ref.attitude) < 0.5 * std::numbers::pi / 180);
  CHECK(state.film.power_film == relative(ref.power).epsilon(0.01));
  CHECK(state.film.flow_left + state.film.flow_right == relative(ref.side_flow).epsilon(0.01));
  CHECK(state.film.h_min == relative(ref.h_min).epsilon(0.01));
  return state;
}

TEST_CASE("TwoPadsOfOneViscosity_AreThoseOfAnotherProgram") {
  const SteadyState state =
      compare({112696.545, 0.5409872779, 0.8435664569, 11675.2727, 3.352346745e-4, 8.960816948e-5}, {});
  // What comes to a pad less what leaves that before it: differences of flows five times and twice as large.
  CHECK(state.film.flow_features[0] == relative(2.937028598e-4 - 2.372771814e-4).epsilon(0.15));
  CHECK(state.film.flow_features[1] == relative(5.725118559e-4 - 2.937028598e-4).epsilon(0.04));
}

// Without heat through walls and with one temperature across the film; of the oil that leaves a pad, four fifths come
// to the next one with it.
TEST_CASE("TwoPadsOfOilThatWarms_AreThoseOfAnotherProgram") {
  SteadyOptions options{.thermal = film::ThermalModel{.layers = 1, .T_supply = 323, .T_edges = 323}};
  options.thermal->journal = film::InsulatedWall{};
  options.thermal->carry_over = 0.8;
  const SteadyState state =
      compare({112794.082, 0.6113515627, 0.8050309532, 8380.12216, 3.682903391e-4, 7.569878371e-5}, options);
  CHECK(state.film.p_max == relative(2801826.2).epsilon(0.01));
  const film::HeatObservables& observed = state.heat->observed;
  CHECK(std::abs(observed.T_supplies[0] - 335.7128195) < 0.3);  // K, of 12.7 that the oil has warmed
  CHECK(std::abs(observed.T_supplies[1] - 329.3165990) < 0.3);
  CHECK(std::abs(observed.T_shell_max - 345.1406072) < 0.3);
  CHECK(std::abs(observed.T_journal - 336.6145241) < 0.3);
}

// Borders of grooves on nodes or midway between them: the same oil is renewed.
TEST_CASE("RenewedOil_DoesNotDependOnWhereBordersLie") {
  SteadyOptions options{.thermal = film::ThermalModel{.layers = 1, .T_supply = 323, .T_edges = 323}};
  options.thermal->journal = film::InsulatedWall{};
  options.thermal->carry_over = 0.8;
  const OperatingPoint point{.journal_speed = 94.24777960769379, .load = Eigen::Vector2d(0, -112794.082)};
  std::array<Eigen::VectorXd, 2> T;
  for (const bool midway : {false, true}) {
    const film::FilmModel model = scaled_for(two_pads(midway ? 270 : 180), point);
    SteadyState state;
    REQUIRE(solve_steady(model, point, options, state).solved());
    T[midway ? 1 : 0] = state.heat->observed.T_supplies;
  }
  // K, of 12 that the oil has warmed: of first order, 0.03 K where cells are a quarter.
  CHECK((T[0] - T[1]).cwiseAbs().maxCoeff() < 0.1);
}

}  // namespace two_pad_bearing_test
}  // namespace hersey::bearing
