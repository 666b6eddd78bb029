#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/bearing/steady_bearing.h"
#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// Machines at rest and in steady motion on their films, all found at once.
namespace hersey::run {
namespace steady_machine_test {

const std::string rotor = R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  ground: {frames: {left: {origin: 0 0 -300 mm}, right: {origin: 0 0 300 mm}}}
  rotor:
    mass: 40 kg
    inertia: {xx: 0.35 kg.m^2, yy: 0.35 kg.m^2, zz: 0.332 kg.m^2}
    frames: {left: {origin: 0 0 -300 mm}, right: {origin: 0 0 300 mm}}
joints: {turning: {type: planar, between: [ground, rotor], axis: z}}
lubricants: {oil: {viscosity: 10 mPa.s}}
bearings:
  left: {shell: ground.left, journal: rotor.left, diameter: 50 mm, width: 25 mm, radial_clearance: 60 um, lubricant: oil,
         grid: {circumferential: 36, axial: 7}, supply: {line: 90 deg, pressure: 0.5 bar},
         operating_point: {journal_speed: 9000 rpm, load: 196.2 N, load_angle: -90 deg}}
  right: {shell: ground.right, journal: rotor.right, diameter: 50 mm, width: 25 mm, radial_clearance: 60 um, lubricant: oil,
          grid: {circumferential: 36, axial: 7}, supply: {line: 90 deg, pressure: 0.5 bar}}
drives: {motor: {joint: turning, coordinate: rotation, speed: 9000 rpm}}
simulation: {analysis: steady}
)";

// Its axis may tilt; what turns is carried by one that does not, so that the coordinates keep still.
const std::string overhung = R"(hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  ground: {frames: {a: {origin: 0 0 0 mm}, b: {origin: 0 0 400 mm}}}
  axis: {mass: 1 g, inertia: {xx: 1e-6 kg.m^2, yy: 1e-6 kg.m^2, zz: 1e-6 kg.m^2}}
  rotor:
    mass: 60 kg
    centre_of_mass: 0 0 450 mm
    inertia: {xx: 2 kg.m^2, yy: 2 kg.m^2, zz: 1.5 kg.m^2}
    frames: {a: {origin: 0 0 0 mm}, b: {origin: 0 0 400 mm}}
joints:
  floats: {type: free, between: [ground, axis]}
  spin: {type: revolute, between: [axis, rotor], axis: z}
forces:
  torque_arm: {type: bushing, between: [ground, axis], stiffness: 0 0 1e6 N/m, rotational_stiffness: 0 0 1e5 N.m/rad}
drives: {motor: {joint: spin, coordinate: rotation, speed: 6000 rpm}}
lubricants: {oil: {viscosity: 20 mPa.s}}
bearings:
  a: {shell: ground.a, journal: rotor.a, diameter: 50 mm, width: 25 mm, radial_clearance: 50 um, lubricant: oil,
      grid: {circumferential: 36, axial: 7}, supply: {line: -90 deg, pressure: 1 bar}}
  b: {shell: ground.b, journal: rotor.b, diameter: 50 mm, width: 25 mm, radial_clearance: 50 um, lubricant: oil,
      grid: {circumferential: 36, axial: 7}, supply: {line: 90 deg, pressure: 1 bar}}
simulation: {analysis: steady}
)";

class Solved {
 public:
  explicit Solved(const std::string& text, const std::vector<std::string>& overrides = {})
      : summary_(simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch_ / "run.h5"})) {}

  [[nodiscard]] const Summary& summary() const { return summary_; }
  /// Last row of a series.
  [[nodiscard]] std::vector<double> last(const std::string& path) const {
    REQUIRE(summary_.status == Status::completed);
    const results::Array array = results::Reader(summary_.results).read(path);
    return {array.values.end() - static_cast<std::ptrdiff_t>(array.width()), array.values.end()};
  }
  [[nodiscard]] double number(const std::string& path) const { return last(path).front(); }

 private:
  TemporaryDirectory scratch_;
  Summary summary_;
};

/// A bearing of the model by itself at its operating point, or under another load or speed.
bearing::SteadyState alone(const model::Bearing& bearing, double speed, double load) {
  bearing::OperatingPoint point{.journal_speed = speed};
  point.load = bearing::Coordinates(Eigen::Vector2d(0, -load));
  bearing::SteadyState state;
  REQUIRE(bearing::solve_steady(bearing.film, point, {.kind = bearing.kind}, state).solved());
  return state;
}

