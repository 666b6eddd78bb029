#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "hersey/study/bearing_study.h"
#include "relative.h"
#include "temporary_directory.h"

// Thrust pads on pivots as one entry in a machine: their steady motion with the shaft, and what it is equal to.
namespace hersey::study {
namespace thrust_pads_run_test {

std::string film_of(const std::string& name, const std::string& sense, const std::string& point) {
  return fmt::format(R"(  {0}:
    kind: tilting_pad_thrust
    stator: ground{1}
    runner: shaft{1}
    inner_diameter: 100 mm
    outer_diameter: 200 mm
    pads: {{count: 3, arc: 80 deg, offset: 0.6, pivot_radius: 76 mm}}
    sense: {2}
    lubricant: oil
    grid: {{along: 17, radial: 9}}
{3})",
                     name, name == "back" ? ".back" : "", sense, point);
}

std::string machine(double load, const std::string& bearings) {
  return fmt::format(R"(hersey: 1
lubricants: {{oil: {{viscosity: 20 mPa.s}}}}
bodies:
  ground: {{frames: {{back: {{origin: 0 0 30.08 mm, rotation: {{axis: x, angle: 180 deg}}}}}}}}
  shaft: {{mass: 100 kg, inertia: {{xx: 5 kg.m^2, yy: 5 kg.m^2, zz: 1 kg.m^2}}, frames: {{back: {{origin: 0 0 30 mm, rotation: {{axis: x, angle: 180 deg}}}}}}}}
joints:
  turning: {{type: cylindrical, between: [ground, shaft], axis: z, initial: {{translation: 35 um}}}}
drives:
  motor: {{joint: turning, coordinate: rotation, speed: 300 rad/s}}
forces:
  thrust: {{type: force, body: shaft, axes: ground, components: [0 N, 0 N, {} N]}}
simulation: {{analysis: steady}}
bearings:
{})",
                     -load, bearings);
}

class Ran {
 public:
  explicit Ran(const std::string& text, const std::vector<std::string>& overrides = {})
      : summary_(run::simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch_ / "run.h5"})) {
    REQUIRE_MESSAGE(summary_.status == run::Status::completed, summary_.message);
  }
  [[nodiscard]] std::vector<double> last(const std::string& path) const {
    const results::Array array = results::Reader(summary_.results).read(path);
    return {array.values.end() - static_cast<std::ptrdiff_t>(array.width()), array.values.end()};
  }
  [[nodiscard]] double number(const std::string& path) const { return last(path).front(); }

 private:
  TemporaryDirectory scratch_;
  run::Summary summary_;
};

constexpr double solved_for = 1e-6;  // the steady motion is found to 1e-9 of its forces
const std::vector<std::string> series{"film_thickness_axis", "h_min", "p_max", "power_film", "flow_outer"};

TEST_CASE("PadsInAMachine_AreThoseByThemselvesAndWrittenByHand") {
  const std::string text =
      machine(20e3, film_of("main", "positive", "    operating_point: {speed: 300 rad/s, load: 20 kN}\n"));
  const Ran ran(text);
  const BearingSolution alone = BearingSolver().solve(model::read_text(text, "m.yaml"), {.bearing = "main"});
  REQUIRE_MESSAGE(alone.solved(), alone.message);
  CHECK(ran.last("bodies/shaft/position")[2] == relative(alone.state.e[0]).epsilon(solved_for));
  const std::string path = "thrust_pads_run_test.yaml";
  std::ofstream(path) << text;
  const Ran by_hand(model::expanded_text(path, {}));
  std::filesystem::remove(path);
  for (const std::string& key : series)
    CHECK(by_hand.number("bearings/main_pad_2/" + key) ==
          relative(ran.number("bearings/main_pad_2/" + key)).epsilon(1e-9));  // the same equations
  CHECK(alone.state.film.patches.at(1).h_min == relative(ran.number("bearings/main_pad_2/h_min")).epsilon(solved_for));
}

