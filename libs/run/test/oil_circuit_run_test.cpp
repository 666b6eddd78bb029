#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// A rotor in two bearings that a pump on its shaft feeds through one circuit.
namespace hersey::run {
namespace oil_circuit_run_test {

constexpr double kEps = std::numeric_limits<double>::epsilon();

std::string bearing(const std::string& name, const std::string& clearance, const std::string& feed) {
  return "  " + name + R"(:
    shell: ground
    journal: rotor
    diameter: 60 mm
    width: 30 mm
    radial_clearance: )" +
         clearance + R"(
    lubricant: oil
    grid: {circumferential: 24, axial: 9}
    features:
      groove: {shape: circumferential_groove, angle: 90 deg, arc: 180 deg, length: 8 mm, )" +
         feed + "}\n";
}

std::string machine(const std::string& circuit, const std::string& bearings) {
  return R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
lubricants:
  oil: {viscosity: 12 mPa.s, density: 850 kg/m^3}
bodies:
  rotor: {mass: 120 kg, inertia: {xx: 4 kg.m^2, yy: 4 kg.m^2, zz: 0.6 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, rotor], axis: z}
drives:
  motor: {joint: turning, coordinate: rotation, speed: 3000 rpm}
)" + circuit +
         "bearings:\n" + bearings + "simulation: {duration: 4 ms, step: 0.2 ms}\n";
}

const std::string kPumped = R"(circuit:
  lubricant: oil
  nodes:
    sump: {pressure: 0 bar}
    gallery: {volume: 20 cm^3, compliance: 1 mm^3/bar, free_air: 0.02}
    main_1: {}
    main_2: {}
  elements:
    pump: {type: pump, from: sump, to: gallery, displacement: 6 cm^3, leakage: 0.2 l/min/bar, joint: turning}
    relief: {type: relief_valve, from: gallery, to: sump, opening_pressure: 3 bar, conductance: 10 l/min/bar}
    drilling: {type: drilling, from: gallery, to: main_1, length: 80 mm, diameter: 4 mm, loss_coefficient: 1.5}
    jet: {type: orifice, from: gallery, to: main_2, diameter: 1.5 mm}
)";

std::string pumped() {
  return machine(kPumped,
                 bearing("main_1", "40 um", "circuit: main_1") + bearing("main_2", "50 um", "circuit: main_2"));
}

struct Ran {
  TemporaryDirectory scratch;
  Summary summary;
  results::Reader reader;
  explicit Ran(const std::string& text, const std::vector<std::string>& overrides = {})
      : summary(simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch / "run.h5"})),
        reader(summary.results) {
    REQUIRE(summary.status == Status::completed);
  }
  [[nodiscard]] std::vector<double> all(const std::string& series) const { return reader.read("/" + series).values; }
  [[nodiscard]] double last(const std::string& series) const { return all(series).back(); }
};

TEST_CASE("BearingOnAStiffSource_IsThatOfAGivenPressure") {
  const Ran given(machine("", bearing("main", "45 um", "pressure: 2 bar")));
  const std::string behind = R"(circuit:
  lubricant: oil
  nodes: {supply: {pressure: 2 bar}, hole: {}}
  elements: {pipe: {type: resistance, from: supply, to: hole, resistance: 1 Pa.s/m^3}}
)";
  const Ran stiff(machine(behind, bearing("main", "45 um", "circuit: hole")));
  for (const char* series : {"bearings/main/h_min", "bearings/main/p_max", "bearings/main/power_film",
                             "bearings/main/flow_feature_groove"}) {
    CAPTURE(series);
    const std::vector<double> a = given.all(series), b = stiff.all(series);
    REQUIRE(a.size() == b.size());
    // 1e-5 m^3/s through 1 Pa s/m^3 leave 1e-5 Pa of 2e5, and steps end at residuals of 1e-8
    for (std::size_t k = 0; k < a.size(); ++k) CHECK(b[k] == doctest::Approx(a[k]).epsilon(1e-7));
  }
}

