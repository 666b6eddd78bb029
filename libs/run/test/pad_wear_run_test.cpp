#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "relative.h"
#include "temporary_directory.h"

// Pads that wear, and the one moving surface that all of them wear.
namespace hersey::run {
namespace pad_wear_run_test {

class Run {
 public:
  explicit Run(const std::string& text, const std::vector<std::string>& overrides = {})
      : summary_(simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch_ / "run.h5"})) {
    INFO(summary_.message);
    REQUIRE(summary_.status == Status::completed);
  }

  [[nodiscard]] std::vector<double> series(const std::string& path) const {
    return results::Reader(summary_.results).read(path).values;
  }
  [[nodiscard]] double last(const std::string& path) const { return series(path).back(); }
  /// Sum over bearings of this name and a number from 1.
  [[nodiscard]] double sum(const std::string& name, int count, const std::string& key) const {
    double sum = 0;
    for (int k = 1; k <= count; ++k) sum += last(fmt::format("bearings/{}{}/{}", name, k, key));
    return sum;
  }

 private:
  TemporaryDirectory scratch_;
  Summary summary_;
};

/// A shaft that a load presses into a bore of three arcs, which wear, and which wear it.
std::string three_arcs(bool is_one_film) {
  std::string text = R"(hersey: 1
parameters: {end: 20 ms, sense: 1, around: even, group: journal, shell: 2e-15 1/Pa, journal: 1e-15 1/Pa}
lubricants: {oil: {viscosity: 30 mPa.s, density: 860 kg/m^3}}
bodies:
  shaft: {mass: 20 kg, inertia: {xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 6e-3 kg.m^2}}
joints: {turning: {type: planar, between: [ground, shaft], axis: z, initial: {x: "0.5 um*${sense}", y: -28.3 um, rotation_rate: "120 rpm*${sense}"}}}
drives: {motor: {joint: turning, coordinate: rotation, speed: "120 rpm*${sense}"}}
forces: {load: {type: force, body: shaft, components: [{expression: "3000*sin(200*t)*${sense}", unit: N}, -6 kN, 0 N], axes: ground}}
bearings:
)";
  const auto add = [&](const std::string& name, const std::string& bore, const std::string& group) {
    text += "  " + name +
            R"(: {shell: ground, journal: shaft, diameter: 50 mm, width: 25 mm, radial_clearance: 30 um, lubricant: oil,
         cavitation: reynolds, grid: {circumferential: 72, axial: 5}, )" +
            bore + R"(,
         asperities: {model: greenwood_tripp_fit, roughness: 0.8 um, elastic_factor: 3e-3, composite_modulus: 110 GPa,
                      friction: 0.1},
         wear: {shell: {coefficient: "${shell}"}, journal: {coefficient: "${journal}", around: "${around}")" +
            group + R"(}, acceleration: 5000, running_in: {roughness: 0.3 um, depth: 2 um}}}
)";
  };
  if (is_one_film)
    add("bore1", "bore: {type: lobes, count: 3, preload: 0.1, groove: 20 deg, angle: 30 deg}", "");
  else
    for (int k = 1; k <= 3; ++k)
      add(fmt::format("arc{}", k),
          fmt::format("arcs: {{pad: {{middle: {} deg, arc: 100 deg, preload: 0.1}}}}", 120 * k - 90),
          ", group: \"${group}\"");
  return text + "simulation: {duration: \"${end}\", step: 0.5 ms}\n";
}

// One film on three arcs has one journal; three films on an arc each have it where they name it.
TEST_CASE("FilmsOfOneWornJournal_WearAsOneFilmOnAllTheirArcs") {
  constexpr double solved_for = 1e-6;  // steps are solved to 1e-8 of their largest term
  for (const std::string around : {"around=even", "around=local"}) {
    CAPTURE(around);
    const Run one(three_arcs(true), {around}), three(three_arcs(false), {around});
    for (const char* key : {"worn_volume_fixed", "worn_volume_moving", "power_film", "power_asperity", "wear_rate"})
      CHECK(three.sum("arc", 3, key) == relative(one.sum("bore", 1, key)).epsilon(solved_for));
    double thinnest = 1, deepest = 0;
    for (int k = 1; k <= 3; ++k) {
      thinnest = std::min(thinnest, three.last(fmt::format("bearings/arc{}/h_min", k)));
      deepest = std::max(deepest, three.last(fmt::format("bearings/arc{}/wear_moving", k)));
    }
    CHECK(thinnest == relative(one.last("bearings/bore1/h_min")).epsilon(solved_for));
    CHECK(deepest == relative(one.last("bearings/bore1/wear_moving")).epsilon(solved_for));
    CHECK(three.last("bearings/arc3/worn_volume_fixed") > 0);
    // Arcs that carry nothing meet the journal that the loaded one has worn, by place once it has come round to them.
    CHECK(three.last("bearings/arc1/worn_volume_moving") == 0);
    CHECK(three.last("bearings/arc1/wear_moving") == three.last("bearings/arc3/wear_moving"));
  }
}

TEST_CASE("FilmsOfOwnSurfaces_DoNotSeeEachOthersWear_AndAGroupOfOneIsNone") {
  std::string apart = three_arcs(false);
  for (int k = 1; k <= 3; ++k) apart.replace(apart.find("\"${group}\""), 10, "own" + std::to_string(k));
  const Run run(apart, {"end=5 ms"});
  CHECK(run.last("bearings/arc1/wear_moving") == 0);
  CHECK(run.last("bearings/arc3/wear_moving") > 0);
  const std::string group = ", group: own";
  for (int k = 1; k <= 3; ++k) apart.erase(apart.find(group), group.size() + 1);
  const Run without(apart, {"end=5 ms"});
  for (const char* key : {"h_min", "power_film", "wear_moving", "worn_volume_moving"})
    CHECK(run.series(std::string("bearings/arc3/") + key) == without.series(std::string("bearings/arc3/") + key));
}

