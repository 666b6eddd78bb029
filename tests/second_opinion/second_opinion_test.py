#!/usr/bin/python3
"""The second film solver is right by itself, where closed forms are known, and agrees with hersey on a few random bearings.

    second_opinion_test.py HERSEY [Class.test_name]
"""

import math
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import comparison  # noqa: E402  (it finds the second solver)
import in_time  # noqa: E402
import numpy as np  # noqa: E402
from bearing import Bearing, Feature  # noqa: E402
from figures import figures  # noqa: E402
from film import FREE, Film, Motion, march  # noqa: E402

HERSEY = os.path.abspath(sys.argv.pop(1))

R, C, MU, SPEED = 0.025, 25e-6, 0.02, 300.0
UNIT = MU * SPEED * (R / C) ** 2  # of pressure
SECOND_ORDER = (3.0, 5.5)  # by which halved cells reduce an error of second order, about


def solved(bearing, motion, columns, rows):
    film = Film(bearing, motion, columns, rows)
    film.solve()
    return film, figures(film)


class ClosedForms(unittest.TestCase):
    def test_a_wide_half_film_is_guembel_s(self):
        e = 0.6
        b = Bearing(R, 0.01, C, MU, cavitation="guembel", edges=(None, None), line=math.pi, line_pressure=0.0, shear_force="torque_only")
        radial = 12 * e**2 / ((2 + e**2) * (1 - e**2))
        tangential = 6 * math.pi * e / ((2 + e**2) * math.sqrt(1 - e**2))
        exact = UNIT * R * b.L * math.hypot(radial, tangential)
        errors = []
        for n in (40, 80):
            # the gap is widest at 180 deg; pressure 0 there
            _, a = solved(b, Motion((e * C, 0.0), journal=SPEED), n, 3)
            errors.append(a["load"] / exact - 1)
            self.assertAlmostEqual(a["attitude"], math.atan2(tangential, radial), delta=6 / n**2)  # second order
        self.assertTrue(SECOND_ORDER[0] < errors[0] / errors[1] < SECOND_ORDER[1], errors)
        self.assertLess(abs(errors[1]), 0.004)  # what 80 cells leave

    def test_a_narrow_half_film_is_ocvirk_s(self):
        e, L = 0.5, 0.02 * R
        b = Bearing(R, L, C, MU, cavitation="guembel", shear_force="torque_only")
        _, a = solved(b, Motion((e * C, 0.0), journal=SPEED), 240, 8)
        size = MU * SPEED * R * L**3 / C**2
        exact = size * e / (4 * (1 - e**2) ** 2) * math.sqrt(16 * e**2 + math.pi**2 * (1 - e**2))
        self.assertAlmostEqual(a["load"] / exact, 1, delta=0.02)  # 1/64 by the parabola along on eight cells; (L/D)^2
        self.assertAlmostEqual(a["attitude"], math.atan(math.pi * math.sqrt(1 - e**2) / (4 * e)), delta=2e-3)

    def test_a_narrow_film_squeezed_is_the_closed_form_s(self):
        """Half film of a short bearing under squeeze alone: pressure 6 mu v cos(phi) (L^2/4 - z^2)/h^3 where that is positive."""
        e, L, v = 0.4, 0.02 * R, 1e-3
        b = Bearing(R, L, C, MU, cavitation="guembel")
        _, a = solved(b, Motion((e * C, 0.0), velocity=(v, 0.0)), 240, 8)
        # over the half that closes, by quadrature
        phi = (np.arange(20000) + 0.5) * math.pi / 20000 - 0.5 * math.pi
        exact = MU * R * L**3 * v / C**3 * (np.cos(phi) ** 2 / (1 - e * np.cos(phi)) ** 3).sum() * math.pi / 20000
        self.assertAlmostEqual(a["load"] / exact, 1, delta=0.02)

    def test_torque_of_a_journal_in_the_middle_is_petroff_s(self):
        b = Bearing(R, 0.02, C, MU, edges=((1e5, 1.0), (1e5, 1.0)))
        _, a = solved(b, Motion((0.0, 0.0), journal=SPEED), 48, 4)
        self.assertAlmostEqual(a["torque_shell"] / (2 * math.pi * MU * R**3 * b.L * SPEED / C), 1, delta=1e-9)  # round-off

    def test_oil_through_a_step_is_rayleigh_s(self):
        """A deep half turn, a shallow half, wide, both ends of the step at one pressure: triangles of pressure."""
        deep = 1.0
        pocket = Feature(False, 0.5 * math.pi, 0.0, math.pi, 0.01, None, deep * C, False)
        b = Bearing(R, 0.01, C, MU, cavitation="guembel", edges=(None, None), line=0.0, line_pressure=0.0, features=[pocket])
        film, _ = solved(b, Motion((0.0, 0.0), journal=SPEED), 24, 2)
        H, length = 1 + deep, math.pi * R
        exact = 6 * MU * R * SPEED * length * (H - 1) / (C**2 * (H**3 + 1))
        self.assertAlmostEqual(film.p.max() / exact, 1, delta=1e-9)  # linear pressures, which the elements have