TEST_CASE("CircuitOfTwoBearings_SettlesInItsSteadyMotion") {
  const Ran steady(pumped(), {"simulation={analysis: steady}"}), settled(pumped(), {"simulation.duration=400 ms"});
  for (const char* series :
       {"circuit/pressure_gallery", "circuit/pressure_main_1", "circuit/pressure_main_2", "circuit/flow_relief",
        "circuit/drawn_main_1", "circuit/drawn_main_2", "bearings/main_1/h_min", "bearings/main_2/p_max"}) {
    CAPTURE(series);
    CHECK(settled.last(series) == doctest::Approx(steady.last(series)).epsilon(2e-4));  // what is left of the transient
  }
  CHECK(steady.last("circuit/pressure_gallery") > 3e5);  // the valve is open
  CHECK(steady.last("circuit/pressure_main_2") < steady.last("circuit/pressure_gallery"));
}

TEST_CASE("OilOfACircuit_IsConservedOverTheRun") {
  const Ran run(pumped(), {"simulation.duration=10 ms"});
  double worst = 0;
  for (const double error : run.all("circuit/balance_error")) worst = std::max(worst, error);
  CHECK(worst < 1e-9);  // of the largest flow
  const std::vector<double> t = run.all("time"), stored = run.all("circuit/stored");
  const std::vector<double> pump = run.all("circuit/flow_pump"), relief = run.all("circuit/flow_relief"),
                            drawn_1 = run.all("circuit/drawn_main_1"), drawn_2 = run.all("circuit/drawn_main_2");
  double came_in = 0, largest = 0;
  for (std::size_t k = 1; k < t.size(); ++k) {
    came_in += (t[k] - t[k - 1]) * (pump[k] - relief[k] - drawn_1[k] - drawn_2[k]);
    largest = std::max(largest, pump[k]);
  }
  // 1e-9 of what the pump gives
  CHECK(std::abs(stored.back() - stored.front() - came_in) < 1e-9 * largest * (t.back() - t.front()));
  CHECK(stored.back() != stored.front());
}

// A supply that sucks half of the time empties the bearing's groove, and the summary says so.
TEST_CASE("FeedFromAStarvedNode_IsReportedWithItsTime") {
  const std::string suction = R"~(circuit:
  lubricant: oil
  nodes: {supply: {pressure: {expression: "1e5*cos(2*pi*500*t)", unit: Pa}}, hole: {}}
  elements: {pipe: {type: resistance, from: supply, to: hole, resistance: 1e6 Pa.s/m^3}}
)~";
  const Ran run(machine(suction, bearing("main", "45 um", "circuit: hole")), {"simulation.step=0.05 ms"});
  const std::vector<double> starved = run.all("circuit/starved_hole"), p = run.all("circuit/pressure_hole"),
                            fill = run.all("circuit/fill_hole");
  for (std::size_t k = 0; k < p.size(); ++k) {
    CHECK(starved[k] == (fill[k] < 1 ? 1 : 0));
    CHECK(fill[k] >= 0);
    CHECK(p[k] >= 0);
    CHECK((fill[k] == 1 || p[k] == 0));
  }
  double time = 0;
  for (std::size_t k = 1; k < starved.size(); ++k) time += starved[k] / static_cast<double>(starved.size() - 1);
  CHECK(std::abs(time - 0.5) < 0.05);  // half of two whole periods of 40 steps
  const auto is_of_feed = [](const std::string& warning) { return warning.find("node 'hole'") != std::string::npos; };
  const std::vector<std::string>& warnings = run.summary.bearings.front().warnings;
  CHECK(std::count_if(warnings.begin(), warnings.end(), is_of_feed) == 1);
  const Ran fed(pumped());
  for (const BearingSummary& summary : fed.summary.bearings)
    for (const std::string& warning : summary.warnings) CHECK(warning.find("cavitation pressure") == std::string::npos);
}

// What a film takes over a step, as a mean, and what the circuit gives at the step's end differ by the film's
// storage over the step.
TEST_CASE("FlowsOfFilmsAndCircuit_AreTheSame_ToFirstOrderInTheStep") {
  const auto difference = [](const char* step) {
    const Ran run(pumped(), {"simulation.duration=8 ms", std::string("simulation.step=") + step});
    return std::abs(run.last("circuit/drawn_main_1") - run.last("bearings/main_1/flow_feature_groove")) /
           run.last("circuit/drawn_main_1");
  };
  const double coarse = difference("0.2 ms"), fine = difference("0.05 ms");
  CHECK(coarse < 0.02);               // of the flow, at 0.2 ms
  CHECK(fine < 0.5 * coarse + 1e-6);  // what settled films still differ by
}

