#!/usr/bin/python3
"""Directional and adjoint derivatives of FMUs of both versions, against steps from a changed input.

derivatives_test.py HERSEY WORK [Class.test]"""

import os
import shutil
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import fmu_test  # noqa: E402  takes HERSEY and WORK off the arguments
from fmu_test import H_MIN, LOAD_Y, STEP  # noqa: E402
from importer import ERROR, OK, Fmu  # noqa: E402

LOAD_X, SPEED = "forces.push.components.x", "drives.motor.speed"
# With steps of differences [SI]: nodes of the film that switch between full and cavitated bend what longer ones see.
KNOWNS = {LOAD_X: 0.1, LOAD_Y: 0.1, SPEED: 0.05}
VECTORS = [["bodies.rod.position.x", "bodies.rod.position.y"], ["bodies.rod.velocity.x", "bodies.rod.velocity.y"],
           ["bearings.big_end.force.x", "bearings.big_end.force.y"], [H_MIN], ["bearings.big_end.p_max"],
           ["bearings.big_end.power_film"], ["bearings.big_end.torque_journal"], ["joints.main.coordinates"]]
UNKNOWNS = [name for vector in VECTORS for name in vector]


class Cases:
    version = 0

    @classmethod
    def setUpClass(cls):
        os.makedirs(fmu_test.WORK, exist_ok=True)
        cls.folder = tempfile.mkdtemp(prefix=f"derivatives {cls.version} ", dir=fmu_test.WORK)
        cls.fmu = cls.export("rig", fmu_test.RIG, "simulation.tolerance=1e-11")  # so that differences have digits

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def export(cls, name, text, *sets):
        model, path = (os.path.join(cls.folder, name + suffix) for suffix in (".yaml", ".fmu"))
        with open(model, "w", encoding="utf-8") as file:
            file.write(text)
        fmu_test.run("export", model, "--fmu", path, "--fmi", cls.version, *[w for change in sets for w in ("--set", change)])
        return Fmu(path, os.path.join(cls.folder, name))

    def between(self, first, length):
        """An instance, with its state before and behind a step of `length` for which all inputs were set."""
        one = fmu_test.Instance(self.fmu).initialise()
        one.march(first)
        for name, value in ((LOAD_X, 20.0), (LOAD_Y, -600.0), (SPEED, 310.0)):
            self.assertEqual(one.set(name, value), OK)
        before = one.state()
        self.assertEqual(one.step(first * STEP, length), OK, one.log)
        return one, before

    def differences(self, one, before, name, first, length):
        """d UNKNOWNS / d name by central differences of steps, extrapolated from two of them."""
        def outputs(value):
            one.restore(before)
            self.assertEqual(one.set(name, value), OK)
            self.assertEqual(one.step(first * STEP, length), OK, one.log)
            return np.array([one.get(unknown) for unknown in UNKNOWNS])
        one.restore(before)
        value, step = one.get(name), KNOWNS[name]
        coarse, fine = [(outputs(value + h) - outputs(value - h)) / (2 * h) for h in (step, step / 2)]
        return fine + (fine - coarse) / 3

    def test_derivatives_are_those_of_steps_with_another_input(self):
        for first, length in ((3, STEP), (2, 5 * STEP), (4, 2.6 * STEP), (1, 0.3 * STEP)):
            one, before = self.between(first, length)
            found = np.array(one.jacobian(UNKNOWNS, list(KNOWNS)))
            values = np.array([one.get(unknown) for unknown in UNKNOWNS])
            for column, name in enumerate(KNOWNS):
                expected, row = self.differences(one, before, name, first, length), 0
                for vector in VECTORS:
                    part = slice(row, row + len(vector))
                    off = np.abs(found[part, column] - expected[part]).max()
                    asked = 1e-6 * np.abs(expected[part]).max()  # what is asked of derivatives
                    digits = 1e-13 * np.abs(values[part]).max() / KNOWNS[name]  # that differences have, where outputs hardly answer
                    self.assertLessEqual(off, asked + digits, f"{vector} by {name} over {length}")
                    row += len(vector)
            one.release(before)
            one.free()

    def test_a_direction_is_the_sum_of_its_inputs(self):
        one, _ = self.between(2, STEP)
        whole = np.array(one.jacobian(UNKNOWNS, list(KNOWNS)))
        seed = [3.0, -0.5, 0.25]
        status, found = one.derivatives("Directional", UNKNOWNS, list(KNOWNS), seed, len(UNKNOWNS))
        self.assertEqual(status, OK)
        np.testing.assert_allclose(found, whole @ seed, rtol=1e-14, atol=0)  # a sum of three
        one.free()

    def test_asking_changes_no_bit(self):
        asked, left = fmu_test.Instance(self.fmu).initialise(), fmu_test.Instance(self.fmu).initialise()
        for k in range(6):
            rows = asked.march(1, first=k)
            asked.jacobian([H_MIN], [LOAD_Y])
            self.assertEqual(rows, left.march(1, first=k))
            self.assertEqual(asked.get(H_MIN), rows[0])
            self.assertEqual(asked.get(LOAD_Y), left.get(LOAD_Y))
        asked.free()
        left.free()

    def test_before_the_first_step_no_input_has_acted(self):
        one = fmu_test.Instance(self.fmu).initialise()
        self.assertEqual(one.jacobian(UNKNOWNS, list(KNOWNS)), [[0, 0, 0]] * len(UNKNOWNS))
        one.free()

    def test_what_there_is_no_derivative_of_is_said(self):
        one, before = self.between(1, STEP)
        for unknown, known, why in ((LOAD_Y, LOAD_Y, "is no output"), (H_MIN, fmu_test.CLEARANCE, "is no input"),
                                    (H_MIN, H_MIN, "is no input"), (4000000, LOAD_Y, "value reference"),
                                    ("time", LOAD_Y, "value reference")):
            self.assertEqual(one.derivatives("Directional", [unknown], [known], [1.0], 1)[0], ERROR)
            self.assertIn(why, one.log[-1][1])
        one.restore(before)  # behind it no step has been taken
        self.assertEqual(one.derivatives("Directional", [H_MIN], [LOAD_Y], [1.0], 1)[0], ERROR)
        self.assertIn("a step taken before", one.log[-1][1])
        one.release(before)
        one.free()

    def test_models_without_derivatives_say_so(self):
        fmu = self.export("chosen", fmu_test.RIG.replace("step: 0.1 ms", "step: {tolerance: 1e-4}"))
        flag = "providesDirectionalDerivative" + ("s" if self.version == 3 else "")
        self.assertEqual(fmu.description.find("CoSimulation").get(flag), "false")
        self.assertEqual(self.fmu.description.find("CoSimulation").get(flag), "true")
        one = fmu_test.Instance(fmu).initialise()
        self.assertEqual(one.step(0, STEP), OK)
        self.assertEqual(one.derivatives("Directional", [H_MIN], [LOAD_Y], [1.0], 1)[0], ERROR)
        self.assertIn("steps of fixed length", one.log[-1][1])
        one.free()