TEST_CASE("RotorInItsFilms_FloatsWhereEachBearingDoes") {
  for (const std::string condition : {"mass_conserving", "reynolds", "guembel"}) {
    CAPTURE(condition);
    const std::vector<std::string> overrides{"bearings.left.cavitation=" + condition,
                                             "bearings.right.cavitation=" + condition};
    const Solved steady(rotor, overrides);
    const model::Model model = model::read_text(rotor, "m.yaml", overrides);
    const bearing::SteadyState by_itself = alone(model.bearings.front(), 300 * std::numbers::pi, 196.2);
    constexpr double same = 1e-7;  // both solve the same equations, to 1e-8 of the load and better
    for (const std::string name : {"left", "right"}) {
      const std::string path = "/bearings/" + name + "/";
      CHECK(steady.number(path + "h_min") == relative(by_itself.film.h_min).epsilon(same));
      CHECK(steady.number(path + "p_max") == relative(by_itself.film.p_max).epsilon(same));
      CHECK(steady.number(path + "power_film") == relative(by_itself.film.power_film).epsilon(same));
      CHECK(steady.number(path + "flow_left") == relative(by_itself.film.flow_left).epsilon(same));
    }
  }
}

TEST_CASE("OverhungRotor_IsBalancedByItsFilms") {
  const Solved steady(overhung);
  const std::vector<double> a = steady.last("/bearings/a/force"), b = steady.last("/bearings/b/force"),
                            moment_a = steady.last("/bearings/a/moment"), moment_b = steady.last("/bearings/b/moment");
  const double weight = 60.001 * 9.81, round_off = 1e-7 * weight;  // of Newton's method
  CHECK(std::abs(a[1] + b[1] + weight) < round_off);
  CHECK(std::abs(a[0] + b[0]) < round_off);
  // About the middle of the shell a, in which x-moments are those of forces along y.
  CHECK(std::abs(moment_a[0] + moment_b[0] - 0.4 * b[1] - 0.45 * 60 * 9.81) < round_off);
  CHECK(std::abs(moment_a[1] + moment_b[1] + 0.4 * b[0]) < round_off);
  // One axis has one slope: round-off of 5e-5 rad.
  constexpr double rigid = 1e-9;  // what rounding leaves of the same slope
  CHECK(steady.last("/bearings/a/tilt")[0] == relative(steady.last("/bearings/b/tilt")[0]).epsilon(rigid));
  CHECK(steady.last("/bearings/a/tilt")[0] != 0);
}

TEST_CASE("SettledRun_EndsInTheSteadyMotion") {
  // Well damped: at 3000 rpm the vibration of the start has fallen below 1e-4 in 0.2 s.
  const Solved steady(rotor, {"drives.motor.speed=3000 rpm"});
  const Solved settled(rotor, {"drives.motor.speed=3000 rpm", "simulation={duration: 0.2 s, step: 0.4 ms}",
                               "joints.turning.initial={x: 25 um, y: -25 um}"});
  constexpr double left = 1e-4;  // of the vibration
  for (const std::string figure : {"h_min", "p_max", "power_film", "eccentricity_ratio"})
    CHECK(settled.number("/bearings/left/" + figure) ==
          relative(steady.number("/bearings/left/" + figure)).epsilon(left));
}

// At 1/900 of the speed Newton's method halts on the way from the centre to a film of 0.6 um.
TEST_CASE("SlowRotor_IsFoundByTheMotionThatItsFilmsAllow") {
  const Solved steady(rotor, {"drives.motor.speed=10 rpm"});
  const model::Model model = model::read_text(rotor, "m.yaml");
  const bearing::SteadyState by_itself = alone(model.bearings.front(), std::numbers::pi / 3, 196.2);
  constexpr double same = 1e-6;  // a hundredth of the clearance carries Newton's tolerance of 1e-8
  CHECK(steady.number("/bearings/left/h_min") == relative(by_itself.film.h_min).epsilon(same));
}