// The films of a bearing are one bearing, too: together they carry what the shaft does.
TEST_CASE("FilmsOfABearing_HaveFiguresTogether") {
  const Ran found(machine(20e3, film_of("main", "positive", "")));
  const std::vector<double> force = found.last("groups/main/force");
  CHECK(force[2] == relative(20e3).epsilon(solved_for));
  CHECK(std::abs(force[0]) + std::abs(force[1]) < solved_for * 20e3);
  double power = 0, thinnest = 1, largest = 0;
  for (int k = 1; k <= 3; ++k) {
    const std::string pad = fmt::format("bearings/main_pad_{}/", k);
    power += found.number(pad + "power_film");
    thinnest = std::min(thinnest, found.number(pad + "h_min"));
    largest = std::max(largest, found.number(pad + "p_max"));
  }
  CHECK(found.number("groups/main/power_film") == relative(power).epsilon(1e-12));  // round-off of sums
  CHECK(found.number("groups/main/h_min") == thinnest);
  CHECK(found.number("groups/main/p_max") == largest);
}

TEST_CASE("PadsOnBothSidesOfACollar_HoldItInTheMiddle") {
  const Ran found(machine(0, film_of("front", "positive", "") + film_of("back", "negative", "")));
  CHECK(found.last("bodies/shaft/position")[2] == relative(40e-6).epsilon(solved_for));  // of 80 um
  for (const std::string& key : series)
    CHECK(found.number("bearings/front_pad_1/" + key) ==
          relative(found.number("bearings/back_pad_1/" + key)).epsilon(solved_for));
}

TEST_CASE("LinePivot_IsAPointThatDoesNotYieldAlongTheRadius") {
  const Ran line(machine(20e3, film_of("main", "positive", "    pivot: {type: rigid, form: line}\n")));
  const std::string path = "thrust_pads_run_test.yaml";
  std::ofstream(path) << machine(20e3, film_of("main", "positive", ""));
  std::string text = model::expanded_text(path, {});
  std::filesystem::remove(path);
  std::string stiff;
  for (int k = 1; k <= 3; ++k)
    stiff += fmt::format(
        "  hold_{0}: {{type: bushing, between: [main_carrier.pivot_{0}, main_pad_{0}.pivot], "
        "rotational_stiffness: [0 N.m/rad, 1e12 N.m/rad, 0 N.m/rad]}}\n",
        k);
  const Ran free(text);
  text.insert(text.find("forces:\n") + 8, stiff);
  const Ran point(text);
  for (const std::string& key : series) {
    const std::string path_of_series = "bearings/main_pad_1/" + key;
    CHECK(point.number(path_of_series) == relative(line.number(path_of_series)).epsilon(solved_for));
  }
  CHECK(std::abs(free.number("bearings/main_pad_1/h_min") / line.number("bearings/main_pad_1/h_min") - 1) > 0.01);
}

TEST_CASE("SettledThrustPads_AreThoseOfTheSteadyMotion") {
  const std::string text = machine(20e3, film_of("main", "positive", ""));
  const Ran steady(text), settled(text, {"simulation={duration: 60 ms, step: 0.5 ms}"});
  for (const std::string& key : series)
    CHECK(settled.number("bearings/main_pad_3/" + key) ==
          relative(steady.number("bearings/main_pad_3/" + key)).epsilon(1e-3));  // what has not settled
}

// Where the shaft begins does not tell where it ends, nor whether it ends anywhere.
TEST_CASE("SteadyMotion_DoesNotDependOnWhereTheShaftBegins") {
  const auto film_from = [](const std::string& start) {
    return Ran(machine(20e3, film_of("front", "positive", "")), {"joints.turning.initial.translation=" + start})
        .number("bearings/front_pad_1/h_min");
  };
  const double reference = film_from("35 um");
  for (const char* start : {"15 um", "25 um", "50 um", "80 um"}) {
    CAPTURE(start);
    CHECK(film_from(start) == relative(reference).epsilon(solved_for));
  }
}

}  // namespace thrust_pads_run_test
}  // namespace hersey::study
