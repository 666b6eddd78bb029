#include <doctest/doctest.h>

#include <cmath>

#include "hot_film.h"
#include "relative.h"

// Shells in bodies that conduct heat, by what heat into each angle does to them.
namespace hersey::film {
namespace body_wall_test {

FilmModel bearing(double R, double L, double c, int n_phi, int n_z) {
  FilmModel model{.R = R, .L = L, .c = c, .grid = {.n_phi = n_phi, .n_z = n_z}, .lubricant = {.mu0 = 0.03}};
  model.lubricant.temperature_law = ExponentialViscosity{.mu_ref = 0.03, .T_ref = 40 + zero_celsius, .beta = 0.034};
  return model;
}

ThermalModel supplied_at_40(int layers) {
  return {.layers = layers, .T_supply = 40 + zero_celsius, .T_edges = 40 + zero_celsius};
}

/// A ring as a body: conductances of (thermal.12) solved for temperatures, and half its thickness at the bore.
BodyWall ring_as_body(const FilmModel& model, const RingWall& ring) {
  const int n = model.grid.n_phi;
  const double R = model.R, Ro = ring.outer_radius, middle = (R + Ro) / 2, k = ring.conductivity, L = model.L;
  const double dphi = 2 * pi / n, around = k * (Ro - R) * L / (middle * dphi);
  const double outside = dphi / (std::log(Ro / middle) / (k * L) + 1 / (ring.transfer * Ro * L)) +
                         ring.transfer * (Ro * Ro - R * R) * dphi;
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    Y(i, i) = 2 * around + outside;
    Y(i, (i + 1) % n) -= around;
    Y((i + 1) % n, i) -= around;
  }
  auto wall = std::make_shared<WallConduction>();
  wall->T0.setConstant(n, ring.T_ambient);
  wall->rise = Y.inverse();
  wall->rise.diagonal().array() += R * std::log(middle / R) / k / (R * dphi * L);
  return {.conduction = wall};
}

/// Between walls at both edges nothing varies along the axis: heat into an angle is spread evenly over the width.
FilmModel closed_bearing() {
  FilmModel model = bearing(0.05, 0.08, 145e-6, 48, 5);
  model.edge_left = model.edge_right = {EdgeKind::closed, 0, 0};
  model.supply = {SupplyKind::fixed_angle, 0.3, 70e3};
  return model;
}

TEST_CASE("RingAsABody_IsTheRing") {
  const FilmModel model = closed_bearing();
  const Journal journal{.e = 0.6 * model.c * Eigen::Vector2d(-0.6, -0.8), .omega_journal = 200};
  ThermalModel thermal = supplied_at_40(5);
  const RingWall ring{.outer_radius = 0.09, .transfer = 300, .T_ambient = 310};
  thermal.shell = ring;
  const HotFilm by_ring = solve_hot(model, thermal, surfaces(model, journal), journal.e, 1e-8);
  thermal.shell = ring_as_body(model, ring);
  const HotFilm by_body = solve_hot(model, thermal, surfaces(model, journal), journal.e, 1e-8);
  constexpr double solved = 1e-6;  // K: both iterations end when temperatures change by 1e-8 K in one iteration
  CHECK((by_ring.temperatures.shell - by_body.temperatures.shell).cwiseAbs().maxCoeff() < solved);
  CHECK((by_ring.temperatures.hottest - by_body.temperatures.hottest).cwiseAbs().maxCoeff() < solved);
  CHECK(by_body.heat.balance.to_shell == relative(by_ring.heat.balance.to_shell).epsilon(1e-7));  // by that
  CHECK(by_body.heat.balance.to_shell > 50);
  CHECK(by_body.heat.balance.error() < 1e-8);  // the film's residual
  CHECK(by_body.iterations <= 14);             // the ring, a part of the film's equations, takes 11
}

TEST_CASE("HeatIntoABody_IsThatOfTheBalance_AndItsTemperaturesFollow") {
  FilmModel model = bearing(0.025, 0.02, 30e-6, 36, 9);
  model.asperities = {.model = AsperityModel::greenwood_tripp_fit,
                      .sigma = 3e-6,
                      .elastic_factor = 3e-3,
                      .composite_modulus = 1e11,
                      .mu_friction = 0.02};
  model.edge_left = {EdgeKind::pressure, 1e5, 0};
  model.features.push_back({.name = "hole", .phi = 1, .z = 2e-3, .arc = 0.5, .length = 8e-3, .pressure = 3e5});
  const Journal journal{.e = {20e-6, 15e-6}, .omega_shell = 0, .omega_journal = 120};
  const SurfaceMotion motion = surfaces(model, journal);
  ThermalModel thermal = supplied_at_40(4);
  const BodyWall body = ring_as_body(model, {.outer_radius = 0.04, .T_ambient = 300});
  thermal.shell = body;
  Reynolds reynolds(model);
  FilmHeat heat(model, thermal);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.grid.size());
  FilmHistory history;
  for (int k = 0; k < 3; ++k) {
    history.viscosity = heat.viscosity();
    REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
    heat.advance(motion, history, u);
    const HeatState& state = heat.state();
    CHECK(state.wall_heat.sum() == relative(heat.observables().balance.to_shell).epsilon(1e-12));  // round-off
    const Eigen::VectorXd T = body.conduction->temperatures(state.wall_heat);
    CHECK((state.shell - T).cwiseAbs().maxCoeff() <
          1e-3);  // fraction of the start that the solver leaves: 1e-5 of 100 K
  }
}

