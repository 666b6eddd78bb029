#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/bearing/bearing_numbers.h"
#include "hersey/bearing/steady_bearing.h"
#include "hersey/bearing/total_coefficients.h"
#include "relative.h"

namespace hersey::bearing {
namespace hot_bearing_test {

using film::zero_celsius;

film::FilmModel model_of(film::Lubricant oil, int n_phi, int n_z) {
  film::FilmModel model{
      .R = 0.05, .L = 0.05, .c = 50e-6, .grid = {.n_phi = n_phi, .n_z = n_z}, .lubricant = std::move(oil)};
  model.shear_force = film::ShearForce::torque_only;
  model.supply = {film::SupplyKind::widest_gap, 0, 0};
  return model;
}

/// ISO VG 46 as the reference cases have it.
film::Lubricant vg46(double T) {
  film::Lubricant oil{.mu0 = 1, .density = 869};
  oil.temperature_law = film::WaltherViscosity::through(46e-6, 6.8e-6, 869);
  return film::at_temperature(oil, T);
}

OperatingPoint point() { return {.journal_speed = 100 * std::numbers::pi, .load = Eigen::Vector2d(0, -10e3)}; }

// The balance of ISO 7902 for a bearing of D 100, B 50, psi 0.001 under 10 kN at 3000 rpm with oil supplied at 50 degC,
// by an independent program that takes its bearing numbers from a table of its own.
TEST_CASE("OneEffectiveTemperature_IsThatOfTheBalance") {
  film::FilmModel model = scaled_for(model_of(vg46(323.15), 120, 25), point());
  SteadyState state;
  const GlobalHeat heat{.T_supply = 50 + zero_celsius};
  const SteadySummary summary = solve_global(model, point(), heat, {}, state);
  REQUIRE(summary.solved());
  REQUIRE(state.effective);
  CHECK(std::abs(state.effective->T - zero_celsius - 65.987) < 0.05);  // its grid and this one
  CHECK(std::abs(state.effective->T_out - zero_celsius - 81.973) < 0.1);
  CHECK(state.e.norm() / model.c == relative(0.57887).epsilon(1e-3));                           // as well
  CHECK(state.film.power_film == relative(1147.18836).epsilon(3e-3));                           // as well
  CHECK(state.film.flow_left + state.film.flow_right == relative(2.1351906e-5).epsilon(5e-3));  // as well
  CHECK(model.lubricant.mu0 == relative(0.014163034).epsilon(2e-3));      // 0.05 K, by the oil's slope of 0.03 1/K
  CHECK(model.lubricant.density == relative(840.2002358).epsilon(1e-4));  // likewise, of 0.00065 1/K
  CHECK(summary.heat_iterations <= 20);
  // The balance itself, with the oil at the temperature found.
  const double rise =
      (state.film.power_film) / (model.lubricant.density * 2000 * (state.film.flow_left + state.film.flow_right));
  CHECK(state.effective->T_out - heat.T_supply == relative(rise).epsilon(1e-6));  // 1e-8 of temperature over its slope
}

// The same independent program's bearing (D 100, B 100, psi 0.0015, 4 kN, 480 rpm, VG 68) whose housing of 0.3 m^2
// gives off all heat at 20 W/(m^2 K) to 40 degC.
TEST_CASE("HousingThatCools_IsThatOfAnIndependentProgram") {
  film::FilmModel model = model_of({.mu0 = 1, .density = 874}, 120, 25);
  model.L = 0.1, model.c = 75e-6;
  model.lubricant.temperature_law = film::WaltherViscosity::through(68e-6, 8.7e-6, 874);
  const OperatingPoint at{.journal_speed = 16 * std::numbers::pi, .load = Eigen::Vector2d(0, -4e3)};
  model.lubricant = film::at_temperature(model.lubricant, 313.15);
  model = scaled_for(model, at);
  SteadyState state;
  const GlobalHeat heat{.cools_by_surroundings = true, .transfer = 20, .area = 0.3, .T_ambient = 313.15};
  REQUIRE(solve_global(model, at, heat, {}, state).solved());
  CHECK(std::abs(state.effective->T - zero_celsius - 53.5913) < 0.05);                         // its grid and this one
  CHECK(state.e.norm() / model.c == relative(0.381827).epsilon(2e-3));                         // as well
  CHECK(state.film.power_film == relative(81.54779).epsilon(3e-3));                            // as well
  CHECK(state.film.flow_left + state.film.flow_right == relative(5.695108e-6).epsilon(5e-3));  // as well
}

TEST_CASE("HousingThatCools_SetsTheTemperature") {
  film::FilmModel model = scaled_for(model_of(vg46(313.15), 60, 13), point());
  SteadyState state;
  const GlobalHeat heat{.cools_by_surroundings = true, .transfer = 20, .area = 2, .T_ambient = 313.15};
  REQUIRE(solve_global(model, point(), heat, {}, state).solved());
  CHECK((state.effective->T - heat.T_ambient) * 20 * 2 == relative(state.film.power_film).epsilon(1e-6));  // as above
  CHECK(state.effective->T_out == state.effective->T);
}

// An oil that thins by shear as well: its balance is that of the film it makes at the temperature found, which is the
// isothermal one there, and it warms less than an oil that does not.
TEST_CASE("OneEffectiveTemperature_IsThatOfAnOilThatThinsByShear") {
  film::Lubricant thinning = vg46(323.15);
  thinning.shear_thinning = {film::Cross{.limit = 0.4, .exponent = 0.8}, 3e5, 0};
  const film::FilmModel cold = scaled_for(model_of(thinning, 60, 13), point());
  film::FilmModel model = cold, newtonian = scaled_for(model_of(vg46(323.15), 60, 13), point());
  const GlobalHeat heat{.T_supply = 50 + zero_celsius};
  SteadyState state, plain, isothermal;
  const SteadySummary summary = solve_global(model, point(), heat, {}, state);
  REQUIRE(summary.solved());
  CHECK(summary.heat_iterations <= 20);
  REQUIRE(solve_global(newtonian, point(), heat, {}, plain).solved());
  CHECK(state.film.power_film < 0.9 * plain.film.power_film);
  CHECK(state.effective->T < plain.effective->T - 2);
  CHECK(state.film.h_min < plain.film.h_min);
  film::FilmModel at = cold;
  at.lubricant = film::at_temperature(cold.lubricant, state.effective->T);
  REQUIRE(solve_steady(at, point(), {}, isothermal).solved());
  CHECK(isothermal.film.h_min == relative(state.film.h_min).epsilon(1e-6));  // temperatures to 1e-8, by its slope
  CHECK(isothermal.film.power_film == relative(state.film.power_film).epsilon(1e-6));  // as well
  const double rise = state.film.power_film / (at.lubricant.density * at.lubricant.specific_heat *
                                               (state.film.flow_left + state.film.flow_right));
  CHECK(state.effective->T_out - heat.T_supply == relative(rise).epsilon(1e-6));  // as above
}

// A load that the film carries with cold oil and not with the oil it warms, and a film whose heat leaves it only
// with oil of impossible temperature are reported as such, with the position where layers are solved.
TEST_CASE("ThermalRunaway_IsReportedAsSuch") {
  const film::Lubricant oil = vg46(323.15);
  const film::ThermalModel thermal{.layers = 3, .T_supply = 323.15, .T_edges = 323.15};
  struct Trial {
    double load, speed;
    const char* reason;
  };
  for (const Trial& trial : {Trial{5e5, 100 * std::numbers::pi, "too thin for the film to stay"},
                             Trial{3e5, 2000 * std::numbers::pi, "no oil is one above 400 degC"}}) {
    CAPTURE(trial.reason);
    OperatingPoint at = point();
    at.load = Eigen::Vector2d(0, -trial.load);
    at.journal_speed = trial.speed;
    const film::FilmModel model = scaled_for(model_of(oil, 40, 9), at);
    SteadyState state;
    CHECK(solve_steady(model, at, {}, state).solved());  // with cold oil there is a film
    const SteadySummary summary = solve_steady(model, at, {.thermal = thermal}, state);
    CHECK_FALSE(summary.solved());
    CHECK(summary.message.starts_with("thermal runaway: "));
    for (const char* word : {trial.reason, " degC at ", " deg, z = ", " mm"})
      CHECK(summary.message.find(word) != std::string::npos);
  }
}

/// Heat into an angle warms all of the shell by the same, and widens it.
film::BodyWall even_body(const film::Grid& grid, double rise, double growth) {
  auto wall = std::make_shared<film::WallConduction>();
  wall->T0.setConstant(grid.n_phi, 40 + zero_celsius);
  wall->rise.setConstant(grid.n_phi, grid.n_phi, rise);
  wall->T_body0 = wall->T0.head(1);
  wall->rise_body.setConstant(1, grid.n_phi, rise);
  if (growth != 0) {
    wall->shape0.setZero(grid.size());
    wall->shape_by_heat.setConstant(grid.size(), grid.n_phi, growth);
    wall->shape_by_rise.setZero(grid.size());
  }
  return {.conduction = wall};
}

// A bore that heat widens everywhere alike is one of larger clearance.
TEST_CASE("BoreThatHeatWidens_IsOneOfLargerClearance") {
  film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  model.supply = {};  // a line is as thick as the clearance that is given
  model.edge_left = model.edge_right = {film::EdgeKind::pressure, 1e5, 0};
  SteadyOptions options{.thermal = film::ThermalModel{.T_supply = 50 + zero_celsius, .T_edges = 50 + zero_celsius}};
  options.thermal->shell = even_body(model.grid, 0.1, 5e-8);
  SteadyState grown;
  const SteadySummary summary = solve_steady(model, point(), options, grown);
  REQUIRE(summary.solved());
  CHECK(summary.heat_iterations <= 25);
  REQUIRE(grown.shapes.thermal_shell.size() == model.grid.size());
  const double growth = grown.shapes.thermal_shell[0];
  CHECK(growth > 3e-6);  // a fraction of the clearance of 50 um that matters
  CHECK(growth == relative(5e-8 * grown.heat->observed.balance.to_shell).epsilon(1e-7));  // 1e-8 of temperatures
  CHECK(grown.heat->observed.T_body_max - grown.heat->T_body[0] == 0);
  CHECK(grown.heat->T_body[0] == relative(313.15 + 0.1 * grown.heat->observed.balance.to_shell).epsilon(1e-12));  // eps
  model.c += growth;
  options.thermal->shell = even_body(model.grid, 0.1, 0);
  SteadyState wide;
  REQUIRE(solve_steady(model, point(), options, wide).solved());
  CHECK((grown.e - wide.e).norm() < 1e-6 * model.c);  // 1e-8 of temperatures, by the slope of the position
  CHECK(grown.film.p_max == relative(wide.film.p_max).epsilon(1e-5));                         // as well
  CHECK(grown.heat->observed.T_max == relative(wide.heat->observed.T_max).epsilon(1e-7));     // as well
  CHECK(steady_fields(model, wide).h.minCoeff() == relative(wide.film.h_min).epsilon(1e-2));  // nodes, and between them
  const GridError error = estimate_grid_error(model, wide, options);
  CHECK(error.known);
}

/// Heat warms all of the journal by the same and, where growth is not zero, widens it.
film::BodyJournal even_journal(const film::Grid& grid, double rise, double growth) {
  auto journal = std::make_shared<film::JournalConduction>();
  journal->T0 = 40 + zero_celsius;
  journal->rise = rise;
  journal->T_body0.setConstant(1, journal->T0);
  journal->rise_body.setConstant(1, rise);
  if (growth != 0) {
    journal->shape0.setZero(grid.n_z);
    journal->shape_by_heat.setConstant(grid.n_z, growth);
    journal->shape_by_rise.setZero(grid.n_z);
  }
  return {.conduction = journal};
}

SteadyOptions options_with(const film::BodyJournal& journal) {
  SteadyOptions options{.thermal = film::ThermalModel{.T_supply = 50 + zero_celsius, .T_edges = 50 + zero_celsius}};
  options.thermal->journal = journal;
  return options;
}

// A journal that heat grows everywhere alike is one in a smaller clearance, and as warm as a node of a network that
// passes its heat on through the same conductance.
TEST_CASE("JournalThatHeatGrows_IsOneInASmallerClearance") {
  film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  model.supply = {};  // a line is as thick as the clearance that is given
  model.edge_left = model.edge_right = {film::EdgeKind::pressure, 1e5, 0};
  SteadyState grown, small, lumped;
  const SteadySummary summary = solve_steady(model, point(), options_with(even_journal(model.grid, 0.1, 2e-8)), grown);
  CAPTURE(summary.message);
  REQUIRE(summary.solved());
  CHECK(summary.heat_iterations <= 25);
  REQUIRE(grown.shapes.thermal_journal.size() == model.grid.size());
  CHECK(grown.shapes.thermal_shell.size() == 0);
  const film::HeatObservables& observed = grown.heat->observed;
  CHECK(observed.balance.error() < 1e-8);  // what the last change of temperature leaves
  const double growth = grown.shapes.thermal_journal[0];
  CHECK(growth > 3e-6);  // a fraction of the clearance of 50 um that matters
  CHECK(growth == relative(2e-8 * observed.balance.to_journal).epsilon(1e-7));  // 1e-8 of temperatures
  CHECK(grown.heat->T_journal_body[0] == relative(313.15 + 0.1 * observed.balance.to_journal).epsilon(1e-12));  // eps
  CHECK(observed.T_journal_body_max == grown.heat->T_journal_body[0]);
  CHECK(steady_fields(model, grown).h.minCoeff() == relative(grown.film.h_min).epsilon(1e-2));  // nodes, and between
  model.c -= growth;
  REQUIRE(solve_steady(model, point(), options_with(even_journal(model.grid, 0.1, 0)), small).solved());
  CHECK(small.shapes.thermal_journal.size() == 0);
  CHECK((grown.e - small.e).norm() < 1e-6 * model.c);                   // 1e-8 of temperatures, by the position's slope
  CHECK(grown.film.p_max == relative(small.film.p_max).epsilon(1e-5));  // as well
  CHECK(observed.T_max == relative(small.heat->observed.T_max).epsilon(1e-7));  // as well
  SteadyOptions by_node = options_with({});
  by_node.thermal->journal = film::NodeWall{.T = 313.15, .node = 0};
  by_node.network = film::ThermalNetworkModel{.nodes = {{"shaft", 1e3, 313.15, false}, {"room", 0, 313.15, true}},
                                              .paths = {{"stub", 0, 1, 1 / 0.1}}};
  REQUIRE(solve_steady(model, point(), by_node, lumped).solved());
  CHECK(lumped.heat->observed.T_journal == relative(small.heat->observed.T_journal).epsilon(1e-7));  // as well
  CHECK(lumped.film.p_max == relative(small.film.p_max).epsilon(1e-5));                              // as well
  const GridError error = estimate_grid_error(model, small, options_with(even_journal(model.grid, 0.1, 0)));
  CHECK(error.known);
}

// Shell and journal that widen alike leave the clearance as it is.
TEST_CASE("BoreAndJournalThatGrowAlike_KeepTheirClearance") {
  film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  model.supply = {};
  model.edge_left = model.edge_right = {film::EdgeKind::pressure, 1e5, 0};
  SteadyOptions options = options_with(even_journal(model.grid, 0.1, 0));
  options.thermal->shell = even_body(model.grid, 0.1, 0);
  SteadyState rigid, both;
  REQUIRE(solve_steady(model, point(), options, rigid).solved());
  auto shell = std::make_shared<film::WallConduction>(*even_body(model.grid, 0.1, 1e-12).conduction);
  auto journal = std::make_shared<film::JournalConduction>(*even_journal(model.grid, 0.1, 1e-12).conduction);
  shell->shape0.setConstant(8e-6), journal->shape0.setConstant(8e-6);
  options.thermal->shell = film::BodyWall{.conduction = shell};
  options.thermal->journal = film::BodyJournal{.conduction = journal};
  REQUIRE(solve_steady(model, point(), options, both).solved());
  CHECK(both.shapes.thermal_journal[3] == relative(8e-6).epsilon(1e-3));  // and a picometre per watt
  CHECK((both.e - rigid.e).norm() < 1e-4 * model.c);                      // picometres per watt of a clearance of 50 um
  CHECK(both.film.p_max == relative(rigid.film.p_max).epsilon(1e-3));     // likewise
}

TEST_CASE("JournalThatFillsItsBore_IsReported") {
  film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  auto journal = std::make_shared<film::JournalConduction>(*even_journal(model.grid, 0.1, 5e-8).conduction);
  journal->shape0 = Eigen::VectorXd::LinSpaced(model.grid.n_z, 0, 51e-6);  // at one end of the bearing
  SteadyState state;
  const SteadySummary summary = solve_steady(model, point(), options_with({.conduction = journal}), state);
  CHECK_FALSE(summary.solved());
  CAPTURE(summary.message);
  CHECK(summary.message.find("a seizure: the clearance of 50 um closes to") != std::string::npos);
  CHECK(summary.message.find(" at z = ") != std::string::npos);
}

TEST_CASE("HotBearing_CarriesItsLoadAndBalances") {
  const film::FilmModel model = scaled_for(model_of(vg46(323.15), 60, 13), point());
  SteadyOptions options;
  options.thermal = film::ThermalModel{.layers = 4, .T_supply = 323.15, .T_edges = 323.15};
  options.thermal->shell = film::RingWall{.outer_radius = 0.08, .T_ambient = 303.15};
  SteadyState hot, cold;
  const SteadySummary summary = solve_steady(model, point(), options, hot);
  REQUIRE(summary.solved());
  REQUIRE(hot.heat);
  CHECK((hot.load - *point().load).norm() < 1e-9 * point().load->norm());  // the solver's tolerance of 1e-10
  CHECK(summary.heat_iterations <= 20);
  CHECK(hot.heat->observed.balance.error() < 1e-8);  // what the last change of temperature leaves
  // The oil leaves warmer than it comes, and what it takes along is all but what the ring does.
  CHECK(hot.heat->observed.T_side > 323.15 + 5);
  CHECK(hot.heat->observed.balance.power == relative(hot.film.power_film).epsilon(1e-9));
  CHECK(std::abs(hot.heat->observed.balance.to_journal) < 1e-6 * hot.heat->observed.balance.power);
  // Warm oil is thin: against the bearing that has the supply's temperature everywhere.
  REQUIRE(solve_steady(model, point(), {}, cold).solved());
  CHECK(hot.film.h_min < 0.9 * cold.film.h_min);
  CHECK(hot.film.power_film < 0.8 * cold.film.power_film);
}

// Every layer by its own shear, against one layer by the film's sliding: both of one oil, whose thinning halves the
// power.
TEST_CASE("ThinningLayers_AgreeWithTheTangentViscosity") {
  film::Lubricant oil{.mu0 = 0.02};
  oil.temperature_law = film::FixedViscosity{0.02};
  const film::FilmModel newtonian = scaled_for(model_of(oil, 60, 13), point());
  oil.shear_thinning = {film::Cross{.limit = 0.3, .exponent = 0.8}, 3e5, 0};
  const film::FilmModel model = scaled_for(model_of(oil, 60, 13), point());
  SteadyOptions options;
  options.thermal = film::ThermalModel{.layers = 5, .T_supply = 323.15, .T_edges = 323.15};
  SteadyState layered, tangent, plain;
  const SteadySummary summary = solve_steady(model, point(), options, layered);
  REQUIRE(summary.solved());
  CHECK(summary.heat_iterations <= 20);
  CHECK((layered.load - *point().load).norm() < 1e-9 * point().load->norm());  // the solver's tolerance of 1e-10
  CHECK(layered.heat->observed.balance.error() < 1e-8);                        // what the last change leaves
  REQUIRE(solve_steady(model, point(), {}, tangent).solved());
  REQUIRE(solve_steady(newtonian, point(), {}, plain).solved());
  CHECK(tangent.film.power_film < 0.7 * plain.film.power_film);
  // The tangent is off by a few percent of what thinning does (cross_slider: -7 % of load with so thin a limit).
  CHECK(layered.film.h_min == relative(tangent.film.h_min).epsilon(0.03));
  CHECK(layered.film.power_film == relative(tangent.film.power_film).epsilon(0.02));
  // One layer is the tangent's way.
  options.thermal->layers = 1;
  REQUIRE(solve_steady(model, point(), options, layered).solved());
  CHECK(layered.film.h_min == relative(tangent.film.h_min).epsilon(1e-8));  // two searches to 1e-10 of the load
  // The sense of rotation does not matter.
  options.thermal->layers = 5;
  OperatingPoint other = point();
  other.journal_speed = -other.journal_speed;
  SteadyState mirrored, forwards;
  REQUIRE(solve_steady(model, other, options, mirrored).solved());
  REQUIRE(solve_steady(model, point(), options, forwards).solved());
  constexpr double both = 1e-6;  // of films and layers found to 1e-8 on their own ways
  CHECK(mirrored.film.h_min == relative(forwards.film.h_min).epsilon(both));
  CHECK(mirrored.film.power_film == relative(forwards.film.power_film).epsilon(both));
}

/// Film and heat at a point, from those of `near`.
SteadySummary solve_beside(const film::FilmModel& model, const SteadyOptions& options, const SteadyState& near,
                           const OperatingPoint& at, SteadyState& state) {
  SteadyOptions nearby = options;
  nearby.start_film = near.u;
  if (near.heat) nearby.start_heat = near.heat->state;
  return solve_steady(model, at, nearby, state);
}

// An oil that does not thin: what its temperatures do is of no account.
TEST_CASE("TotalCoefficientsOfAConstantOil_AreTheFrozenOnes") {
  film::FilmModel model = scaled_for(model_of(vg46(323.15), 60, 13), point());
  model.lubricant.temperature_law = film::ExponentialViscosity{.mu_ref = 0.02, .T_ref = 323.15, .beta = 0};
  model.cavitation = film::Cavitation::guembel;  // no cells that switch within a difference
  SteadyOptions options;
  options.thermal = film::ThermalModel{.layers = 3, .T_supply = 323.15, .T_edges = 323.15};
  SteadyState state;
  REQUIRE(solve_steady(model, point(), options, state).solved());
  DynamicCoefficients total;
  const auto beside = [&](const OperatingPoint& at, SteadyState& other) {
    return solve_beside(model, options, state, at, other);
  };
  REQUIRE(find_total_coefficients(model, state, beside, total).solved());
  // Square of the step, 1e-3 of the gap, and half a cell of pressure that guembel cuts off.
  constexpr double tolerance = 2e-3;
  const DynamicCoefficients& frozen = state.coefficients;
  CHECK((total.stiffness.topLeftCorner<2, 2>() - frozen.stiffness.topLeftCorner<2, 2>()).norm() <
        tolerance * frozen.stiffness.topLeftCorner<2, 2>().norm());
  CHECK((total.damping.topLeftCorner<2, 2>() - frozen.damping.topLeftCorner<2, 2>()).norm() <
        tolerance * frozen.damping.topLeftCorner<2, 2>().norm());
  CHECK((total.stiffness.bottomRightCorner<2, 2>() - frozen.stiffness.bottomRightCorner<2, 2>()).norm() <
        tolerance * frozen.stiffness.bottomRightCorner<2, 2>().norm());
  CHECK((total.damping.bottomRightCorner<2, 2>() - frozen.damping.bottomRightCorner<2, 2>()).norm() <
        tolerance * frozen.damping.bottomRightCorner<2, 2>().norm());
}

// A little more load moves a hot bearing by what its total stiffness says, and not by what the frozen one does.
TEST_CASE("TotalStiffness_IsThatUnderALittleMoreLoad") {
  const film::FilmModel model = scaled_for(model_of(vg46(323.15), 60, 13), point());
  SteadyOptions options;
  options.thermal = film::ThermalModel{.layers = 3, .T_supply = 323.15, .T_edges = 323.15};
  options.thermal->shell = film::RingWall{.outer_radius = 0.08, .T_ambient = 303.15};
  SteadyState state;
  REQUIRE(solve_steady(model, point(), options, state).solved());
  DynamicCoefficients total;
  const auto beside = [&](const OperatingPoint& at, SteadyState& other) {
    return solve_beside(model, options, state, at, other);
  };
  REQUIRE(find_total_coefficients(model, state, beside, total).solved());
  const Eigen::Vector2d more(20, -50);
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  for (const double side : {1.0, -1.0}) {
    OperatingPoint at = point();
    *at.load += side * more;
    SteadyState other;
    REQUIRE(solve_beside(model, options, state, at, other).solved());
    moved += 0.5 * side * other.e;
  }
  const Eigen::Vector2d carried = total.stiffness.topLeftCorner<2, 2>() * moved;
  CHECK((carried - more).norm() < 0.02 * more.norm());  // cells of the cavity's edge that fill or empty
  const Eigen::Vector2d frozen = state.coefficients.stiffness.topLeftCorner<2, 2>() * moved;
  CHECK((frozen - more).norm() > 0.05 * more.norm());  // temperatures matter, or there is nothing to test
}

// Seen from axes that are turned, and with the sense of rotation mirrored, the bearing is the same.
TEST_CASE("HotBearing_TurnedOrMirrored_IsTheSame") {
  const film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  SteadyOptions options;
  options.thermal = film::ThermalModel{.layers = 3, .T_supply = 323.15, .T_edges = 323.15};
  options.thermal->shell = film::RingWall{.outer_radius = 0.08, .T_ambient = 303.15};
  SteadyState first, turned, mirrored;
  REQUIRE(solve_steady(model, point(), options, first).solved());
  OperatingPoint other = point();
  other.load = Eigen::Vector2d(10e3, 0);  // by a quarter turn, twelve nodes
  REQUIRE(solve_steady(model, other, options, turned).solved());
  other = point();
  other.journal_speed = -other.journal_speed;
  REQUIRE(solve_steady(model, other, options, mirrored).solved());
  constexpr double tolerance = 1e-6;  // of films and temperatures found to 1e-8 on their own ways
  for (const SteadyState* state : {&turned, &mirrored}) {
    CHECK(state->film.h_min == relative(first.film.h_min).epsilon(tolerance));
    CHECK(state->heat->observed.T_max - 323.15 == relative(first.heat->observed.T_max - 323.15).epsilon(tolerance));
    CHECK(state->heat->observed.balance.to_shell == relative(first.heat->observed.balance.to_shell).epsilon(tolerance));
  }
}

film::ThermalModel ring_at_50() {
  film::ThermalModel thermal{.layers = 3, .T_supply = 323.15, .T_edges = 323.15};
  thermal.shell = film::RingWall{.outer_radius = 0.08, .T_ambient = 303.15};
  return thermal;
}

// A bearing whose clearance has grown is that of the grown clearance, found on the way to its temperatures.
TEST_CASE("ClearanceAtTemperature_IsThatOfItsWalls") {
  film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  // The line lies on a row of nodes: between nodes its conductance would depend on the clearance as given.
  model.supply = {film::SupplyKind::fixed_angle, std::numbers::pi / 2, 0};
  SteadyOptions options{.thermal = ring_at_50()};
  options.thermal->expansion = film::ThermalExpansion{.shell = 23e-6, .journal = 12e-6, .T_reference = 293.15};
  std::vector<film::JournalWall> journals{film::FreeJournal{}, film::InsulatedWall{}};
  for (const film::JournalWall& journal : journals) {
    for (const double sense : {1.0, -1.0}) {
      CAPTURE(journal.index());
      CAPTURE(sense);
      options.thermal->journal = journal;
      OperatingPoint at = point();
      at.journal_speed *= sense;
      SteadyState hot, same;
      const SteadySummary summary = solve_steady(model, at, options, hot);
      REQUIRE(summary.solved());
      CHECK(summary.heat_iterations <= 25);
      const film::HeatObservables& observed = hot.heat->observed;
      const double growth =
          0.05 * (23e-6 * (observed.T_shell_wall - 293.15) - 12e-6 * (observed.T_journal_wall - 293.15));
      CHECK(hot.point.growth ==
            relative(growth).epsilon(1e-6));  // 1e-8 of the largest rise, 30 K, over both walls' 10 K
      CHECK(growth > 10e-6);
      if (journal.index() == 2) CHECK(observed.T_journal_wall == observed.T_journal);
      // The same clearance given cold, of walls that keep their size.
      film::FilmModel grown = model;
      grown.c += hot.point.growth;
      SteadyOptions keeps = options;
      keeps.thermal->expansion.reset();
      REQUIRE(solve_steady(grown, at, keeps, same).solved());
      constexpr double ways = 1e-6;  // of films and temperatures found to 1e-8 on two ways
      CHECK(hot.film.h_min == relative(same.film.h_min).epsilon(ways));
      CHECK(observed.T_max - 323.15 == relative(same.heat->observed.T_max - 323.15).epsilon(ways));
      CHECK(hot.film.flow_left == relative(same.film.flow_left).epsilon(ways));
      const BearingNumbers a = bearing_numbers(model, hot), b = bearing_numbers(grown, same);
      CHECK(a.eccentricity_ratio == relative(b.eccentricity_ratio).epsilon(ways));
      CHECK(a.sommerfeld_So == relative(b.sommerfeld_So).epsilon(ways));
      CHECK(in_load_axes(model, hot).K(0, 0) ==
            relative(in_load_axes(grown, same).K(0, 0)).epsilon(1e-5));  // derivatives
    }
  }
}

TEST_CASE("PositionThatIsGiven_KeepsItsRatioAsTheClearanceGrows") {
  const film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  SteadyOptions options{.thermal = ring_at_50()};
  options.thermal->expansion = film::ThermalExpansion{.shell = 23e-6, .journal = 12e-6, .T_reference = 293.15};
  OperatingPoint at{.journal_speed = 300};
  at.e = Eigen::Vector2d(0, -0.6 * model.c);
  SteadyState hot;
  REQUIRE(solve_steady(model, at, options, hot).solved());
  CHECK(hot.point.growth > 10e-6);
  CHECK(hot.e.norm() / clearance(model, hot.point) == relative(0.6).epsilon(1e-12));  // round-off
}

TEST_CASE("OneEffectiveTemperature_MovesTheClearance") {
  film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  GlobalHeat heat{.T_supply = 50 + zero_celsius};
  heat.expansion = WallExpansion{.material = {.shell = 23e-6, .journal = 12e-6, .T_reference = 293.15}};
  SteadyState state;
  REQUIRE(solve_global(model, point(), heat, {}, state).solved());
  CHECK(state.point.growth ==
        relative(0.05 * 11e-6 * (state.effective->T - 293.15)).epsilon(1e-6));  // of its tolerance
  heat.expansion->T_shell = 293.15, heat.expansion->T_journal = 343.15;
  REQUIRE(solve_global(model, point(), heat, {}, state).solved());
  CHECK(state.point.growth == relative(-0.05 * 12e-6 * 50).epsilon(1e-12));  // round-off
}

TEST_CASE("ClearanceThatCloses_IsReportedAsASeizure") {
  film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  SteadyOptions options{.thermal = ring_at_50()};
  options.thermal->expansion = film::ThermalExpansion{.shell = 0, .journal = 60e-6, .T_reference = 293.15};
  SteadyState state;
  const SteadySummary summary = solve_steady(model, point(), options, state);
  CHECK(!summary.solved());
  CAPTURE(summary.message);
  CHECK(summary.message.find("a seizure: the clearance of 50 um closes") != std::string::npos);
  GlobalHeat heat{.T_supply = 50 + zero_celsius};
  heat.expansion = WallExpansion{.material = *options.thermal->expansion};
  const SteadySummary global = solve_global(model, point(), heat, {}, state);
  CHECK(!global.solved());
  CHECK(global.message.find("a seizure: the clearance of 50 um closes") != std::string::npos);
}

// Block, shaft and room: each body as warm as its heat over its conductance, and the film that of such walls.
TEST_CASE("WallsOfANetwork_AreInBalance") {
  const film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  SteadyOptions options{.thermal = ring_at_50()};
  options.thermal->shell = film::NodeWall{.T = 293.15, .node = 0};
  options.network = film::ThermalNetworkModel{
      .nodes = {{"block", 1e4, 293.15, false}, {"shaft", 1e3, 293.15, false}, {"room", 0, 298.15, true}},
      .paths = {{"housing", 0, 2, 8}, {"stub", 1, 2, 3}, {"across", 0, 1, 1}}};
  for (const std::size_t journal : {1, 0}) {  // a body of its own, or that of the shell
    CAPTURE(journal);
    options.thermal->journal = film::NodeWall{.T = 293.15, .node = journal};
    SteadyState hot, given;
    const SteadySummary summary = solve_steady(model, point(), options, hot);
    REQUIRE(summary.solved());
    CHECK(summary.heat_iterations <= 20);
    const film::NetworkObservables& observed = hot.heat->network;
    CHECK(std::abs(observed.error()) < 1e-10);  // round-off
    const film::HeatBalance& balance = hot.heat->observed.balance;
    CHECK(balance.error() < 1e-8);  // what the last change of temperature leaves
    const double block = observed.T[0], shaft = observed.T[1];
    CHECK(hot.heat->state.shell[5] == relative(block).epsilon(1e-12));  // round-off
    // Likewise.
    CHECK(hot.heat->state.journal == relative(observed.T[static_cast<Eigen::Index>(journal)]).epsilon(1e-12));
    const double to_shaft = journal == 1 ? balance.to_journal : 0;
    CHECK(balance.to_shell + balance.to_journal - to_shaft ==
          relative(8 * (block - 298.15) + (block - shaft)).epsilon(1e-8));  // round-off of both sums
    // Likewise.
    CHECK(3 * (shaft - 298.15) - (block - shaft) == relative(to_shaft).epsilon(1e-8).scale(1));
    SteadyOptions fixed = options;
    fixed.network.reset();
    fixed.thermal->shell = film::WallAtTemperature{.T = block};
    fixed.thermal->journal = film::WallAtTemperature{.T = hot.heat->state.journal};
    REQUIRE(solve_steady(model, point(), fixed, given).solved());
    CHECK(given.heat->observed.T_max - 323.15 ==
          relative(hot.heat->observed.T_max - 323.15).epsilon(1e-6));                          // on two ways
    CHECK(given.heat->observed.balance.to_shell == relative(balance.to_shell).epsilon(1e-5));  // likewise
  }
}

// A sump that feeds the bearing, takes its oil back and is cooled, and a block around the ring: all heat of the film
// goes into the air through both, and the film is that of oil and surroundings of these temperatures.
TEST_CASE("SumpAndBlockOfANetwork_AreInBalance") {
  const film::FilmModel model = scaled_for(model_of(vg46(323.15), 48, 9), point());
  SteadyOptions options{.thermal = ring_at_50()};
  const film::NetworkNode sump{.T = 323.15, .node = 0}, block{.T = 313.15, .node = 1};
  options.thermal->oil = {.line = sump, .edges = sump, .features = {}, .drain = sump};
  options.thermal->oil.features.assign(model.features.size(), sump);
  auto& ring = std::get<film::RingWall>(options.thermal->shell);
  ring.surroundings = block, ring.T_ambient = block.T;
  options.network = film::ThermalNetworkModel{
      .nodes = {{"sump", 1e4, 323.15, false}, {"block", 1e3, 313.15, false}, {"room", 0, 298.15, true}},
      .paths = {{"cooler", 0, 2, 60}, {"housing", 1, 2, 3}, {"across", 0, 1, 1}}};
  SteadyState hot, given;
  const SteadySummary summary = solve_steady(model, point(), options, hot);
  CAPTURE(summary.message);
  REQUIRE(summary.solved());
  CHECK(summary.heat_iterations <= 25);
  const film::NetworkObservables& observed = hot.heat->network;
  const film::HeatBalance& balance = hot.heat->observed.balance;
  CHECK(std::abs(observed.error()) < 1e-10);                            // round-off
  CHECK(balance.error() < 1e-8);                                        // what the last change of temperature leaves
  CHECK(observed.heat[0] == relative(balance.to_oil).epsilon(1e-6));    // as much oil comes as leaves: film's residual
  CHECK(observed.heat[1] == relative(balance.to_shell).epsilon(1e-6));  // likewise
  CHECK(observed.to_fixed == relative(balance.power).epsilon(1e-6));    // likewise
  CHECK(std::abs(observed.T[0] - 323.15) > 1);
  SteadyOptions fixed = options;
  fixed.network.reset();
  fixed.thermal->oil = {};
  fixed.thermal->T_supply = fixed.thermal->T_edges = observed.T[0];
  fixed.thermal->T_features.assign(model.features.size(), observed.T[0]);
  auto& same = std::get<film::RingWall>(fixed.thermal->shell);
  same.surroundings.reset(), same.T_ambient = observed.T[1];
  REQUIRE(solve_steady(model, point(), fixed, given).solved());
  CHECK(given.heat->observed.T_max - observed.T[0] ==
        relative(hot.heat->observed.T_max - observed.T[0]).epsilon(1e-5));             // on two ways
  CHECK(given.heat->observed.balance.power == relative(balance.power).epsilon(1e-6));  // likewise
}

}  // namespace hot_bearing_test
}  // namespace hersey::bearing
