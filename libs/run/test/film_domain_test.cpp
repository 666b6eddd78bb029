#include <doctest/doctest.h>

#include <string>

#include "hersey/model/read.h"
#include "hersey/run/simulate.h"
#include "temporary_directory.h"

// Films whose trials leave the domain of their equations: absurd pressures, liners that sink, surfaces that meet.
namespace hersey::run {
namespace film_domain_test {

Summary run(const std::string& text) {
  const TemporaryDirectory scratch;
  return simulate(model::read_text(text, "machine.yaml", {}), {.results = scratch / "run.h5"});
}

bool shows_code(const std::string& message) {
  return message.find("does not hold") != std::string::npos || message.find(".cpp") != std::string::npos;
}

TEST_CASE("LightJournalOnALiner_RunsThroughAbsurdTrials") {
  const Summary summary = run(R"(hersey: 1
bodies:
  shaft:
    mass: 0.95 kg
    inertia: {xx: 0.0038 kg.m^2, yy: 0.0038 kg.m^2, zz: 0.00024 kg.m^2}
joints: {j: {type: planar, between: [ground, shaft], axis: z, initial: {rotation_rate: -500 rpm}}}
drives: {d: {joint: j, coordinate: rotation, speed: -500 rpm}}
forces: {f: {type: force, body: shaft, components: [0 N, -26 N, 0 N]}}
lubricants: {oil: {viscosity: 4.1 mPa.s}}
bearings:
  ma:
    shell: ground
    journal: shaft
    diameter: 45 mm
    width: 16 mm
    radial_clearance: 31 um
    lubricant: oil
    features: {f0: {shape: hole, angle: 10 deg, depth: 0 mm, diameter: 9.7 mm, pressure: 20 bar}}
    compliance: {model: column, composite_modulus: 60 GPa, length: 2 mm}
    asperities: {model: greenwood_tripp, roughness: 1 um, elastic_factor: 3e-3, composite_modulus: 115 GPa, friction: 0.1}
simulation: {duration: 4.08 ms, step: 1.36 ms}
)");
  CHECK_MESSAGE(summary.status == Status::completed, summary.message);
  CHECK(summary.rejected_steps > 0);  // some trial was outside the domain
}

TEST_CASE("TensionInAStiffeningOil_DoesNotOverflow") {
  const Summary summary = run(R"(hersey: 1
bodies:
  shaft:
    mass: 0.050478 kg
    inertia: {xx: 0.00020191 kg.m^2, yy: 0.00020191 kg.m^2, zz: 2.5239e-06 kg.m^2}
joints: {j: {type: planar, between: [ground, shaft], axis: z, initial: {x: 3.1021 um, y: -3.3006 um, rotation_rate: 502.064 rpm}}}
drives: {d: {joint: j, coordinate: rotation, speed: 502.064 rpm}}
forces: {f: {type: force, body: shaft, components: [0 N, -8.8181 N, 0 N]}}
lubricants: {oil: {viscosity: 4.944 mPa.s, pressure_viscosity: {law: roelands, z: 0.6}}}
bearings:
  ma:
    shell: ground
    journal: shaft
    diameter: 20 mm
    width: 17.24 mm
    radial_clearance: 9.3511 um
    lubricant: oil
    cavitation: {model: guembel, pressure: -0.5 bar}
    features: {f0: {shape: oval_hole, angle: 119.1 deg, depth: 0 mm, around: 8.129 mm, along: 8.129 mm, pressure: 0.5 bar}}
simulation: {duration: 1.2 ms, step: 0.230877 ms}
)");
  CHECK_MESSAGE(summary.status == Status::completed, summary.message);
}

// At its edges the film has the pressure outside: nothing separates smooth surfaces there, however soft they are.
TEST_CASE("HeavyJournalOnASoftLiner_IsReportedToTouchAtItsEdges") {
  const Summary summary = run(R"(hersey: 1
bodies:
  shaft: {mass: 3147.4 kg, inertia: {xx: 13 kg.m^2, yy: 13 kg.m^2, zz: 3.9 kg.m^2}}
joints: {j: {type: planar, between: [ground, shaft], axis: z, initial: {rotation_rate: 420 rpm}}}
drives: {d: {joint: j, coordinate: rotation, speed: 420 rpm}}
forces: {f: {type: force, body: shaft, components: [93967 N, 0 N, 0 N]}}
lubricants: {oil: {viscosity: 40 mPa.s}}
bearings:
  ma:
    shell: ground
    journal: shaft
    diameter: 100 mm
    width: 48 mm
    radial_clearance: 48 um
    lubricant: oil
    features: {f1: {shape: oval_hole, angle: 350.9 deg, depth: 0 mm, around: 28.8 mm, along: 28.8 mm, pressure: 0.5 bar}}
    compliance: {model: column, composite_modulus: 5 GPa, length: 2 mm}
simulation: {duration: 0.11 s, step: 1.1 ms}
)");
  CHECK(summary.status == Status::failed);
  CHECK_FALSE(shows_code(summary.message));
  CHECK(summary.message.find("bearing ma: the journal touches the shell") != std::string::npos);
  CHECK(summary.message.find("asperities") != std::string::npos);
}

}  // namespace film_domain_test
}  // namespace hersey::run
