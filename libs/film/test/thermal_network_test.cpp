#include "hersey/film/thermal_network.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "film_over_time.h"
#include "relative.h"

// Lumped bodies, alone and warmed by films.
namespace hersey::film {
namespace thermal_network_test {

FilmModel bearing(int n_phi, int n_z) {
  FilmModel model = small_bearing(25e-6, n_phi, n_z);
  model.shear_force = ShearForce::torque_only;
  return model;
}

// C dT/dt = P0 exp(-beta (T - 40)) - G (T - 25) of one body around and within a concentric film, by an independent
// program (quadrature of a fine step).
TEST_CASE("BodyWarmedByAFilm_IsThatOfTheReference") {
  FilmModel model = bearing(8, 5);
  // Oil that neither stores heat nor insulates the walls: the film has the body's temperature.
  model.lubricant.specific_heat = 1, model.lubricant.conductivity = 1e4;
  ThermalModel thermal{.layers = 1, .T_supply = 25 + zero_celsius, .T_edges = 25 + zero_celsius};
  thermal.shell = NodeWall{.T = 25 + zero_celsius, .node = 0};
  thermal.journal = NodeWall{.T = 25 + zero_celsius, .node = 0};
  const ThermalNetworkModel bodies{
      .nodes = {{"body", 200, 25 + zero_celsius, false}, {"air", 0, 25 + zero_celsius, true}},
      .paths = {{"out", 0, 1, 2}}};
  constexpr std::array<double, 6> times{30, 60, 120, 300, 600, 1200};
  constexpr std::array<double, 6> wanted{50.29241345413409, 58.821206366691854, 64.1936807460481,
                                         65.74577631866171, 65.76688794857124,  65.76690439194738};
  std::array<std::array<double, 6>, 3> found{};
  for (std::size_t level = 0; level < 3; ++level) {
    const double dt = 2 / std::exp2(level);
    ThermalNetwork network(bodies);
    FilmOverTime film(model, thermal, {.omega_journal = 300});
    double t = 0;
    for (std::size_t k = 0; k < times.size(); ++k) {
      for (; t < times[k] - 0.5 * dt; t += dt) {
        film.advance(dt);
        network.advance(dt, {film.at_nodes()});
        film.follow(network);
        CHECK(std::abs(network.observables().error()) < 1e-10);  // round-off of 1e4 times the heat that passes
      }
      found[level][k] = network.temperatures()[0] - zero_celsius;
    }
  }
  for (std::size_t k = 0; k < times.size(); ++k) {
    CAPTURE(times[k]);
    const double coarse = found[1][k] - found[0][k], fine = found[2][k] - found[1][k];
    if (times[k] <= 120) CHECK(std::abs(std::log2(coarse / fine) - 1) < 0.1);  // first order in time
    // Extrapolated once; what is left of the steps is of second order.
    CHECK(std::abs(found[2][k] + fine - wanted[k]) < 5e-3);
  }
}

ThermalModel between_nodes(std::size_t shell, std::size_t journal) {
  ThermalModel thermal = supplied_at_40(4);
  thermal.shell = NodeWall{.T = 320, .node = shell};
  thermal.journal = NodeWall{.T = 310, .node = journal};
  return thermal;
}

TEST_CASE("AnswerToWalls_IsThatOfFiniteDifferences") {
  FilmModel model = bearing(24, 7);
  model.features.push_back({.name = "hole", .phi = 1, .z = 0, .arc = 0.9, .length = 8e-3, .pressure = 3e5});
  for (const double omega : {300.0, -300.0}) {
    for (const double dt : {1e-4, 1.0}) {
      for (const Cavitation cavitation : {Cavitation::mass_conserving, Cavitation::reynolds, Cavitation::guembel}) {
        CAPTURE(omega);
        CAPTURE(dt);
        CAPTURE(static_cast<int>(cavitation));
        model.cavitation = cavitation;
        ThermalModel thermal = between_nodes(0, 1);
        thermal.carry_over = cavitation == Cavitation::reynolds ? 0 : 0.7;
        const Journal journal{.e = {12e-6, 8e-6}, .omega_journal = omega};
        FilmOverTime film(model, thermal, journal);
        film.advance(dt);
        const WallHeatFlow at = film.heat.heat_flow();
        CHECK(at.T == Eigen::Vector2d(320, 310));
        // The same step is solved with the other walls from the start, and compared with the one that is moved there at
        // its end.
        for (const Eigen::Vector2d& T : {Eigen::Vector2d(330, 310), Eigen::Vector2d(320, 290)}) {
          thermal.shell = NodeWall{.T = T[0], .node = 0}, thermal.journal = NodeWall{.T = T[1], .node = 1};
          FilmOverTime other(model, thermal, journal);
          other.advance(dt);
          const Eigen::Vector2d expected = at.heat + at.by_T * (T - at.T);
          const double scale = at.heat.cwiseAbs().maxCoeff() + (at.by_T * (T - at.T)).cwiseAbs().maxCoeff();
          constexpr double solved = 1e-6;  // linear systems to 1e-7 of an answer
          CHECK((other.heat.heat_flow().heat - expected).norm() < solved * scale);
          ThermalModel again = between_nodes(0, 1);
          again.carry_over = thermal.carry_over;
          FilmOverTime same(model, again, journal);
          same.advance(dt);
          same.heat.move_walls(T);
          CHECK((same.heat.state().film - other.heat.state().film).cwiseAbs().maxCoeff() <
                1e-4);                                                            // both to 1e-6 of 20 K
          CHECK(same.heat.state().journal == relative(T[1]).epsilon(1e-14));      // round-off
          CHECK(same.heat.state().shell[3] == relative(T[0]).epsilon(1e-14));     // round-off
          CHECK((same.heat.heat_flow().heat - expected).norm() < 1e-12 * scale);  // round-off
          CHECK(same.heat.observables().balance.to_shell == relative(expected[0]).epsilon(1e-9));  // round-off of sums
          CHECK(same.heat.observables().balance.error() < 1e-6);  // the film's residual over a short step
        }
      }
    }
  }
}

// Two films, a shell of next to no capacity, a block and a shaft that both films share, from microseconds to hours.
TEST_CASE("StepsOfAnyLength_ConserveHeat") {
  const FilmModel model = bearing(16, 5);
  const ThermalNetworkModel bodies{.nodes = {{"shell", 1e-3, 300, false},
                                             {"shaft", 800, 310, false},
                                             {"block", 2e4, 290, false},
                                             {"room", 0, 295, true},
                                             {"lonely", 10, 333, false}},
                                   .paths = {{"seat", 0, 2, 300}, {"outside", 2, 3, 5}, {"stub", 1, 3, 1}}};
  ThermalNetwork network(bodies);
  FilmOverTime first(model, between_nodes(0, 1), {.e = {12e-6, 0}, .omega_journal = 200});
  FilmOverTime second(model, between_nodes(2, 1), {.e = {0, -8e-6}, .omega_journal = 200});
  for (const double dt : {1e-6, 1e-4, 1e-2, 1.0, 100.0, 1e4, 1e4, 1e5, 1e6, 1e7, 1e7, 1e7, 1e7, 1e7, 1e7}) {
    CAPTURE(dt);
    first.advance(dt), second.advance(dt);
    network.advance(dt, {first.at_nodes(), second.at_nodes()});
    first.follow(network), second.follow(network);
    const NetworkObservables& observed = network.observables();
    CHECK(std::abs(observed.error()) < 1e-9);  // round-off
    CHECK(observed.heat.sum() ==
          relative(first.heat.observables().balance.to_shell + first.heat.observables().balance.to_journal +
                   second.heat.observables().balance.to_shell + second.heat.observables().balance.to_journal)
              .epsilon(1e-9));  // round-off of sums over nodes
    CHECK(first.heat.state().journal == relative(second.heat.state().journal).epsilon(1e-14));  // one body
    CHECK(observed.T.minCoeff() > 280);
    CHECK(observed.T.maxCoeff() < 420);
    CHECK(observed.T[3] == 295);
    CHECK(observed.T[4] == relative(333).epsilon(1e-12));  // round-off: nothing leads there
  }
  // At rest heat from films flows to the room, and a steady balance gives the same.
  CHECK(network.observables().to_fixed ==
        relative(network.observables().heat.sum()).epsilon(1e-5));  // viscosities follow by a step
  ThermalNetwork steady(bodies);
  for (int k = 0; k < 3; ++k) steady.advance(0, {first.at_nodes(), second.at_nodes()});
  for (int k = 0; k < 3; ++k)
    CHECK(steady.temperatures()[k] == relative(network.temperatures()[k]).epsilon(1e-5));  // what is left of the start
  CHECK(steady.temperatures()[4] == 333);
}

TEST_CASE("WayOut_IsFoundAlongPaths") {
  const ThermalNetworkModel bodies{
      .nodes = {{"a", 1, 300, false}, {"b", 1, 300, false}, {"c", 1, 300, false}, {"air", 0, 300, true}},
      .paths = {{"ab", 0, 1, 2}, {"out", 1, 3, 1}, {"none", 2, 3, 0}}};
  CHECK(reaches_surroundings(bodies, 0));
  CHECK(reaches_surroundings(bodies, 3));
  CHECK(!reaches_surroundings(bodies, 2));
}

}  // namespace thermal_network_test
}  // namespace hersey::film
