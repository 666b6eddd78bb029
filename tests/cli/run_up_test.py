"""Rotors that run up, coast down or lose a blade, in time: against closed forms, in the summary and in the report.

    run_up_test.py HERSEY [Class.test_name]
"""

import base64
import cmath
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERSEY = sys.argv.pop(1)
RPM = math.pi / 30

# Jeffcott's rotor: a mass on springs that are alike in all directions, rotated by a drive.
MASS, STIFFNESS, DAMPING, MOMENT = 10.0, 1e6, 632.0, 1e-5  # a damping ratio of 0.1
JEFFCOTT = """hersey: 1
parameters: {begins: 0 s, duration: 0.5 s, gravity: 0}
gravity: 0 ${gravity} 0 m/s^2
bodies:
  rotor: {mass: 10 kg, inertia: {xx: 0.05 kg.m^2, yy: 0.05 kg.m^2, zz: 0.08 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, rotor], axis: z}
forces:
  support:
    type: bearing_table
    between: [ground, rotor]
    stiffness: {xx: 1 MN/m, yy: 1 MN/m}
    damping: {xx: 632 N.s/m, yy: 632 N.s/m}
  blade: {type: unbalance, on: rotor, amount: 10 g.mm, phase: 40 deg, begins: "${begins}"}
drives:
  motor: {joint: turning, coordinate: rotation, speed: SPEED}
simulation: {duration: "${duration}", step: STEP, spectral_radius: 0.95}
"""


def linear(speed):
    """Steady amplitude of exp(i theta) of the rotor's answer to its unbalance at phase zero."""
    return MOMENT * speed**2 / (STIFFNESS - MASS * speed**2 + 1j * DAMPING * speed)


def second_difference(function, at, step):
    return (function(at + step) - 2 * function(at) + function(at - step)) / step**2


def duhamel(speed, phase, since):
    """x + i y of the rotor at rest on which the unbalance begins to act at its direction `phase`, a time `since` later."""
    steady = linear(speed) * cmath.exp(1j * phase)
    decay = DAMPING / (2 * MASS)
    roots = [-decay + sign * 1j * math.sqrt(STIFFNESS / MASS - decay**2) for sign in (1, -1)]
    # Two free motions take displacement and velocity of the steady one away at the start.
    first = (1j * speed - roots[1]) * steady / (roots[1] - roots[0])
    second = -steady - first
    since = np.maximum(since, 0)
    free = first * np.exp(roots[0] * since) + second * np.exp(roots[1] * since)
    return np.where(since > 0, steady * np.exp(1j * speed * since) + free, 0)


