#pragma once

#include <string>
#include <vector>

#include "edited.h"
#include "hersey/model/read.h"

namespace hersey::run {

/// A journal rotating in a floating bush under a load: small enough for a run in milliseconds.
inline const std::string kSmallRig = R"(hersey: 1
title: Small rig
parameters:
  load: 500 N
  duration: 4 ms
bodies:
  pin: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
  rod: {mass: 0.5 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  main: {type: revolute, between: [ground, pin], initial: {rotation_rate: 3000 rpm}}
  guide: {type: planar, between: [ground, rod], initial: {x: 0 um}}
drives:
  motor: {joint: main, coordinate: rotation, speed: 3000 rpm}
  hold: {joint: guide, coordinate: rotation, position: 0 deg}
forces:
  push: {type: force, body: rod, components: [0 N, "-${load}", 0 N]}
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  big_end:
    shell: rod
    journal: pin
    diameter: 45 mm
    width: 15.6 mm
    radial_clearance: 34 um
    lubricant: oil
    grid: {circumferential: 24, axial: 5}
    supply: {line: widest_gap, pressure: 1 bar}
simulation:
  crank: main
  duration: "${duration}"
  step: 2 deg
  spectral_radius: 0.6
)";

/// The rig with one text replaced by another.
inline std::string rig_with(const std::string& old, const std::string& replacement) {
  return edited(kSmallRig, old, replacement);
}

inline model::Model rig(const std::string& text = kSmallRig, const std::vector<std::string>& overrides = {}) {
  return model::read_text(text, "rig.yaml", overrides);
}

}  // namespace hersey::run
