#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// A piston in its liner, moved by a crank: a skirt in a machine (theory manual, chapter skirt).
namespace hersey::run {
namespace skirt_run_test {

// A rod without mass, so that the side force is that of gas force and piston alone; no gravity.
const std::string piston = R"(hersey: 1
lubricants:
  oil: {viscosity: 20 mPa.s, density: 850 kg/m^3}
bodies:
  ground: {frames: {liner: {origin: 0 180 0 mm, rotation: {axis: x, angle: -90 deg}}}}
  crank: {mass: 6 kg, inertia: {xx: 0.02 kg.m^2, yy: 0.02 kg.m^2, zz: 0.03 kg.m^2}, frames: {pin: {origin: 0 40 0 mm}}}
  rod: {mass: 0, inertia: {xx: 0 kg.m^2, yy: 0 kg.m^2, zz: 0 kg.m^2}, frames: {small_end: {origin: 0 140 0 mm}}}
  piston:
    mass: 0.4 kg
    inertia: {xx: 4e-4 kg.m^2, yy: 4e-4 kg.m^2, zz: 4e-4 kg.m^2}
    frames: {pin: {origin: 0 0 0 mm}, skirt: {origin: 0 0 0 mm, rotation: {axis: x, angle: -90 deg}}}
joints:
  main: {type: revolute, between: [ground, crank], axis: z, initial: {rotation_rate: 1000 rpm}}
  big_end: {type: revolute, between: [crank.pin, rod], axis: z, initial: {rotation: 0 deg, rotation_rate: -1285.7142857 rpm}}
  wrist: {type: revolute, between: [rod.small_end, piston.pin], axis: z, initial: {rotation: 0 deg, rotation_rate: 285.7142857 rpm}}
drives:
  motor: {joint: main, coordinate: rotation, speed: 1000 rpm}
forces:
  gas: {type: force, body: piston, direction: 0 -1 0, magnitude: 3 kN, axes: ground}
bearings:
  skirt:
    kind: skirt
    skirt: piston.skirt
    liner: ground.liner
    diameter: 75 mm
    length: 42 mm
    radial_clearance: 35 um
    lubricant: oil
    grid: {around: 9, along: 17}
    shape: [{profile: barrel, top: 30 um, bottom: 20 um}]
simulation: {crank: main, duration: 60 deg, step: 0.5 deg}
)";

std::string edited(const std::string& from, const std::string& to) {
  std::string text = piston;
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::vector<double> series(const results::Reader& reader, const std::string& name) {
  return reader.read("/bearings/skirt/" + name).values;
}

/// Runs the text and returns the series of the skirt.
std::vector<double> series_of(const std::string& text, const std::string& name,
                              const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory scratch;
  const Summary summary = simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch / "run.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  return series(results::Reader(summary.results), name);
}

// The side force is that of a piston without a mass across its liner, which the rod's lean gives (skirt.9): what parts
// them is the inertia of the secondary motion. Energy and oil are balanced.
TEST_CASE("SideForce_IsThatOfTheMechanism") {
  const TemporaryDirectory scratch;
  const Summary summary = simulate(model::read_text(piston, "m.yaml"), {.results = scratch / "run.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  CHECK(summary.worst_power_balance < 1e-6);             // steps are solved to 1e-8 of their largest term
  CHECK(summary.bearings[0].worst_mass_balance < 1e-6);  // likewise
  const results::Reader reader(summary.results);
  const std::vector<double> side = series(reader, "side_force"), friction = series(reader, "skirt_friction"),
                            speed = series(reader, "skirt_speed"), time = reader.read("/time").values;
  const double omega = 1000 * std::numbers::pi / 30, r = 0.04, l = 0.14;
  double worst = 0, largest = 0;
  for (std::size_t k = 20; k < side.size(); ++k) {  // from 10 deg on: the start's transient has gone
    const double a = omega * time[k], lean = std::asin(r / l * std::sin(a));
    const double lean_rate = r / l * std::cos(a) * omega / std::cos(lean);
    const double lean_acceleration =
        (-r / l * std::sin(a) * omega * omega + std::sin(lean) * lean_rate * lean_rate) / std::cos(lean);
    const double v = -r * std::sin(a) * omega - l * std::sin(lean) * lean_rate;
    const double acceleration = -r * std::cos(a) * omega * omega - l * std::cos(lean) * lean_rate * lean_rate -
                                l * std::sin(lean) * lean_acceleration;
    CHECK(speed[k] == doctest::Approx(v).epsilon(3e-4));  // squares of the secondary motion over the rod
    const double expected = (3000 + 0.4 * acceleration - friction[k]) * std::tan(lean);
    worst = std::max(worst, std::abs(side[k] - expected));
    largest = std::max(largest, expected);
  }
  CHECK(largest > 500);
  CHECK(worst < 1e-3 * largest);  // accelerations across the liner: micrometres in milliseconds
}

// Against steps a fifth and a tenth as long, whose difference from theirs is nearly the whole error.
TEST_CASE("SecondaryMotion_ConvergesWithTheStep") {
  const auto at_end = [&](const std::string& step) {
    return series_of(piston, "offset_top", {"simulation.step=" + step, "simulation.duration=30 deg"}).back();
  };
  const double coarse = at_end("1 deg"), half = at_end("0.5 deg"), fine = at_end("0.1 deg");
  CHECK(std::abs(half - fine) < 2e-2 * std::abs(fine));                  // of half a degree, from a start at rest
  CHECK(std::abs(half - fine) < 0.6 * std::abs(coarse - fine) + 1e-12);  // at least of first order; a picometre
}

// Against the stroke of the ideal mechanism and the mean of the power, and on twice as many nodes in both directions.
TEST_CASE("FrictionMeanEffectivePressure_IsTheMeanPowerOverTheDisplacedVolume") {
  const auto pressure_of = [&](const std::string& grid) {
    const TemporaryDirectory scratch;
    const Summary summary = simulate(
        model::read_text(
            piston, "m.yaml",
            {"simulation.duration=360 deg", "simulation.cycle={period: 360 deg}", "simulation.step=2 deg", grid}),
        {.results = scratch / "run.h5"});
    CAPTURE(summary.message);
    REQUIRE(summary.status == Status::completed);
    const results::Reader reader(summary.results);
    const double pressure = series(reader, "cycles/fields/friction_mean_effective_pressure").at(0);
    const double stroke = series(reader, "cycles/fields/stroke").at(0);
    CHECK(stroke == doctest::Approx(0.08).epsilon(1e-3));  // twice the crank; the trapezoidal rule on steps of 2 deg
    const std::vector<double> power = series(reader, "skirt_friction_power"), time = reader.read("/time").values;
    double work = 0;
    for (std::size_t k = 1; k < power.size(); ++k) work += 0.5 * (time[k] - time[k - 1]) * (power[k] + power[k - 1]);
    const double volume = std::numbers::pi / 4 * 0.075 * 0.075 * 0.08;
    CHECK(pressure == doctest::Approx(work / volume).epsilon(1e-3));  // the stroke's own error
    return pressure;
  };
  const double coarse = pressure_of("bearings.skirt.grid={around: 9, along: 17}");
  const double fine = pressure_of("bearings.skirt.grid={around: 17, along: 33}");
  CHECK(coarse > 0);
  CHECK(coarse == doctest::Approx(fine).epsilon(0.03));  // what engineers ask of it
}

// The same engine seen in a mirror: rotating backwards, its thrust side is on the other side.
TEST_CASE("MirroredEngine_HasItsThrustSideOnTheOtherSide") {
  const std::vector<double> side = series_of(piston, "side_force", {"simulation.duration=30 deg"});
  std::string mirrored = edited("1000 rpm", "-1000 rpm");
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"rotation_rate: -1285.7142857", "rotation_rate: 1285.7142857"},
           {"rotation_rate: 285.7142857", "rotation_rate: -285.7142857"}}) {
    const std::size_t at = mirrored.find(from);
    REQUIRE(at != std::string::npos);
    mirrored.replace(at, from.size(), to);
  }
  const std::vector<double> back = series_of(mirrored, "side_force", {"simulation.duration=30 deg"});
  REQUIRE(side.size() == back.size());
  for (std::size_t k = 4; k < side.size(); ++k)
    CHECK(back[k] == doctest::Approx(-side[k]).epsilon(1e-5));  // steps are solved to 1e-8, forces of stiff films
}

// On thin layers: oil and energy are balanced whichever way the skirt goes, and the film's derivative by the speed that
// brings the oil is right: coupled with the bodies in one Newton iteration, it is the motion found by exchanging
// forces.
TEST_CASE("StarvedSkirt_IsBalancedAndTheSameHoweverCoupled") {
  const TemporaryDirectory scratch;
  const std::string layers = "bearings.skirt.oil={top: 4 um, bottom: 25 um}";
  const Summary summary =
      simulate(model::read_text(piston, "m.yaml", {layers, "simulation.duration=200 deg", "simulation.step=1 deg"}),
               {.results = scratch / "run.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  CHECK(summary.worst_power_balance < 1e-6);             // steps are solved to 1e-8 of their largest term
  CHECK(summary.bearings[0].worst_mass_balance < 1e-6);  // likewise
  const results::Reader reader(summary.results);
  const std::vector<double> starved = series(reader, "starved_share"), scraped = series(reader, "flow_scraped"),
                            speed = series(reader, "skirt_speed"), bottom = series(reader, "flow_left");
  // On its way up one side of the skirt runs dry, since 4 um fill no more than some 8 um of a gap; on its way down none
  // does.
  CHECK(speed.back() > 0);
  CHECK(starved.back() > 0.5);
  CHECK(speed[90] < 0);
  CHECK(starved[90] < 0.05);
  for (std::size_t k = 1; k < speed.size(); ++k) {
    CHECK(scraped[k] >= -1e-15);  // round-off of m^3/s beside 1e-5
    const double brought = 25e-6 * std::max(-speed[k], 0.0) * 2 * 80 * std::numbers::pi / 180 * 0.0375;
    CHECK(-bottom[k] <= 1.001 * brought + 1e-9);  // its speed at the end of the step for the mean over it
  }
  const std::vector<std::string> brief{layers, "simulation.duration=20 deg"};
  const double as_it_is = series_of(piston, "side_force", brief).back();
  CHECK(
      series_of(piston, "side_force", {layers, brief.back(), "bearings.skirt.coupling={scheme: partitioned}"}).back() ==
      relative(as_it_is).epsilon(1e-5));  // steps are solved to 1e-8, forces of stiff films
}

// A liner whose frame lies elsewhere along its axis, and a partitioned coupling: the same motion.
TEST_CASE("LinerMovedAlongItself_OrCoupledOtherwise_IsTheSameMachine") {
  const std::vector<std::string> brief{"simulation.duration=20 deg"};
  const double as_it_is = series_of(piston, "side_force", brief).back();
  CHECK(series_of(edited("origin: 0 180 0 mm", "origin: 0 60 0 mm"), "side_force", brief).back() ==
        relative(as_it_is).epsilon(1e-5));  // steps are solved to 1e-8, forces of stiff films
  CHECK(series_of(piston, "side_force", {brief.front(), "bearings.skirt.coupling={scheme: partitioned}"}).back() ==
        relative(as_it_is).epsilon(1e-5));  // likewise
}

}  // namespace skirt_run_test
}  // namespace hersey::run