// A rigid rotor whose mass is just the critical one of the bearings' coefficients neither damps nor excites whirl.
TEST_CASE("RotorOfCriticalMass_WhirlsAtTheThreshold") {
  const std::vector<std::string> reynolds{"bearings.left.cavitation=reynolds", "bearings.right.cavitation=reynolds"};
  const model::Model model = model::read_text(rotor, "m.yaml", reynolds);
  const bearing::SteadyState by_itself = alone(model.bearings.front(), 300 * std::numbers::pi, 196.2);
  const Eigen::Matrix2d K = by_itself.coefficients.stiffness.topLeftCorner<2, 2>(),
                        C = by_itself.coefficients.damping.topLeftCorner<2, 2>();
  // s = i w of det(-w^2 m + i w C + K) = 0: keff = m w^2 by the imaginary part, w by the real one.
  const double keff = (K(0, 0) * C(1, 1) + K(1, 1) * C(0, 0) - K(0, 1) * C(1, 0) - K(1, 0) * C(0, 1)) / C.trace();
  const double w2 = ((keff - K(0, 0)) * (keff - K(1, 1)) - K(0, 1) * K(1, 0)) / C.determinant();
  std::vector<std::string> overrides = reynolds;
  overrides.insert(overrides.end(), {"bodies.rotor.mass=" + std::to_string(2 * keff / w2) + " kg",
                                     "gravity=0 " + std::to_string(-196.2 * w2 / keff) + " 0 m/s^2",
                                     "simulation={analysis: modes, modes_about: turning}"});
  const Solved modes(rotor, overrides);
  const results::Reader reader(modes.summary().results);
  const double damping = reader.read("/modes/fields/damping_ratio").values.front(),
               frequency = reader.read("/modes/fields/frequency").values.front();
  // Coefficients are means over places of the grid; the modes have those of one: 1 % apart on 36 nodes.
  CHECK(std::abs(damping) < 0.01);
  CHECK(frequency == relative(std::sqrt(w2) / (2 * std::numbers::pi)).epsilon(0.01));
}

// A pressure without a restrictor presses alike at any thickness: nowhere does it carry just the weight.
TEST_CASE("PadAtAGivenPressure_HasNoPlaceOfRest") {
  const Solved rest(R"(hersey: 1
gravity: -9.81 0 0 m/s^2
lubricants: {oil: {viscosity: 20 mPa.s}}
bodies:
  carriage: {mass: 100 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints: {lift: {type: prismatic, between: [ground, carriage], axis: x, initial: {translation: 60 um}}}
bearings:
  pad: {kind: plane_slider, pad: carriage, runner: ground, length: 50 mm, width: 50 mm, lubricant: oil,
        grid: {along: 21, across: 21},
        features: {recess: {shape: pocket, y: 0 mm, z: 0 mm, along: 20 mm, across: 20 mm, depth: 2 mm, pressure: 10 bar}}}
simulation: {analysis: static}
)");
  CHECK(rest.summary().status == Status::failed);
  CHECK(rest.summary().message.find("films carry what their supplies press") != std::string::npos);
}

TEST_CASE("SteadyMotion_WithAWallInABodyIsRefused") {
  try {
    (void)model::read_text(rotor, "m.yaml",
                           {"bearings.left.thermal={model: film, supply_temperature: 50 degC, shell: {wall: body}, "
                            "journal: {wall: body}}"});
    FAIL("a fault");
  } catch (const InputError& error) {
    const std::string text = error.what();
    CHECK(text.find("bearings.left.thermal.shell: a wall in a body that conducts, in the steady motion") !=
          std::string::npos);
    CHECK(text.find("bearings.left.thermal.journal: a wall in a body that conducts, in the steady") !=
          std::string::npos);
  }
}

// The line on a column of nodes or between two, where it meets edges in air: what it would take back leaves, too.
TEST_CASE("SettledFilm_HasTheFlowsOfItsSteadyMotion") {
  const std::string journal = R"(hersey: 1
parameters: {line: 90 deg}
bodies:
  shaft: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
  ground: {frames: {bore: {origin: 10 24 0 um}}}
joints: {turning: {type: revolute, between: [ground, shaft], axis: z, initial: {rotation_rate: 9000 rpm}}}
drives: {motor: {joint: turning, coordinate: rotation, speed: 9000 rpm}}
lubricants: {oil: {viscosity: 10 mPa.s}}
bearings:
  bush: {shell: ground.bore, journal: shaft, diameter: 50 mm, width: 25 mm, radial_clearance: 60 um, lubricant: oil,
         grid: {circumferential: 36, axial: 7}, supply: {line: "${line}", pressure: 0.5 bar}}
simulation: {duration: 40 ms, step: 0.2 ms}
)";
  for (const char* line : {"line=90 deg", "line=87 deg", "line=-30 deg"}) {
    const auto flow = [&](const char* series, const std::vector<std::string>& overrides) {
      const TemporaryDirectory folder;
      const Summary summary = simulate(model::read_text(journal, "m.yaml", overrides), {.results = folder / "r.h5"});
      REQUIRE(summary.status == Status::completed);
      return results::Reader(summary.results).read(series).values.back();
    };
    for (const char* series : {"/bearings/bush/flow_left", "/bearings/bush/flow_supply"}) {
      constexpr double solved_for = 1e-9;  // films are solved to 1e-10
      CAPTURE(line);
      CAPTURE(series);
      CHECK(flow(series, {line}) ==
            relative(flow(series, {line, "simulation={analysis: steady}"})).epsilon(solved_for));
    }
  }
}

}  // namespace steady_machine_test
}  // namespace hersey::run
