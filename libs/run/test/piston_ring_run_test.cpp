#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "temporary_directory.h"

// Piston rings in an engine: their power, and the friction mean effective pressure of the whole engine.
namespace hersey::run {
namespace piston_ring_run_test {

const std::string engine = R"(hersey: 1
parameters: {speed: 1000 rpm, friction: 0.1, tension: 10 N}
bodies:
  ground: {frames: {liner: {origin: 0 180 0 mm, rotation: {axis: x, angle: -90 deg}}}}
  crank: {mass: 6 kg, inertia: {xx: 0.02 kg.m^2, yy: 0.02 kg.m^2, zz: 0.03 kg.m^2}, frames: {pin: {origin: 0 40 0 mm}}}
  rod:
    mass: 0.55 kg
    centre_of_mass: 0 40 0 mm
    inertia: {xx: 2.2e-3 kg.m^2, yy: 2e-4 kg.m^2, zz: 2.2e-3 kg.m^2}
    frames: {small_end: {origin: 0 140 0 mm}}
  piston:
    mass: 0.4 kg
    inertia: {xx: 4e-4 kg.m^2, yy: 4e-4 kg.m^2, zz: 4e-4 kg.m^2}
    frames: {skirt: {origin: 0 -4 0 mm, rotation: {axis: x, angle: -90 deg}}}
joints:
  main: {type: revolute, between: [ground, crank], axis: z, initial: {rotation_rate: "${speed}"}}
  big_end: {type: revolute, between: [crank.pin, rod], axis: z, initial: {rotation_rate: -1285.7142857 rpm}}
  wrist: {type: revolute, between: [rod.small_end, piston], axis: z, initial: {rotation_rate: 285.7142857 rpm}}
drives:
  motor: {joint: main, coordinate: rotation, speed: "${speed}"}
lubricants: {oil: {viscosity: 8 mPa.s, density: 850 kg/m^3}}
forces:
  ring:
    type: piston_ring
    between: [ground.liner, piston.skirt]
    bore: 75 mm
    height: 1.5 mm
    tension: "${tension}"
    friction: "${friction}"
    viscosity: 8 mPa.s
    transition_speed: 1 mm/s
bearings:
  skirt:
    kind: skirt
    skirt: piston.skirt
    liner: ground.liner
    diameter: 75 mm
    length: 42 mm
    radial_clearance: 35 um
    lubricant: oil
    grid: {around: 7, along: 13}
    shape: [{profile: barrel, top: 30 um, bottom: 20 um}]
simulation: {crank: main, duration: 360 deg, step: 2 deg, cycle: {period: 360 deg}}
)";

struct Run {
  Summary summary;
  double friction_pressure = 0, volume = 0, energy_of_ring = 0, energy_of_skirt = 0, of_skirt = 0;
  std::vector<double> force, power, speed;
};

Run run_of(const std::vector<std::string>& overrides) {
  const TemporaryDirectory scratch;
  Run run;
  run.summary = simulate(model::read_text(engine, "m.yaml", overrides), {.results = scratch / "run.h5"});
  CAPTURE(run.summary.message);
  REQUIRE(run.summary.status == Status::completed);
  const results::Reader reader(run.summary.results);
  const auto values = [&](const std::string& name) { return reader.read(name).values; };
  run.friction_pressure = values("/cycles/fields/friction_mean_effective_pressure").at(0);
  run.volume = values("/cycles/fields/displaced_volume").at(0);
  run.of_skirt = values("/bearings/skirt/cycles/fields/friction_mean_effective_pressure").at(0);
  run.force = values("/forces/ring/friction_force"), run.power = values("/forces/ring/friction_power");
  run.speed = values("/bearings/skirt/skirt_speed");
  const std::vector<double> time = values("/time");
  for (std::size_t k = 1; k < time.size(); ++k)
    run.energy_of_ring += 0.5 * (time[k] - time[k - 1]) * (run.power[k] + run.power[k - 1]);
  return run;
}

// A constant friction force mu N, N = 2 pi T, goes twice along the stroke: 2 mu N over the piston's area, whatever the
// stroke is. Films and rings add up.
TEST_CASE("FrictionMeanEffectivePressure_IsThatOfFilmsAndRings") {
  const Run with = run_of({});
  const double area = std::numbers::pi / 4 * 0.075 * 0.075, load = 2 * std::numbers::pi * 10;
  CHECK(with.summary.worst_power_balance < 1e-6);                    // steps are solved to 1e-8 of their largest term
  CHECK(with.volume == doctest::Approx(area * 0.08).epsilon(1e-3));  // twice the crank; trapezoids of 2 deg
  CHECK(with.friction_pressure * with.volume ==
        doctest::Approx(with.of_skirt * with.volume + with.energy_of_ring).epsilon(1e-9));  // sums of the same terms
  CHECK(with.friction_pressure - with.of_skirt ==
        doctest::Approx(2 * 0.1 * load / area).epsilon(2e-3));  // trapezoids, and the passage through zero speed
  for (std::size_t k = 1; k < with.force.size(); ++k) {
    const double sliding = with.speed[k] / std::hypot(with.speed[k], 1e-3);
    CHECK(with.force[k] ==
          doctest::Approx(-0.1 * load * sliding).epsilon(1e-3).scale(load));  // a tilted piston's speed
    CHECK(with.power[k] >= 0);
  }
  const Run without = run_of({"tension=0 N"});
  CHECK(without.friction_pressure == doctest::Approx(without.of_skirt).epsilon(1e-12));  // round-off
}

// A curve over the Hersey number that is a straight line is viscous friction, which grows with the speed; gas adds to
// the load that tension brings.
TEST_CASE("RingOverTheHerseyNumber_IsViscousWhereItsCurveIsALine") {
  const std::vector<std::string> line{"forces.ring.friction={expression: 20*hersey, unit: \"1\"}"};
  const auto energy = [&](std::vector<std::string> more) {
    more.insert(more.end(), line.begin(), line.end());
    return run_of(more).energy_of_ring;
  };
  const double once = energy({});
  CHECK(once > 0);
  // mu N = 20 eta v pi D: of a load it does not know.
  CHECK(energy({"tension=20 N"}) == doctest::Approx(once).epsilon(1e-6));  // the secondary motion differs a little
  CHECK(energy({"forces.ring.viscosity=16 mPa.s"}) == doctest::Approx(2 * once).epsilon(1e-6));  // likewise
  const double face = std::numbers::pi * 0.075 * 1.5e-3, load = 2 * std::numbers::pi * 10;
  const double of_constant = run_of({}).energy_of_ring, with_gas = run_of({"forces.ring.gas=2 bar"}).energy_of_ring;
  CHECK(with_gas / of_constant == doctest::Approx(1 + 2e5 * face / load).epsilon(1e-5));  // likewise
}

}  // namespace piston_ring_run_test
}  // namespace hersey::run
