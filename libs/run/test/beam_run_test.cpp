// Beams from the model file to the results file.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "edited.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "source_dir.h"
#include "temporary_directory.h"

namespace hersey::run {
namespace beam_run_test {

// A slender blade on a hub: EI = 1 N m^2, 1 kg/m, 1 m long.
const char* const kBlade = R"(hersey: 1
title: A rotating blade
bodies:
  blade:
    beam:
      points: [0 0 0 m, 1 0 0 m]
      section: {properties: {area: 1 cm^2, shear_y: 0.5 cm^2, shear_z: 0.5 cm^2, I_y: 0.01 cm^4, I_z: 0.01 cm^4, J: 0.02 cm^4}}
      material: {youngs_modulus: 10 GPa, poisson_ratio: 0.3, density: 10000 kg/m^3}
      elements: 16
    frames:
      tip: {along: end}
joints:
  hub: {type: revolute, between: [ground, blade], axis: z}
drives:
  motor: {joint: hub, coordinate: rotation, speed: 3 rad/s}
simulation: {analysis: modes, modes_about: turning}
)";

/// Runs a model in `folder` and opens its results.
results::Reader run_in(const TemporaryDirectory& folder, const std::string& text) {
  std::ofstream(folder / "model.yaml") << text;
  const Summary summary = simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5"});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  return results::Reader(folder / "r.h5");
}

TEST_CASE("TurningBlade_HasTheFrequenciesOfTheClosedForm") {
  // sqrt(E I/(rho A L^4)) = 1 rad/s: lag and flap at 3 rad/s of the slender blade; shear, rotary inertia and elements
  // of 1/16 make 1e-3 of the first modes.
  const TemporaryDirectory folder;
  const results::Reader reader = run_in(folder, kBlade);
  const auto frequency = reader.read("/modes/fields/frequency").values;
  CHECK(2 * std::numbers::pi * frequency[0] == doctest::Approx(3.743511896).epsilon(2e-3));
  CHECK(2 * std::numbers::pi * frequency[1] == doctest::Approx(4.797278532).epsilon(2e-3));
  // In flap the tip moves along z, in lag along y, for rows [real part of all amplitudes of 17 nodes].
  const auto shape = reader.read("/modes/fields/blade_amplitudes_real").values;
  const auto tip = [&](std::size_t mode, std::size_t axis) { return std::abs(shape[(mode * 17 + 16) * 12 + axis]); };
  const auto other = reader.read("/modes/fields/blade_amplitudes_imaginary").values;
  const auto tip_imaginary = [&](std::size_t mode, std::size_t axis) {
    return std::abs(other[(mode * 17 + 16) * 12 + axis]);
  };
  CHECK(tip(0, 1) + tip_imaginary(0, 1) > 100 * (tip(0, 2) + tip_imaginary(0, 2)));
  CHECK(tip(1, 2) + tip_imaginary(1, 2) > 100 * (tip(1, 1) + tip_imaginary(1, 1)));
}

TEST_CASE("VerySlenderBlade_KeepsItsSlowModes") {
  // I/(A L^2) = 1e-8: bending is ten million times slower than the shear of an element, and its stiffness lost in the
  // round-off of that one, squared. E I/(rho A L^4) stays 1 rad^2/s^2.
  const TemporaryDirectory folder;
  const std::string stubby =
      "{area: 1 cm^2, shear_y: 0.5 cm^2, shear_z: 0.5 cm^2, I_y: 0.01 cm^4, I_z: 0.01 cm^4, J: 0.02 cm^4}";
  std::string text = edited(kBlade, stubby,
                            "{area: 1 m^2, shear_y: 1 m^2, shear_z: 1 m^2, I_y: 1e-8 m^4, I_z: 1e-8 m^4, J: 2e-8 m^4}");
  text = edited(text, "youngs_modulus: 10 GPa, poisson_ratio: 0.3, density: 10000 kg/m^3",
                "youngs_modulus: 1e8 Pa, poisson_ratio: 0.3, density: 1 kg/m^3");
  const results::Reader reader = run_in(folder, text);
  const auto frequency = reader.read("/modes/fields/frequency").values;
  CHECK(2 * std::numbers::pi * frequency[0] == doctest::Approx(3.743511896).epsilon(2e-3));
  CHECK(2 * std::numbers::pi * frequency[1] == doctest::Approx(4.797278532).epsilon(2e-3));
  CHECK(reader.number_attribute("/modes", "stable").value_or(0) == 1);
}

TEST_CASE("SupportedBeam_ShowsItsSectionForces") {
  const TemporaryDirectory folder;
  std::string text = edited(kBlade, "title:", "gravity: 0 0 -0.02 m/s^2\ntitle:");
  text = edited(text, "type: revolute, between: [ground, blade], axis: z", "type: fixed, between: [ground, blade]");
  text = edited(text, "drives:\n  motor: {joint: hub, coordinate: rotation, speed: 3 rad/s}\n", "");
  text = edited(text, "modes, modes_about: turning", "static");
  const results::Reader reader = run_in(folder, text);
  const auto force = reader.read("/bodies/blade/section_force").values,
             moment = reader.read("/bodies/blade/section_moment").values,
             position = reader.read("/bodies/blade/node_position").values;
  REQUIRE(force.size() == 48);
  REQUIRE(position.size() == 51);
  // q = 0.02 N/m; the middle of element k sees what hangs beyond its ends' share: q (L - x) and q (L - x)^2/2.
  for (std::size_t k = 0; k < 16; ++k) {
    const double x = (static_cast<double>(k) + 0.5) / 16;
    // Sagging by 0.25 % rotates the sections: an effect of second order.
    CHECK(std::abs(force[3 * k + 2]) == doctest::Approx(0.02 * (1 - x)).epsilon(1e-3));
    // The same, and the weight of half an element.
    CHECK(moment[3 * k + 1] == doctest::Approx(0.02 * (1 - x) * (1 - x) / 2).epsilon(1e-2).scale(1e-3));
  }
  CHECK(position[50] == doctest::Approx(-0.02 / 8).epsilon(5e-3));
  CHECK(reader.number_attribute("/bodies/blade", "mass").value_or(0) ==
        doctest::Approx(1).epsilon(1e-12));  // round-off
}

// A strip of 1 m by 20 mm by 1 mm, E I = 1/3 N m^2, under a moment at its end of m times 2 pi E I/L: m whole circles.
// Its stiffness along is 10^7 times the one across.
TEST_CASE("StripUnderAnEndMoment_RollsUpToCircles") {
  for (const double revolutions : {0.05, 0.5, 1.0, 2.0}) {
    CAPTURE(revolutions);
    const TemporaryDirectory folder;
    const double angle = 2 * std::numbers::pi * revolutions;
    const results::Reader reader = run_in(folder, fmt::format(R"(hersey: 1
gravity: 0 0 0 m/s^2
bodies:
  strip:
    beam:
      points: [0 0 0 m, 1 0 0 m]
      section: {{rectangle: {{width: 1 mm, height: 20 mm}}}}
      material: {{youngs_modulus: 200 GPa, poisson_ratio: 0, density: 7800 kg/m^3}}
    frames: {{tip: {{along: end}}}}
joints: {{clamp: {{type: fixed, between: [ground, strip]}}}}
forces: {{roll: {{type: torque, body: strip.tip, components: [0 N.m, 0 N.m, {:.15g} N.m]}}}}
simulation: {{analysis: static}}
)",
                                                              angle / 3));
    // Stable for two revolutions: then a moment of fixed direction turns it over, out of the plane.
    CHECK(reader.text_attribute("/", "message").value_or("").find("indifferent") == std::string::npos);
    const auto tip = reader.read("/bodies/strip.tip/position").values;
    // chords of 20 equal arcs: longer than the arc's own by (angle/20)^2/24 at the most
    const double chords = angle * angle / 400 / 24;
    // Newton's end, beside the chords.
    CHECK(std::abs(tip[0] - std::sin(angle) / angle) < 1.1 * chords * std::abs(std::sin(angle) / angle) + 1e-8);
    CHECK(std::abs(tip[1] - (1 - std::cos(angle)) / angle) < 1.1 * chords * (1 - std::cos(angle)) / angle + 1e-8);
  }
}

