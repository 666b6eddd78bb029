#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "hersey/model/read.h"

namespace hersey::model {

/// A small complete model. Line numbers matter: the tests of faults name them.
inline const std::string good_model = R"(hersey: 1
title: Test
parameters:
  load: 500 N
  speed: 3000 rpm
bodies:
  shaft:
    mass: 1 kg
    inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}
    frames:
      pin: {origin: 0 50 0 mm, rotation: {axis: 0 0 2, angle: 90 deg}}
  rod: {mass: 2 kg}
joints:
  main: {type: revolute, between: [ground, shaft]}
  guide: {type: planar, between: [ground, rod]}
drives:
  motor: {joint: main, coordinate: rotation, speed: "${speed}"}
forces:
  push: {type: force, body: rod, components: [0 N, "-${load}", 0 N]}
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  big_end:
    shell: rod
    journal: shaft.pin
    diameter: 45 mm
    width: 15.6 mm
    radial_clearance: 34 um
    lubricant: oil
simulation:
  crank: main
  duration: 2 rev
  step: 1 deg
)";

/// `text` with the one occurrence of `from` replaced by `to`.
inline std::string edited(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  return text;
}

/// What the reader says about `text`, one fault a line.
inline std::string faults_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)read_text(text, "m.yaml", overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

/// What the reader says about the good model with `from` replaced by `to`.
inline std::string faults_after(const std::string& from, const std::string& to) {
  return faults_of(edited(good_model, from, to));
}

}  // namespace hersey::model
