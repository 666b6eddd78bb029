"""Bearings that together use what one can have: the metamorphic tests change one thing in one of them."""

PLAIN = """
hersey: 1
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  main:
    diameter: 45 mm
    width: 20 mm
    radial_clearance: 34 um
    lubricant: oil
    grid: {circumferential: 36, axial: 9}
    edge_pressure: 0.2 bar
    operating_point: {journal_speed: 3570 rpm, load: 2500 N, load_angle: -80 deg}
"""

# Everything without temperatures: each value is of weight at this operating point.
FULL = """
hersey: 1
lubricants:
  oil:
    viscosity: 15 mPa.s
    pressure_viscosity: {law: barus, alpha: 1.5e-8 1/Pa}
    shear_thinning: {law: cross, exponent: 0.8, limit_ratio: 0.5, critical_shear_rate: 1e6 1/s}
    compressibility: {law: dowson_higginson, rise: 0.6e-9 1/Pa, saturation: 1.7e-9 1/Pa}
    density: 860 kg/m^3
bearings:
  main:
    diameter: 45 mm
    width: 20 mm
    radial_clearance: 34 um
    lubricant: oil
    grid: {circumferential: 48, axial: 13, refine: [{towards: edges, factor: 2, reach: 2 mm}, {towards: angle, angle: -60 deg, factor: 1.5, reach: 20 deg}]}
    cavitation: {model: mass_conserving, pressure: -0.2 bar}
    edge_pressure: {left: 0.2 bar, right: -0.2 bar}
    ambient_fill: {left: 1, right: 0.3}
    supply: {line: 110 deg, pressure: 1.2 bar}
    features:
      hole: {shape: hole, on: journal, angle: 120 deg, z: -4 mm, diameter: 8 mm, pressure: 1.2 bar, depth: 0.3 mm}
      groove: {shape: axial_groove, angle: 160 deg, arc: 25 deg, length: 12 mm, pressure: 2 bar, depth: 0.2 mm}
      pocket: {shape: pocket, angle: -20 deg, z: 1 mm, arc: 30 deg, length: 7 mm, depth: 20 um}
    shape:
      - {profile: barrel, on: journal, drop: 3 um}
      - {profile: taper, rise: 2 um}
      - {profile: ovality, amplitude: 2 um, angle: 30 deg}
      - {profile: lobes, count: 3, offset: 2 um, angle: 50 deg}
    roughness: {shell: {sigma: 0.8 um, gamma: 3}, journal: {sigma: 0.4 um, gamma: 1}}
    asperities: {model: greenwood_tripp, roughness: 1.2 um, mean_summit_height: 1 um, elastic_factor: 3e-3, composite_modulus: 115 GPa, friction: 0.12}
    compliance: {model: column, composite_modulus: 57 GPa, length: 22.5 mm}
    operating_point:
      journal_speed: 3570 rpm
      eccentricity_ratio: 0.8
      eccentricity_angle: -70 deg
      radial_velocity: 1 mm/s
      journal_angle: 15 deg
      tilt_x: 0.01 deg
      tilt_y: -0.015 deg
"""

# The film's own temperature.
HOT = """
hersey: 1
lubricants:
  oil:
    viscosity: {law: exponential, viscosity: 40 mPa.s, reference: 40 degC, coefficient: 0.034 1/K}
    pressure_viscosity: 1.2e-8 1/Pa
    shear_thinning: {law: carreau, exponent: 0.7, transition: 2, limit_ratio: 0.5, critical_stress: 60 kPa}
    density: 860 kg/m^3
    specific_heat: 2000 J/kg/K
    conductivity: 0.13 W/m/K
bearings:
  main:
    diameter: 100 mm
    width: 50 mm
    radial_clearance: 60 um
    lubricant: oil
    grid: {circumferential: 36, axial: 7}
    edge_pressure: 0.3 bar
    features:
      groove: {shape: axial_groove, angle: 90 deg, arc: 20 deg, length: 40 mm, pressure: 1 bar, temperature: 42 degC}
    thermal:
      model: film
      supply_temperature: 40 degC
      edge_temperature: 45 degC
      layers: 4
      carry_over: 0.8
      shell: {wall: ring, outer_diameter: 160 mm, conductivity: 50 W/m/K, heat_transfer: 80 W/m^2/K, ambient: 30 degC}
      journal: free
      expansion: {shell: 23e-6 1/K, journal: 12e-6 1/K, reference: 20 degC}
    operating_point: {journal_speed: 2000 rpm, eccentricity_ratio: 0.6, eccentricity_angle: -70 deg}
"""

# One temperature by a balance of heat; Reynolds' condition.
GLOBAL = """
hersey: 1
lubricants:
  oil:
    viscosity: {law: exponential, viscosity: 40 mPa.s, reference: 40 degC, coefficient: 0.034 1/K}
    compressibility: {law: constant_bulk_modulus, bulk_modulus: 1.5 GPa}
    thermal_expansion: 0.65e-3 1/K
    density: 870 kg/m^3
bearings:
  main:
    diameter: 60 mm
    width: 40 mm
    diametral_clearance: 90 um
    lubricant: oil
    grid: {circumferential: 36, axial: 17}
    edge_pressure: 0.3 bar
    cavitation: {model: reynolds}
    cavitated_shear: full
    shear_force: torque_only
    features:
      groove: {shape: circumferential_groove, length: 5 mm, arc: 120 deg, angle: 90 deg, pressure: 2 bar, depth: 0.5 mm}
    thermal:
      model: global
      cooling: {area: 0.3 m^2, heat_transfer: 20 W/m^2/K, ambient: 20 degC}
      expansion: {shell: 23e-6 1/K, journal: 12e-6 1/K, reference: 20 degC, shell_temperature: 50 degC, journal_temperature: 55 degC}
    operating_point: {journal_speed: 1500 rpm, shell_speed: 100 rpm, load: 3 kN, load_angle: -90 deg}
"""
