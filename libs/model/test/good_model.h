#pragma once

#include <string>

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

}  // namespace hersey::model
