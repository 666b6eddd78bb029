#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "film_over_time.h"
#include "relative.h"

// Oil that flows between nodes of a network, and back from films into the nodes it came from.
namespace hersey::film {
namespace oil_stream_test {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double cold = 20 + zero_celsius, warm = 90 + zero_celsius;

ThermalNode oil(double heat_capacity, double T) {
  return {.name = "oil", .heat_capacity = heat_capacity, .T = T, .is_oil = true};
}

ThermalNode given(double T) { return {.name = "given", .T = T, .is_fixed = true}; }

OilStream stream(std::size_t from, std::size_t to, double rate) { return {.from = from, .to = to, .kept = rate}; }

TEST_CASE("JunctionOfTwoStreams_HasTheirMixture") {
  ThermalNetwork network({.nodes = {given(cold), given(warm), oil(0, 50 + zero_celsius), oil(0, 0)}, .paths = {}});
  for (const double dt : {1e-3, 0.0}) {
    network.advance(dt, {}, {stream(0, 2, 30), stream(1, 2, 70), stream(2, 3, 100)});
    const double mixed = 0.3 * cold + 0.7 * warm;
    CHECK(network.temperatures()[2] == relative(mixed).epsilon(8 * kEps));  // round-off of three sums
    CHECK(network.temperatures()[3] == relative(mixed).epsilon(8 * kEps));  // likewise
    CHECK(std::abs(network.observables().error()) < 8 * kEps);              // likewise
  }
}

// A junction without inflow, and a ring of junctions without one from outside, have no mixture.
TEST_CASE("JunctionWithoutInflow_KeepsItsTemperature") {
  ThermalNetwork network({.nodes = {given(warm), oil(0, cold), oil(0, cold + 5), oil(0, cold + 10)}, .paths = {}});
  network.advance(1e-3, {}, {stream(1, 0, 10), stream(2, 3, 5), stream(3, 2, 5)});
  CHECK(network.temperatures()[1] == cold);
  CHECK(network.temperatures()[2] == cold + 5);
  CHECK(network.temperatures()[3] == cold + 10);
}

// A volume that warm oil flows through warms as 1 - exp(-t Q/V).
TEST_CASE("VolumeInAStream_WarmsAsAnExponential") {
  const double capacity = 400, rate = 100, t = 3;
  const auto error_with = [&](int steps) {
    ThermalNetwork network({.nodes = {given(warm), oil(capacity, cold), given(cold)}, .paths = {}});
    for (int k = 0; k < steps; ++k) network.advance(t / steps, {}, {stream(0, 1, rate), stream(1, 2, rate)});
    return network.temperatures()[1] - (warm + (cold - warm) * std::exp(-rate * t / capacity));
  };
  const double order = std::log2(error_with(100) / error_with(200));
  CHECK(std::abs(order - 1) < 0.02);  // implicit Euler at 1/133 of the time constant
}

TEST_CASE("HeatThatACoolerTakes_IsWhatTheOilLoses") {
  const double rate = 120, remaining = 0.4;
  ThermalNetwork network({.nodes = {given(warm), oil(0, cold), given(cold)}, .paths = {}});
  network.advance(0, {},
                  {{.from = 0, .to = 1, .kept = remaining * rate, .coolant = 2, .cooled = (1 - remaining) * rate}});
  const double outlet = network.temperatures()[1];
  CHECK(outlet == relative(cold + remaining * (warm - cold)).epsilon(8 * kEps));                  // round-off
  CHECK(network.observables().by_oil[2] == relative(rate * (warm - outlet)).epsilon(64 * kEps));  // likewise
  CHECK(std::abs(network.observables().by_oil[1]) < 64 * kEps * rate * warm);                     // likewise
}

TEST_CASE("HeatDissipatedOnTheWay_WarmsTheOil") {
  const double rate = 50, heat = 25;
  ThermalNetwork network({.nodes = {given(cold), oil(0, cold)}, .paths = {}});
  network.advance(0, {}, {{.from = 0, .to = 1, .kept = rate, .heat = heat}});
  CHECK(network.temperatures()[1] - cold == relative(heat / rate).epsilon(1e-12));  // digits that 293 K leaves of 0.5 K
}

/// A hole in front of the pressure's hill, through which the film gives oil back to node 0; 1 takes what its sides
/// lose.
struct GivesBack {
  explicit GivesBack(double carry_over = 1) : model(small_bearing_with_hole(0.7, 24, 7)) {
    model.features[0].pressure = 1e5;
    thermal = supplied_at_40(3);
    thermal.carry_over = carry_over;
    const double T = 40 + zero_celsius;
    thermal.oil = {.features = {NetworkNode{.T = T, .node = 0, .name = "port", .takes_back = true}},
                   .drain = NetworkNode{.T = T, .node = 1, .name = "sump"}};
    thermal.journal = FreeJournal{.heat_capacity = 50};
  }
  FilmModel model;
  ThermalModel thermal;
};

const Journal against{.e = {15e-6, 8e-6}, .omega_journal = -300};

TEST_CASE("OilThatAFilmGivesBack_WarmsTheNodeItCameFrom") {
  GivesBack at;
  FilmOverTime film(at.model, at.thermal, against);
  film.advance(0);
  const FilmTerminals terminals = terminals_of(at.thermal);
  const Eigen::Index port = 2 + terminals.index_of_oil(at.thermal.oil.features[0]),
                     sump = 2 + terminals.index_of_drain();
  const WallHeatFlow heat = film.heat.heat_flow();
  CHECK(heat.heat[port] > 0);
  CHECK(heat.heat[sump] > 0);
  // Both together are what the film's oil carries away: nothing comes in but through its edges, at 40 degC.
  const HeatBalance balance = film.heat.observables().balance;
  CHECK(heat.heat[port] + heat.heat[sump] == relative(balance.to_oil).epsilon(1e-3));  // residual of a steady film
  at.thermal.oil.features[0]->takes_back = false;
  FilmOverTime drained(at.model, at.thermal, against);
  drained.advance(0);
  CHECK(drained.heat.heat_flow().heat[sump] == relative(heat.heat[port] + heat.heat[sump]).epsilon(1e-12));  // sums
  CHECK(drained.heat.heat_flow().heat[port] == 0);
}

TEST_CASE("AnswerOfOilGivenBack_IsThatOfFiniteDifferences") {
  for (const double carry_over : {1.0, 0.6}) {
    CAPTURE(carry_over);
    const GivesBack at(carry_over);
    FilmOverTime film(at.model, at.thermal, against);
    film.advance(1e-3);
    const WallHeatFlow observed = film.heat.heat_flow();
    for (Eigen::Index terminal = 2; terminal < observed.T.size(); ++terminal) {
      CAPTURE(terminal);
      Eigen::VectorXd T = observed.T;
      T[terminal] += 10;
      FilmOverTime other(at.model, at.thermal, against);
      HeatState begin = other.heat.state();
      begin.outside = T.tail(T.size() - 2);
      other.heat.set_state(begin);
      other.advance(1e-3);
      const Eigen::VectorXd expected = observed.heat + observed.by_T * (T - observed.T);
      // A step's linear systems are solved to 1e-7 of an answer.
      CHECK((other.heat.heat_flow().heat - expected).norm() < 1e-6 * (expected - observed.heat).norm());
    }
  }
}

}  // namespace oil_stream_test
}  // namespace hersey::film
