#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <numbers>
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
  CHECK(warm.assumptions.find("in a body whose mesh conducts heat steadily; in a simulation it begins at 70 degC") !=
        std::string::npos);
}

// Over cycles the body takes the temperatures at which it passes on what the film gives it in the mean, and its shape.
TEST_CASE("ShellOfABody_SettlesOverCycles") {
  const TemporaryDirectory folder;
  std::ofstream(folder / "ring.inp") << RingFile{.around = 48}.text();
  std::string text = model_text;
  const std::string once = "duration: 1 ms, step: 0.1 ms";
  text.replace(text.find(once), once.size(), "cycle: {period: 4 ms, until_converged: 0, most: 14}, step: 0.2 ms");
  std::ofstream(folder / "model.yaml") << text;
  const model::Model model = model::read(folder / "model.yaml", {});
  const Summary summary = simulate(model, {.results = folder / "r.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(folder / "r.h5");
  const auto series = [&reader](const std::string& name) { return reader.read("/bearings/main/" + name).values; };
  const std::vector<double> T = series("T_shell_mean"), heat = series("heat_to_shell"), h = series("h_min"),
                            error = series("mass_balance_error");
  CHECK(T.front() == doctest::Approx(70));
  CHECK(std::abs(T.back() - 70) > 2);
  // A small steel ring is about as warm everywhere: 80 W/m^2/K times its outer surface, to 40 degC.
  const double out = 80 * 2 * std::numbers::pi * RingFile{}.outer * 1e-3 * RingFile{}.width * 1e-3 * (T.back() - 40);
  CHECK(heat.back() == doctest::Approx(out).epsilon(0.05));  // and what the journal still moves
  // By its shape the film is that of the clearance that the bore then has.
  CHECK(std::abs(h.back() / h[10] - 1) > 1e-3);
  CHECK(*std::max_element(error.begin(), error.end()) < 1e-9);  // round-off of a step over its flow: the shape moves
  // Interrupted within the second cycle it goes on to the same bits.
  std::atomic<bool> stop{false};
  Options parts{.results = folder / "parts.h5", .stop = &stop};
  parts.on_progress = [&stop, taken = 0](const Progress&) mutable { stop = taken++ >= 27; };
  REQUIRE(simulate(model, parts).status == Status::stopped);
  REQUIRE(simulate(model, {.results = folder / "parts.h5", .resume = true}).status == Status::completed);
  const results::Reader again(folder / "parts.h5");
  for (const char* name : {"T_shell_mean", "heat_to_shell", "h_min", "p_max"})
    CHECK(again.read(std::string("/bearings/main/") + name).values == series(name));
}

}  // namespace heated_run_test
}  // namespace hersey::run
