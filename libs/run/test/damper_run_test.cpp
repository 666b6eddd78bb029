#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "hersey/bearing/steady_bearing.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// A squeeze-film damper between moving bodies.
namespace hersey::run {
namespace damper_run_test {

const std::string damper = R"(hersey: 1
gravity: 0 0 0 m/s^2
bodies: {journal: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}}
joints: {orbit: {type: planar, between: [ground, journal], axis: z, initial: {x: 60 um}}}
drives:
  x: {joint: orbit, coordinate: x, position: {expression: '60e-6*cos(100*t)', unit: m}}
  y: {joint: orbit, coordinate: y, position: {expression: '60e-6*sin(100*t)', unit: m}}
  hold: {joint: orbit, coordinate: rotation, speed: 0 rpm}
lubricants: {oil: {viscosity: 10 mPa.s, density: 850 kg/m^3}}
bearings:
  damper:
    kind: squeeze_film_damper
    shell: ground
    journal: journal
    diameter: 100 mm
    width: 50 mm
    radial_clearance: 100 um
    lubricant: oil
    cavitation: full_film
    edge_pressure: {leakage: 0.5}
    grid: {circumferential: 60, axial: 9}
    operating_point: {whirl_speed: 100 rad/s, orbit_ratio: 0.6}
simulation: {duration: 10 ms, step: 1 ms}
)";

/// Force on the shell outwards and from x towards y, at the last instant of a prescribed orbit.
std::array<double, 2> force_of_run(const std::vector<std::string>& overrides) {
  const TemporaryDirectory scratch;
  const Summary summary = simulate(model::read_text(damper, "m.yaml", overrides), {.results = scratch / "run.h5"});
  REQUIRE_MESSAGE(summary.status == Status::completed, summary.message);
  const results::Array force = results::Reader(summary.results).read("bearings/damper/force");
  const results::Array time = results::Reader(summary.results).read("time");
  const double angle = 100 * time.values.back(), cosine = std::cos(angle), sine = std::sin(angle);
  const auto last = force.values.end() - static_cast<std::ptrdiff_t>(force.width());
  return {last[0] * cosine + last[1] * sine, -last[0] * sine + last[1] * cosine};
}

std::array<double, 2> force_of_orbit(const std::vector<std::string>& overrides) {
  const model::Model model = model::read_text(damper, "m.yaml", overrides);
  const model::Bearing& bearing = model.bearings.front();
  const auto& given = std::get<model::DamperPoint>(*bearing.operating_point);
  bearing::OperatingPoint point{.whirl_speed = given.whirl_speed};
  point.e = Eigen::Vector2d(given.orbit_ratio * bearing.film.c, 0);
  bearing::SteadyState state;
  const bearing::SteadySummary summary =
      bearing::solve_steady(bearing::scaled_for(bearing.film, point), point, {.kind = bearing.kind}, state);
  REQUIRE_MESSAGE(summary.solved(), summary.message);
  return {state.load[0], state.load[1]};  // the orbit's axes: x radial
}

// A film without a fill fraction has no past: any instant of a prescribed orbit is the steady one.
TEST_CASE("PrescribedOrbit_HasTheForceOfTheSteadyOne") {
  for (const std::string cavitation : {"full_film", "guembel"}) {
    CAPTURE(cavitation);
    const std::vector<std::string> set{"bearings.damper.cavitation=" + cavitation};
    const auto run = force_of_run(set), steady = force_of_orbit(set);
    const double scale = std::hypot(steady[0], steady[1]);
    // Wedge and squeeze are interpolated differently: of the grid's second order.
    CHECK(std::abs(run[0] - steady[0]) < 3e-3 * scale);
    CHECK(std::abs(run[1] - steady[1]) < 3e-3 * scale);
  }
}

}  // namespace damper_run_test
}  // namespace hersey::run
