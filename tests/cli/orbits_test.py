#!/usr/bin/python3
"""`hersey orbits`: branches of periodic motions against independent solutions, and the command as users call it."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

HERSEY = os.path.abspath(sys.argv.pop(1))

# x'' + 4 x' + 1e4 x + 1e10 x^3 = 0.2 cos(omega t)
DUFFING = """hersey: 1
title: A hardening spring
parameters: {omega: 80, steps: 100}
bodies:
  weight: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  slide: {type: prismatic, between: [ground, weight], axis: x}
forces:
  spring: {type: sliding_spring, joint: slide, stiffness: 1e4 N/m, damping: 4 N.s/m}
  rest: {type: force, body: weight, direction: x, magnitude: {expression: "0.2*cos(${omega}*t) - 1e10*slide.translation^3", unit: N}}
simulation:
  cycle: {period: "2*pi s/${omega}", lead_in: shooting}
  step: "2*pi s/${omega}/${steps}"
  spectral_radius: 1
"""

# An oscillator that is pushed: beyond a push it keeps to its rhythm, below it its own frequency sets in.
FORCED_VAN_DER_POL = """hersey: 1
parameters: {push: 1.5, w: 1.3, steps: 120}
bodies:
  weight: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  slide: {type: prismatic, between: [ground, weight], axis: x, initial: {translation: 1.5 m}}
forces:
  spring: {type: sliding_spring, joint: slide, stiffness: 1 N/m}
  rest: {type: force, body: weight, direction: x, magnitude: {expression: "0.4*(1 - slide.translation^2)*slide.translation_rate + ${push}*cos(${w}*t)", unit: N}}
simulation:
  cycle: {period: "2*pi s/${w}", lead_in: shooting}
  step: "2*pi s/${w}/${steps}"
  spectral_radius: 1
"""


# A rotor with an unbalance on a support that hardens alike in all directions.
HARDENING = """hersey: 1
parameters: {speed: 2500 rpm, revolution: "2*pi rad/${speed}", steps: 120}
bodies:
  rotor: {mass: 10 kg, inertia: {xx: 0.05 kg.m^2, yy: 0.05 kg.m^2, zz: 0.08 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, rotor], axis: z}
forces:
  support: {type: bearing_table, between: [ground, rotor], stiffness: {xx: 1 MN/m, yy: 1 MN/m}, damping: {xx: 200 N.s/m, yy: 200 N.s/m}}
  x: {type: force, body: rotor, direction: x, magnitude: {expression: "-3e12*(turning.x^2 + turning.y^2)*turning.x", unit: N}}
  y: {type: force, body: rotor, direction: y, magnitude: {expression: "-3e12*(turning.x^2 + turning.y^2)*turning.y", unit: N}}
  residual: {type: unbalance, on: rotor, amount: 200 g.mm}
drives:
  motor: {joint: turning, coordinate: rotation, speed: "${speed}"}
simulation:
  cycle: {period: "${revolution}", lead_in: shooting}
  step: "${revolution}/${steps}"
  spectral_radius: 0.95
