#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// A rod that slides in a sleeve, as a valve in its guide: a journal film that is dragged along its axis.
namespace hersey::run {
namespace sleeve_run_test {

constexpr double R = 4e-3, L = 30e-3, c = 25e-6, mu = 0.01;

const std::string guide = R"(hersey: 1
lubricants:
  oil: {viscosity: 10 mPa.s}
bodies:
  guide: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
  valve: {mass: 0.1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
  ground: {frames: {rod: {origin: 10 0 0 um}}}
joints:
  guide: {type: prismatic, between: [ground, guide], axis: z}
  valve: {type: prismatic, between: [ground.rod, valve], axis: z}
drives:
  guide: {joint: guide, coordinate: translation, speed: 0 m/s}
  valve: {joint: valve, coordinate: translation, speed: 2 m/s}
bearings:
  stem:
    shell: guide
    journal: valve
    diameter: 8 mm
    width: 30 mm
    radial_clearance: 25 um
    lubricant: oil
    grid: {circumferential: 36, axial: 13}
    ambient_fill: 1
simulation: {duration: 4 ms, step: 1 ms}
)";

/// The last force on the guide, and the last of a series.
struct Last {
  double x, z;
  double power, error;
};

Last last_of(const std::vector<std::string>& overrides) {
  const TemporaryDirectory scratch;
  const Summary summary = simulate(model::read_text(guide, "m.yaml", overrides), {.results = scratch / "run.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  CHECK(summary.bearings[0].worst_mass_balance < 1e-6);  // steps are solved to 1e-8 of their largest term
  const results::Reader reader(summary.results);
  const std::vector<double> force = reader.read("/bearings/stem/force").values;
  return {force[force.size() - 3], force.back(), reader.read("/bearings/stem/power_film").values.back(),
          reader.read("/bearings/stem/power_error").values.back()};
}

// Between parallel surfaces no pressure arises: the drag of Couette flow, Petrov's with eccentricity.
TEST_CASE("RodThatSlides_IsDraggedAlongItsGuide") {
  const double drag = mu * 2 * 2 * std::numbers::pi * R * L / std::sqrt(c * c - 1e-10);  // of an eccentricity of 10 um
  const Last rod = last_of({});
  CHECK(rod.z == relative(drag).epsilon(1e-6));          // periodic sums over 36 lines of a smooth function
  CHECK(rod.power == relative(2 * drag).epsilon(1e-6));  // likewise
  CHECK(std::abs(rod.x) < 1e-6 * drag);                  // no pressure: round-off
  // Only the speed of one against the other counts, and its sign.
  const Last sleeve = last_of({"drives.valve.speed=0 m/s", "drives.guide.speed=-2 m/s"});
  CHECK(sleeve.z == relative(rod.z).epsilon(1e-9));                                   // the same film
  CHECK(last_of({"drives.valve.speed=-2 m/s"}).z == relative(-rod.z).epsilon(1e-9));  // likewise
}

// A bore that narrows along the motion builds a pressure by the wedge; against it the oil cavitates, and a bore seen
// from its other end is the same. The shape belongs to the guide, so that a moving guide takes its wedge along.
TEST_CASE("TaperedGuide_CarriesItsRodByTheWedge") {
  const auto tapered = [](const std::string& rise, const std::string& valve, const std::string& sleeve) {
    return last_of({"bearings.stem.shape=[{profile: taper, rise: " + rise + "}]", "drives.valve.speed=" + valve,
                    "drives.guide.speed=" + sleeve});
  };
  const Last narrowing = tapered("-20 um", "2 m/s", "0 m/s"), widening = tapered("20 um", "2 m/s", "0 m/s");
  // The rod lies off towards x, where its film is thinner and bears more: the guide is pushed there.
  CHECK(narrowing.x > 0.1);
  CHECK(std::abs(widening.x) < 1e-3 * narrowing.x);
  CHECK(std::abs(narrowing.error) < 1e-2 * narrowing.power);  // of 13 rows, second order
  const Last turned = tapered("20 um", "-2 m/s", "0 m/s"), moving = tapered("-20 um", "0 m/s", "-2 m/s");
  CHECK(turned.x == relative(narrowing.x).epsilon(1e-6));   // steps are solved to 1e-8
  CHECK(turned.z == relative(-narrowing.z).epsilon(1e-6));  // likewise
  CHECK(moving.x == relative(narrowing.x).epsilon(1e-6));   // likewise
}

}  // namespace sleeve_run_test
}  // namespace hersey::run
