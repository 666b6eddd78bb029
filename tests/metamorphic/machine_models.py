"""Machines that together use most of what one can have: the pairs over machines change one thing in one of them.

Each takes some tenths of a second: a few steps on coarse grids. WORKSHOP: one of every joint and force, in space. CRANK: a closed loop
with a film in it. ROTOR: a loose shaft in two films, one of them with temperatures and a thermal network. WHIP: a beam.
"""

WORKSHOP = """
hersey: 1
gravity: 0.4 -0.7 -9.81 m/s^2
bodies:
  ground:
    frames:
      post: {origin: 120 -40 300 mm, rotation: {axis: 1 2 2, angle: 25 deg}}
      wall: {origin: 400 80 210 mm}
      table: {origin: -300 60 100 mm}
      rail: {origin: -200 -300 180 mm, rotation: {axis: 0 1 0, angle: 30 deg}}
      deck: {origin: 0 500 90 mm}
    shapes: {floor: {shape: half_space, point: 0 0 -60 mm, normal: 0.1 0.05 1}}
  arm:
    mass: 1.4 kg
    centre_of_mass: 90 10 -20 mm
    inertia: {xx: 2e-3 kg.m^2, yy: 6e-3 kg.m^2, zz: 7e-3 kg.m^2, xy: 2e-4 kg.m^2, yz: -1e-4 kg.m^2, zx: 3e-4 kg.m^2}
    frames: {tip: {origin: 180 10 0 mm, rotation: {axis: x, angle: 40 deg}}, side: {origin: 60 40 0 mm}}
  bob:
    mass: 0.6 kg
    centre_of_mass: 5 0 -70 mm
    inertia: {xx: 8e-4 kg.m^2, yy: 7e-4 kg.m^2, zz: 3e-4 kg.m^2}
    frames: {end: {origin: 0 10 -130 mm}}
    shapes: {ball: {shape: sphere, centre: 0 10 -130 mm, diameter: 60 mm}}
  carriage:
    mass: 0.9 kg
    inertia: {xx: 1e-3 kg.m^2, yy: 1.2e-3 kg.m^2, zz: 1e-3 kg.m^2}
    frames: {pin: {origin: 20 0 40 mm}}
  wheel:
    mass: 0.5 kg
    centre_of_mass: 4 0 0 mm
    inertia: {xx: 4e-4 kg.m^2, yy: 4e-4 kg.m^2, zz: 7e-4 kg.m^2}
  spindle:
    mass: 0.7 kg
    inertia: {xx: 9e-4 kg.m^2, yy: 9e-4 kg.m^2, zz: 3e-4 kg.m^2}
    frames: {end: {origin: 0 0 120 mm}}
  nut:
    mass: 0.3 kg
    inertia: {xx: 2e-4 kg.m^2, yy: 2e-4 kg.m^2, zz: 3e-4 kg.m^2}
  cross:
    mass: 0.4 kg
    centre_of_mass: 0 0 60 mm
    inertia: {xx: 3e-4 kg.m^2, yy: 3e-4 kg.m^2, zz: 1e-4 kg.m^2}
    frames: {end: {origin: 0 0 110 mm}}
  puck:
    mass: 0.35 kg
    inertia: {xx: 2e-4 kg.m^2, yy: 2e-4 kg.m^2, zz: 3e-4 kg.m^2}
    frames: {rim: {origin: 30 0 0 mm}}
  ship:
    mass: 0.8 kg
    centre_of_mass: 3 2 1 mm
    inertia: {xx: 6e-4 kg.m^2, yy: 9e-4 kg.m^2, zz: 1.1e-3 kg.m^2}
    frames: {bow: {origin: 50 0 10 mm}}
    shapes: {hull: {shape: sphere, diameter: 50 mm}}
joints:
  shoulder: {type: revolute, between: [ground.post, arm], axis: 0.2 1 0.1, initial: {rotation: 20 deg, rotation_rate: 30 rpm}}
  socket: {type: spherical, between: [arm.tip, bob], initial: {orientation: 10 -20 30 deg, angular_velocity: 10 5 -20 rpm}}
  slide: {type: prismatic, between: [ground.rail, carriage], axis: x, initial: {translation: 12 mm, translation_rate: 0.2 m/s}}
  hub: {type: revolute, between: [carriage.pin, wheel], axis: z, initial: {rotation: 5 deg, rotation_rate: 60 rpm}}
  sleeve: {type: cylindrical, between: [ground.wall, spindle], axis: z, initial: {translation: 5 mm, rotation: 15 deg, translation_rate: 0.1 m/s, rotation_rate: 90 rpm}}
  thread: {type: screw, between: [spindle.end, nut], axis: z, lead: 12 mm, initial: {rotation: 40 deg}}
  cardan: {type: universal, between: [ground.table, cross], axis: z, initial: {rotation_1: 8 deg, rotation_2: -12 deg, rotation_1_rate: 20 rpm, rotation_2_rate: -15 rpm}}
  ice: {type: planar, between: [ground.deck, puck], axis: z, initial: {x: 3 mm, y: -6 mm, rotation: 12 deg, x_rate: 0.1 m/s, y_rate: 0.15 m/s}}
  sea: {type: free, between: [ground, ship], initial: {position: 250 -150 -50 mm, orientation: 5 15 -25 deg, velocity: 0.1 0.2 -0.3 m/s, angular_velocity: 10 -20 15 rpm}}
drives:
  spin: {joint: ice, coordinate: rotation, speed: {expression: "4 + 3*t", unit: rad/s}, ramp: 5 ms}
couplings:
  mesh: {type: gear, output: thread.rotation, input: hub.rotation, ratio: 0.7}
forces:
  push: {type: force, body: bob.end, components: [2 N, {expression: 3*cos(40*t), unit: N}, -1 N], axes: body}
  pull: {type: force, body: arm.tip, direction: 1 1 0, magnitude: 4 N}
  turn: {type: torque, body: cross, direction: z, magnitude: {table: {points: [[0, 0.1], [0.02, 0.3], [0.1, 0]], x_unit: s, y_unit: N.m}, shift: -2 ms, interpolation: smooth, scale: 0.5}}
  line: {type: spring_damper, between: [arm.side, carriage.pin], stiffness: 300 N/m, damping: 4 N.s/m, free_length: 350 mm, tension: {expression: 2 + 10*length^2, unit: N}}
  return: {type: torsion_spring, joint: shoulder, stiffness: 3 N.m/rad, damping: 0.02 N.m.s/rad, free_angle: 12 deg, torque: {expression: 0.5*angle^3, unit: N.m}}
  buffer: {type: sliding_spring, joint: slide, stiffness: 900 N/m, damping: 3 N.s/m, free_position: 4 mm, force: {expression: 1e4*stretch^3, unit: N}}
  rubber: {type: bushing, between: [cross.end, puck.rim], stiffness: 200 300 150 N/m, rotational_stiffness: 2 1 3 N.m/rad, damping: 1 2 3 N.s/m, rotational_damping: 0.01 0.02 0.01 N.m.s/rad}
  drag: {type: joint_friction, joint: sleeve, coordinate: rotation, coulomb: 0.02 N.m, viscous: 0.003 N.m.s/rad, transition_speed: 0.5 rad/s}
  motor: {type: speed_control, joint: hub, speed: 80 rpm, proportional: 0.02 N.m.s/rad, integral: 0.3 N.m/rad, limit: 0.05 N.m}
contacts:
  landing:
    between: [ground.floor, ship.hull]
    materials: [{youngs_modulus: 2 MPa, poisson_ratio: 0.4}, {youngs_modulus: 5 MPa, poisson_ratio: 0.3}]
    damping: {coefficient: 0.5 s/m}
    friction: {coefficient: 0.3, slip_speed: 20 mm/s}
simulation:
  duration: 40 ms
  step: 1 ms
"""

