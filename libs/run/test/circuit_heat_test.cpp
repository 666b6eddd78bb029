#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// Oil of a circuit that carries its heat along: sump, pump, cooler, gallery and two warm films.
namespace hersey::run {
namespace circuit_heat_test {

constexpr double kEps = std::numeric_limits<double>::epsilon();

const std::string kOil = R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
lubricants:
  oil: {viscosity: {law: exponential, viscosity: 28 mPa.s, reference: 40 degC, coefficient: 0.034 1/K}, density: 860 kg/m^3,
        specific_heat: 2000 J/kg/K, conductivity: 0.13 W/m/K}
)";

const std::string kRotor = R"(bodies:
  rotor: {mass: 120 kg, inertia: {xx: 4 kg.m^2, yy: 4 kg.m^2, zz: 0.6 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, rotor], axis: z}
drives:
  motor: {joint: turning, coordinate: rotation, speed: 3000 rpm}
)";

const std::string kThermal = R"(thermal:
  nodes:
    pan: {heat_capacity: 8 J/K, temperature: 60 degC}
    air: {fixed: 20 degC}
  paths: {to_air: {between: [pan, air], conductance: 6 W/K}}
)";

const std::string kNodes = R"(    sump: {pressure: 0 bar, temperature: {node: pan}}
    behind_pump: {}
    gallery: {volume: 4 cm^3, compliance: 1 mm^3/bar}
    main_1: {}
    main_2: {}
)";
const std::string kNodesReversed = R"(    main_2: {}
    main_1: {}
    gallery: {volume: 4 cm^3, compliance: 1 mm^3/bar}
    behind_pump: {}
    sump: {pressure: 0 bar, temperature: {node: pan}}
)";

std::string circuit(const std::string& nodes) {
  return "circuit:\n  lubricant: oil\n  temperature: 50 degC\n  nodes:\n" + nodes + R"(  elements:
    pump: {type: pump, from: sump, to: behind_pump, displacement: 6 cm^3, leakage: 0.2 l/min/bar, joint: turning}
    relief: {type: relief_valve, from: gallery, to: sump, opening_pressure: 3 bar, conductance: 10 l/min/bar}
    cooler: {type: cooler, from: behind_pump, to: gallery, resistance: 1e8 Pa.s/m^3, conductance: 20 W/K, coolant: 35 degC}
    drilling: {type: drilling, from: gallery, to: main_1, length: 80 mm, diameter: 4 mm, loss_coefficient: 1.5}
    jet: {type: orifice, from: gallery, to: main_2, diameter: 1.5 mm}
)";
}

std::string bearing(const std::string& name, const std::string& clearance) {
  return "  " + name + R"(:
    shell: ground
    journal: rotor
    diameter: 60 mm
    width: 30 mm
    radial_clearance: )" +
         clearance + R"(
    lubricant: oil
    grid: {circumferential: 24, axial: 9}
    thermal: {model: film, layers: 3, supply_temperature: {node: pan}, drains_to: pan, shell: {wall: insulated},
              journal: {wall: free, heat_capacity: 0.2 J/K}}
    features:
      groove: {shape: circumferential_groove, angle: 90 deg, arc: 180 deg, length: 8 mm, circuit: )" +
         name + "}\n";
}

std::string machine(const std::string& nodes = kNodes) {
  return kOil + kRotor + kThermal + circuit(nodes) + "bearings:\n" + bearing("main_1", "40 um") +
         bearing("main_2", "50 um") + "simulation: {duration: 4 ms, step: 0.2 ms}\n";
}

struct WarmRun {
  TemporaryDirectory scratch;
  Summary summary;
  results::Reader reader;
  explicit WarmRun(const std::string& text, const std::vector<std::string>& overrides = {})
      : summary(simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch / "run.h5"})),
        reader(summary.results) {
    INFO(summary.message);
    REQUIRE(summary.status == Status::completed);
  }
  [[nodiscard]] std::vector<double> all(const std::string& series) const { return reader.read("/" + series).values; }
  [[nodiscard]] double last(const std::string& series) const { return all(series).back(); }
};

const std::vector<std::string> kFigures{
    "circuit/temperature_sump",   "circuit/temperature_behind_pump", "circuit/temperature_gallery",
    "circuit/temperature_main_1", "circuit/pressure_gallery",        "circuit/flow_drilling",
    "circuit/heat_cooler",        "bearings/main_1/T_max",           "bearings/main_2/h_min"};

TEST_CASE("HeatOfASettledMachine_GoesIntoCoolantAndSurroundings") {
  const WarmRun steady(machine(), {"simulation={analysis: steady}"});
  const double made = steady.last("bearings/main_1/heat_dissipated") + steady.last("bearings/main_2/heat_dissipated") +
                      steady.last("circuit/dissipated");
  CHECK(steady.last("circuit/heat_cooler") > 0.2 * made);
  // Temperatures are found to 1e-8 of their rise, the films' heat to 1e-5 of its equations.
  CHECK(steady.last("thermal/heat_to_surroundings") == relative(made).epsilon(1e-4));
  CHECK(steady.last("circuit/temperature_gallery") < steady.last("circuit/temperature_sump"));
  CHECK(steady.last("circuit/temperature_behind_pump") > steady.last("circuit/temperature_sump"));
  CHECK(steady.last("circuit/temperature_sump") == steady.last("thermal/T_pan"));
}

