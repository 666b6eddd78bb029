#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "hersey/bearing/steady_bearing.h"
#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// Steady motion of machines whose films have temperatures, and grooves between films that mix their oil.
namespace hersey::run {
namespace warm_steady_test {

const std::string oil_and_shaft = R"(hersey: 1
lubricants:
  oil: {viscosity: {law: exponential, viscosity: 28 mPa.s, reference: 40 degC, coefficient: 0.034 1/K}, density: 860 kg/m^3,
        specific_heat: 2000 J/kg/K, conductivity: 0.13 W/m/K}
bodies: {shaft: {mass: 20 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}}
joints: {turning: {type: planar, between: [ground, shaft], axis: z}}
drives: {motor: {joint: turning, coordinate: rotation, speed: "${speed}"}}
forces: {load: {type: force, body: shaft, components: [0 N, -4 kN, 0 N]}}
)";

const std::string plain = oil_and_shaft + R"(parameters: {speed: 3000 rpm}
bearings:
  main: {shell: ground, journal: shaft, diameter: 100 mm, width: 60 mm, radial_clearance: 80 um, lubricant: oil,
         grid: {circumferential: 40, axial: 7}, supply: {line: 90 deg, pressure: 0.7 bar},
         thermal: {model: film, supply_temperature: 40 degC, shell: {wall: ring, outer_diameter: 160 mm, ambient: 30 degC},
                   expansion: {shell: 1.2e-5 1/K, journal: 1.5e-5 1/K}}}
simulation: {analysis: steady}
)";

const std::string pads = oil_and_shaft + R"(parameters: {speed: 3000 rpm, carry: 1}
bearings:
  pads:
    kind: tilting_pad
    shell: ground
    journal: shaft
    diameter: 100 mm
    width: 60 mm
    radial_clearance: 80 um
    lubricant: oil
    grid: {circumferential: 56, axial: 5}
    pads: {count: 4, arc: 75 deg, preload: 0.47, mass: 0.05 kg}
    thermal: {model: film, supply_temperature: 40 degC, carry_over: "${carry}",
              journal: {wall: free, heat_capacity: 0.05 J/K}}
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

const std::vector<std::string> figures{"h_min", "p_max", "power_film", "T_max", "T_shell_max", "T_journal"};

TEST_CASE("MachineOnAWarmFilm_IsWhereTheBearingIsByItself") {
  const Solved steady(plain);
  const model::Model model = model::read_text(plain, "m.yaml");
  const model::Bearing& bearing = model.bearings.front();
  bearing::OperatingPoint point{.journal_speed = 314.15926535897931};
  point.load = bearing::Coordinates(Eigen::Vector2d(0, -4000));
  bearing::SteadyState state;
  const auto& thermal = std::get<film::ThermalModel>(bearing.heat);
  REQUIRE(bearing::solve_steady(bearing.film, point, {.kind = bearing.kind, .thermal = thermal}, state).solved());
  constexpr double same = 1e-6;  // both alternate until temperatures change by 1e-8 of their rise
  const std::string path = "/bearings/main/";
  CHECK(steady.number(path + "h_min") == relative(state.film.h_min).epsilon(same));
  CHECK(steady.number(path + "power_film") == relative(state.film.power_film).epsilon(same));
  CHECK(steady.number(path + "T_max") + film::zero_celsius == relative(state.heat->observed.T_max).epsilon(same));
  CHECK(steady.number(path + "T_journal") + film::zero_celsius ==
        relative(state.heat->observed.T_journal).epsilon(same));
}

TEST_CASE("WarmPads_SettleInTimeWhereTheirSteadyMotionIs") {
  const Solved steady(pads), run(pads, {"simulation={duration: 250 ms, step: 0.5 ms}"});
  constexpr double settled = 1e-5;  // what is left of the journal's warming after 250 ms
  for (const char* pad : {"pads_pad_1", "pads_pad_2", "pads_pad_3", "pads_pad_4"}) {
    for (const std::string& figure : figures) {
      const std::string path = fmt::format("/bearings/{}/{}", pad, figure);
      CAPTURE(path);
      CHECK(run.number(path) == relative(steady.number(path)).epsilon(settled));
    }
  }
}

TEST_CASE("WarmPads_DoNotDependOnTheSenseOfRotation") {
  const Solved one(pads), other(pads, {"speed=-3000 rpm"});
  constexpr double same = 1e-6;  // both searches end with temperatures to 1e-8 of their rise
  // Pads 1 and 2 stand on either side of the load.
  for (const std::string& figure : figures) {
    CAPTURE(figure);
    CHECK(other.number("/bearings/pads_pad_1/" + figure) ==
          relative(one.number("/bearings/pads_pad_2/" + figure)).epsilon(same));
    CHECK(other.number("/bearings/pads_pad_3/" + figure) ==
          relative(one.number("/bearings/pads_pad_4/" + figure)).epsilon(same));
  }
}

TEST_CASE("OilThatIsCarriedOver_WarmsTheNextPad") {
  double last = 0;
  for (const char* carry_over : {"0", "0.5", "1"}) {
    const Solved steady(pads, {fmt::format("carry={}", carry_over)});
    CHECK(steady.number("/bearings/pads_pad_2/T_max") > last + 0.5);
    last = steady.number("/bearings/pads_pad_2/T_max");
  }
}

