#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hersey/bearing/steady_bearing.h"
#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// Machines on thrust bearings and sliders whose films have temperatures.
namespace hersey::run {
namespace warm_thrust_run_test {

const std::string collar = R"(hersey: 1
lubricants:
  oil: {viscosity: {law: exponential, viscosity: 28 mPa.s, reference: 40 degC, coefficient: 0.034 1/K}, density: 860 kg/m^3,
        specific_heat: 2000 J/kg/K, conductivity: 0.13 W/m/K}
bodies: {shaft: {mass: 20 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}}
joints: {turning: {type: cylindrical, between: [ground, shaft], axis: z, initial: {translation: 50 um}}}
drives: {motor: {joint: turning, coordinate: rotation, speed: 3000 rpm}}
forces: {load: {type: force, body: shaft, axes: ground, components: [0 N, 0 N, -30 kN]}}
parameters: {carry: 0.8}
)";

const std::string fixed = collar + R"(bearings:
  main:
    kind: thrust
    stator: ground
    runner: shaft
    inner_diameter: 100 mm
    outer_diameter: 200 mm
    pads: {count: 6, arc: 50 deg}
    shape: [{profile: ramp, rise: 30 um}]
    lubricant: oil
    grid: {along: 13, radial: 7}
    thermal:
      model: film
      supply_temperature: 40 degC
      carry_over: "${carry}"
      stator: {wall: pad, thickness: 20 mm, ambient: 40 degC}
      runner: {wall: free, heat_capacity: 0.5 J/K}
simulation: {analysis: steady}
)";

const std::string tilting = collar + R"(bearings:
  pads:
    kind: tilting_pad_thrust
    stator: ground
    runner: shaft
    inner_diameter: 100 mm
    outer_diameter: 200 mm
    pads: {count: 6, arc: 50 deg, offset: 0.6, pivot_radius: 77 mm, mass: 0.05 kg}
    lubricant: oil
    grid: {along: 13, radial: 7}
    thermal: {model: film, supply_temperature: 40 degC, carry_over: "${carry}", runner: {wall: free, heat_capacity: 0.5 J/K}}
simulation: {analysis: steady}
)";

class Solved {
 public:
  explicit Solved(const std::string& text, const std::vector<std::string>& overrides = {})
      : summary_(simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch_ / "run.h5"})) {
    INFO(summary_.message);
    REQUIRE(summary_.status == Status::completed);
  }

  /// Last value of a series.
  [[nodiscard]] double number(const std::string& path) const {
    const results::Array array = results::Reader(summary_.results).read(path);
    return array.values.at(array.values.size() - array.width());
  }

 private:
  TemporaryDirectory scratch_;
  Summary summary_;
};

TEST_CASE("MachineOnWarmSectors_IsWhereTheBearingIsByItself") {
  const Solved steady(fixed);
  const model::Model model = model::read_text(fixed, "m.yaml");
  const model::Bearing& bearing = model.bearings.front();
  bearing::OperatingPoint point{.journal_speed = 314.15926535897931};
  point.e = point.e_rate = bearing::Coordinates::Zero(1);
  point.load = bearing::Coordinates::Constant(1, -30e3);
  bearing::SteadyState state;
  const auto& thermal = std::get<film::ThermalModel>(bearing.heat);
  REQUIRE(bearing::solve_steady(bearing.film, point, {.kind = bearing.kind, .thermal = thermal}, state).solved());
  constexpr double same = 1e-6;  // both alternate until temperatures change by 1e-8 of their rise
  const std::string path = "/bearings/main/";
  CHECK(steady.number(path + "h_min") == relative(state.film.h_min).epsilon(same));
  CHECK(steady.number(path + "power_film") == relative(state.film.power_film).epsilon(same));
  CHECK(steady.number(path + "T_max") + film::zero_celsius == relative(state.heat->observed.T_max).epsilon(same));
  CHECK(steady.number(path + "T_runner") + film::zero_celsius ==
        relative(state.heat->observed.T_journal).epsilon(same));
}

TEST_CASE("WarmThrustBearings_SettleInTimeWhereTheirSteadyMotionIs") {
  constexpr double settled = 1e-6;  // what is left of the runner's warming after 250 ms: 1e-8
  for (const auto& [text, film] : {std::pair{fixed, "main"}, std::pair{tilting, "pads_pad_2"}}) {
    // Pads of steel take minutes to warm: they are left out of the run.
    const std::vector<std::string> insulated =
        text == fixed ? std::vector<std::string>{"bearings.main.thermal.stator={wall: insulated}"}
                      : std::vector<std::string>{};
    std::vector<std::string> in_time = insulated;
    in_time.emplace_back("simulation={duration: 250 ms, step: 1 ms}");
    const Solved steady(text, insulated), run(text, in_time);
    for (const char* figure : {"h_min", "p_max", "power_film", "T_max", "T_face_max", "T_runner"}) {
      const std::string path = fmt::format("/bearings/{}/{}", film, figure);
      CAPTURE(path);
      CHECK(run.number(path) == relative(steady.number(path)).epsilon(settled));
    }
  }
}

std::vector<Fault> faults_of(const std::string& text, const std::vector<std::string>& overrides) {
  try {
    (void)model::read_text(text, "m.yaml", overrides);
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

TEST_CASE("HeatThatAFlatFilmCannotHave_IsNamed") {
  CHECK(faults_of(fixed, {}).empty());
  const std::vector<Fault> two = faults_of(fixed, {"bearings.main.temperature=60 degC"});
  REQUIRE(two.size() == 1);
  CHECK(two.front().path == "bearings.main.temperature");
  CHECK(!faults_of(fixed, {"bearings.main.thermal.stator={wall: body}"}).empty());
  CHECK(!faults_of(fixed, {"bearings.main.thermal={model: global, supply_temperature: 40 degC}"}).empty());
  // No oil is renewed, and none leaves.
  const std::vector<std::string> closed{"bearings.main.edge_pressure={inner: closed, outer: closed}",
                                        "bearings.main.thermal.stator={wall: insulated}"};
  std::vector<std::string> circling = closed;
  circling.emplace_back("carry=1");
  CHECK(faults_of(fixed, closed).empty());
  REQUIRE(faults_of(fixed, circling).size() == 1);
  CHECK(faults_of(fixed, circling).front().path == "bearings.main.thermal");
}

}  // namespace warm_thrust_run_test
}  // namespace hersey::run