class RunUp(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def hersey(self, *arguments, code=0):
        done = subprocess.run([HERSEY, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def run_model(self, speed, step, *arguments):
        (self.folder / "model.yaml").write_text(JEFFCOTT.replace("SPEED", speed).replace("STEP", step), encoding="utf-8")
        self.hersey("run", self.folder / "model.yaml", "--output", self.folder / "out", "--force", *arguments)
        return self.folder / "out/results.h5"

    # -- blade-out ----------------------------------------------------------------------------------------------

    def blade_out(self, step, *arguments, begins=0.0333):
        """(times, x + i y less Duhamel's integral over the steady amplitude, results)."""
        speed = 3000 * RPM
        path = self.run_model(f"{speed!r} rad/s", step, "--set", f"begins={begins} s", "--set", "duration=0.2 s", *arguments)
        with h5py.File(path) as file:
            t, z = file["time"][...], file["bodies/rotor/position"][...] @ (1, 1j, 0)
            rest = {name: file[f"energy/since_start/{name}"][...] for name in ("unexplained", "put_in")}
            kinetic = file["energy/kinetic"][...]
        expected = duhamel(speed, speed * begins + math.radians(40), t - begins)
        return t, z, (z - expected) / abs(linear(speed)), rest, kinetic

    def test_a_blade_that_is_lost_acts_from_its_instant_on(self):
        t, z, error, rest, kinetic = self.blade_out("0.1 ms")
        before = t <= 0.0333 + 1e-12  # of the sum of steps
        self.assertEqual(float(np.abs(z[before]).max()), 0)
        self.assertLess(np.abs(t - 0.0333).min(), 1e-12)  # a step ends at it
        self.assertLess(np.abs(error).max(), 2.5e-3)  # of second order: see below
        self.assertGreater(np.abs(z[~before]).max(), 0.9 * abs(linear(3000 * RPM)))
        # What the drive puts in afterwards is a thousandth of what the shaft has: the trapezoidal rule of the balance, too.
        self.assertLess(np.abs(rest["unexplained"]).max(), 1e-3 * np.abs(rest["put_in"][t > 0.034] - rest["put_in"][before][-1]).max())
        self.assertLess(np.abs(np.diff(kinetic[before])).max(), 1e-12 * kinetic[0])  # round-off

    def test_its_error_falls_with_the_square_of_the_step(self):
        coarse, fine = (np.abs(self.blade_out(step)[2]).max() for step in ("0.2 ms", "0.1 ms"))
        self.assertAlmostEqual(coarse / fine, 4, delta=0.3)  # the next order of a twentieth of a radian a step

    def test_its_instant_may_lie_beside_the_end_of_a_step(self):
        for begins in (0.0333 - 1e-9, 0.0333 + 1e-9, 0.03330123):
            t, z, error, _, _ = self.blade_out("0.1 ms", begins=begins)
            self.assertLess(np.abs(t - begins).min(), 1e-12)  # of the sum of steps
            self.assertEqual(float(np.abs(z[t <= begins + 1e-12]).max()), 0)  # likewise
            self.assertLess(np.abs(error).max(), 2.5e-3)  # as above

    def test_steps_by_their_error_end_at_it_too(self):
        t, z, error, _, _ = self.blade_out("{tolerance: 1e-10}", begins=0.04137)
        self.assertEqual(float(np.abs(z[t <= 0.04137]).max()), 0)
        self.assertIn(0.04137, t)
        self.assertLess(np.abs(error).max(), 5e-3)  # falls with the power 2/3 of the tolerance: 0.009 at 1e-9, 0.002 here

    def test_a_blade_at_the_start_or_after_the_end(self):
        with_key = self.run_model("3000 rpm", "0.5 ms", "--set", "duration=10 ms")
        with h5py.File(with_key) as file:
            at_start = file["bodies/rotor/position"][...]
        text = JEFFCOTT.replace("SPEED", "3000 rpm").replace("STEP", "0.5 ms").replace(', begins: "${begins}"', "")
        (self.folder / "always.yaml").write_text(text, encoding="utf-8")
        self.hersey("run", self.folder / "always.yaml", "--output", self.folder / "always", "--set", "duration=10 ms")
        with h5py.File(self.folder / "always/results.h5") as file:
            self.assertTrue(np.array_equal(file["bodies/rotor/position"][...], at_start))
        never = self.run_model("3000 rpm", "0.5 ms", "--set", "begins=1 s", "--set", "duration=10 ms")
        with h5py.File(never) as file:
            self.assertEqual(np.abs(file["bodies/rotor/position"][...]).max(), 0)

    # -- run-up -------------------------------------------------------------------------------------------------

    FIRST, RATE, LENGTH = 150.0, 26.0, 13.0  # rad/s, rad/s^2, s: from 0.47 to 1.54 of the critical speed of 316 rad/s

    def run_up(self, down=False):
        last = self.FIRST + self.RATE * self.LENGTH
        speed = f"{last} - {self.RATE}*t" if down else f"{self.FIRST} + {self.RATE}*t"
        return self.run_model(f'{{expression: "{speed}", unit: rad/s}}', "0.2 ms", "--set", f"duration={self.LENGTH} s")

    def page_data(self):
        page = (self.folder / "out/report.html").read_text(encoding="utf-8")
        return json.loads(re.search(r'<script id="hersey-data" type="application/json">(.*?)</script>', page, re.S)[1])

    @staticmethod
    def numbers(text):
        return np.frombuffer(base64.b64decode(text["data"]), np.float32).reshape(text["shape"]).astype(float)

    def expected(self, speed, rate):
        """Amplitude while the speed changes: the steady one, the tangential force of the unbalance, and what the change of speed
        adds in first order, -i rate/2 d^2/d speed^2 of the answer to a force of one size."""
        answer = lambda w: 1 / (STIFFNESS - MASS * w**2 + 1j * DAMPING * w)
        force = lambda w: MOMENT * (w**2 - 1j * rate)
        slow = answer(speed) * force(speed)
        passing = -0.5j * rate * second_difference(lambda w: answer(w) * MOMENT * w**2, speed, 0.1)
        return (slow + passing) * cmath.exp(1j * math.radians(40))

    def require_tracks(self, rate):
        data = self.page_data()["runs"][0]["run_up"]
        self.assertEqual((data["shaft"], data["revolutions"], data["orders"]), ("turning", 8, [0.5, 1, 2]))
        self.assertEqual([(d["path"], d["column"]) for d in data["displacements"]], [("/bodies/rotor/position", k) for k in (0, 1)])
        largest = abs(linear(math.sqrt(STIFFNESS / MASS)))
        for d, ahead in zip(data["displacements"], (0, math.pi / 2)):
            speed, amplitude, lag = (self.numbers(d[key]) for key in ("speed", "amplitude", "lag"))
            self.assertEqual(amplitude.shape, (200, 3))
            found = amplitude[:, 1] * np.exp(-1j * lag[:, 1])
            wanted = np.array([self.expected(w, rate) for w in speed]) * np.exp(-1j * ahead)
            # The motion from rest dies out in a second; a window spans 4 rad/s of a peak 63 rad/s wide; the next order of the rate.
            inner = np.abs(speed - speed[0]) > 30
            self.assertLess(np.abs(found - wanted)[inner].max() / largest, 6e-3)
            self.assertLess(amplitude[inner][:, (0, 2)].max() / largest, 1e-3)  # the growth in a window
            steady = np.array([abs(linear(w)) for w in speed])
            peak = np.argmax(amplitude[:, 1])
            self.assertLess(abs(amplitude[peak, 1] / steady.max() - 1), 0.02)  # what a window of 4 rad/s and the rate, 26/31.6^2, take in second order
            self.assertLess(abs(self.numbers(d["peak_to_peak"])[peak] / (2 * amplitude[peak, 1]) - 1), 0.01)  # 20 rows a revolution
            # The unbalance is 40 deg ahead of the mark; along y all is a quarter later.
            turned = np.degrees(np.unwrap(lag[:, 1] if speed[0] < speed[-1] else lag[::-1, 1]))
            self.assertAlmostEqual((turned[-1] - turned[0]), self.turned(max(speed)) - self.turned(min(speed)), delta=3)
        return data

    @staticmethod
    def turned(speed):
        return -math.degrees(cmath.phase(linear(speed)))

    def test_orders_of_a_run_up_are_the_linear_answer(self):
        self.run_up()
        data = self.require_tracks(self.RATE)
        for d in data["displacements"]:
            speed, frequency, amplitude = (self.numbers(d["cascade"][key]) for key in ("speed", "frequency", "amplitude"))
            self.assertTrue(np.all(np.diff(speed) > 0))
            ridge = frequency[np.argmax(amplitude, axis=1)]
            # A piece of the run lasts 0.63 s: the speed rises by 2.6 Hz in it.
            self.assertLess(np.abs(ridge - speed / (2 * math.pi))[2:].max(), 1.5)

    def test_a_coast_down_has_the_answer_of_the_run_up(self):
        self.run_up(down=True)
        self.require_tracks(-self.RATE)

    def test_the_summary_names_the_critical_speed(self):
        path = self.run_up()
        rows = [row for row in json.loads(self.hersey("report", path, "--json").stdout) if row["group"] == "run-up"]
        self.assertEqual([row["name"] for row in rows], ["largest 1x amplitude, rotor"])
        critical, (row,) = math.sqrt(STIFFNESS / MASS) / RPM, rows
        self.assertEqual(row["unit"], "m")
        self.assertLess(abs(row["value"] / max(abs(linear(w)) for w in range(280, 360)) - 1), 0.02)
        axis, speed, lag = re.fullmatch(r"along ([xy]), ([\d.]+) rpm of turning, t = [\d.e+]+ ms, lags by (-?\d+)°", row["where"]).groups()
        # The peak of U w^2/... lies 1/(1 - 2 zeta^2)^.5 above, 1 %; the rate moves it by 26/63 rad/s and windows are 1.6 rad/s apart.
        self.assertLess(abs(float(speed) / critical - 1.01), 0.01)
        # The unbalance is 40 deg ahead, y a quarter behind; 1 % of speed turn the phase by 6 deg.
        self.assertLess(abs(float(lag) - (90 - 40 + (90 if axis == "y" else 0))), 12)
        headings = [line for line in self.hersey("report", "--all", path).stdout.splitlines() if line and not line.startswith(" ")]
        self.assertIn("run-up or coast-down", headings)
        self.assertFalse([line for line in headings if line.startswith("bearing")], "there is no bearing")

    def test_a_shaft_that_turns_round_is_tracked_in_the_longer_direction(self):
        # From 50 rad/s forward to 350 backward: the rotor turns round after 0.25 s.
        speed = "{expression: '50 - 200*t', unit: rad/s}"
        self.run_model(speed, "0.5 ms", "--set", "duration=2 s")
        data = self.page_data()["runs"][0]["run_up"]
        for d in data["displacements"]:
            self.assertGreater(self.numbers(d["time"])[0], 0.25)
            speed, frequency, amplitude = (self.numbers(d["cascade"][key]) for key in ("speed", "frequency", "amplitude"))
            ridge = frequency[np.argmax(amplitude, axis=1)]
            # Pieces last 0.09 s, in which the speed rises by 2.7 Hz; the slow ones have less than a revolution.
            self.assertLess(np.abs(ridge - speed / (2 * math.pi))[speed > 100].max(), 4)

    def test_a_run_at_constant_speed_has_no_run_up(self):
        self.run_model("3000 rpm", "0.5 ms", "--set", "duration=0.6 s")
        self.assertNotIn("run_up", self.page_data()["runs"][0])


if __name__ == "__main__":
    unittest.main()
