"""A journal under a constant load at a constant speed, run until it rests: `hersey bearing` of the same bearing, figure by figure."""

import os

import h5py

import tree as trees
from tree import hersey

# Damped to rest within some hundred steps of a light journal: what is left is the film's residual, 1e-8 of its flows.
SOLVED = 1e-7

# Errors are round-off; of the power's own the bearing tells the share.
NOT_COMPARED = ("mass_balance_error", "heat_balance_error", "power_error", "power_error_share")

JOURNAL = """
hersey: 1
bodies: {shaft: {mass: 0.2 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}}
joints:
  bench: {type: planar, between: [ground, shaft], axis: z, initial: {x: 5 um, y: -12 um, rotation_rate: SPEED}}
drives: {motor: {joint: bench, coordinate: rotation, speed: SPEED}}
forces: {push: {type: force, body: shaft, components: [0 N, -500 N, 0 N]}}
lubricants: {oil: {viscosity: 15 mPa.s, density: 860 kg/m^3, pressure_viscosity: 1.2e-8 1/Pa}}
bearings:
  main:
    shell: ground
    journal: shaft
    diameter: 50 mm
    width: 25 mm
    radial_clearance: 50 um
    lubricant: oil
    grid: {circumferential: 48, axial: 9}
    edge_pressure: {left: 0.1 bar, right: 0.2 bar}
    operating_point: {journal_speed: SPEED, load: 500 N, load_angle: -90 deg}
simulation: {duration: 0.6 s, step: 1 ms, spectral_radius: 0}
output: {every: 600}
"""

SUPPLIED = {"supply": {"line": "97 deg", "pressure": "1 bar"},
            "features": {"groove": {"shape": "axial_groove", "angle": "30 deg", "arc": "25 deg", "length": "15 mm", "pressure": "1.5 bar"}}}

# A machine's film scales missing oil with 1000 rad/s, a bearing's with its own speed (film.6), which tells beside supplies and where
# shear fades out without a fill fraction: here both are the same.
OWN = "1000 rad/s"
CASES = {
    "plain": ("3000 rpm", {}),
    "supplied": (OWN, SUPPLIED),
    "reynolds": (OWN, {"cavitation": "reynolds"}),
    "guembel": (OWN, {"cavitation": "guembel"}),
    "rough": (OWN, {"asperities": {"model": "greenwood_tripp", "roughness": "8 um", "composite_modulus": "115 GPa", "friction": "0.1"},
                           "roughness": {"shell": {"sigma": "2 um", "gamma": "3"}}, "cavitated_shear": "full"}),
    "on columns": (OWN, {"compliance": {"model": "column", "composite_modulus": "1 GPa", "length": "3 mm"},
                                "shape": [{"profile": "barrel", "drop": "3 um"}, {"profile": "ovality", "amplitude": "3 um", "angle": "20 deg"}]}),
}


def differences(program, folder):
    off = []
    for name, (speed, more) in CASES.items():
        tree = trees.load(JOURNAL.replace("SPEED", speed))
        tree["bearings"]["main"] |= more
        off += [f"{name}: {text}" for text in of_one(program, tree, folder)]
    return off


def of_one(program, tree, folder):
    ending, figures = trees.bearing(program, tree, folder)
    output = os.path.join(folder, "settled")
    ran = hersey.run(program, "run", os.path.join(folder, "model.yaml"), "--output", output, "--force", "--json")
    if ending.kind != "answer" or ran.kind != "answer":
        return [f"{ending.kind}, {ran.kind}: {ending.text} {ran.text}"]
    off = []
    with h5py.File(os.path.join(output, "results.h5")) as file:
        rows = file["bearings/main"]
        both = sorted(name for name in figures if name in rows and rows[name].ndim == 1 and name not in NOT_COMPARED)
        for name in both:
            settled, steady = float(rows[name][-1]), figures[name][0]
            places = 1e-6 if name.endswith("_z") else 0.0  # of a place within a smooth film, the square root of what is solved [m]
            if steady is not None and abs(settled - steady) > SOLVED * abs(steady) + places:
                off.append(f"{name}: {settled:.10g} settled, {steady:.10g} by itself")
    return off if len(both) > 12 else [f"only {len(both)} figures in both"]
