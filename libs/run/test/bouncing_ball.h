#pragma once

#include <string>

namespace hersey::run {

/// A ball that falls on a floor, slides and bounces.
inline const std::string kBall = R"(hersey: 1
title: A ball
gravity: 0 0 -9.81 m/s^2
bodies:
  ball:
    mass: 40 g
    inertia: {xx: 6.4e-6 kg.m^2, yy: 6.4e-6 kg.m^2, zz: 6.4e-6 kg.m^2}
    shapes: {surface: {shape: sphere, diameter: 40 mm}}
  ground:
    shapes: {floor: {shape: half_space, point: 0 0 1 mm, normal: 0 0 1}}
joints:
  flight: {type: free, between: [ground, ball], initial: {position: 0 0 22 mm, velocity: 0.5 0 -1 m/s}}
contacts:
  bounce:
    between: [ball.surface, ground.floor]
    stiffness: {force: 50 N, penetration: 1 mm}
    damping: {restitution: 0.8, speed: 1 m/s}
    friction: {coefficient: 0.4, slip_speed: 1 mm/s}
simulation: {duration: 20 ms, step: 0.05 ms}
)";

}  // namespace hersey::run
