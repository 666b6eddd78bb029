// Energy balance of a run: each part is a separate integral, and nothing is unexplained.
#include <doctest/doctest.h>

#include <cmath>

#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace energy_balance_test {

const std::string kDampedBlock = R"(hersey: 1
title: Springs and dampers of every kind
gravity: 0 0 -9.81 m/s^2
bodies:
  block:
    mass: 2 kg
    inertia: {xx: 4e-3 kg.m^2, yy: 5e-3 kg.m^2, zz: 6e-3 kg.m^2}
    frames: {corner: {origin: 0.1 0.05 0 m}}
  slide: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
  ground: {frames: {post: {origin: 0.4 0.1 0.2 m}}}
joints:
  flight: {type: free, between: [ground, block], initial: {position: 5 2 3 mm, velocity: 0.5 0 -1 m/s}}
  rail: {type: prismatic, between: [ground, slide], axis: x, initial: {translation: 5 mm, translation_rate: 1 m/s}}
forces:
  mount:
    type: bushing
    between: [ground, block]
    stiffness: 8 9 10 N/mm
    rotational_stiffness: 100 120 150 N.m/rad
    damping: 20 30 40 N.s/m
    rotational_damping: 0.1 0.2 0.3 N.m.s/rad
  strut: {type: spring_damper, between: [ground.post, block.corner], stiffness: 2 N/mm, damping: 30 N.s/m, free_length: 0.3 m}
  rub: {type: joint_friction, joint: rail, coordinate: translation, coulomb: 3 N, transition_speed: 10 mm/s}
  stop: {type: sliding_spring, joint: rail, stiffness: 1 N/mm, damping: 5 N.s/m}
  push: {type: force, body: block, components: [10 N, 0 N, 5 N]}
simulation: {duration: 50 ms, step: 0.1 ms, spectral_radius: 1}
)";

TEST_CASE("EnergyOfDampers_IsWhatTheyTake") {
  const TemporaryDirectory folder;
  const auto run = [&](const std::string& step) {
    const model::Model model = model::read_text(kDampedBlock, "block.yaml", {"simulation.step=" + step});
    return simulate(model, {.results = folder / "r.h5", .overwrite = true});
  };
  const Summary coarse = run("0.2 ms"), fine = run("0.1 ms");
  REQUIRE(fine.status == Status::completed);
  CHECK(fine.energy.dampers > 0.2);
  CHECK(fine.energy.stored < 0);
  // Trapezoidal rule and integrator are of order two, (omega dt)^2/12 of the block's fastest motion, some 160 rad/s:
  // 2e-5. What two steps extrapolate to is nothing.
  CHECK(fine.energy.error() < 0.3 * coarse.energy.error());
  CHECK(std::abs(4 * fine.energy.error() - coarse.energy.error()) / 3 < 1e-7);
  const results::Reader reader(folder / "r.h5");
  CHECK(reader.read("/energy/since_start/dampers").values.back() == fine.energy.dampers);
  CHECK(reader.read("/energy/since_start/unexplained").values.back() == fine.energy.unexplained());
}

// The torque on the rotating journal is known from the drive. An oval bore's torque without the moment of the pressure
// on its slopes would put in some per cent too little.
TEST_CASE("EnergyPutIntoAFilm_IsWhatItsIntegralsTake") {
  for (const std::string shape :
       {"[{profile: ovality, amplitude: 15 um, angle: 30 deg}]",
        "[{profile: ovality, on: journal, amplitude: 10 um}, {profile: barrel, drop: 5 um}]"}) {
    CAPTURE(shape);
    const TemporaryDirectory folder;
    const Summary summary =
        simulate(rig(kSmallRig, {"bearings.big_end.shape=" + shape, "bearings.big_end.shear_force=torque_only",
                                 "bearings.big_end.grid={circumferential: 60, axial: 13}", "simulation.step=0.5 deg"}),
                 {.results = folder / "r.h5"});
    REQUIRE(summary.status == Status::completed);
    CHECK(summary.energy.films > 0.01);
    CHECK(summary.bearings[0].energy_taken > 0.01);
    // Discretisation error of the grid: 3e-5 to 1e-4 of the power
    CHECK(std::abs(summary.bearings[0].energy_error) < 1e-3);
    CHECK(summary.energy.error() < 2e-3);
    const results::Reader reader(folder / "r.h5");
    const auto series = [&](const std::string& name) { return reader.read(name).values; };
    const auto unexplained = series("/power/unexplained"), error = series("/bearings/big_end/power_error");
    for (std::size_t i = 1; i < error.size(); ++i)
      CHECK(unexplained[i] == doctest::Approx(error[i]).epsilon(1e-3));  // all else is balanced
  }
}

}  // namespace energy_balance_test
}  // namespace hersey::run