CRANK = """
hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  ground: {frames: {bore: {origin: 0 180 0 mm}}}
  crank:
    mass: 2 kg
    centre_of_mass: 0 6 0 mm
    inertia: {xx: 2e-3 kg.m^2, yy: 2e-3 kg.m^2, zz: 3e-3 kg.m^2}
    frames: {pin: {origin: 0 40 0 mm}}
  rod:
    mass: 0.5 kg
    centre_of_mass: 0 45 0 mm
    inertia: {xx: 1.6e-3 kg.m^2, yy: 1e-4 kg.m^2, zz: 1.7e-3 kg.m^2}
    frames: {small_end: {origin: 0 140 0 mm}}
  piston:
    mass: 0.4 kg
    inertia: {xx: 3e-4 kg.m^2, yy: 2e-4 kg.m^2, zz: 3e-4 kg.m^2}
joints:
  main: {type: revolute, between: [ground, crank], axis: z, initial: {rotation: 0 deg}}
  bore: {type: prismatic, between: [ground.bore, piston], axis: y, initial: {translation: 5 um, translation_rate: 0 m/s}}
  wrist: {type: revolute, between: [piston, rod.small_end], axis: z, initial: {rotation: 0.001 deg, rotation_rate: -71.80783 rad/s}}
drives:
  motor: {joint: main, coordinate: rotation, speed: 2400 rpm}
forces:
  gas:
    type: force
    body: piston
    direction: 0 -1 0
    magnitude: {table: {points: [[0, 1], [60, 4], [200, 0.5], [720, 1]], x_unit: deg, y_unit: bar}, over: main.rotation, period: 720 deg, shift: 10 deg, scale: 4000 mm^2}
lubricants:
  oil: {viscosity: 12 mPa.s, pressure_viscosity: {law: barus, alpha: 1.2e-8 1/Pa}, density: 860 kg/m^3}
bearings:
  big_end:
    shell: rod
    journal: crank.pin
    diameter: 44 mm
    width: 20 mm
    radial_clearance: 30 um
    lubricant: oil
    grid: {circumferential: 24, axial: 7}
    edge_pressure: {left: 0.1 bar, right: 0.2 bar}
    supply: {line: widest_gap, pressure: 2 bar}
    features: {hole: {shape: hole, on: journal, angle: 60 deg, z: 1 mm, diameter: 14 mm, pressure: 2 bar}}
    shape: [{profile: ovality, amplitude: 2 um, angle: 30 deg}]
    asperities: {model: greenwood_tripp, roughness: 6 um, elastic_factor: 3e-3, composite_modulus: 115 GPa, friction: 0.12}
simulation:
  crank: main
  duration: 20 deg
  step: 1 deg
output: {fields_every: 5 deg}
"""