TEST_CASE("WarmCircuit_SettlesInItsSteadyMotion") {
  const WarmRun steady(machine(), {"simulation={analysis: steady}"}),
      settled(machine(), {"simulation.duration=4 s", "simulation.step=4 ms"});
  for (const std::string& series : kFigures) {
    CAPTURE(series);
    CHECK(settled.last(series) == relative(steady.last(series)).epsilon(1e-3));  // what is left of the transient
  }
}

TEST_CASE("NodesOverCycles_SettleWhereTheSteadyMotionIs") {
  const WarmRun steady(machine(), {"simulation={analysis: steady}"}),
      settled(machine(), {"simulation={step: 1 ms, cycle: {period: 10 ms, until_converged: 0, most: 30}}"});
  for (const std::string& series : kFigures) {
    CAPTURE(series);
    CHECK(settled.last(series) == relative(steady.last(series)).epsilon(1e-8));  // what is left after 30 cycles
  }
}

// What warms a gallery is what flows into it: by the rows of the results alone.
TEST_CASE("HeatOfTheNodes_IsConservedInEachStep") {
  const WarmRun run(machine(), {"simulation.duration=10 ms"});
  double worst = 0;
  for (const double error : run.all("thermal/heat_balance_error")) worst = std::max(worst, std::abs(error));
  CHECK(worst < 1e-10);  // round-off of sums of some hundred watts at 300 K
  const double rho_c = 860 * 2000.0, capacity = rho_c * 4e-6;
  const std::vector<double> t = run.all("time"), T = run.all("circuit/temperature_gallery"),
                            before = run.all("circuit/temperature_behind_pump"),
                            cooled = run.all("circuit/heat_cooler"), Q = run.all("circuit/flow_cooler");
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double gained = capacity * (T[k] - T[k - 1]) / (t[k] - t[k - 1]);
    const double dissipated = 1e8 * Q[k] * Q[k];  // in the cooler, whose drop is 1e8 Q
    const double came = rho_c * Q[k] * (before[k] - T[k]) - cooled[k] + dissipated;
    // of heat flows of some ten thousand watts over 0 degC, whose temperatures have 14 digits
    CHECK(std::abs(gained - came) < 1e-9 * rho_c * Q[k] * 100);
  }
  CHECK(T.back() != T.front());
}

TEST_CASE("OrderOfNodes_IsOfNoConsequence") {
  const WarmRun one(machine(), {"simulation.duration=2 ms"}),
      other(machine(kNodesReversed), {"simulation.duration=2 ms"});
  for (const std::string& series : kFigures) {
    CAPTURE(series);
    CHECK(other.last(series) == relative(one.last(series)).epsilon(1e-9));  // steps end at residuals of 1e-8
  }
}

/// Two drillings from a warm and a cold supply to a drain, laminar and without films.
std::string two_pipes(const std::string& first, const std::string& second) {
  return kOil + kRotor + R"(forces: {lift: {type: force, body: rotor, components: [0 N, 1177.2 N, 0 N]}}
circuit:
  lubricant: oil
  nodes: {hot: {pressure: 2 bar, temperature: 90 degC}, cold: {pressure: 2 bar, temperature: 40 degC}, out: {pressure: 0 bar, temperature: 20 degC}}
  elements:
    first: {type: drilling, )" +
         first + R"(, length: 80 mm, diameter: 2 mm, friction: laminar}
    second: {type: drilling, )" +
         second + R"(, length: 80 mm, diameter: 2 mm, friction: laminar}
simulation: {duration: 1 ms, step: 0.5 ms}
)";
}

TEST_CASE("ViscosityOfAnElement_IsThatOfTheOilThatFlowsIn") {
  const WarmRun with(two_pipes("from: hot, to: out", "from: cold, to: out"));
  const double ratio = with.last("circuit/flow_first") / with.last("circuit/flow_second");
  CHECK(ratio == relative(std::exp(0.034 * 50)).epsilon(16 * kEps));  // round-off
  const WarmRun against(two_pipes("from: out, to: hot", "from: out, to: cold"));
  CHECK(against.last("circuit/flow_first") == -with.last("circuit/flow_first"));
  CHECK(against.last("circuit/flow_second") == -with.last("circuit/flow_second"));
}

// Oil whose heat nothing changes, in a circuit with temperatures and in one without.
TEST_CASE("CircuitAtOneTemperature_IsOneWithoutTemperatures") {
  const std::vector<std::string> large{"lubricants.oil.specific_heat=1e12 J/kg/K",
                                       "thermal.nodes.pan={fixed: 50 degC}"};
  std::string cold = machine();
  cold.replace(cold.find(", temperature: {node: pan}}\n    behind"), 27, "}");
  cold.replace(cold.find("type: cooler"), 12, "type: resistance");
  cold.erase(cold.find(", conductance: 20 W/K, coolant: 35 degC"), 39);
  const WarmRun with(machine(), large), without(cold, large);
  for (const char* series : {"circuit/pressure_gallery", "circuit/flow_drilling", "circuit/drawn_main_2",
                             "bearings/main_1/p_max", "bearings/main_2/h_min"}) {
    CAPTURE(series);
    CHECK(with.last(series) ==
          relative(without.last(series)).epsilon(1e-8));  // heat of friction and losses warms this oil by 1e-7 K
  }
}

}  // namespace circuit_heat_test
}  // namespace hersey::run
