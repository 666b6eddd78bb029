#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "relative.h"
#include "wearing_bush.h"

// Journals that wear place by place while they run.
namespace hersey::run {
namespace journal_wear_run_test {

using namespace wearing_bush;

const std::string turning = R"(hersey: 1
parameters: {end: 100 ms, step: 0.5 ms, sense: 1, axes: body, shell: 0 1/Pa, journal: 2e-15 1/Pa, around: local,
             x: 6.6 um, x_rate: 0 m/s, y_rate: 0 m/s, lines: 60, factor: 2000}
lubricants: {oil: {viscosity: 30 mPa.s, density: 860 kg/m^3}}
bodies:
  shaft: {mass: 2 kg, inertia: {xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 6e-3 kg.m^2}}
joints: {turning: {type: planar, between: [ground, shaft], axis: z, initial: {x: "${x}*${sense}", y: -27.5 um, x_rate: "${x_rate}", y_rate: "${y_rate}", rotation_rate: "120 rpm*${sense}"}}}
drives: {motor: {joint: turning, coordinate: rotation, speed: "120 rpm*${sense}"}}
forces: {load: {type: force, body: shaft, direction: 0 -1 0, magnitude: 6 kN, axes: "${axes}"}}
bearings:
  bush: {shell: ground, journal: shaft, diameter: 50 mm, width: 25 mm, radial_clearance: 30 um, lubricant: oil,
         grid: {circumferential: "${lines}", axial: 5},
         asperities: {model: greenwood_tripp_fit, roughness: 0.8 um, elastic_factor: 3e-3, composite_modulus: 110 GPa,
                      friction: 0.1},
         supply: {line: widest_gap, pressure: 1 bar},
         wear: {shell: {coefficient: "${shell}"}, journal: {coefficient: "${journal}", around: "${around}"},
                acceleration: "${factor}"}}
simulation: {duration: "${end}", step: "${step}"}
)";

Run run_of(const std::vector<std::string>& overrides) { return Run(overrides, Status::completed, turning); }

/// Worn depths of the middle row at the end, turned so that the largest comes first.
std::vector<double> profile(const Run& run, const std::string& field) {
  constexpr std::size_t n_z = 5;
  const std::size_t n_phi = run.field("phi").size();
  const std::vector<double> all = run.field(field);
  std::vector<double> row(n_phi);
  for (std::size_t i = 0; i < n_phi; ++i) row[i] = all[all.size() - n_phi * n_z + i * n_z + n_z / 2];
  std::rotate(row.begin(), std::max_element(row.begin(), row.end()), row.end());
  return row;
}

/// Volume worn off a surface over the last tenth of a run.
double late_volume(const Run& run, const std::string& series) {
  const std::vector<double> volume = run.series(series);
  return volume.back() - volume[volume.size() - volume.size() / 10];
}

// Seen from the worn surface both films are the same, one in the mirror: in the first the bush stands, in the second
// the journal, around which the film travels. What parts them once they have settled is the grid, over which the fill
// of a film that travels is transported with first order.
TEST_CASE("JournalUnderATurningLoad_WearsAsTheBushUnderAStandingOne") {
  const auto difference = [](int lines) {
    const std::vector<std::string> both{"end=400 ms", "step=1 ms", "factor=20", "lines=" + std::to_string(lines)};
    std::vector<std::string> of_bush = both, of_journal = both;
    for (const char* text : {"axes=ground", "shell=2e-15 1/Pa", "journal=0 1/Pa"}) of_bush.emplace_back(text);
    for (const char* text : {"x=-6.6 um", "x_rate=345.575 um/s", "y_rate=-82.938 um/s"}) of_journal.emplace_back(text);
    const Run bush = run_of(of_bush), journal = run_of(of_journal);
    CHECK(journal.last("worn_volume_fixed") == 0);
    const std::vector<double> on_journal = profile(journal, "moving_wear"), on_bush = profile(bush, "fixed_wear");
    const auto half = static_cast<std::size_t>(lines / 2);
    CHECK(on_journal[half] < 1e-3 * on_journal[0]);  // nothing on the other side but what settling left there
    CHECK(on_bush[half] == 0);
    return std::abs(late_volume(journal, "worn_volume_moving") / late_volume(bush, "worn_volume_fixed") - 1);
  };
  const double coarse = difference(60), fine = difference(120);
  CHECK(coarse < 0.02);
  CHECK(fine < 0.65 * coarse);
}

// Under a load that stands still the difference from even wear is that of the part of a revolution which is not whole.
TEST_CASE("JournalUnderAStandingLoad_WearsAsMuchByPlaceAsEvenly") {
  const std::vector<std::string> model{"axes=ground", "end=500 ms", "step=1 ms", "journal=2e-16 1/Pa"};
  std::vector<std::string> evenly = model;
  evenly.emplace_back("around=even");
  const Run local = run_of(model), even = run_of(evenly);
  CHECK(local.last("worn_volume_moving") == relative(even.last("worn_volume_moving")).epsilon(0.01));
  CHECK(local.last("wear_moving") > even.last("wear_moving"));
  const std::vector<double> around = profile(local, "moving_wear");
  CHECK(*std::min_element(around.begin(), around.end()) > 0);
}

TEST_CASE("JournalThatWearsByPlace_BalancesOilAndPower") {
  const Run run = run_of({}), finer = run_of({"step=0.25 ms"});
  constexpr double of_oil = 1e-9;
  CHECK(std::abs(run.last("oil_unexplained")) < of_oil * run.last("oil_through_flow"));
  CHECK(std::abs(run.summary().bearings[0].energy_error) < 2e-3);  // the film's own on this grid
  CHECK(finer.last("worn_volume_moving") == relative(run.last("worn_volume_moving")).epsilon(0.01));  // first order
}

TEST_CASE("Mirrored_JournalsWearAlike") {
  const Run one = run_of({"end=30 ms"}), mirrored = run_of({"end=30 ms", "sense=-1"});
  constexpr double solved_for = 1e-6;
  CHECK(mirrored.last("worn_volume_moving") == relative(one.last("worn_volume_moving")).epsilon(solved_for));
  CHECK(mirrored.last("wear_moving") == relative(one.last("wear_moving")).epsilon(solved_for));
}

TEST_CASE("ResumedJournalWear_IsTheSame") {
  const model::Model model = model::read_text(turning, "m.yaml", {"end=20 ms"});
  const TemporaryDirectory folder;
  const Summary whole = simulate(model, {.results = folder / "whole.h5"});
  REQUIRE(whole.status == Status::completed);
  std::atomic<bool> stop{false};
  int taken = 0;
  Options part{.results = folder / "parts.h5", .stop = &stop};
  part.on_progress = [&](const Progress&) { stop = ++taken > 15; };  // of 40 steps
  REQUIRE(simulate(model, part).status == Status::stopped);
  const Summary resumed = simulate(model, {.results = folder / "parts.h5", .resume = true});
  REQUIRE(resumed.status == Status::completed);
  const results::Reader a(whole.results), b(resumed.results);
  for (const char* name : {"worn_volume_moving", "wear_moving", "h_min", "power_asperity"})
    CHECK(a.read(std::string("/bearings/bush/") + name).values == b.read(std::string("/bearings/bush/") + name).values);
}

}  // namespace journal_wear_run_test
}  // namespace hersey::run
