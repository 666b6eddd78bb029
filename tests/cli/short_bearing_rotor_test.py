#!/usr/bin/python3
"""Rotors in short bearings: oil whirl and periodic motions against closed forms and two independent methods (verification/short_bearing).

Where the bearing's force is written as expressions the rotor is the same on both sides, and only the step is between them; where it is a film, width over
diameter is, too, whose error falls with its square.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERSEY = os.path.abspath(sys.argv.pop(1))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "verification", "short_bearing"))

import models  # noqa: E402
from cycles import Cycle, HarmonicBalance, correct, newborn  # noqa: E402
from rotor import Rotor, force_by_quadrature, force_of_fixed_film, force_of_moving_film, lyapunov, threshold_of_eccentricity  # noqa: E402

AT_SPEED = np.eye(6)[5]  # the plane on which a limit cycle has a given s


def hersey(text, command, *arguments):
    """Output of a command on a model, as JSON, and the rows of its results where there are any."""
    with tempfile.TemporaryDirectory() as folder:
        model, output = pathlib.Path(folder, "model.yaml"), pathlib.Path(folder, "output")
        model.write_text(text)
        run = subprocess.run([HERSEY, command, model, "--json", *(["--output", output] if command == "run" else []), *map(str, arguments)],
                             capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        rows = None
        if command == "run":
            with h5py.File(output / "results.h5") as file:
                rows = file["time"][:], file["joints/turning/coordinates"][:]
        return json.loads(run.stdout), rows


def threshold_by_hersey(model_of, s):
    """s and whirl ratio at which the forward whirl ceases to decay, of `hersey rotor` at speeds around s."""
    w = np.linspace(0.98, 1.02, 5) * s * models.RATE
    found, _ = hersey(model_of(s), "rotor", "--sweep", f"w={w[0]}:{w[-1]}:{len(w)}")
    whirl = [max((mode for mode in one["modes"] if mode["whirl"] == "forward"), key=lambda mode: mode["growth_rate"]) for one in found["speeds"]]
    growth = [mode["growth_rate"] for mode in whirl]
    at = np.polyval(np.polyfit(growth, w, 3), 0)
    return at / models.RATE, np.polyval(np.polyfit(w, [mode["damped_frequency"] for mode in whirl], 3), at) * 2 * np.pi / at


def spectrum(values, orders=8):
    """X_k of x(t) = Re sum_k X_k exp(i k t), of equally distant values of a period."""
    X = np.fft.rfft(values)[:orders] * 2 / len(values)
    X[0] /= 2
    return X


def extrapolated(coarse, fine):
    """Of steps, or widths, half as large, of second order."""
    return (4 * fine - coarse) / 3


def limit_cycle_by_hersey(text, steps):
    """Period [rad of the shaft] of a found cycle, and |X_k|, |Y_k|, which do not depend on where it begins."""
    _, (time, rows) = hersey(text, "run")
    speed = (rows[-1, 2] - rows[0, 2]) / (time[-1] - time[0])
    xy = rows[-steps:, :2] / models.CLEARANCE
    return (time[-1] - time[-1 - steps]) * speed, np.abs([spectrum(xy[:, k]) for k in range(2)])


def reference(gamma, s, film="moving", size=0.1):
    """The limit cycle at s that grows out of the threshold."""
    cycle = newborn(gamma, film, size)
    for s_on_the_way in np.linspace(cycle.s, s, 4)[1:]:
        cycle = correct(gamma, film, cycle, AT_SPEED, s_on_the_way)
    return cycle


class Reference(unittest.TestCase):
    def test_forces_are_integrals_of_the_pressure(self):
        for state in ((0.3, -0.5, 0.1, 0.2), (0.1, 0.02, -0.3, 0.4), (-0.6, -0.6, 0, 0.1)):
            np.testing.assert_allclose(force_of_moving_film(*state), force_by_quadrature(*state), rtol=1e-7)  # 200000 points, kink at the film's ends
        np.testing.assert_allclose(force_of_moving_film(0.3, -0.5, 0, 0), force_of_fixed_film(0.3, -0.5, 0, 0), rtol=1e-12)  # round-off

    def test_a_rotor_whose_journal_floats_low_enough_never_whirls(self):
        # Short bearings of half a film are stable at every speed beyond an eccentricity ratio of 0.756, where the whirl ratio becomes zero.
        self.assertIsNotNone(threshold_of_eccentricity(0.755)[0])
        self.assertIsNone(threshold_of_eccentricity(0.757)[0])


class Threshold(unittest.TestCase):
    def test_threshold_on_the_closed_form(self):
        for e in (0.1, 0.3, 0.5, 0.7):
            s, gamma, ratio = threshold_of_eccentricity(e)
            found = threshold_by_hersey(lambda at: models.on_closed_form(gamma, at, Rotor(gamma, at).equilibrium()), s)
            np.testing.assert_allclose(found, (s, ratio), rtol=2e-5)  # cubic through five speeds in 4 %

    def test_threshold_on_films_that_become_short(self):
        for e in (0.1, 0.3, 0.5):
            s, gamma, ratio = threshold_of_eccentricity(e)
            found = [np.array(threshold_by_hersey(lambda at: models.on_film(gamma, at, width, grid=(120, 9)), s)) for width in (0.2, 0.1)]
            np.testing.assert_allclose(extrapolated(*found), (s, ratio), rtol=2e-3)  # 120 lines, and the ends of the half film


class KindOfBifurcation(unittest.TestCase):
    """The limit cycle of short bearings lies before the threshold, unstable, where the journal floats high, and beyond it, stable, where it floats low."""

    def of(self, model_of, gamma, s, ratio, beside):
        """Where a small cycle is that `hersey orbits` finds, relative to the threshold, and its largest multiplier."""
        cycle = newborn(gamma, "moving", 0.2)
        at = s * cycle.s / threshold_of_eccentricity(beside)[0]
        text = model_of(at, cycle.start) + models.shooting(72, 1 / ratio, finds_period=True, tolerance=1e-5)
        found, _ = hersey(text, "orbits", "--along", f"w={at * models.RATE}:{1.01 * at * models.RATE}", "--most", 1, "--multipliers", 1)
        multiplier = found["orbits"][0]["multipliers"][0]
        return at / s - 1, abs(complex(multiplier["re"], multiplier["im"]))

    def test_kind_changes_where_that_of_the_closed_form_does(self):
        for e in (0.08, 0.12, 0.2, 0.4):
            s, gamma, ratio = threshold_of_eccentricity(e)
            expected = np.sign(lyapunov(gamma, "moving"))
            side, multiplier = self.of(lambda at, start: models.on_closed_form(gamma, at, start, simulation=""), gamma, s, ratio, e)
            self.assertEqual(np.sign(side), -expected)
            self.assertEqual(np.sign(multiplier - 1), expected)

    def test_kind_on_a_film_is_the_same(self):
        for e in (0.08, 0.3):
            s, gamma, ratio = threshold_of_eccentricity(e)
            on_film = lambda at, start=(0, 0, 0, 0), simulation="": models.on_film(gamma, at, 0.1, start, simulation=simulation)
            s_film, _ = threshold_by_hersey(lambda at: on_film(at, simulation="simulation: {analysis: steady}\n"), s)
            _, multiplier = self.of(on_film, gamma, s_film, ratio, e)
            self.assertEqual(np.sign(multiplier - 1), np.sign(lyapunov(gamma, "moving")))


class LimitCycles(unittest.TestCase):
    def test_limit_cycle_on_the_closed_form(self):
        s, gamma, ratio = threshold_of_eccentricity(0.3)
        exact = reference(gamma, 1.02 * s)
        x, y, _, _ = exact.orbit(gamma, "moving", 256)
        sizes = np.abs([spectrum(x), spectrum(y)])
        # Begun beside the orbit.
        found = [limit_cycle_by_hersey(models.on_closed_form(gamma, 1.02 * s, exact.start * 1.02, simulation=models.shooting(steps, 2, True)), steps) for steps in (72, 144)]
        self.assertAlmostEqual(extrapolated(found[0][0], found[1][0]) / exact.period, 1, delta=2e-6)  # fourth order of a step is left, and 1e-6 of shooting
        np.testing.assert_allclose(extrapolated(found[0][1], found[1][1]), sizes, atol=2e-5)  # likewise; orbit of 0.8 across
        errors = [np.max(abs(one[1] - sizes)) for one in found]
        self.assertAlmostEqual(np.log2(errors[0] / errors[1]), 2, delta=0.1)  # the order

    def test_limit_cycles_on_films_that_become_short(self):
        s, gamma, ratio = threshold_of_eccentricity(0.3)
        exact = reference(gamma, 1.02 * s)
        x, y, _, _ = exact.orbit(gamma, "moving", 256)
        sizes = np.abs([spectrum(x), spectrum(y)])
        found = []
        for width in (0.2, 0.1):
            # As far beyond the threshold as the other: the orbit's size follows from that distance.
            at = 1.02 * threshold_by_hersey(lambda at: models.on_film(gamma, at, width), s)[0]
            found.append(limit_cycle_by_hersey(models.on_film(gamma, at, width, exact.start, simulation=models.shooting(144, 2, True, 1e-5)), 144))
        self.assertAlmostEqual(extrapolated(found[0][0], found[1][0]) / exact.period, 1, delta=3e-3)  # 60 lines, 144 steps
        first = extrapolated(found[0][1], found[1][1])[:, 1]
        np.testing.assert_allclose(first, sizes[:, 1], rtol=1e-2)  # likewise

    def test_fold_is_where_a_large_whirl_sets_in_at_once(self):
        # At an eccentricity ratio of 0.3 the stable cycle grows beyond the threshold, and ends in a fold.
        s, gamma, _ = threshold_of_eccentricity(0.3)
        cycle = reference(gamma, 1.03 * s)
        for s_on_the_way in (1.04 * s, 1.046 * s, 1.048 * s):
            cycle = correct(gamma, "moving", cycle, AT_SPEED, s_on_the_way)
        found = []
        for steps in (40, 80):
            text = models.on_closed_form(gamma, 1.048 * s, cycle.start, simulation=models.shooting(steps, 2, True, 1e-5))
            branch, _ = hersey(text, "orbits", "--along", f"w={1.048 * s * models.RATE}:{1.05 * s * models.RATE}", "--step", 0.4, "--tolerance", 1e-5, "--multipliers", 1, "--most", 14)
            self.assertEqual([one["kind"] for one in branch["bifurcations"]], ["fold"])
            found.append(branch["bifurcations"][0]["value"] / models.RATE)
        # The fold of the reference: its largest s, by a parabola through cycles of given amplitude.
        plane = np.array([*(cycle.start - Rotor(gamma, s).equilibrium()), 0, 0])
        places = plane[:4] @ cycle.start * (1 + np.array([0.02, 0.025, 0.03, 0.035, 0.04]))
        speeds = []
        for place in places:
            cycle = correct(gamma, "moving", cycle, plane, place)
            speeds.append(cycle.s)
        parabola = np.polyfit(places - places[2], speeds, 4)
        turns = np.roots(np.polyder(parabola))
        turn = min((root.real for root in turns if abs(root.imag) < 1e-12), key=abs)
        self.assertAlmostEqual(extrapolated(*found) / np.polyval(parabola, turn), 1, delta=1e-5)  # a fold is within 0.002 of the unit circle


    def test_fold_down_to_which_a_rotor_keeps_its_large_whirl(self):
        # At an eccentricity ratio of 0.1 the unstable cycle grows below the threshold, and a fold makes it stable.
        s, gamma, _ = threshold_of_eccentricity(0.1)
        near = Cycle(np.array([0.135, -0.6295, 0.3135, 0.059]), 12.637, 0.952 * s)  # of a continuation by cycles.py
        cycle = correct(gamma, "moving", near, AT_SPEED, 0.952 * s)
        text = models.on_closed_form(gamma, cycle.s, cycle.start, simulation=models.shooting(72, 2, True, 1e-5))
        branch, _ = hersey(text, "orbits", "--along", f"w={cycle.s * models.RATE}:{0.949 * s * models.RATE}", "--step", 0.4, "--tolerance", 1e-5, "--multipliers", 1, "--most", 16)
        self.assertFalse(branch["orbits"][0]["is_stable"])
        self.assertTrue(branch["orbits"][-1]["is_stable"])
        self.assertEqual([one["kind"] for one in branch["bifurcations"]], ["fold"])
        # 0.950487 by cycles.py: fold_between; 72 steps of an orbit that passes close to where the film has no direction.
        self.assertAlmostEqual(branch["bifurcations"][0]["value"] / models.RATE / s, 0.950487, delta=2e-4)


class Unbalance(unittest.TestCase):
    """One orbit by three ways: harmonics that balance, shooting and waiting."""

    def harmonic_balance(self, rotor):
        guess = None
        for share in (0.3, 0.6, 1.0):
            X, Y, _ = HarmonicBalance(Rotor(rotor.gamma, rotor.s, rotor.film, share * rotor.unbalance), 24).solve(guess)
            guess = X, Y
        return np.array([X, Y])[:, :8]

    def by_hersey(self, text, steps):
        """X_k and Y_k over the shaft's angle, of the last revolution."""
        _, (_, rows) = hersey(text, "run")
        last = rows[-steps:]
        shift = np.exp(-1j * np.arange(8) * last[0, 2])
        return np.array([spectrum(last[:, k] / models.CLEARANCE) * shift for k in range(2)])

    def difference(self, found, exact):
        """Largest distance of two orbits, as a share of their size."""
        waves = np.exp(1j * np.outer(np.arange(256) * 2 * np.pi / 256, np.arange(8)))
        size = max(np.ptp((waves @ exact[k]).real) for k in range(2))
        return max(np.max(abs((waves @ (found[k] - exact[k])).real)) for k in range(2)) / size

    def test_harmonics_shooting_and_waiting_agree(self):
        s, gamma, _ = threshold_of_eccentricity(0.3)
        exact = self.harmonic_balance(Rotor(gamma, 0.9 * s, "moving", 0.3))
        start = exact[0, 0].real, exact[1, 0].real, 0, 0
        for simulation in (lambda steps: models.shooting(steps), lambda steps: models.waiting(steps, 60)):  # deviations fall to 0.84^60 = 3e-5
            found = [self.by_hersey(models.on_closed_form(gamma, 0.9 * s, start, 0.3, simulation(steps)), steps) for steps in (48, 96)]
            self.assertLess(self.difference(extrapolated(*found), exact), 2e-5)  # fourth order of a step, what waiting leaves

    def test_shooting_finds_the_orbit_that_no_rotor_keeps(self):
        s, gamma, _ = threshold_of_eccentricity(0.3)
        exact = self.harmonic_balance(Rotor(gamma, 1.02 * s, "moving", 0.1))
        start = exact[0, 0].real, exact[1, 0].real, 0, 0
        found = [self.by_hersey(models.on_closed_form(gamma, 1.02 * s, start, 0.1, models.shooting(steps)), steps) for steps in (48, 96)]
        self.assertLess(self.difference(extrapolated(*found), exact), 2e-5)  # fourth order of a step

    def test_orbits_on_films_that_become_short(self):
        s, gamma, _ = threshold_of_eccentricity(0.3)
        exact = self.harmonic_balance(Rotor(gamma, 0.9 * s, "moving", 0.3))
        start = exact[0, 0].real, exact[1, 0].real, 0, 0
        found = [self.by_hersey(models.on_film(gamma, 0.9 * s, width, start, 0.3, simulation=models.shooting(96, tolerance=1e-5)), 96) for width in (0.2, 0.1)]
        self.assertLess(self.difference(extrapolated(*found), exact), 5e-3)  # 60 lines, 96 steps


if __name__ == "__main__":
    unittest.main()
