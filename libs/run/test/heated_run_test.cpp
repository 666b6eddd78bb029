#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "meshed_bearing.h"
#include "ring_file.h"
#include "temporary_directory.h"

// Shells in bodies that conduct heat, in a run.
namespace hersey::run {
namespace heated_run_test {

const std::string model_text =
    MeshedBearing{.title = "A warm ring around a journal",
                  .ring = {"ring.inp",
                           "modes: 0\n"
                           "heat:\n"
                           "  conductivity: 46 W/m/K\n"
                           "  expansion: 12e-6 1/K\n"
                           "  cooling: {outside: {heat_transfer: 80 W/m^2/K, ambient: 40 degC}}",
                           kHub},
                  .load = "500 N",
                  .oil = "{grade: iso_vg_46}",
                  .film =
                      "grid: {circumferential: 36, axial: 7}\n"
                      "thermal: {model: film, supply_temperature: 50 degC, shell: {wall: body, temperature: 70 degC}}"}
        .text();

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

/// A hollow shaft in a body, cooled in its bore, replaces the warm ring.
const std::vector<std::string> warm_shaft = {
    "bodies.shaft={flexible: {mesh: shaft.inp, length_unit: 1 mm, modes: 0, material: {youngs_modulus: 210 GPa, "
    "poisson_ratio: 0.3, density: 7850 kg/m^3}, heat: {conductivity: 46 W/m/K, expansion: 12e-6 1/K, cooling: {bore: "
    "{heat_transfer: 2 kW/m^2/K, ambient: 40 degC}}}}, frames: {axis: {nodes: bore, connection: average, origin: 0 0 0 "
    "mm}}}",
    "joints.slide.between=[ground, shaft.axis]",
    "forces.push.body=shaft",
    "bearings.main.journal=shaft.axis",
    "bearings.main.thermal.shell={wall: given, temperature: 60 degC}",
    "bearings.main.thermal.journal={wall: body, temperature: 55 degC}",
    "bodies.ring.flexible.heat.expansion=0 1/K"};

std::vector<std::string> with_shaft(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), warm_shaft.begin(), warm_shaft.end());
  return overrides;
}

/// A folder with model and meshes.
struct Files {
  explicit Files(const std::string& simulation = {}) {
    std::ofstream(folder / "ring.inp") << RingFile{.around = 48}.text();
    std::ofstream(folder / "shaft.inp") << RingFile{.inner = 10, .outer = 22.5, .around = 48, .through = 3}.text();
    std::string text = model_text;
    const std::string once = "duration: 1 ms, step: 0.1 ms";
    if (!simulation.empty()) text.replace(text.find(once), once.size(), simulation);
    std::ofstream(folder / "model.yaml") << text;
  }
  [[nodiscard]] model::Model model(const std::vector<std::string>& overrides) const {
    return model::read(folder / "model.yaml", overrides);
  }
  TemporaryDirectory folder;
};

TEST_CASE("JournalOfAWarmBody_ClosesTheGapOfARun") {
  const Files files;
  const auto last = [&files](const std::vector<std::string>& overrides, const char* name) {
    const TemporaryDirectory folder;
    const Summary summary = simulate(files.model(with_shaft(overrides)), {.results = folder / "r.h5"});
    CAPTURE(summary.message);
    REQUIRE(summary.status == Status::completed);
    const results::Reader reader(folder / "r.h5");
    return reader.read(std::string("/bearings/main/") + name).values.back();
  };
  const double h = last({}, "h_min");
  const double growth = last({}, "journal_growth");
  // 35 K above its reference it is thicker by alpha R 35 K: the bearing of that clearance, its journal at 55 degC.
  CHECK(growth == doctest::Approx(12e-6 * 0.0225 * 35).epsilon(5e-3));                               // flat faces
  CHECK(last({}, "clearance_of_bodies") == doctest::Approx(34e-6 - growth).epsilon(1e-9).scale(0));  // round-off
  CHECK(last({}, "T_journal_body_max") == doctest::Approx(55));
  const std::vector<std::string> tight = {"bearings.main.radial_clearance=" + std::to_string(34 - 1e6 * growth) + " um",
                                          "bearings.main.thermal.journal={wall: given, temperature: 55 degC}"};
  CHECK(last(tight, "h_min") == doctest::Approx(h).epsilon(1e-3).scale(0));  // an even shape to 1e-3 of the growth
  CHECK(std::abs(last({"bodies.shaft.flexible.heat.expansion=0 1/K"}, "h_min") / h - 1) > 0.02);
}