TEST_CASE("SteppedBeam_IsTwoBeamsEndToEnd") {
  // E I = 2 N m^2 over the first half, 1 N m^2 over the second; 1 mN across the tip.
  const TemporaryDirectory folder;
  const results::Reader reader = run_in(folder, R"(hersey: 1
title: A stepped cantilever
bodies:
  thick:
    beam:
      points: [0 0 0 m, 0.5 0 0 m]
      section: {properties: {area: 1 cm^2, shear_y: 1 cm^2, shear_z: 1 cm^2, I_y: 2 mm^4, I_z: 2 mm^4, J: 4 mm^4}}
      material: {youngs_modulus: 1000 GPa, poisson_ratio: 0, density: 1000 kg/m^3}
    frames: {end: {along: end}}
  thin:
    beam:
      points: [0 0 0 m, 0.5 0 0 m]
      section: {properties: {area: 1 cm^2, shear_y: 1 cm^2, shear_z: 1 cm^2, I_y: 1 mm^4, I_z: 1 mm^4, J: 2 mm^4}}
      material: {youngs_modulus: 1000 GPa, poisson_ratio: 0, density: 1000 kg/m^3}
    frames: {end: {along: end}}
joints:
  clamp: {type: fixed, between: [ground, thick]}
  step: {type: fixed, between: [thick.end, thin]}
forces:
  tip: {type: force, body: thin.end, components: [0 N, 1 mN, 0 N]}
simulation: {analysis: static}
)");
  const auto position = reader.read("/bodies/thin/node_position").values;
  const double deflection = 1e-3 * ((1 - 0.125) / (3 * 2) + 0.125 / 3);
  CHECK(position[3 * 20 + 1] == doctest::Approx(deflection).epsilon(1e-3));  // shear, and the sag's second order
}

