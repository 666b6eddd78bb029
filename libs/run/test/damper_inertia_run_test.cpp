#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "edited.h"
#include "hersey/bearing/film_inertia.h"
#include "hersey/bearing/steady_bearing.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// Machines that feel the inertia of the oil in a damper.
namespace hersey::run {
namespace damper_inertia_run_test {

constexpr double pi = std::numbers::pi;

// Thin oil: the film hardly damps, and its mass does not depend on viscosity.
const std::string machine = R"(hersey: 1
gravity: 0 0 0 m/s^2
parameters: {mass: 1 kg}
bodies:
  housing: {mass: 2 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
  journal: {mass: "${mass}", inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  seat: {type: planar, between: [ground, housing], axis: z}
  orbit: {type: planar, between: [housing, journal], axis: z, initial: {x: 5 um, y: 0 um}}
drives:
  x: {joint: seat, coordinate: x, position: 0 m}
  y: {joint: seat, coordinate: y, position: 0 m}
  rotation: {joint: seat, coordinate: rotation, speed: 0 rpm}
  hold: {joint: orbit, coordinate: rotation, speed: 0 rpm}
forces:
  cage: {type: bushing, between: [housing, journal], stiffness: 4e5 4e5 0 N/m}
lubricants: {oil: {viscosity: 1e-3 mPa.s, density: 850 kg/m^3}}
bearings:
  damper:
    kind: squeeze_film_damper
    shell: housing
    journal: journal
    diameter: 100 mm
    width: 50 mm
    radial_clearance: 100 um
    lubricant: oil
    cavitation: full_film
    oil_inertia: added_mass
    grid: {circumferential: 36, axial: 9}
simulation: {duration: 20 ms, step: 0.1 ms, spectral_radius: 0.95}
)";

const std::vector<std::string> without{"bearings.damper.oil_inertia=none"};

bearing::FilmInertia inertia_of(const std::vector<std::string>& overrides = {}) {
  const model::Model model = model::read_text(machine, "m.yaml", overrides);
  return {model.bearings.front().film, 1.2};
}

struct Run {
  results::Array time, e, force;
  std::vector<double> kinetic, strain, lost;
};

Run run_of(const std::vector<std::string>& overrides) {
  const TemporaryDirectory scratch;
  const Summary summary = simulate(model::read_text(machine, "m.yaml", overrides), {.results = scratch / "run.h5"});
  REQUIRE_MESSAGE(summary.status == Status::completed, summary.message);
  const results::Reader reader(summary.results);
  return {.time = reader.read("time"),
          .e = reader.read("bearings/damper/eccentricity"),
          .force = reader.read("bearings/damper/force"),
          .kinetic = reader.read("energy/kinetic").values,
          .strain = reader.read("energy/springs").values,
          .lost = reader.read("energy/since_start/film_dissipation").values};
}

/// Highest natural frequency of a model [Hz].
double frequency_of(const std::string& text, std::vector<std::string> overrides) {
  overrides.emplace_back("simulation={analysis: modes}");
  overrides.emplace_back("joints.orbit.initial.x=0 um");
  const TemporaryDirectory scratch;
  const Summary summary = simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch / "run.h5"});
  REQUIRE_MESSAGE(summary.status == Status::completed, summary.message);
  const std::vector<double> found = results::Reader(summary.results).read("modes/fields/frequency").values;
  return *std::max_element(found.begin(), found.end());
}

// Damping of 1e-3 mPa s is 1e-5 of the critical one, whose square counts.
TEST_CASE("FreeVibration_HasTheMassOfTheOil") {
  constexpr double lightly_damped = 1e-8;  // as above
  const double k = 4e5, added = inertia_of().masses(0).radial;
  REQUIRE(added > 0.5);  // not a small one
  for (const double mass : {1.0, 1.5})
    CHECK(frequency_of(machine, {"mass=" + std::to_string(mass) + " kg"}) ==
          relative(std::sqrt(k / (mass + added)) / (2 * pi)).epsilon(lightly_damped));
  CHECK(frequency_of(machine, without) == relative(std::sqrt(k) / (2 * pi)).epsilon(lightly_damped));
  // A shell of 2 kg that is free takes the opposite force: the oil's mass adds to that of the relative motion.
  const std::string free = edited(edited(machine, "  x: {joint: seat, coordinate: x, position: 0 m}\n", ""),
                                  "  y: {joint: seat, coordinate: y, position: 0 m}\n", "");
  CHECK(frequency_of(free, {}) == relative(std::sqrt(k / (2.0 / 3 + added)) / (2 * pi)).epsilon(lightly_damped));
}

TEST_CASE("RunWithInertia_IsOfSecondOrder") {
  // A wide orbit, in which the mass changes along the path.
  const std::vector<std::string> wide{"joints.orbit.initial.x=60 um", "joints.orbit.initial.y_rate=0.005 m/s",
                                      "simulation.duration=8 ms"};
  const auto end = [&](const char* step) {
    std::vector<std::string> overrides = wide;
    overrides.push_back(std::string("simulation.step=") + step);
    const Run run = run_of(overrides);
    const std::size_t last = run.e.values.size() - 2;
    return Eigen::Vector2d(run.e.values[last], run.e.values[last + 1]);
  };
  const Eigen::Vector2d coarse = end("0.08 ms"), middle = end("0.04 ms"), fine = end("0.02 ms");
  const double order = std::log2((coarse - middle).norm() / (middle - fine).norm());
  CHECK(order > 1.9);
  CHECK(order < 2.1);
}

TEST_CASE("EnergyOfAFreeOrbit_IsConservedButForTheFilm") {
  const Run run = run_of({"joints.orbit.initial.x=60 um", "joints.orbit.initial.y_rate=0.005 m/s",
                          "simulation.step=10 us", "simulation.duration=10 ms", "simulation.spectral_radius=0.99"});
  const auto total = [&](std::size_t i) { return run.kinetic[i] + run.strain[i] + run.lost[i]; };
  double change = 0, exchanged = 0;
  for (std::size_t i = 0; i < run.kinetic.size(); ++i) {
    change = std::max(change, std::abs(total(i) - total(0)));
    exchanged = std::max(exchanged, std::abs(run.kinetic[i] - run.kinetic[0]));
  }
  CHECK(exchanged > 0.2 * total(0));
  CHECK(change < 2e-4 * total(0));  // squared share of the step in the vibration's period, 1.5e-3 rad times 10
}

// Relative motion and forces do not depend on how the machine moves as a whole where nothing else acts: at a constant
// velocity, and with both bodies accelerated alike.
TEST_CASE("MovedMachine_HasTheSameRelativeMotion") {
  const std::vector<std::string> short_run{"simulation.duration=5 ms"};
  std::vector<std::string> moved = short_run;
  moved.insert(moved.end(), {"drives.x.position={expression: '3*t', unit: m}"});
  const Run at_rest = run_of(short_run), flying = run_of(moved);
  REQUIRE(at_rest.e.values.size() == flying.e.values.size());
  for (std::size_t i = 0; i < at_rest.e.values.size(); ++i) {
    CHECK(std::abs(at_rest.e.values[i] - flying.e.values[i]) < 1e-6 * 5e-6);  // Newton's tolerance over 50 steps
  }
}

// A film without damping has the force of its inertia alone.
TEST_CASE("ForceOnTheShell_ContainsTheInertia") {
  const Run run = run_of({"joints.orbit.initial.x=2 um", "simulation.step=20 us", "simulation.duration=4 ms"});
  const double added = inertia_of().masses(0).radial, omega = std::sqrt(4e5 / (1 + added));
  double largest = 0;
  for (std::size_t i = 0; i < run.time.values.size(); ++i)
    largest = std::max(
        largest, std::abs(run.force.values[i * run.force.width()] - -added * omega * omega * run.e.values[2 * i]));
  // Of the squared ratio of the orbit, 4e-4, and of the step.
  CHECK(largest < 2e-3 * added * omega * omega * 2e-6);
}

// On a small circle with viscous oil the force is that of the study's damping and added mass.
TEST_CASE("PrescribedOrbit_HasTheForceOfDampingAndAddedMass") {
  const std::string text = edited(edited(machine, "drives:\n", R"(drives:
  orbit_x: {joint: orbit, coordinate: x, position: {expression: '2e-6*cos(600*t)', unit: m}}
  orbit_y: {joint: orbit, coordinate: y, position: {expression: '2e-6*sin(600*t)', unit: m}}
)"),
                                  "viscosity: 1e-3 mPa.s", "viscosity: 6 mPa.s");
  const std::vector<std::string> overrides{"joints.orbit.initial.x=2 um", "simulation={duration: 4 ms, step: 50 us}"};
  const model::Model model = model::read_text(text, "m.yaml", overrides);
  bearing::SteadyState state;
  REQUIRE(bearing::solve_steady(model.bearings.front().film, {}, {.inertia_factor = 1.2}, state).solved());
  const double C = state.coefficients.damping(0, 0), M = state.coefficients.inertia(0, 0), e = 2e-6, Omega = 600;
  REQUIRE(M * Omega > 0.05 * C);  // far above what is allowed below
  const TemporaryDirectory scratch;
  const Summary summary = simulate(model, {.results = scratch / "run.h5"});
  REQUIRE_MESSAGE(summary.status == Status::completed, summary.message);
  const results::Reader reader(summary.results);
  const results::Array force = reader.read("bearings/damper/force"), time = reader.read("time");
  for (std::size_t k = time.values.size() / 2; k < time.values.size(); ++k) {
    const double cosine = std::cos(Omega * time.values[k]), sine = std::sin(Omega * time.values[k]);
    const double x = force.values[k * force.width()], y = force.values[k * force.width() + 1];
    const Eigen::Vector2d polar(x * cosine + y * sine, -x * sine + y * cosine);
    const Eigen::Vector2d exact = e * Omega * Eigen::Vector2d(-M * Omega, C);
    // Of the squared ratio of the orbit, 4e-4, and of the squared angle of a step, 9e-4, in phase and size.
    constexpr double small = 2e-3;  // as above
    CHECK((polar - exact).norm() < small * exact.norm());
  }
}

TEST_CASE("BoreThatDiffersAround_RunsWithoutInertiaAndSaysSo") {
  const auto found = [](const model::Model& model) {
    std::string text;
    for (const Fault& warning : model.warnings)
      if (warning.path == "bearings.damper.oil_inertia") text += warning.found;
    return text;
  };
  const model::Model whole = model::read_text(machine, "m.yaml", {});
  CHECK(found(whole).empty());
  CHECK(whole.bearings.front().moves_with_inertia);
  const model::Model fed = model::read_text(machine, "m.yaml", {"bearings.damper.supply={line: 90 deg}"});
  CHECK_FALSE(fed.bearings.front().moves_with_inertia);
  CHECK(contains(found(fed), "a supply line"));
}

}  // namespace damper_inertia_run_test
}  // namespace hersey::run
