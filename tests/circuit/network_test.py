#!/usr/bin/python3
"""A network of drillings and orifices against an independent solution: other formulas of the same laws, another root finder."""

import math
import os
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERSEY = os.path.abspath(sys.argv.pop(1))

MU, RHO = 0.008, 860.0
GIVEN = {"supply": 5e5, "sump": 0.0, "tank": 0.4e5}
UNKNOWN = ["a", "b", "c", "d"]
# name: (from, to, length, diameter, roughness, loss coefficient)
DRILLINGS = {
    "inlet": ("supply", "a", 0.15, 6e-3, 2e-5, 1.5),
    "cross": ("a", "b", 0.06, 3e-3, 0.0, 0.0),
    "branch": ("a", "c", 0.40, 4e-3, 5e-5, 2.6),
    "thin": ("b", "d", 0.05, 0.6e-3, 0.0, 0.5),
    "drain": ("d", "sump", 0.10, 5e-3, 1e-5, 1.0),
}
# name: (from, to, diameter, discharge coefficient)
ORIFICES = {
    "jet": ("c", "d", 2.2e-3, 0.7),
    "nozzle": ("b", "sump", 1.6e-3, 0.62),
    "spray": ("c", "tank", 1e-3, 0.8),
}


def churchill(reynolds, roughness):
    """Darcy's friction factor by Churchill (1977)."""
    a = (2.457 * math.log(1 / ((7 / reynolds) ** 0.9 + 0.27 * roughness))) ** 16
    b = (37530 / reynolds) ** 16
    return 8 * ((8 / reynolds) ** 12 + (a + b) ** -1.5) ** (1 / 12)


def bisect(function, low, high):
    """Root of an ascending function, to the last digit."""
    while True:
        middle = 0.5 * (low + high)
        if not low < middle < high:
            return middle
        if function(middle) > 0:
            high = middle
        else:
            low = middle


def drilling_flow(drop, length, diameter, roughness, zeta):
    """The velocity by bisection: of drops that creep, of none."""
    if drop == 0:
        return 0.0
    area = math.pi / 4 * diameter**2

    def excess(v):
        f = churchill(RHO * v * diameter / MU, roughness / diameter)
        return (f * length / diameter + zeta) * RHO * v * v / 2 - abs(drop)

    return math.copysign(area * bisect(excess, 1e-12, 1e3), drop)


def orifice_flow(drop, diameter, coefficient):
    """Torricelli's and Sampson's flow, joined as in the manual."""
    jet = coefficient * math.pi / 4 * diameter**2 * math.sqrt(2 / RHO)
    transition = (jet * 24 * MU / diameter**3) ** 2
    return jet * drop / (drop**2 + transition**2) ** 0.25


def surpluses(unknown):
    p = GIVEN | dict(zip(UNKNOWN, unknown))
    surplus = dict.fromkeys(p, 0.0)
    flows = {}
    for name, (start, end, *sizes) in DRILLINGS.items():
        flows[name] = (start, end, drilling_flow(p[start] - p[end], *sizes))
    for name, (start, end, *sizes) in ORIFICES.items():
        flows[name] = (start, end, orifice_flow(p[start] - p[end], *sizes))
    for start, end, flow in flows.values():
        surplus[start] -= flow
        surplus[end] += flow
    return np.array([surplus[name] for name in UNKNOWN]), {name: flow for name, (_, _, flow) in flows.items()}


def solution():
    """Sweeps from node to node, each by bisection between the lowest and the highest given pressure: slow, and without derivatives."""
    p = np.full(len(UNKNOWN), 1e5)
    for _ in range(2000):
        before = p.copy()
        for k in range(len(UNKNOWN)):
            def lack(value, k=k):
                trial = p.copy()
                trial[k] = value
                return -surpluses(trial)[0][k]
            p[k] = bisect(lack, 0.0, 5e5)
        if np.max(np.abs(p - before)) <= 1e-11 * 5e5:  # a tenth of what is asked below is left by sweeps that contract by half
            break
    return p, surpluses(p)[1]


def model():
    nodes = "".join(f"    {name}: {{pressure: {p} Pa}}\n" for name, p in GIVEN.items())
    nodes += "".join(f"    {name}: {{}}\n" for name in UNKNOWN)
    elements = "".join(
        f"    {name}: {{type: drilling, from: {start}, to: {end}, length: {length} m, diameter: {diameter} m, roughness: {rough} m, "
        f"loss_coefficient: {zeta}}}\n" for name, (start, end, length, diameter, rough, zeta) in DRILLINGS.items())
    elements += "".join(
        f"    {name}: {{type: orifice, from: {start}, to: {end}, diameter: {diameter} m, discharge_coefficient: {coefficient}}}\n"
        for name, (start, end, diameter, coefficient) in ORIFICES.items())
    return f"""hersey: 1
lubricants:
  oil: {{viscosity: {MU} Pa.s, density: {RHO} kg/m^3}}
bodies:
  rotor: {{mass: 1 kg, inertia: {{xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}}}}
joints:
  turning: {{type: revolute, between: [ground, rotor], axis: z}}
circuit:
  lubricant: oil
  nodes:
{nodes}  elements:
{elements}simulation: {{duration: 1 ms, step: 1 ms}}
"""


class Network(unittest.TestCase):
    def test_pressures_and_flows_are_those_of_another_solution(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "model.yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(model())
            output = os.path.join(folder, "run")
            done = subprocess.run([HERSEY, "run", path, "--output", output], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            pressures, flows = solution()
            with h5py.File(os.path.join(output, "results.h5")) as file:
                for name, expected in zip(UNKNOWN, pressures):
                    self.assertLess(abs(file[f"circuit/pressure_{name}"][-1] - expected), 1e-8 * expected, name)
                for name, expected in flows.items():
                    self.assertLess(abs(file[f"circuit/flow_{name}"][-1] - expected), 1e-8 * abs(expected), name)

    def test_network_has_laminar_and_turbulent_drillings(self):
        _, flows = solution()
        reynolds = {name: RHO * abs(flows[name]) * 4 / (math.pi * DRILLINGS[name][3] * MU) for name in DRILLINGS}
        self.assertLess(min(reynolds.values()), 2000)
        self.assertGreater(max(reynolds.values()), 3000)


if __name__ == "__main__":
    unittest.main()
