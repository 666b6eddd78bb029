// Runs that go cycle by cycle until they repeat themselves.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hersey/core/input_error.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace cycles_test {

std::string rig_of_cycles(const std::string& cycle) {
  std::string text = rig_with("  duration: \"${duration}\"\n", "  cycle: " + cycle + "\n");
  // A load that rotates with the crank: the film never comes to rest.
  const std::string push = "components: [0 N, \"-${load}\", 0 N]";
  return text.replace(text.find(push), push.size(),
                      "direction: y, magnitude: {expression: \"-500*(1 + 0.5*sin(main.rotation))\", unit: N}");
}

struct Cycles {
  Summary summary;
  std::vector<CycleProgress> reported;
  std::vector<double> end, change, h_min, p_max, friction;
  std::vector<double> time;  // rows of the run
};

Cycles cycles_of(const std::string& text) {
  const TemporaryDirectory scratch;
  Cycles cycles;
  Options options{.results = scratch / "run.h5"};
  options.on_cycle = [&](const CycleProgress& cycle) { cycles.reported.push_back(cycle); };
  cycles.summary = simulate(rig(text), options);
  const results::Reader reader(options.results);
  const auto values = [&](const char* name) { return reader.read(name).values; };
  cycles.end = values("/cycles/fields/time"), cycles.change = values("/cycles/fields/change");
  cycles.h_min = values("/bearings/big_end/cycles/fields/moft"),
  cycles.p_max = values("/bearings/big_end/cycles/fields/pofp");
  cycles.friction = values("/bearings/big_end/cycles/fields/power_film");  // nothing touches
  cycles.time = values("/time");
  return cycles;
}

struct Rows {
  std::vector<double> T_journal, heat_to_journal, correction;
};

constexpr double kRevolution = 60.0 / 3000;

TEST_CASE("Cycles_EndTheRunOnceTheyRepeat") {
  const Cycles cycles = cycles_of(rig_of_cycles("{period: 360 deg, until_converged: 0.01, most: 12}"));
  INFO(cycles.summary.message);
  REQUIRE(cycles.summary.status == Status::completed);
  const std::size_t n = cycles.change.size();
  REQUIRE(n >= 2);
  CHECK(n < 12);
  CHECK(cycles.summary.cycles == static_cast<int>(n));
  CHECK(cycles.summary.message.find("converged in cycle") == 0);
  CHECK(cycles.reported.size() == n);
  CHECK(cycles.time.back() == doctest::Approx(kRevolution * static_cast<double>(n)));
  CHECK(std::isnan(cycles.change[0]));
  for (std::size_t i = 1; i < n; ++i) {
    CHECK(cycles.end[i] == doctest::Approx(kRevolution * static_cast<double>(i + 1)));
    // The change is that of the figure that changed most.
    const auto differ = [&](const std::vector<double>& x) {
      return std::abs(x[i] - x[i - 1]) / std::max(x[i], x[i - 1]);
    };
    CHECK(cycles.change[i] == std::max({differ(cycles.h_min), differ(cycles.p_max), differ(cycles.friction)}));
    CHECK((cycles.change[i] <= 0.01) == (i + 1 == n));
    CHECK(cycles.reported[i].change == cycles.change[i]);
    CHECK(cycles.reported[i].largest.find(" of big_end") != std::string::npos);
  }
}

TEST_CASE("AllCyclesAskedFor_AreRun") {
  const Cycles cycles = cycles_of(rig_of_cycles("{period: 90 deg, until_converged: 0, most: 3}"));
  CHECK(cycles.h_min.size() == 3);
  CHECK(cycles.summary.message.empty());
  CHECK(cycles.time.back() == doctest::Approx(0.75 * kRevolution));
}

TEST_CASE("CyclesThatDoNotConverge_AreReported") {
  const Cycles cycles = cycles_of(rig_of_cycles("{period: 90 deg, until_converged: 1e-9, most: 3}"));
  CHECK(cycles.summary.status == Status::completed);
  CHECK(cycles.summary.cycles == 3);
  CHECK(cycles.summary.message.find("not converged after 3 cycles: ") == 0);
  const Cycles one = cycles_of(rig_of_cycles("{period: 90 deg}\n  duration: 135 deg"));
  CHECK(one.summary.cycles == 1);
  CHECK(one.summary.message.find("fewer than two cycles") == 0);
}