// Over a step a body keeps its temperatures, whatever its conduction would give.
TEST_CASE("BodyInAStep_KeepsItsTemperature") {
  FilmModel model = closed_bearing();
  const Journal journal{.e = 0.6 * model.c * Eigen::Vector2d(-0.6, -0.8), .omega_journal = 200};
  const SurfaceMotion motion = surfaces(model, journal);
  ThermalModel thermal = supplied_at_40(3), given = thermal;
  BodyWall body = ring_as_body(model, {.outer_radius = 0.09, .T_ambient = 300});
  body.T_start = 330;
  thermal.shell = body;
  given.shell = WallAtTemperature{.T = 330};
  Reynolds reynolds(model);
  FilmHeat heat(model, thermal), same(model, given);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.grid.size());
  FilmHistory history;
  history.viscosity = heat.viscosity();
  REQUIRE(solve_film(reynolds, motion, history, {}, u).solved());
  history.dt = 1e-3;
  history.theta.setOnes(u.size());
  heat.advance(motion, history, u);
  same.advance(motion, history, u);
  CHECK((heat.state().shell.array() == 330).all());
  CHECK((heat.state().film - same.state().film).cwiseAbs().maxCoeff() < 1e-6);  // K; each solved to 1e-9 of the step
  CHECK(heat.observables().balance.to_shell == relative(same.observables().balance.to_shell).epsilon(1e-7));  // by that
}

TEST_CASE("ShapeOfABody_IsLinearInTheHeat") {
  const FilmModel model = closed_bearing();
  auto wall =
      std::make_shared<WallConduction>(*ring_as_body(model, {.outer_radius = 0.09, .T_ambient = 300}).conduction);
  wall->shape0.setConstant(model.grid.size(), 2e-6);
  wall->shape_by_heat.setConstant(model.grid.size(), model.grid.n_phi, 1e-8);
  wall->shape_by_rise.setConstant(model.grid.size(), 6e-7);
  ThermalModel thermal = supplied_at_40(3);
  thermal.shell = BodyWall{.conduction = wall};
  FilmHeat heat(model, thermal);
  HeatState state = heat.state();
  state.wall_heat.setConstant(5);
  heat.set_state(state);
  CHECK(heat.shell_opening()[7] == relative(2e-6 + 48 * 5e-8).epsilon(1e-12));  // round-off
  CHECK(heat.body_temperatures().size() == 0);
}

// Even heat warms and shapes as before, and what varies around is the same to the square of the angles' distance.
TEST_CASE("BodyOnACoarserGrid_IsTheSameBody") {
  const FilmModel model = closed_bearing();
  WallConduction wall = *ring_as_body(model, {.outer_radius = 0.09, .T_ambient = 300}).conduction;
  const Grid fine = model.grid, coarse = resampled(fine, 24, 3);
  wall.shape_by_heat.resize(fine.size(), fine.n_phi);
  for (int i = 0; i < fine.n_phi; ++i)
    for (int j = 0; j < fine.n_z; ++j)
      wall.shape_by_heat.row(fine.index(i, j)).setConstant(1e-8 * (2 + std::cos(fine.phi(i)) + fine.z_over_L(j)));
  wall.shape0.setConstant(fine.size(), 1e-6);
  wall.shape_by_rise.setConstant(fine.size(), 6e-7);
  const WallConduction observed = on_grid(wall, fine, coarse);
  constexpr double round_off = 1e-12;  // of sums over angles
  CHECK((observed.T0.array() - 300).abs().maxCoeff() < 300 * round_off);
  CHECK((observed.rise - observed.rise.transpose()).cwiseAbs().maxCoeff() < round_off);
  const Eigen::VectorXd even = Eigen::VectorXd::Ones(24);
  CHECK(observed.temperatures(even)[3] ==
        relative(wall.temperatures(0.5 * Eigen::VectorXd::Ones(48))[6]).epsilon(round_off));
  Eigen::VectorXd wave(24), fine_wave(48);
  for (int i = 0; i < 24; ++i) wave[i] = std::cos(coarse.phi(i));
  for (int i = 0; i < 48; ++i) fine_wave[i] = 0.5 * std::cos(fine.phi(i));
  const double rise = wall.temperatures(fine_wave)[0] - 300;
  CHECK(observed.temperatures(wave)[0] - 300 == relative(rise).epsilon(std::pow(2 * pi / 24, 2) / 3));
  CHECK(observed.shape(even)[coarse.index(6, 2)] ==
        relative(wall.shape(0.5 * Eigen::VectorXd::Ones(48))[fine.index(12, 4)]).epsilon(round_off));
}

}  // namespace body_wall_test
}  // namespace hersey::film
