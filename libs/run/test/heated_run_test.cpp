#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "ring_file.h"
#include "temporary_directory.h"

// Shells in bodies that conduct heat, in a run.
namespace hersey::run {
namespace heated_run_test {

const std::string model_text = R"(hersey: 1
title: A warm ring around a journal
bodies:
  ring:
    flexible:
      mesh: ring.inp
      length_unit: 1 mm
      material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}
      modes: 0
      heat:
        conductivity: 46 W/m/K
        expansion: 12e-6 1/K
        cooling: {outside: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}}
    frames:
      hub: {nodes: outside, connection: average, origin: 0 0 0 mm}
  shaft: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  clamp: {type: fixed, between: [ground, ring.hub]}
  slide: {type: planar, between: [ground, shaft]}
drives:
  motor: {joint: slide, coordinate: rotation, speed: 3000 rpm}
forces:
  push: {type: force, body: shaft, components: [0 N, -500 N, 0 N]}
lubricants:
  oil: {grade: iso_vg_46}
bearings:
  main:
    shell: ring.hub
    journal: shaft
    diameter: 45 mm
    width: 15.6 mm
    radial_clearance: 34 um
    lubricant: oil
    edge_pressure: 1 bar
    grid: {circumferential: 36, axial: 7}
    thermal: {model: film, supply_temperature: 50 degC, shell: {wall: body, temperature: 70 degC}}
simulation: {duration: 1 ms, step: 0.1 ms}
)";

struct Outcome {
  double h_min = 0, heat_to_shell = 0, T_shell = 0;
  std::string assumptions;
};

Outcome run(const std::vector<std::string>& overrides) {
  const TemporaryDirectory folder;
  std::ofstream(folder / "ring.inp") << RingFile{.around = 48}.text();
  std::ofstream(folder / "model.yaml") << model_text;
  const Summary summary = simulate(model::read(folder / "model.yaml", overrides), {.results = folder / "r.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(folder / "r.h5");
  Outcome outcome{.h_min = reader.read("/bearings/main/h_min").values.back(),
                  .heat_to_shell = reader.read("/bearings/main/heat_to_shell").values.back(),
                  .T_shell = reader.read("/bearings/main/T_shell_mean").values.back(),
                  .assumptions = {}};
  for (const auto& [what, text] : reader.text_table("/assumptions")) outcome.assumptions += text + "\n";
  return outcome;
}

TEST_CASE("ShellOfAWarmBody_OpensTheGapOfARun") {
  const Outcome warm = run({});
  // A ring 50 K above its reference is wider by alpha R 50 K: the bearing of that clearance, its shell at 70 degC.
  const Outcome wide = run(
      {"bearings.main.radial_clearance=47.5 um", "bearings.main.thermal.shell={wall: given, temperature: 70 degC}"});
  const Outcome rigid = run({"bodies.ring.flexible.heat.expansion=0 1/K"});
  CHECK(warm.h_min == doctest::Approx(wide.h_min).epsilon(5e-3).scale(0));  // flat faces: 0.2 % of the radius' growth
  CHECK(warm.heat_to_shell == doctest::Approx(wide.heat_to_shell).epsilon(5e-3));  // as well
  CHECK(warm.T_shell == doctest::Approx(70));
  CHECK(std::abs(rigid.h_min / warm.h_min - 1) > 0.05);
  CHECK(warm.assumptions.find("in a body whose mesh conducts heat steadily; in a simulation it stays at 70 degC") !=
        std::string::npos);
}

}  // namespace heated_run_test
}  // namespace hersey::run