TEST_CASE("FallingBeam_IsRecordedAndBalanced") {
  const TemporaryDirectory folder;
  std::string text = edited(kBlade, "title:", "gravity: 0 -9.81 0 m/s^2\ntitle:");
  text = edited(text, "drives:\n  motor: {joint: hub, coordinate: rotation, speed: 3 rad/s}\n", "");
  text = edited(text, "analysis: modes, modes_about: turning", "duration: 0.3 s, step: 1 ms");
  text = edited(text, "elements: 16", "elements: 6\n      damping: {stiffness: 10 ms}");
  std::ofstream(folder / "model.yaml") << text;
  const Summary summary = simulate(model::read(folder / "model.yaml"), {.results = folder / "r.h5"});
  INFO(summary.message);
  CHECK(summary.status == Status::completed);
  CHECK(summary.worst_power_balance < 1e-7);  // steps are solved to 1e-8
  const results::Reader reader(folder / "r.h5");
  const auto series = [&](const std::string& name) { return reader.read(name).values; };
  CHECK(series("/energy/strain") == series("/bodies/blade/strain_energy"));
  CHECK(series("/bodies/blade/dissipation").back() > 0);
  CHECK(series("/bodies/blade.tip/position").size() == 3 * series("/time").size());
  CHECK_FALSE(reader.has("/bodies/blade.node 2/position"));
  CHECK_FALSE(reader.has("/joints/blade.tip/coordinates"));
}

TEST_CASE("JournalOnABeam_MovesWithItsNode") {
  const TemporaryDirectory folder;
  const std::filesystem::path file =
      std::filesystem::path(hersey::source_dir()) / "examples" / "flexible_rotor" / "films.yaml";
  const model::Model model =
      model::read(file.string(), {"simulation.duration=4 ms", "bearings.right.grid.circumferential=24"});
  const Summary summary = simulate(model, {.results = folder / "r.h5"});
  INFO(summary.message);
  REQUIRE(summary.status == Status::completed);
  CHECK(summary.worst_power_balance < 1e-6);  // steps are solved to 1e-8
  const results::Reader reader(folder / "r.h5");
  const auto series = [&](const std::string& name) { return reader.read(name).values; };
  const auto node = series("/bodies/shaft/node_position"), left = series("/bearings/left/eccentricity"),
             right = series("/bearings/right/eccentricity"), fall = series("/bearings/right/force");
  const std::size_t rows = left.size() / 2, width = node.size() / rows, last = width - 3;
  double size = 0;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      // m: far above round-off, far below the eccentricity.
      CHECK(std::abs(left[2 * row + axis] - node[width * row + axis]) < 1e-10);
      CHECK(std::abs(right[2 * row + axis] - node[width * row + last + axis]) < 1e-10);
      size = std::max(size, std::abs(right[2 * row + axis]));
    }
  // 0.956 um with steps sixteen times shorter, 0.959 um with four times the nodes around the bearing.
  CHECK(size == doctest::Approx(0.956e-6).epsilon(0.02));
  CHECK(std::abs(fall[3 * (rows - 1) + 1]) > 0.1);
}

}  // namespace beam_run_test
}  // namespace hersey::run
