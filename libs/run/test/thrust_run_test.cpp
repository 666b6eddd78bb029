#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "hersey/core/input_error.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// Thrust bearings in machines: a shaft on one, between two, and on pads that are bodies on pivots.
namespace hersey::run {
namespace thrust_run_test {

class Ran {
 public:
  explicit Ran(const std::string& text, const std::vector<std::string>& overrides = {})
      : summary_(simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch_ / "run.h5"})) {
    REQUIRE_MESSAGE(summary_.status == Status::completed, summary_.message);
  }

  /// Last row of a series.
  [[nodiscard]] std::vector<double> last(const std::string& path) const {
    const results::Array array = results::Reader(summary_.results).read(path);
    return {array.values.end() - static_cast<std::ptrdiff_t>(array.width()), array.values.end()};
  }
  [[nodiscard]] double number(const std::string& path) const { return last(path).front(); }
  [[nodiscard]] const Summary& summary() const { return summary_; }

 private:
  TemporaryDirectory scratch_;
  Summary summary_;
};

const std::string collar = R"(hersey: 1
lubricants: {oil: {viscosity: 20 mPa.s}}
bodies:
  shaft: {mass: 100 kg, inertia: {xx: 5 kg.m^2, yy: 5 kg.m^2, zz: 1 kg.m^2}}
joints:
  turning: {type: cylindrical, between: [ground, shaft], axis: z, initial: {translation: 40 um}}
drives:
  motor: {joint: turning, coordinate: rotation, speed: 300 rad/s}
forces:
  thrust: {type: force, body: shaft, axes: ground, components: [0 N, 0 N, -5 kN]}
bearings:
  main:
    kind: thrust
    stator: ground
    runner: shaft
    inner_diameter: 100 mm
    outer_diameter: 200 mm
    pads: {count: 3, arc: 50 deg}
    shape: [{profile: ramp, rise: 20 um}]
    lubricant: oil
    grid: {along: 13, radial: 9}
simulation: {analysis: steady}
)";

// A shaft that is let go sinks to where `analysis: steady` finds it at once, and where the film carries the thrust.
TEST_CASE("ShaftOnAThrustBearing_SettlesAtItsSteadyMotion") {
  const Ran steady(collar), settled(collar, {"simulation={duration: 40 ms, step: 0.5 ms}"});
  const std::string film = "bearings/main/";
  CHECK(steady.last(film + "force")[2] == relative(-5000).epsilon(1e-7));  // the film on the stator; Newton's tolerance
  for (const char* series : {"film_thickness_axis", "h_min", "p_max", "power_film", "torque_runner", "flow_outer",
                             "flow_leading", "runner_speed", "p_max_r"}) {
    CAPTURE(series);
    // What is left of settling after some ten time constants, damping over stiffness.
    CHECK(settled.number(film + series) == relative(steady.number(film + series)).epsilon(1e-3));
  }
  CHECK(settled.summary().bearings[0].worst_mass_balance < 1e-6);  // every step is solved to 1e-8 of its largest term
  CHECK(settled.summary().worst_power_balance < 1e-6);             // likewise
}

// Two bearings on both sides of a collar: without a thrust the collar floats in the middle, whichever side is which.
TEST_CASE("CollarBetweenTwoBearings_FloatsInTheMiddle") {
  std::string both = collar;
  const std::size_t pads = both.find("simulation:");
  // Behind the collar, of 30 mm, both frames have their z the other way, and the shaft turns them backwards.
  both.insert(pads, R"(  back:
    kind: thrust
    stator: ground.back
    runner: shaft.back
    sense: negative
    inner_diameter: 100 mm
    outer_diameter: 200 mm
    pads: {count: 3, arc: 50 deg}
    shape: [{profile: ramp, rise: 20 um}]
    lubricant: oil
    grid: {along: 13, radial: 9}
)");
  const std::string rotation = "rotation: {axis: x, angle: 180 deg}";
  both.replace(both.find("zz: 1 kg.m^2}}"), std::string("zz: 1 kg.m^2}}").size(),
               "zz: 1 kg.m^2}, frames: {back: {origin: 0 0 30 mm, " + rotation +
                   "}}}\n  ground: {frames: {back: {origin: "
                   "0 0 30.08 mm, " +
                   rotation + "}}}");
  const Ran free(both, {"forces.thrust.components=[0 N, 0 N, 0 N]", "joints.turning.initial.translation=30 um"}),
      pushed(both);
  CHECK(free.number("bearings/main/film_thickness_axis") == relative(40e-6).epsilon(1e-7));  // of 80 um; Newton's
  CHECK(free.number("bearings/back/film_thickness_axis") == relative(40e-6).epsilon(1e-7));  // likewise
  CHECK(free.number("bearings/main/h_min") == relative(free.number("bearings/back/h_min")).epsilon(1e-7));  // likewise
  CHECK(free.number("bearings/main/torque_runner") ==
        relative(-free.number("bearings/back/torque_runner")).epsilon(1e-6));        // both brake the shaft
  CHECK(free.number("bearings/back/runner_speed") == relative(-300).epsilon(1e-9));  // the drive's
  CHECK(pushed.number("bearings/main/film_thickness_axis") < 40e-6);
  // Each film pushes its stator away from the collar, against its own z.
  CHECK(-pushed.last("bearings/main/force")[2] + pushed.last("bearings/back/force")[2] ==
        relative(5000).epsilon(1e-6));  // Newton's tolerance
}

constexpr double degree = std::numbers::pi / 180;