// Over cycles the journal takes the temperature at which its body passes on what the film gives it in the mean: that of
// the steady bearing, and its growth.
TEST_CASE("JournalOfABody_SettlesOverCycles") {
  const Files files("cycle: {period: 4 ms, until_converged: 0, most: 14}, step: 0.2 ms");
  const model::Model model = files.model(with_shaft({}));
  const auto file = files.folder / "r.h5";
  const Summary summary = simulate(model, {.results = file});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(file);
  const auto series = [&reader](const std::string& name) { return reader.read("/bearings/main/" + name).values; };
  const std::vector<double> T = series("T_journal"), heat = series("heat_to_journal"), h = series("h_min"),
                            growth = series("journal_growth"), error = series("mass_balance_error");
  CHECK(T.front() == doctest::Approx(55));
  CHECK(std::abs(T.back() - 55) > 0.5);
  const double pi = std::numbers::pi, per_log = 1 / (2 * pi * 46 * 0.0156), out = 2000 * 2 * pi * 0.01 * 0.0156;
  CHECK(T.back() - 40 ==
        doctest::Approx(heat.back() * (1 / out + per_log * std::log(2.25))).epsilon(0.02));  // three elements across
  CHECK(std::abs(growth.back() / growth[10] - 1) > 0.01);
  CHECK(std::abs(h.back() / h[10] - 1) > 1e-3);
  CHECK(*std::max_element(error.begin(), error.end()) < 1e-9);  // round-off of a step over its flow: the shape moves
  // Energy that bodies put in is absorbed by films, including growing walls.
  const std::vector<double> missing = series("power_error"), made = series("power_film");
  for (std::size_t k = 0; k < missing.size(); ++k)
    CHECK(std::abs(missing[k]) < 3e-4 * made[k]);  // motions of a step to first order; walls do a hundredth of it
  // Interrupted within the second cycle it goes on to the same bits.
  std::atomic<bool> stop{false};
  Options parts{.results = files.folder / "parts.h5", .stop = &stop};
  parts.on_progress = [&stop, taken = 0](const Progress&) mutable { stop = taken++ >= 27; };
  REQUIRE(simulate(model, parts).status == Status::stopped);
  REQUIRE(simulate(model, {.results = files.folder / "parts.h5", .resume = true}).status == Status::completed);
  const results::Reader again(files.folder / "parts.h5");
  for (const char* name : {"T_journal", "heat_to_journal", "h_min", "p_max", "journal_growth"})
    CHECK(again.read(std::string("/bearings/main/") + name).values == series(name));
}

// Heat enters a rotating body evenly around; for a pin that swings this assumption gets a warning.
TEST_CASE("JournalInABodyThatSwings_IsWarnedOf") {
  const Files files;
  const auto warnings_of = [&files](const std::string& drive) {
    const TemporaryDirectory folder;
    const Summary summary = simulate(files.model(with_shaft({"drives.motor=" + drive})), {.results = folder / "r.h5"});
    CAPTURE(summary.message);
    REQUIRE(summary.status == Status::completed);
    std::string text;
    for (const std::string& warning : summary.bearings.at(0).warnings) text += warning + "\n";
    return text;
  };
  const std::string swings = warnings_of(
      "{joint: slide, coordinate: rotation, position: {expression: 0.02*(1 - cos(2*pi*1000*t)), unit: rad}}");
  CHECK(swings.find("swings in its shell") != std::string::npos);
  CHECK(swings.find("is an estimate") != std::string::npos);
  CHECK(warnings_of("{joint: slide, coordinate: rotation, speed: 3000 rpm}").find("its shell") == std::string::npos);
}

// A shaft that cycles warm until it fills its bore.
TEST_CASE("JournalThatFillsItsBore_EndsTheRunAsASeizure") {
  const Files files("cycle: {period: 4 ms, until_converged: 0, most: 14}, step: 0.2 ms");
  const Summary summary =
      simulate(files.model(with_shaft({"bodies.shaft.flexible.heat.expansion=200e-6 1/K",
                                       "bodies.shaft.flexible.heat.reference_temperature=54 degC",
                                       "bodies.shaft.flexible.heat.cooling={bore: {heat_transfer: 2 "
                                       "kW/m^2/K, ambient: 70 degC}}"})),
               {.results = files.folder / "r.h5"});
  CAPTURE(summary.message);
  CHECK(summary.status != Status::completed);
  CHECK(summary.message.find("a seizure: the clearance of 34 um closes to") != std::string::npos);
  CHECK(summary.message.find(" at z = ") != std::string::npos);
}

}  // namespace heated_run_test
}  // namespace hersey::run
