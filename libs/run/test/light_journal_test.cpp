#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "small_rig.h"
#include "temporary_directory.h"

// Journals whose mass is nothing beside the damping of their film: a load pushes them through the oil.
namespace hersey::run {
namespace light_journal_test {

const std::string kSqueezed = R"(hersey: 1
parameters: {mass: 1e-3 kg, step: 0.1 ms}
bodies:
  journal: {mass: "${mass}", inertia: {xx: 0.01 kg.m^2, yy: 0.01 kg.m^2, zz: 0.01 kg.m^2}}
joints:
  slide: {type: prismatic, between: [ground, journal], axis: x, initial: {translation: 25 um}}
forces:
  load: {type: force, body: journal, components: [1000 N, 0 N, 0 N]}
lubricants:
  oil: {viscosity: 20 mPa.s}
bearings:
  main:
    shell: ground
    journal: journal
    diameter: 50 mm
    width: 25 mm
    radial_clearance: 50 um
    lubricant: oil
    grid: {circumferential: 36, axial: 7}
    cavitation: reynolds
    shear_force: torque_only
simulation: {duration: 8 ms, step: "${step}", spectral_radius: 0.8}
)";

std::vector<double> path(const std::vector<std::string>& overrides, const std::string& text = kSqueezed) {
  const TemporaryDirectory scratch;
  const Summary summary = simulate(rig(text, overrides), {.results = scratch / "run.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  return results::Reader(summary.results).read("/joints/slide/coordinates").values;
}

/// The limit of steps so short that they resolve the start.
double reference() {
  static const double end = path({"mass=0 kg", "step=20 us"}).back();
  return end;
}

/// A rod of half a gram floats on a rotating pin under a very small alternating force: it stays within a thousandth of
/// the clearance of the centre or, where the supply pulls it, off it without a load.
std::string floating(const std::string& edge, const std::string& supply, double rate) {
  const std::string push = "components: [0 N, \"-${load}\", 0 N]", rod = "rod: {mass: 0.5 kg";
  std::string text = rig_with("supply: {line: widest_gap, pressure: 1 bar}",
                              "supply: {line: widest_gap, pressure: " + supply + " bar}\n    edge_pressure: " + edge +
                                  " bar\n    cavitation: guembel");
  text.replace(text.find(push), push.size(),
               "direction: y, magnitude: {expression: \"-0.05*sin(" + std::to_string(rate) + "*t)\", unit: N}");
  return text.replace(text.find(rod), rod.size(), "rod: {mass: 0.5 g");
}

// The widest gap moves around the centre for very small motions, and a vanishing resultant is a sum with round-off:
// steps were cut to nanoseconds for both, and the run ended there.
TEST_CASE("JournalWithoutALoad_IsStoppedByNoRoundOffAndNoSupply") {
  const TemporaryDirectory scratch;
  for (const char* edge : {"0", "0.3", "1"}) {
    for (const char* supply : {"0", "0.5", "1"}) {
      for (const double rate : {400.0, 2000.0}) {
        CAPTURE(edge);
        CAPTURE(supply);
        CAPTURE(rate);
        const Summary summary = simulate(rig(floating(edge, supply, rate), {"duration=8 ms"}),
                                         {.results = scratch / "run.h5", .overwrite = true});
        CAPTURE(summary.message);
        CHECK(summary.status == Status::completed);
        CHECK(summary.rejected_steps <= 5);  // where it begins to move
      }
    }
  }
}

TEST_CASE("LightJournal_FollowsItsLoadFromTheFirstStep") {
  for (const char* mass : {"1 kg", "1e-3 kg", "1e-6 kg"}) {
    CAPTURE(std::string(mass));
    const std::vector<double> x = path({std::string("mass=") + mass});
    CHECK(x.front() == doctest::Approx(25e-6).epsilon(1e-14));  // round-off of the unit
    CHECK(std::is_sorted(x.begin(), x.end()));
    CHECK(x.back() == doctest::Approx(reference()).epsilon(1e-4));  // steps of second order
  }
}

TEST_CASE("LightJournal_KeepsOrderTwo") {
  const double coarse = path({"step=0.4 ms"}).back() - reference(), fine = path({"step=0.2 ms"}).back() - reference();
  CHECK(std::log2(coarse / fine) == doctest::Approx(2).epsilon(0.1));
}

TEST_CASE("JournalWithoutMass_IsTheLimitOfALightOne") {
  const std::vector<double> without = path({"mass=0 kg"});
  for (const char* mass : {"1e-3 kg", "1e-6 kg"}) {
    CAPTURE(std::string(mass));
    const std::vector<double> with = path({std::string("mass=") + mass});
    REQUIRE(with.size() == without.size());
    // A step of it starts with a delay of mass over damping: 1 g over 1e5 N s/m.
    for (std::size_t i = 0; i < with.size(); ++i) CHECK(std::abs(with[i] - without[i]) < 1e-6 * without[i]);
  }
}

TEST_CASE("MassThatNothingHolds_IsAskedFor") {
  // The film holds the journal across its axis, not along it.
  std::string text = kSqueezed;
  const std::string slide = "type: prismatic, between: [ground, journal], axis: x, initial: {translation: 25 um}";
  text.replace(text.find(slide), slide.size(), "type: prismatic, between: [ground, journal], axis: z");
  try {
    check(rig(text, {"mass=0 kg"}));
    FAIL("it started");
  } catch (const InputError& error) {
    const Fault& fault = error.faults().front();
    CAPTURE(fault.text());
    CHECK(fault.path == "joints.slide");
    CHECK(fault.found.find("nothing determines the motion of joint slide, translation") != std::string::npos);
    CHECK(fault.suggestion.find("mass") != std::string::npos);
  }
}

}  // namespace light_journal_test
}  // namespace hersey::run