/// One pad of 50 degrees, 50 to 100 mm, on a pivot in its face, 30 degrees behind its leading edge at 76 mm, below a
/// runner that turns at 300 rad/s and is pressed on it by the load [N].
std::string pivoted(double load, double turned, const std::string& simulation) {
  const double x = 0.076 * std::cos(turned * degree), y = 0.076 * std::sin(turned * degree);
  const std::string pivot = fmt::format("{{origin: [{:.17g} m, {:.17g} m, 0 m]}}", x, y);
  return fmt::format(R"(hersey: 1
lubricants: {{oil: {{viscosity: 20 mPa.s}}}}
bodies:
  ground: {{frames: {{p: {0}}}}}
  pad: {{mass: 0.5 kg, inertia: {{xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}, frames: {{face: {{origin: 0 0 0 m}}, pivot: {0}}}}}
  runner: {{mass: 100 kg, inertia: {{xx: 5 kg.m^2, yy: 5 kg.m^2, zz: 1 kg.m^2}}}}
joints:
  turning: {{type: cylindrical, between: [ground, runner], axis: z, initial: {{translation: 40 um}}}}
  pivot: {{type: universal, between: [ground.p, pad.pivot], axis: z}}
drives:
  motor: {{joint: turning, coordinate: rotation, speed: 300 rad/s}}
forces:
  thrust: {{type: force, body: runner, axes: ground, components: [0 N, 0 N, {1:.17g} N]}}
bearings:
  pad:
    kind: thrust
    stator: pad.face
    runner: runner
    inner_diameter: 100 mm
    outer_diameter: 200 mm
    pads: {{count: 1, arc: 50 deg, angle: {2:.17g} deg}}
    lubricant: oil
    grid: {{along: 41, radial: 31}}
simulation: {3}
)",
                     pivot, -load, turned - 5, simulation);
}

// Of an independent solution on three grids: at W h_p^2/(mu omega r_o^4) = 0.016784 the film at the pivot is h_p, and
// the pad leans by 1.1161 h_p/r_o along and 0.0762 h_p/r_o across the sliding direction there.
TEST_CASE("PivotedPad_MeetsAnIndependentSolution_AtAnyAngle") {
  constexpr double h_p = 30e-6, r_o = 0.1;
  const double load = 0.01678395 * 0.02 * 300 * std::pow(r_o, 4) / (h_p * h_p);
  for (const double turned : {0.0, 77.0}) {
    CAPTURE(turned);
    const Ran found(pivoted(load, turned, "{analysis: steady}"));
    const std::vector<double> tilt = found.last("bearings/pad/runner_tilt");
    const double c = std::cos(turned * degree), s = std::sin(turned * degree);
    const double outwards = tilt[0] * c + tilt[1] * s, onwards = -tilt[0] * s + tilt[1] * c;
    constexpr double of_grid = 5e-3;  // (1/30)^2 times some five
    CHECK(onwards * r_o / h_p == relative(1.11609).epsilon(of_grid));
    CHECK(outwards * r_o / h_p == relative(-0.076249).epsilon(4 * of_grid));  // a small part of the tilt
    CHECK(found.number("bearings/pad/h_min") == relative(0.631977 * h_p).epsilon(of_grid));
    const double at_pivot = found.number("bearings/pad/film_thickness_axis") - outwards * 0.076;
    CHECK(at_pivot == relative(h_p).epsilon(of_grid));
    CHECK(found.number("bearings/pad/flow_outer") == relative(0.0618792 * 300 * r_o * r_o * h_p).epsilon(4 * of_grid));
    const double power = 0.2056619 * 0.02 * 300 * 300 * std::pow(r_o, 4) / h_p;
    CHECK(found.number("bearings/pad/power_film") == relative(power).epsilon(of_grid));
    // The stator's force goes through the pivot, and runner and pad feel the same wrench.
    const std::vector<double> force = found.last("bearings/pad/force"), moment = found.last("bearings/pad/moment");
    CHECK(force[2] == relative(-load).epsilon(5e-6));  // along the pad's axis: a slope of 3e-4 of the shear force
    CHECK(std::abs(moment[0] - 0.076 * s * force[2]) < 1e-6 * load * r_o);  // likewise
    CHECK(std::abs(moment[1] + 0.076 * c * force[2]) < 1e-6 * load * r_o);  // likewise
  }
}

// Between the parallel surfaces of the start nothing but round-off decides whether there is a film.
TEST_CASE("PivotedPad_IsFoundFromAnyParallelGap") {
  const Ran near(pivoted(10000, 0, "{analysis: steady}"));
  for (const char* gap : {"35 um", "40.1 um", "45 um", "50 um"}) {
    CAPTURE(gap);
    const Ran far(pivoted(10000, 0, "{analysis: steady}"), {std::string("joints.turning.initial.translation=") + gap});
    CHECK(far.number("bearings/pad/h_min") == relative(near.number("bearings/pad/h_min")).epsilon(1e-7));  // Newton's
  }
}

// In time the pad finds its tilt.
TEST_CASE("PivotedPad_SettlesAtItsSteadyMotion") {
  const std::vector<std::string> coarse{"bearings.pad.grid={along: 13, radial: 9}"};
  const Ran steady(pivoted(10000, 20, "{analysis: steady}"), coarse),
      settled(pivoted(10000, 20, "{duration: 30 ms, step: 0.25 ms}"), coarse);
  for (const char* series : {"film_thickness_axis", "h_min", "p_max", "power_film"}) {
    CAPTURE(series);
    CHECK(settled.number(std::string("bearings/pad/") + series) ==
          relative(steady.number(std::string("bearings/pad/") + series)).epsilon(2e-3));  // what is left of settling
  }
}

}  // namespace thrust_run_test
}  // namespace hersey::run