ROTOR = """
hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  ground: {frames: {left: {origin: 0 0 -100 mm}, right: {origin: 0 0 140 mm}}}
  shaft:
    mass: 9 kg
    centre_of_mass: 0.02 0 10 mm
    inertia: {xx: 0.09 kg.m^2, yy: 0.09 kg.m^2, zz: 0.006 kg.m^2}
    frames: {left: {origin: 0 0 -100 mm}, right: {origin: 0 0 140 mm}}
joints:
  loose: {type: free, between: [ground, shaft], initial: {position: 5 -12 0 um, angular_velocity: 0 0 3000 rpm}}
forces:
  belt: {type: force, body: shaft.right, components: [60 N, {expression: -40*(1 + 0.3*sin(300*t)), unit: N}, 0 N]}
  thrust: {type: bushing, between: [ground, shaft], stiffness: 0 0 1e5 N/m, damping: 0 0 50 N.s/m}
lubricants:
  oil:
    viscosity: {law: vogel, a: 0.05 mPa.s, b: 1000 K, c: 150 K}
    density: 870 kg/m^3
    specific_heat: 1950 J/kg/K
    conductivity: 0.13 W/m/K
thermal:
  nodes: {housing: {heat_capacity: 400 J/K, temperature: 35 degC}, air: {fixed: 20 degC}}
  paths: {fins: {between: [housing, air], conductance: 4 W/K}}
bearings:
  left:
    shell: ground.left
    journal: shaft.left
    diameter: 40 mm
    width: 20 mm
    radial_clearance: 32 um
    lubricant: oil
    grid: {circumferential: 24, axial: 5}
    cavitation: {model: mass_conserving, pressure: -0.2 bar}
    features: {groove: {shape: axial_groove, angle: 90 deg, arc: 40 deg, length: 14 mm, pressure: 1 bar, temperature: 41 degC}}
    thermal:
      model: film
      supply_temperature: 40 degC
      edge_temperature: 38 degC
      layers: 3
      carry_over: 0.8
      shell: {wall: ring, outer_diameter: 70 mm, conductivity: 45 W/m/K, heat_transfer: 60 W/m^2/K, ambient: {node: housing}}
      journal: {wall: free, heat_capacity: 150 J/K}
  right:
    shell: ground.right
    journal: shaft.right
    diameter: 40 mm
    width: 24 mm
    radial_clearance: 36 um
    lubricant: oil
    grid: {circumferential: 24, axial: 5}
    cavitation: guembel
    supply: {line: 80 deg, pressure: 1.2 bar}
    thermal: {model: isothermal, temperature: 45 degC}
    roughness: {shell: {sigma: 0.5 um, gamma: 3}}
simulation:
  duration: 4 ms
  step: 0.2 ms
output: {fields_every: 1 ms}
"""

WHIP = """
hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  blade:
    beam:
      points: [0 0 0 mm, 200 0 0 mm, 300 60 0 mm]
      section: {rectangle: {width: 8 mm, height: 12 mm}}
      material: {youngs_modulus: 70 GPa, poisson_ratio: 0.33, density: 2700 kg/m^3}
      elements: 5
      damping: {stiffness: 20 us}
    frames: {root: {along: start}, tip: {along: end}}
  bob: {mass: 0.1 kg, inertia: {xx: 1e-5 kg.m^2, yy: 1e-5 kg.m^2, zz: 1e-5 kg.m^2}}
joints:
  hinge: {type: revolute, between: [ground, blade.root], axis: 0 0.3 1, initial: {rotation: 10 deg, rotation_rate: 40 rpm}}
  weld: {type: fixed, between: [blade.tip, bob]}
forces:
  gust: {type: force, body: bob, components: [0 N, {expression: 3*sin(200*t), unit: N}, 1 N]}
simulation:
  duration: 10 ms
  step: 0.5 ms
"""
