#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "hersey/model/read.h"
#include "hersey/results/reader.h"
#include "hersey/run/simulate.h"
#include "temporary_directory.h"

namespace hersey::run::wearing_bush {

/// A bush that stands askew to its shaft and wears.
inline const std::string bush = R"(hersey: 1
parameters: {sense: 1, end: 60 ms, step: 0.5 ms, factor: 5000, k: 2e-15 1/Pa, of_journal: 0 1/Pa, lining: 20 um}
lubricants: {oil: {viscosity: 30 mPa.s, density: 860 kg/m^3}}
bodies:
  ground: {frames: {seat: {rotation: {axis: x, angle: 0.012 deg}}}}
  shaft: {mass: 20 kg, inertia: {xx: 0.1 kg.m^2, yy: 0.1 kg.m^2, zz: 6e-3 kg.m^2}}
joints: {turning: {type: planar, between: [ground, shaft], axis: z, initial: {x: "6.6 um*${sense}", y: -26.2 um, rotation_rate: "120 rpm*${sense}"}}}
drives: {motor: {joint: turning, coordinate: rotation, speed: "120 rpm*${sense}"}}
forces: {load: {type: force, body: shaft, direction: 0 -1 0, magnitude: 3 kN, axes: ground}}
bearings:
  bush: {shell: ground.seat, journal: shaft, diameter: 50 mm, width: 25 mm, radial_clearance: 30 um, lubricant: oil,
         grid: {circumferential: 60, axial: 5},
         asperities: {model: greenwood_tripp_fit, roughness: 0.8 um, elastic_factor: 3e-3, composite_modulus: 110 GPa,
                      friction: 0.1},
         supply: {line: 90 deg, pressure: 1 bar},
         wear: {shell: {coefficient: "${k}", lining: "${lining}"}, journal: {coefficient: "${of_journal}"},
                acceleration: "${factor}", cycle: 5 ms}}
simulation: {duration: "${end}", step: "${step}"}
)";

class Run {
 public:
  explicit Run(const std::vector<std::string>& overrides, Status expected = Status::completed,
               const std::string& text = bush)
      : summary_(simulate(model::read_text(text, "m.yaml", overrides), {.results = scratch_ / "run.h5"})) {
    INFO(summary_.message);
    REQUIRE(summary_.status == expected);
  }

  [[nodiscard]] std::vector<double> series(const std::string& name) const {
    return results::Reader(summary_.results).read("/bearings/bush/" + name).values;
  }
  [[nodiscard]] std::vector<double> field(const std::string& name) const { return series("fields/" + name); }
  [[nodiscard]] const Summary& summary() const { return summary_; }
  [[nodiscard]] double last(const std::string& name) const { return series(name).back(); }
  [[nodiscard]] const std::string& message() const { return summary_.message; }

 private:
  TemporaryDirectory scratch_;
  Summary summary_;
};

/// The bush whose roughness wears to a given one.
inline std::string with_running_in(const std::string& roughness, const std::string& depth) {
  std::string text = bush;
  const std::string before = "cycle: 5 ms";
  text.insert(text.find(before), "running_in: {roughness: " + roughness + ", depth: " + depth + "}, ");
  return text;
}

}  // namespace hersey::run::wearing_bush