"""


def hersey(*arguments):
    return subprocess.run([HERSEY, *map(str, arguments)], capture_output=True, text=True)


def branch(text, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        model = pathlib.Path(folder, "model.yaml")
        model.write_text(text)
        run = hersey("orbits", model, "--json", *arguments)
        assert run.returncode == 0, run.stderr
        return json.loads(run.stdout)


def over_a_period(force, slope, period, start, parameter):
    """End of a period and its derivative by the start, of x'' = force(t, x, v, parameter)."""

    def rates(t, y):
        x, v, *S = y
        S = np.reshape(S, (2, 2))
        A = np.array([[0, 1], slope(t, x, v, parameter)])
        return [v, force(t, x, v, parameter), *(A @ S).ravel()]

    end = solve_ivp(rates, (0, period), [*start, 1, 0, 0, 1], rtol=1e-10, atol=1e-12, method="DOP853").y[:, -1]
    return end[:2], np.reshape(end[2:], (2, 2))


def bifurcation(force, slope, period_of, guess, test):
    """Start and parameter of a periodic motion whose multipliers satisfy test(M) = 0."""

    def misfit(unknown):
        *start, parameter = unknown
        end, M = over_a_period(force, slope, period_of(parameter), start, parameter)
        return [*(end - start), test(M)]

    return fsolve(misfit, guess, xtol=1e-9)


def extrapolated(coarse, fine):
    """Of steps half as long, of second order."""
    return (4 * fine - coarse) / 3


class Branches(unittest.TestCase):
    def test_folds_are_those_of_an_independent_solution(self):
        # In mm and units of 10 ms, so that all numbers are of the order of 1.
        force = lambda t, x, v, w: -0.04 * v - x - x**3 + 0.02 * np.cos(w * t)
        slope = lambda t, x, v, w: [-1 - 3 * x * x, -0.04]
        found = [branch(DUFFING, "--along", "omega=80:130", "--set", f"steps={n}", "--tolerance", "1e-6") for n in (100, 200)]
        for which in range(2):
            coarse, fine = (one["bifurcations"][which] for one in found)
            self.assertEqual((coarse["kind"], fine["kind"]), ("fold", "fold"))
            beside = found[1]["orbits"][fine["behind"]]
            w = fine["value"] / 100
            amplitude = beside["quantities"]["joints.slide.coordinates"]["highest"] * 1e3
            # One harmonic: A cos(w t - phase).
            phase = np.arctan2(0.04 * w * amplitude, (1 - w * w) * amplitude + 0.75 * amplitude**3)
            start = [amplitude * np.cos(phase), amplitude * w * np.sin(phase)]
            exact = bifurcation(force, slope, lambda w: 2 * np.pi / w, [*start, w], lambda M: np.linalg.det(M - np.eye(2)))[2]
            # A fold is located between orbits, one of which is within 0.002 of the unit circle.
            self.assertAlmostEqual(extrapolated(coarse["value"], fine["value"]) / (100 * exact), 1, delta=1e-4)

    def test_a_fold_is_found_in_a_narrow_range(self):
        # In which the motion changes by so little that the branch has a corner there.
        on_the_way = ("--set", "joints.slide.initial.translation_rate=50.4 mm/s")
        for along in ("omega=107.8:107.95", "omega=107:109"):
            found = branch(DUFFING, "--along", along, "--step", "0.2", *on_the_way)
            self.assertEqual([one["kind"] for one in found["bifurcations"]], ["fold"])
            # That of the whole range at 100 steps, whose multipliers are found to 1e-3.
            self.assertAlmostEqual(found["bifurcations"][0]["value"] / 107.8863, 1, delta=2e-5)
            self.assertLess(found["orbits"][-1]["value"], found["bifurcations"][0]["value"])

    def test_orbits_of_a_rotor_on_a_hardening_support_are_circles_of_the_closed_form(self):
        m, k, k3, c, me = 10, 1e6, 3e12, 200, 2e-4
        found = [branch(HARDENING, "--along", "speed=2500:5000rpm", "--set", f"steps={n}", "--tolerance", "1e-5") for n in (60, 120)]
        # ((k + k3 A^2 - m w^2)^2 + c^2 w^2) A^2 = (m e w^2)^2, over A for w^2: two branches that meet at the largest A.
        A = np.linspace(50e-6, 377.5e-6, 400001)
        a, b = m * m - (me / A) ** 2, c * c - 2 * m * (k + k3 * A**2)
        w = np.sqrt((-b + np.sqrt(b * b - 4 * a * (k + k3 * A**2) ** 2)) / (2 * a)) * 30 / np.pi
        turns = np.flatnonzero(np.diff(np.sign(np.diff(w)))) + 1
        self.assertEqual([[b["kind"] for b in one["bifurcations"]] for one in found], [["fold", "fold"]] * 2)
        for exact, k_th in zip(sorted(w[turns], reverse=True), range(2)):
            coarse, fine = (one["bifurcations"][k_th]["value"] for one in found)
            # Of fourth order of a step is left, and a fold is within 0.002 of the unit circle.
            self.assertAlmostEqual(extrapolated(coarse, fine) / exact, 1, delta=2e-4)
        for orbit in found[1]["orbits"]:
            # Deviations of each of two pairs: all decay like exp(-c T/(2 m)) but between the folds.
            decay = np.exp(-c / (2 * m) * orbit["period"])
            largest = abs(complex(orbit["multipliers"][0]["re"], orbit["multipliers"][0]["im"]))
            self.assertGreater(largest, decay * (1 - 1e-2))  # 120 steps, and pairs that nearly coincide
            x, y = (orbit["quantities"][f"joints.turning.coordinates.{name}"]["highest"] for name in "xy")
            self.assertAlmostEqual(x / y, 1, delta=2e-3)  # rows at 120 steps

    def test_a_second_frequency_sets_in_where_an_independent_solution_has_it(self):
        force = lambda t, x, v, f: 0.4 * (1 - x * x) * v - x + f * np.cos(1.3 * t)
        slope = lambda t, x, v, f: [-0.8 * x * v - 1, 0.4 * (1 - x * x)]
        period = 2 * np.pi / 1.3
        found = branch(FORCED_VAN_DER_POL, "--along", "push=1.5:0.3", "--set", "steps=240")
        torus = found["bifurcations"][0]
        self.assertEqual(torus["kind"], "torus")
        beside = found["orbits"][torus["behind"]]
        self.assertTrue(beside["is_stable"])
        waited = solve_ivp(lambda t, y: [y[1], force(t, *y, beside["value"])], (0, 40 * period), [1.5, 0], rtol=1e-8).y[:, -1]
        exact = bifurcation(force, slope, lambda f: period, [*waited, torus["value"]], lambda M: np.linalg.det(M) - 1)
        # 240 steps, and multipliers that are found to 1e-3.
        self.assertAlmostEqual(torus["value"] / exact[2], 1, delta=3e-3)
        _, M = over_a_period(force, slope, period, exact[:2], exact[2])
        frequency = abs(np.angle(np.linalg.eigvals(M)[0])) / (2 * np.pi * period)
        self.assertAlmostEqual(torus["frequency"] / frequency, 1, delta=5e-3)  # likewise


class Command(unittest.TestCase):
    def test_page_and_results_are_written(self):
        with tempfile.TemporaryDirectory() as folder:
            model, page, results = (pathlib.Path(folder, name) for name in ("model.yaml", "page.html", "orbits.json"))
            model.write_text(DUFFING)
            run = hersey("orbits", model, "--along", "omega=80:90", "--report", page, "--results", results)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("ended at the end of the range", run.stdout)
            self.assertIn("A hardening spring", page.read_text())
            found = json.loads(results.read_text())
            self.assertEqual(found["orbits"][0]["value"], 80)
            self.assertEqual(found["orbits"][-1]["value"], 90)
            self.assertEqual(found["units"], {"joints.slide.coordinates": "m"})

    def test_a_quantity_may_be_named_with_its_component(self):
        found = branch(DUFFING, "--along", "omega=80:81", "--observe", "joints.slide.rates,energy.kinetic")
        self.assertEqual(set(found["units"]), {"joints.slide.rates", "energy.kinetic"})

    def test_mistakes_are_explained(self):
        with tempfile.TemporaryDirectory() as folder:
            model = pathlib.Path(folder, "model.yaml")
            model.write_text(DUFFING)
            for along, words in (("omega", "a parameter and its range"), ("omega=80:80", "without length"),
                                 ("omega=80 rpm:90 rad/s", "two units"), ("omeg=80:90", "did you mean")):
                run = hersey("orbits", model, "--along", along)
                self.assertNotEqual(run.returncode, 0)
                self.assertIn(words, run.stderr)
                self.assertTrue(run.stderr.startswith("--along"), run.stderr)
            # Before an orbit is looked for, which may take minutes.
            for option in ("--report", "--results"):
                run = hersey("orbits", model, "--along", "omega=80:90", option, f"{folder}/missing/file")
                self.assertNotEqual(run.returncode, 0)
                self.assertNotIn("periods", run.stderr)
                self.assertIn("in a folder that exists", run.stderr)
            model.write_text(DUFFING.replace("cycle: {period: \"2*pi s/${omega}\", lead_in: shooting}", "duration: 1 s"))
            run = hersey("orbits", model, "--along", "omega=80:90")
            self.assertNotEqual(run.returncode, 0)
            self.assertIn("lead_in: shooting", run.stderr)


if __name__ == "__main__":
    unittest.main()
