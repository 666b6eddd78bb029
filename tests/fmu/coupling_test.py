#!/usr/bin/python3
"""A machine and a mass in a closed loop: co-simulation by the FMU's derivatives keeps the answer of one model of both.

coupling_test.py HERSEY WORK [Class.test]"""

import math
import os
import shutil
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import fmu_test  # noqa: E402  takes HERSEY and WORK off the arguments
from importer import Fmu, Instance  # noqa: E402
from interface_jacobian import Mass, exchange_by_derivatives, exchange_plainly  # noqa: E402

STEP = 1e-5  # of the solver [s]
END = 4e-3
STIFFNESS = 1e7
MASS = 2.0
LOADS = {"x": "200*sin(314*t)", "y": "100*sin(628*t) - 500*(1 - exp(-400*t))"}
INPUTS = ["forces.mount.components.x", "forces.mount.components.y"]
OUTPUTS = ["bodies.rod.position.x", "bodies.rod.position.y"]


def changed(text, *changes):
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    return text


def loads(t):
    return [eval(LOADS[axis], {"sin": math.sin, "exp": math.exp, "t": t}) for axis in "xy"]  # texts of this file


SIMULATION = f"simulation: {{duration: {END} s, step: {STEP} s, spectral_radius: 0.8}}\n"
PART = changed(fmu_test.RIG,
               ('push: {type: force, body: rod, components: [0 N, "-${load}", {expression: "sin(t)", unit: N}]}',
                "mount: {type: force, body: rod, components: [0 N, 0 N, 0 N]}"),
               ("simulation: {duration: 4 ms, step: 0.1 ms, spectral_radius: 0.6}\n", SIMULATION))
WHOLE = changed(PART,
                ("joints:\n", f"  block: {{mass: {MASS} kg, inertia: {{xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}}}\njoints:\n"
                 "  rails: {type: planar, between: [ground, block], initial: {x: 0 um}}\n"),
                ("drives:\n", "drives:\n  upright: {joint: rails, coordinate: rotation, position: 0 deg}\n"),
                ("mount: {type: force, body: rod, components: [0 N, 0 N, 0 N]}",
                 f"mount: {{type: bushing, between: [rod, block], stiffness: {STIFFNESS} {STIFFNESS} 0 N/m}}\n"
                 f'  push: {{type: force, body: block, components: [{{expression: "{LOADS["x"]}", unit: N}}, '
                 f'{{expression: "{LOADS["y"]}", unit: N}}, 0 N]}}'))


class CouplingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.makedirs(fmu_test.WORK, exist_ok=True)
        cls.folder = tempfile.mkdtemp(prefix="coupling ", dir=fmu_test.WORK)
        for name, text in (("whole", WHOLE), ("part", PART)):
            with open(os.path.join(cls.folder, name + ".yaml"), "w", encoding="utf-8") as file:
                file.write(text)
        fmu_test.run("export", os.path.join(cls.folder, "part.yaml"), "--fmu", os.path.join(cls.folder, "part.fmu"),
                     "--fmi", 3)
        cls.fmu = Fmu(os.path.join(cls.folder, "part.fmu"), os.path.join(cls.folder, "unpacked"))
        cls.motions = {}

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def whole(self, solver_step):
        """Motion of the body in the whole model, by steps of the solver."""
        if solver_step not in self.motions:
            out = os.path.join(self.folder, f"out {len(self.motions)}")
            fmu_test.run("run", os.path.join(self.folder, "whole.yaml"), "--output", out, "--set",
                         f"simulation.step={solver_step}s")
            with h5py.File(os.path.join(out, "results.h5")) as file:
                x = file["bodies/rod/position"][:, :2]
            self.motions[solver_step] = x - x[0]
        return self.motions[solver_step]

    def off(self, rows, step):
        """Largest distance from the motion of the whole model by the same steps of the solver, over its largest extent."""
        solver_step = min(step, STEP)
        motion, every = self.whole(solver_step), round(step / solver_step)
        expected = motion[every::every]
        self.assertEqual(len(rows), len(expected))
        return np.abs(rows - expected).max() / np.abs(motion).max()

    def plain(self, step):
        one = Instance(self.fmu).initialise(stop=END)
        rows = exchange_plainly(one, INPUTS, OUTPUTS, Mass(MASS, STIFFNESS, loads), step, round(END / step))
        one.free()
        return self.off(rows, step)

    def coupled(self, step):
        one = Instance(self.fmu).initialise(stop=END)
        rows, taken, asked = exchange_by_derivatives(one, INPUTS, OUTPUTS, Mass(MASS, STIFFNESS, loads), step, round(END / step))
        one.free()
        return self.off(rows, step), taken / len(rows), asked / len(rows)

    def test_derivatives_keep_the_whole_models_answer_at_ten_times_the_step(self):
        off, taken, asked = self.coupled(2 * STEP)
        plain = self.plain(STEP / 5)
        print(f"coupled {off:.2e}, {taken:.2f} steps and {asked:.2f} derivatives each; plain exchange at a tenth of the step {plain:.2e}")
        self.assertLess(off, 1e-4)  # asked of co-simulation, of the largest displacement
        self.assertLess(taken, 3.2)  # one step, and one behind each of two corrections by derivatives of an earlier exchange
        self.assertLess(asked, 0.1)
        self.assertGreater(plain, 1e-4)  # the same: plain exchange needs a step more than ten times shorter

    def test_plain_exchange_is_of_first_order(self):
        found = np.array([self.plain(step) for step in (4 * STEP, 2 * STEP, STEP)])
        np.testing.assert_allclose(np.log2(found[:-1] / found[1:]), 1, atol=0.1)  # steps that are not yet small


if __name__ == "__main__":
    unittest.main()