TEST_CASE("StepsOfControlledError_HitTheEndOfEachCycle") {
  std::string text = rig_of_cycles("{period: 90 deg, until_converged: 0, most: 2}");
  text.replace(text.find("step: 2 deg"), 11, "step: {tolerance: 1e-4}");
  const Cycles cycles = cycles_of(text);
  REQUIRE(cycles.end.size() == 2);
  // Hit exactly: round-off.
  CHECK(cycles.end[0] == doctest::Approx(kRevolution / 4).epsilon(1e-14));
  CHECK(cycles.end[1] == doctest::Approx(kRevolution / 2).epsilon(1e-14));
}

/// The rig with a warm film, a ring around it and walls as `walls` says.
Rows warm_rows(const std::string& walls) {
  std::string text = rig_of_cycles("{period: 360 deg, until_converged: 0, most: 9}");
  const std::string line = "    supply: {line: widest_gap, pressure: 1 bar}\n", oil = "viscosity: 15 mPa.s";
  text.insert(text.find(line),
              "    thermal: {model: film, supply_temperature: 40 degC, layers: 3, shell: {wall: ring, outer_diameter: "
              "60 mm, ambient: 30 degC, temperature: 50 degC}, journal: {wall: free, temperature: 55 degC}}\n");
  text.replace(text.find(oil), oil.size(), "grade: iso_vg_22");
  const TemporaryDirectory scratch;
  const std::filesystem::path file = scratch / "run.h5";
  REQUIRE(simulate(rig(text + walls), {.results = file}).status == Status::completed);
  const results::Reader reader(file);
  const auto values = [&](const std::string& name) { return reader.read("/bearings/big_end/" + name).values; };
  return {values("T_journal"), values("heat_to_journal"), values("cycles/fields/wall_correction")};
}

TEST_CASE("WallsAtTheMeanOfACycle_TakeUpNoHeatInTheEnd") {
  const Rows rows = warm_rows("");  // a machine with cycles
  constexpr std::size_t per_cycle = 180;
  REQUIRE(rows.T_journal.size() == 9 * per_cycle + 1);
  // The temperature is constant from the first step of a cycle to its last.
  CHECK(rows.T_journal[1] == doctest::Approx(55).epsilon(1e-12));  // round-off of kelvins
  CHECK(rows.T_journal[per_cycle] == rows.T_journal[1]);
  CHECK(rows.T_journal[2 * per_cycle] == rows.T_journal[per_cycle + 1]);
  CHECK(rows.T_journal[per_cycle + 1] != rows.T_journal[per_cycle]);
  const auto mean_heat = [&](std::size_t cycle) {
    const auto first = rows.heat_to_journal.begin() + static_cast<std::ptrdiff_t>(cycle * per_cycle) + 1;
    return std::accumulate(first, first + per_cycle, 0.0) / per_cycle;
  };
  CHECK(std::abs(mean_heat(8)) < 0.02 * std::abs(mean_heat(0)));   // residual of the film's own settling
  CHECK(rows.correction.back() < 0.05 * rows.correction.front());  // halved by each cycle, as bush and film settle
}

TEST_CASE("FrozenWalls_KeepTheirTemperatures") {
  const Rows rows = warm_rows("thermal: {walls: frozen}\n");
  for (const double T : rows.T_journal) CHECK(T == doctest::Approx(55).epsilon(1e-12));  // round-off of kelvins
}

TEST_CASE("WallsWithoutCycles_CannotHaveTheirMean") {
  CHECK_THROWS_WITH_AS((void)rig(kSmallRig + "thermal: {walls: cycle_mean}\n"), doctest::Contains("without cycles"),
                       InputError);
}

}  // namespace cycles_test
}  // namespace hersey::run
