#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hersey/bearing/steady_bearing.h"
#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// A carriage that slides on a way: a plane slider in a machine.
namespace hersey::run {
namespace plane_slider_run_test {

const std::string carriage = R"(hersey: 1
gravity: -9.81 0 0 m/s^2
lubricants:
  oil: {viscosity: 20 mPa.s}
bodies:
  way: {mass: 20 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
  carriage: {mass: 100 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}
joints:
  travel: {type: prismatic, between: [ground, way], axis: y}
  lift: {type: prismatic, between: [ground, carriage], axis: x, initial: {translation: 30 um}}
drives:
  feed: {joint: travel, coordinate: translation, speed: 3 m/s}
bearings:
  pad:
    kind: plane_slider
    pad: carriage
    runner: way
    length: 50 mm
    width: 50 mm
    lubricant: oil
    grid: {along: 21, across: 9}
    shape: [{profile: ramp, rise: 20 um}]
simulation: {duration: 60 ms, step: 1 ms}
)";

double last(const results::Reader& reader, const std::string& series) {
  return reader.read("/bearings/pad/" + series).values.back();
}

// It sinks until the film carries its weight: at the film thickness at which `hersey bearing` finds that load.
TEST_CASE("CarriageOnASlider_SettlesWhereTheFilmCarriesIt") {
  const TemporaryDirectory scratch;
  const Summary summary =
      simulate(model::read_text(carriage, "m.yaml", {"simulation.duration=160 ms"}), {.results = scratch / "run.h5"});
  REQUIRE(summary.status == Status::completed);
  const results::Reader reader(summary.results);
  CHECK(reader.read("/bearings/pad/force").values.size() == 3 * reader.rows());
  CHECK(std::abs(last(reader, "force_pressure")) < 1e-9);  // its z-component: round-off of 981 N

  const model::Model alone =
      model::read_text(carriage, "m.yaml", {"bearings.pad.operating_point={speed: 3 m/s, load: 981 N}"});
  bearing::OperatingPoint point{.journal_speed = 3};
  point.load = bearing::Coordinates::Constant(1, 981);
  point.e_rate = bearing::Coordinates::Zero(1);
  bearing::SteadyState state;
  const film::FilmModel film = bearing::scaled_for(alone.bearings[0].film, point);
  REQUIRE(bearing::solve_steady(film, point, {.kind = alone.bearings[0].kind}, state).solved());
  // What is left of settling after ten time constants, damping over stiffness, of 16 ms.
  CHECK(last(reader, "film_thickness_middle") == relative(-state.e[0]).epsilon(1e-3));
  CHECK(last(reader, "p_max") == relative(state.film.p_max).epsilon(2e-3));  // with the square of the gap
  CHECK(last(reader, "power_film") == relative(state.film.power_film).epsilon(1e-3));
  CHECK(last(reader, "flow_trailing") == relative(state.film.flow_last).epsilon(1e-3));
  CHECK(last(reader, "sliding_speed") == relative(3).epsilon(1e-9));  // the drive's
  CHECK(summary.bearings[0].worst_mass_balance < 1e-6);  // every step is solved to 1e-8 of its largest term
}

// A runner that turns about an axis across the pad: energy and oil are balanced as the pad rocks.
TEST_CASE("RockingRunner_KeepsEnergyAndOil") {
  const TemporaryDirectory scratch;
  std::string rocking = carriage;
  rocking.replace(rocking.find("  travel: {type: prismatic, between: [ground, way], axis: y}\n"),
                  std::string("  travel: {type: prismatic, between: [ground, way], axis: y}\n").size(),
                  "  travel: {type: revolute, between: [ground, way], axis: z}\n");
  rocking.replace(rocking.find("coordinate: translation, speed: 3 m/s"),
                  std::string("coordinate: translation, speed: 3 m/s").size(),
                  "coordinate: rotation, position: {expression: 2e-4*sin(200*t), unit: rad}");
  const Summary summary =
      simulate(model::read_text(rocking, "m.yaml", {"simulation.step=0.1 ms", "simulation.duration=10 ms"}),
               {.results = scratch / "run.h5"});
  CAPTURE(summary.message);
  REQUIRE(summary.status == Status::completed);
  CHECK(summary.worst_power_balance < 1e-6);                 // steps are solved to 1e-8 of their largest term
  CHECK(summary.bearings[0].worst_mass_balance < 1e-6);      // likewise
  CHECK(std::abs(summary.bearings[0].energy_error) < 5e-3);  // of 21 x 9 nodes, second order
  const results::Reader reader(summary.results);
  const std::vector<double> slope = reader.read("/bearings/pad/slope").values;
  double steepest = 0;
  for (const double s : slope) steepest = std::max(steepest, std::abs(s));
  CHECK(steepest == relative(2e-4).epsilon(1e-3));  // steps of a fiftieth of the swing
}

// The same machine partitioned, and with its bodies in the other order: the same motion.
TEST_CASE("SliderPartitionedOrReordered_IsTheSameMachine") {
  const TemporaryDirectory scratch;
  const auto thickness = [&](const char* name, const std::string& text, const std::vector<std::string>& overrides) {
    const Summary summary = simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch / name});
    REQUIRE(summary.status == Status::completed);
    return last(results::Reader(summary.results), "film_thickness_middle");
  };
  const std::vector<std::string> brief{"simulation.duration=6 ms"};
  const double as_it_is = thickness("a.h5", carriage, brief);
  std::string other = carriage;
  const std::size_t way = other.find("  way: {mass"), body = other.find("  carriage: {mass"),
                    end = other.find("joints:");
  other = other.substr(0, way) + other.substr(body, end - body) + other.substr(way, body - way) + other.substr(end);
  CHECK(thickness("b.h5", other, brief) == relative(as_it_is).epsilon(1e-9));  // steps are solved to 1e-8
  CHECK(thickness("c.h5", carriage, {brief.front(), "bearings.pad.coupling={scheme: partitioned}"}) ==
        relative(as_it_is).epsilon(1e-6));  // exchanges end at the same tolerance
}

}  // namespace plane_slider_run_test
}  // namespace hersey::run