/// A shaft that turns slowly on tilting pads, heavily loaded.
const std::string pads = R"(hersey: 1
parameters: {end: 5 ms, step: 0.1 ms, sense: 1, shell: 2e-15 1/Pa, journal: 1e-15 1/Pa}
lubricants: {oil: {viscosity: 3 mPa.s, density: 860 kg/m^3}}
bodies:
  shaft: {mass: 20 kg, inertia: {xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 6e-3 kg.m^2}}
joints: {turning: {type: planar, between: [ground, shaft], axis: z, initial: {y: -16 um, rotation_rate: "60 rpm*${sense}"}}}
drives: {motor: {joint: turning, coordinate: rotation, speed: "60 rpm*${sense}"}}
forces: {load: {type: force, body: shaft, components: ["${sense}*1 kN", -6 kN, 0 N], axes: ground}}
bearings:
  front: {kind: tilting_pad, shell: ground, journal: shaft, diameter: 50 mm, width: 25 mm, radial_clearance: 30 um,
          lubricant: oil, grid: {circumferential: 72, axial: 5}, pads: {count: 4, arc: 70 deg, load: on_pad},
          asperities: {model: greenwood_tripp_fit, roughness: 0.8 um, elastic_factor: 3e-3, composite_modulus: 110 GPa,
                       friction: 0.1},
          wear: {shell: {coefficient: "${shell}"}, journal: {coefficient: "${journal}"}, acceleration: 5000}}
simulation: {duration: "${end}", step: "${step}"}
)";

TEST_CASE("TiltingPads_WearWithTheirJournal") {
  const Run run(pads);
  const double fixed = run.sum("front_pad_", 4, "worn_volume_fixed"),
               moving = run.sum("front_pad_", 4, "worn_volume_moving");
  CHECK(fixed > 0);
  constexpr double round_off = 1e-9;
  CHECK(moving == relative(fixed / 2).epsilon(round_off));  // by the ratio of the coefficients
  CHECK(run.last("groups/front/worn_volume_fixed") == relative(fixed).epsilon(round_off));
  CHECK(run.last("groups/front/worn_volume_moving") == relative(moving).epsilon(round_off));
  for (int k = 1; k <= 4; ++k) {
    const std::string pad = fmt::format("bearings/front_pad_{}/", k);
    CHECK(std::abs(run.last(pad + "oil_unexplained")) < round_off * run.last(pad + "oil_through_flow"));
    CHECK(run.last(pad + "wear_moving") == run.last("bearings/front_pad_1/wear_moving"));  // one journal
  }
  const auto unworn = run.last("bearings/front_pad_3/wear_fixed");
  CHECK(unworn == 0);  // opposite to the load
}

/// A collar that turns slowly on pads, heavily loaded.
const std::string collar = R"(hersey: 1
parameters: {sense: 1}
lubricants: {oil: {viscosity: 5 mPa.s, density: 860 kg/m^3}}
gravity: 0 0 0 m/s^2
bodies:
  shaft: {mass: 10 kg, inertia: {xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 0.1 kg.m^2}}
joints: {turning: {type: cylindrical, between: [ground, shaft], axis: z, initial: {translation: 12 um, rotation_rate: "60 rpm*${sense}"}}}
drives: {motor: {joint: turning, coordinate: rotation, speed: "60 rpm*${sense}"}}
forces: {load: {type: force, body: shaft, components: [0 N, 0 N, -4 kN], axes: ground}}
bearings:
  main: {kind: tilting_pad_thrust, stator: ground, runner: shaft, inner_diameter: 60 mm, outer_diameter: 120 mm,
         lubricant: oil, grid: {along: 13, radial: 7}, pads: {count: 4, arc: 60 deg},
         asperities: {model: greenwood_tripp_fit, roughness: 0.8 um, elastic_factor: 3e-3, composite_modulus: 110 GPa,
                      friction: 0.1},
         wear: {stator: {coefficient: 2e-15 1/Pa}, runner: {coefficient: 1e-15 1/Pa}, acceleration: 500}}
simulation: {duration: 30 ms, step: 0.5 ms}
)";

// The pads are alike: each wears a quarter off the collar, which all of them meet.
TEST_CASE("PadsBelowACollar_WearItTogether") {
  const Run run(collar), mirrored(collar, {"sense=-1"});
  const double moving = run.sum("main_pad_", 4, "worn_volume_moving");
  CHECK(moving > 0);
  constexpr double round_off = 1e-9, solved_for = 1e-6;  // steps are solved to 1e-8 of their largest term
  CHECK(moving == relative(run.sum("main_pad_", 4, "worn_volume_fixed") / 2).epsilon(round_off));
  for (int k = 1; k <= 4; ++k) {
    const std::string pad = fmt::format("bearings/main_pad_{}/", k);
    CHECK(run.last(pad + "worn_volume_moving") == relative(moving / 4).epsilon(solved_for));
    CHECK(run.last(pad + "wear_moving") == run.last("bearings/main_pad_1/wear_moving"));
    CHECK(mirrored.last(pad + "worn_volume_moving") == relative(moving / 4).epsilon(solved_for));
  }
}

}  // namespace pad_wear_run_test
}  // namespace hersey::run