TEST_CASE("CircuitTakesHardlyMoreIterations") {
  const auto iterations = [](const std::string& text) {
    const Ran run(text, {"simulation.duration=10 ms"});
    double sum = 0;
    for (const double n : run.all("solver/newton_iterations")) sum += n;
    return sum / static_cast<double>(run.all("time").size());
  };
  const double with = iterations(pumped()),
               without = iterations(machine("", bearing("main_1", "40 um", "pressure: 3 bar") +
                                                    bearing("main_2", "50 um", "pressure: 2.5 bar")));
  CHECK(with < without + 1.5);
}

// The shaft turns the pump: at twice the speed it gives twice the flow, less the same leak.
TEST_CASE("PumpOnAShaft_DeliversWithItsSpeed") {
  const auto delivered = [](const char* speed) {
    const Ran run(pumped(), {"simulation={analysis: steady}", std::string("drives.motor.speed=") + speed});
    const double leak = 0.2e-3 / 60 / 1e5 * run.last("circuit/pressure_gallery");  // 0.2 l/min/bar
    return run.last("circuit/flow_pump") + leak;
  };
  CHECK(delivered("6000 rpm") == doctest::Approx(2 * delivered("3000 rpm")).epsilon(1e3 * kEps));  // sums of both
  CHECK(delivered("3000 rpm") == doctest::Approx(6e-6 * 50).epsilon(1e3 * kEps));
}

TEST_CASE("PumpThatTurnsBackwards_EndsTheRunWithItsName") {
  try {
    const Ran run(pumped(), {"drives.motor.speed={expression: \"-314*(1 + 0*t)\", unit: rad/s}"});
    CHECK(false);
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).find("pump pump turns backwards") != std::string::npos);
    CHECK(std::string(error.what()).find("m.yaml:") != std::string::npos);
  }
}

// A hole of the journal that is over the groove for half of a turn feeds a bore that leads out of the journal.
std::string passing(const std::string& more = "") {
  const std::string circuit = R"(circuit:
  lubricant: oil
  nodes: {supply: {pressure: 3 bar}, groove: {}, mouth: {}, pin: {pressure: 0 bar}}
  elements:
    branch: {type: drilling, from: supply, to: groove, length: 60 mm, diameter: 4 mm, loss_coefficient: 1.5}
    passing: {type: hole_over_groove, from: groove, to: mouth, bearing: main, hole: mouth, groove: groove}
    crank: {type: drilling, from: mouth, to: pin, length: 70 mm, diameter: 2.5 mm, loss_coefficient: 2.5, radii: [30 mm, 55 mm], joint: turning}
)";
  std::string main = bearing("main", "40 um", "circuit: groove");
  const std::string grid = "circumferential: 24, axial: 9";
  main.replace(main.find(grid), grid.size(), "circumferential: 60, axial: 13");
  return machine(circuit, main + "      mouth: {shape: hole, on: journal, diameter: 7 mm, circuit: mouth}\n" + more);
}

TEST_CASE("HoleThatPassesAGroove_IsFedContinuously_AndConservesOil") {
  const auto largest_change = [](const char* step) {
    const Ran run(passing(), {"simulation.duration=20 ms", std::string("simulation.step=") + step});
    const std::vector<double> through = run.all("circuit/flow_passing"), open = run.all("circuit/open_area_passing");
    double most = 0, change = 0, error = 0;
    for (std::size_t k = 1; k < through.size(); ++k) {
      most = std::max(most, through[k]);
      change = std::max(change, std::abs(through[k] - through[k - 1]));
      if (open[k] == 0) CHECK(through[k] == 0);
    }
    for (const double of_step : run.all("circuit/balance_error")) error = std::max(error, of_step);
    CHECK(error < 1e-9);  // of the largest flow
    CHECK(*std::min_element(open.begin(), open.end()) == 0);
    CHECK(*std::max_element(open.begin(), open.end()) ==
          doctest::Approx(std::numbers::pi / 4 * 49e-6).epsilon(1e3 * kEps));  // 7 mm, whole
    return change / most;
  };
  const double coarse = largest_change("0.1 ms"), fine = largest_change("0.02 ms");
  CHECK(fine < 0.5 * coarse);  // a jump would stay as large
  CHECK(fine < 0.2);           // the hole passes the groove's end within 0.75 ms
}

}  // namespace oil_circuit_run_test
}  // namespace hersey::run