class Fmi2Test(Cases, unittest.TestCase):
    version = 2


class Fmi3Test(Cases, unittest.TestCase):
    version = 3

    def test_adjoint_is_the_transposed(self):
        one, _ = self.between(2, 2 * STEP)
        around = "bearings.big_end.h_min_around"
        unknowns, size = [around, "bodies.rod.velocity.y"], self.fmu.sizes[around]
        columns = []
        for k in range(len(KNOWNS)):
            status, column = one.derivatives("Directional", unknowns, list(KNOWNS),
                                             [float(j == k) for j in range(len(KNOWNS))], size + 1)
            self.assertEqual(status, OK, one.log)
            columns.append(column)
        weights = list(np.linspace(1, 2, size)) + [0.5]
        status, found = one.derivatives("Adjoint", unknowns, list(KNOWNS), weights, len(KNOWNS))
        self.assertEqual(status, OK, one.log)
        np.testing.assert_allclose(found, np.array(columns) @ weights, rtol=1e-13)  # sums of 25 terms of one sign
        by_scalars = one.jacobian([f"{around}[{k + 1}]" for k in range(size)], [LOAD_Y])
        self.assertEqual([row[0] for row in by_scalars], columns[1][:size])
        self.assertEqual(one.derivatives("Adjoint", unknowns, list(KNOWNS), weights[1:], len(KNOWNS))[0], ERROR)
        self.assertIn("seeds", one.log[-1][1])
        one.free()

    def test_neighbours_are_near_enough_for_a_jump_of_speed_against_a_film(self):
        """A crank whose speed jumps moves its rod as by an impulse: the cavitated film answers along a bent line."""
        root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
        folder = os.path.join(self.folder, "slider crank")
        shutil.copytree(os.path.join(root, "examples", "slider_crank"), folder)
        with open(os.path.join(folder, "model.yaml"), encoding="utf-8") as file:
            fmu = self.export(os.path.join("slider crank", "crank"), file.read(), "simulation.tolerance=1e-11")
        step = float(fmu.description.find("DefaultExperiment").get("stepSize"))
        force, h = [f"bearings.big_end.force.{axis}" for axis in "xy"], 1e-3
        one = fmu_test.Instance(fmu).initialise(stop=100 * step)
        for first in (3, 40):
            one.march(first - round(one.get("time") / step), step, round(one.get("time") / step))
            before, speed = one.state(), one.get(SPEED)
            self.assertEqual(one.step(first * step, step), OK, one.log)
            found = np.array([row[0] for row in one.jacobian(force, [SPEED])])
            ends = []
            for value in (speed + h, speed - h):
                one.restore(before)
                self.assertEqual(one.set(SPEED, value), OK)
                self.assertEqual(one.step(first * step, step), OK, one.log)
                ends.append(np.array([one.get(name) for name in force]))
            expected = (ends[0] - ends[1]) / (2 * h)
            self.assertLessEqual(np.abs(found - expected).max(), 1e-6 * np.abs(expected).max())  # what is asked of derivatives
            one.restore(before)
            one.release(before)
        one.free()


if __name__ == "__main__":
    unittest.main()