// What enters the pads leaves them; pads that give off no heat are of one mean temperature with their faces.
TEST_CASE("PadsThatConduct_AreInBalance") {
  const Solved cooled(
      pads,
      {"bearings.pads.thermal.shell={wall: pad, thickness: 20 mm, heat_transfer: 500 W/m^2/K, ambient: 40 degC}"});
  const Solved closed(
      pads, {"bearings.pads.thermal.shell={wall: pad, thickness: 20 mm, heat_transfer: 0 W/m^2/K, ambient: 40 degC}"});
  for (const char* pad : {"pads_pad_1", "pads_pad_2", "pads_pad_3", "pads_pad_4"}) {
    const std::string path = fmt::format("/bearings/{}/", pad);
    const double power = closed.number(path + "power_film");
    CHECK(std::abs(closed.number(path + "heat_to_shell")) < 1e-4 * power);  // of the linear solver of steady heat
    CHECK(cooled.number(path + "heat_to_shell") > 0.01 * power);
    CHECK(std::abs(cooled.number(path + "heat_balance_error")) < 1e-6);  // of alternations that have converged
    CHECK(cooled.number(path + "T_shell_max") < closed.number(path + "T_shell_max"));
  }
}

/// Three arcs of a bore, as bodies of their own that are fixed or as one bearing.
std::string three_arcs(bool as_bodies) {
  std::string text = oil_and_shaft + "parameters: {speed: 3000 rpm}\n";
  const std::string film = "journal: shaft, diameter: 100 mm, width: 60 mm, radial_clearance: 80 um, lubricant: oil, ";
  const std::string heat = "thermal: {model: film, supply_temperature: 40 degC, journal: {wall: node, node: journal}}";
  std::string arcs;
  for (const int middle : {-90, 30, 150})
    arcs += fmt::format("a{}: {{middle: {} deg, arc: 100 deg, preload: 0.3}}, ", middle + 90, middle);
  text += "thermal: {nodes: {journal: {heat_capacity: 500 J/K}}";
  if (!as_bodies)
    return text + "}\nbearings:\n  main: {shell: ground, " + film + "grid: {circumferential: 54, axial: 5}, arcs: {" +
           arcs + "}, " + heat + "}\nsimulation: {analysis: steady}\n";
  text += ", grooves: {a: {between: [p0, p120]}, b: {between: [p120, p240]}, c: {between: [p240, p0]}}}\nbearings:\n";
  for (const int middle : {-90, 30, 150})
    text += fmt::format(
        "  p{}: {{shell: ground, {}grid: {{circumferential: 54, axial: 5}}, arcs: {{a: {{middle: {} deg, arc: 100 deg, "
        "preload: 0.3}}}}, {}}}\n",
        middle + 90, film, middle, heat);
  return text + "simulation: {analysis: steady}\n";
}

TEST_CASE("FilmsWithGroovesBetween_AreABoreOfArcs") {
  const Solved bore(three_arcs(false)), films(three_arcs(true));
  constexpr double same = 5e-4;  // the heat that sums over volumes miss is spread over all arcs of a film (thermal.9)
  double power = 0, T_max = 0, h_min = 1;
  for (const char* film : {"p0", "p120", "p240"}) {
    const std::string path = fmt::format("/bearings/{}/", film);
    power += films.number(path + "power_film");
    T_max = std::max(T_max, films.number(path + "T_max"));
    h_min = std::min(h_min, films.number(path + "h_min"));
  }
  CHECK(power == relative(bore.number("/bearings/main/power_film")).epsilon(same));
  CHECK(T_max == relative(bore.number("/bearings/main/T_max")).epsilon(same));
  CHECK(h_min == relative(bore.number("/bearings/main/h_min")).epsilon(same));
}

std::vector<Fault> faults_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)model::read_text(text, "m.yaml", overrides);
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

TEST_CASE("GroovesThatCannotBe_AreNamed") {
  std::string text = three_arcs(true);
  const auto with = [&text](const std::string& old, const std::string& other) {
    std::string changed = text;
    changed.replace(changed.find(old), old.size(), other);
    return changed;
  };
  CHECK(faults_of(text).empty());
  const std::vector<Fault> unknown = faults_of(with("between: [p0, p120]", "between: [p0, p121]"));
  REQUIRE(unknown.size() == 1);
  CHECK(unknown.front().path == "thermal.grooves.a.between.1");
  const std::vector<Fault> twice = faults_of(with("between: [p120, p240]", "between: [p0, p240]"));
  REQUIRE(twice.size() == 1);
  CHECK(twice.front().found == "an end of a film that lies on groove 'a' already");
  CHECK(!faults_of(plain, {"simulation.analysis=equilibrium"}).empty());
  CHECK(faults_of(plain, {"bearings.main.thermal.shell={wall: pad, thickness: 5 mm, ambient: 40 degC}"}).size() == 1);
}

}  // namespace warm_steady_test
}  // namespace hersey::run
