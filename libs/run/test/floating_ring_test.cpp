#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// A ring between two films whose speed is an unknown of the steady motion (theory manual, integrator.36).
namespace hersey::run {
namespace floating_ring_test {

// Both films are fed by a line at their own widest gap.
const std::string rig = R"(hersey: 1
gravity: 0 0 0 m/s^2
parameters: {load: 40 N, driven: 6000 rad/s}
lubricants:
  inner: {viscosity: 8 mPa.s}
  outer: {viscosity: 12 mPa.s}
bodies:
  shaft: {mass: 100 g, inertia: {xx: 1e-5 kg.m^2, yy: 1e-5 kg.m^2, zz: 1e-6 kg.m^2}}
  ring: {mass: 5 g, inertia: {xx: 2e-7 kg.m^2, yy: 2e-7 kg.m^2, zz: 2.5e-7 kg.m^2}}
joints:
  shaft: {type: planar, between: [ground, shaft], axis: z, initial: {y: -5 um}}
  ring: {type: planar, between: [ground, ring], axis: z, initial: {y: -4 um, rotation_rate: 1000 rad/s}}
drives:
  motor: {joint: shaft, coordinate: rotation, speed: "${driven}"}
forces:
  load: {type: force, body: shaft, components: [0 N, "-${load}", 0 N]}
bearings:
  inner: {shell: ring, journal: shaft, diameter: 11 mm, width: 7 mm, radial_clearance: 20 um, lubricant: inner,
          cavitation: reynolds, supply: {line: widest_gap}, grid: {circumferential: 90, axial: 13},
          cavitated_shear: full, shear_force: torque_only}
  outer: {shell: ground, journal: ring, diameter: 17 mm, width: 9 mm, radial_clearance: 40 um, lubricant: outer,
          cavitation: reynolds, supply: {line: widest_gap}, grid: {circumferential: 90, axial: 13},
          cavitated_shear: full, shear_force: torque_only}
simulation: {analysis: steady}
)";

class Steady {
 public:
  explicit Steady(const std::vector<std::string>& overrides = {})
      : summary_(simulate(model::read_text(rig, "m.yaml", overrides), {.results = scratch_ / "run.h5"})) {
    REQUIRE_MESSAGE(summary_.status == Status::completed, summary_.message);
  }
  /// Last row of a series of a bearing.
  [[nodiscard]] std::vector<double> row(const std::string& bearing, const std::string& key) const {
    const results::Array array = results::Reader(summary_.results).read("bearings/" + bearing + "/" + key);
    return {array.values.end() - static_cast<std::ptrdiff_t>(array.width()), array.values.end()};
  }
  [[nodiscard]] double number(const std::string& bearing, const std::string& key) const {
    return row(bearing, key).front();
  }
  /// Speed of the ring over that of the shaft.
  [[nodiscard]] double ratio() const { return number("outer", "speed") / 6000; }

 private:
  TemporaryDirectory scratch_;
  Summary summary_;
};

// W = 40 N of floating_ring.json, shear over the whole gap: its grids differ by 1e-4 in the ratio, 7e-4 in
// eccentricity.
TEST_CASE("LoadedRing_IsThatOfAnIndependentSolution") {
  const Steady ring;
  CHECK(ring.ratio() == relative(0.18897253).epsilon(5e-3));                                // the bar of the reference
  CHECK(ring.number("inner", "eccentricity_ratio") == relative(0.19974690).epsilon(5e-3));  // the same
  CHECK(ring.number("outer", "eccentricity_ratio") == relative(0.54734594).epsilon(5e-3));  // the same
  CHECK(-ring.number("inner", "torque_journal") == relative(0.014613448).epsilon(5e-3));    // the same
  constexpr double solved = 1e-6;  // equations of the steady motion, over the largest term
  // No torque is left on the ring: what the inner film puts on its shell balances what the outer one takes.
  CHECK(ring.number("inner", "torque_shell") == relative(-ring.number("outer", "torque_journal")).epsilon(solved));
  // Each film carries the load, and torques about both axes differ by force times eccentricity.
  for (const std::string film : {"inner", "outer"}) {
    const std::vector<double> force = ring.row(film, "force"), e = ring.row(film, "eccentricity");
    CHECK(std::hypot(force[0], force[1]) == relative(40).epsilon(solved));
    const double difference = -ring.number(film, "torque_journal") - ring.number(film, "torque_shell");
    CHECK(difference == relative(std::abs(e[0] * force[1] - e[1] * force[0])).epsilon(solved));
  }
}

// Without load both films are concentric: mu omega R^3 L/c on either side.
TEST_CASE("ConcentricRing_RotatesAtTheClosedForm") {
  const Steady ring({"load=1 mN", "joints.shaft.initial.y=0 um", "joints.ring.initial.y=0 um"});
  const double outer = 12e-3 * std::pow(8.5, 3) * 9 / 40, inner = 8e-3 * std::pow(5.5, 3) * 7 / 20;
  CHECK(ring.ratio() == relative(1 / (1 + outer / inner)).epsilon(1e-6));  // of second order in the load, 2e-5 W
}

// A ring that is held is a shell: the shaft runs as in a bore that rests.
TEST_CASE("LockedRing_IsAPlainBearing") {
  const std::vector<std::string> held{"drives.hold={joint: ring, coordinate: rotation, speed: 0 rpm}",
                                      "drives.x={joint: ring, coordinate: x, position: 0 um}",
                                      "drives.y={joint: ring, coordinate: y, position: 0 um}",
                                      "joints.ring.initial={y: 0 um}"};
  std::vector<std::string> without = held;
  without.emplace_back("bearings.inner.shell=ground");
  const Steady locked(held), plain(without);
  for (const std::string figure : {"eccentricity_ratio", "torque_journal", "p_max"})
    CHECK(locked.number("inner", figure) == relative(plain.number("inner", figure)).epsilon(1e-8));  // the search's end
  CHECK(std::abs(locked.ratio()) < 1e-12);                                                           // round-off
}

}  // namespace floating_ring_test
}  // namespace hersey::run
