"""Model files of that rotor: on the closed form of its bearing's force, written as expressions, or on a film that is nearly short."""

import re

import numpy as np

MASS, CLEARANCE, GRAVITY = 20.0, 60e-6, 9.81
RATE = np.sqrt(GRAVITY / CLEARANCE)  # omega = s RATE
# The oil's shear pulls with 4 R c/L^2 of the pressure's force, which Ocvirk's theory leaves out: a radius of 25 m does, too.
DIAMETER = 50.0


def expressions(gamma):
    """Force along x and y of a film that turns with the journal's motion, over turning.x and turning.y, with the parameter w [rad/s]."""
    parts = {
        "J": "(2/sqrt(Q)*(pi/2 + atan(P/sqrt(Q*E))))",
        "P": "(X*A - Y*B)",
        "T": "(X*B + Y*A)",
        "E": "(A^2 + B^2)",
        "Q": "(1 - X^2 - Y^2)",
        "A": f"(Y + turning.x_rate*{2 / CLEARANCE:.17g}/${{w}})",
        "B": f"(X - turning.y_rate*{2 / CLEARANCE:.17g}/${{w}})",
        "X": f"(turning.x*{1 / CLEARANCE:.17g})",
        "Y": f"(turning.y*{1 / CLEARANCE:.17g})",
    }
    scale = gamma * MASS * CLEARANCE * RATE / 2
    found = []
    for formula in ("J*(A + 3*X*P/Q) + 2*sqrt(E)*(3*X/Q - T*B/(E - T^2))", "J*(3*Y*P/Q - B) + 2*sqrt(E)*(3*Y/Q - T*A/(E - T^2))"):
        formula = f"({formula})/Q"
        for name, meaning in parts.items():
            formula = re.sub(rf"\b{name}\b", lambda _: meaning, formula)
        found.append(f"-{scale:.17g}*${{w}}*{formula}")
    return found


def head(s, start):
    x, y, vx, vy = start
    w = s * RATE
    return f"""hersey: 1
parameters: {{w: {w:.17g}, speed: "${{w}} rad/s", revolution: "2*pi rad/${{speed}}"}}
gravity: 0 -{GRAVITY} 0 m/s^2
bodies:
  rotor: {{mass: {MASS} kg, inertia: {{xx: 0.2 kg.m^2, yy: 0.2 kg.m^2, zz: 0.2 kg.m^2}}}}
joints:
  turning:
    type: planar
    between: [ground, rotor]
    axis: z
    initial: {{x: {x * CLEARANCE:.17g} m, y: {y * CLEARANCE:.17g} m, x_rate: {vx * CLEARANCE * w:.17g} m/s, y_rate: {vy * CLEARANCE * w:.17g} m/s}}
drives:
  motor: {{joint: turning, coordinate: rotation, speed: "${{speed}}"}}
"""


def forces(lines, unbalance):
    if unbalance:
        lines = [*lines, f"residual: {{type: unbalance, on: rotor, amount: {unbalance * MASS * CLEARANCE:.17g} kg.m}}"]
    return "".join(["forces:\n", *(f"  {line}\n" for line in lines)]) if lines else ""


def on_closed_form(gamma, s, start=(0, 0, 0, 0), unbalance=0.0, simulation="simulation: {analysis: steady}\n", more=()):
    """The rotor on its short bearing, exactly."""
    lines = [f'film_{axis}: {{type: force, body: rotor, direction: {axis}, magnitude: {{expression: "{force}", unit: N}}}}'
             for axis, force in zip("xy", expressions(gamma))]
    return head(s, start) + forces([*lines, *more], unbalance) + simulation


def on_film(gamma, s, width_ratio, start=(0, 0, 0, 0), unbalance=0.0, grid=(60, 9), simulation="simulation: {analysis: steady}\n"):
    """The rotor on a film of L/D = width_ratio whose viscosity gives it the same gamma."""
    width = width_ratio * DIAMETER
    viscosity = gamma * 2 * MASS * CLEARANCE**2 * np.sqrt(CLEARANCE * GRAVITY) / (DIAMETER / 2 * width**3)
    return head(s, start) + forces([], unbalance) + f"""lubricants:
  oil: {{viscosity: {viscosity:.17g} Pa.s, density: 850 kg/m^3}}
bearings:
  main:
    shell: ground
    journal: rotor
    diameter: {DIAMETER} m
    width: {width:.17g} m
    radial_clearance: {CLEARANCE * 1e6:.17g} um
    lubricant: oil
    cavitation: guembel
    grid: {{circumferential: {grid[0]}, axial: {grid[1]}}}
""" + simulation


def shooting(steps, revolutions=1.0, finds_period=False, tolerance=1e-6):
    """Section `simulation` of a periodic motion with so many steps a period."""
    period = f'"{revolutions:.17g}*${{revolution}}"'
    return f"""simulation:
  cycle: {{period: {f'{{about: {period}}}' if finds_period else period}, lead_in: shooting, until_converged: {tolerance:g}, most: 60}}
  step: "{revolutions:.17g}*${{revolution}}/{steps}"
  spectral_radius: 0.95
"""


def waiting(steps, revolutions):
    """Section `simulation` of a run over so many revolutions of as many steps each."""
    return f"""simulation:
  duration: "{revolutions}*${{revolution}}"
  step: "${{revolution}}/{steps}"
  spectral_radius: 0.95
"""