class Conditions(unittest.TestCase):
    def test_oil_is_conserved_and_film_full_or_at_no_pressure(self):
        groove = Feature(False, 2.0, 0.001, 0.4, 0.01, 1e5, 0.0, False)
        hole = Feature(True, -1.5, -0.002, 0.25, 0.006, 1e5, 0.0, False)
        b = Bearing(R, 0.02, C, MU, edges=((0.0, 0.0), (0.0, 0.4)), features=[groove, hole])
        film, a = solved(b, Motion((0.7 * C * math.cos(-1), 0.7 * C * math.sin(-1)), journal=SPEED), 100, 14)
        self.assertGreaterEqual(film.p.min(), -1e-9 * film.p.max())
        self.assertGreaterEqual(film.void.min(), -1e-9)
        self.assertLess(film.void.max(), 1)
        free = film.kind == FREE
        self.assertEqual(float((film.p * film.void)[free].max()), 0.0)
        self.assertLess(np.abs(film.outflow[free]).max(), 1e-12 * a["flow_supply"])  # the equations of every node
        self.assertAlmostEqual(a["side_flow"] / a["flow_supply"], 1, delta=1e-9)

    def test_a_film_marched_in_time_comes_to_the_steady_one(self):
        b = Bearing(R, 0.02, C, MU, line=math.pi, line_pressure=5e4)
        there = Motion((0.6 * C, 0.0), journal=SPEED)
        steady = solved(b, there, 40, 5)[1]
        begin = Motion((0.3 * C, 0.2 * C), journal=SPEED)
        turn = 2 * math.pi / SPEED
        for film in march(b, lambda t: there if t > 0 else begin, [k * 0.1 * turn for k in range(60)], 40, 5):
            pass
        last = figures(film)
        # what is left of the start after six turns: the film renews itself in two
        self.assertAlmostEqual(last["load"] / steady["load"], 1, delta=1e-4)
        self.assertAlmostEqual(last["torque_shell"] / steady["torque_shell"], 1, delta=1e-3)


class Agreement(unittest.TestCase):
    """A few of what `make second-opinion` draws."""

    def agree(self, first, count, examine=comparison.examine):
        answered = 0
        for k in range(first, first + count):
            with tempfile.TemporaryDirectory(prefix="hersey-second-") as folder:
                found = examine(HERSEY, "hersey", f"bearing-{k}", folder, is_small=True)
            with self.subTest(f"bearing-{k}"):
                self.assertEqual(found.off, [], found.model)
            answered += found.ending == "answer"
        self.assertGreaterEqual(answered, count // 2)

    def test_random_bearings_0_to_2(self):
        self.agree(0, 3)

    def test_random_bearings_3_to_5(self):
        self.agree(3, 3)

    def test_random_orbits_in_time(self):
        self.agree(0, 2, in_time.examine)

    def test_forces_in_time_ten_percent_off_are_found(self):
        b = comparison.bearings.Bearing(0.025, 0.02, 40e-6, 0.015, 60, 13, supply=(0.5 * math.pi, 1e5))
        orbit = in_time.Orbit(comparison.steady.Steady(b, 300.0, position=(0.3, -1.5)), (6e-6, 6e-6), 0.02)
        with tempfile.TemporaryDirectory(prefix="hersey-second-") as folder:
            other = in_time.by_the_second(orbit, folder, comparison.ROWS_SMALL, in_time.STEPS_SMALL)
            one = in_time.by_hersey(HERSEY, orbit, folder, in_time.STEPS_SMALL)
        self.assertEqual(in_time.compare(orbit, one, other)[0], [])
        for key in ("force_x", "force_y", "torque_journal", "power_film", "fill_volume"):
            reported = [a | {key: (1.1 * a[key][0], a[key][1])} for a in other]
            self.assertIn(key, [figure for figure, _ in in_time.compare(orbit, one, reported)[0]])

    def test_figures_three_percent_off_are_found(self):
        b = comparison.bearings.Bearing(0.025, 0.02, 40e-6, 0.015, 60, 13, supply=("widest_gap", 0.0))
        case = comparison.steady.Steady(b, 300.0, position=(0.6, 0.3))
        with tempfile.TemporaryDirectory(prefix="hersey-second-") as folder:
            one, other = comparison.both(HERSEY, case, folder, comparison.ROWS)
        self.assertEqual(comparison.compare(case, one, other)[0], [])
        for key in ("load", "torque_journal", "torque_shell", "power_film", "flow_left", "p_max"):
            reported = other | {key: (1.03 * other[key][0], other[key][1])}
            self.assertIn(key, [figure for figure, _ in comparison.compare(case, one, reported)[0]])


if __name__ == "__main__":
    unittest.main()
