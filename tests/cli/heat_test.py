#!/usr/bin/python3
"""Oils and heat at the command line: `hersey oil` and its page, and what `hersey bearing` says where heat leaves no film or no answer."""

import html.parser
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

HERSEY = os.path.abspath(sys.argv.pop(1))
HOT = os.path.join(os.path.abspath(sys.argv.pop(1)), "examples/hot_bearing/model.yaml")
OK, FAILED, WRONG_INPUT = 0, 1, 2
SMALL = ("--no-grid-error", "--set", "bearings.main.grid={circumferential: 40, axial: 9}")


def hersey(*arguments):
    return subprocess.run([HERSEY, *arguments], capture_output=True, text=True, timeout=600, check=False)


class Page(html.parser.HTMLParser):
    """The cells of the tables of a page, the titles of its charts with the paths in them, and whatever it would load from elsewhere."""

    def __init__(self, text):
        super().__init__()
        self.rows, self.charts, self.loaded, self._open = [], {}, [], None
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self._open = tag
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        if tag == "path" and attrs.get("class", "").startswith("line"):
            self.charts[list(self.charts)[-1]].append(attrs["d"])
        self.loaded += [attrs[key] for key in ("src", "href") if key in attrs]

    def handle_data(self, data):
        if self._open == "h2":
            self.charts[data] = []
        if self._open in ("td", "th") and self.rows and self.rows[-1]:
            self.rows[-1][-1] += data

    def handle_endtag(self, tag):
        self._open = None


class Oil(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-heat-")
        self.addCleanup(folder.cleanup)
        self.page = os.path.join(folder.name, "oil.html")

    def shown(self, *arguments):
        run = hersey("oil", *arguments, "--report", self.page)
        self.assertEqual((run.returncode, run.stderr), (OK, ""))
        with open(self.page, encoding="utf-8") as file:
            text = file.read()
        return run.stdout, text, Page(text)

    def test_page_of_a_grade_shows_its_source_and_the_numbers_of_the_table(self):
        printed, text, page = self.shown("iso_vg_46")
        self.assertIn("ISO 3448", text)
        self.assertEqual(page.loaded, [])
        self.assertEqual(list(page.charts), ["Viscosity over temperature"])
        table = [line.split() for line in printed.splitlines() if line.lstrip()[:1].isdigit()]
        self.assertEqual(page.rows[2:], table)
        self.assertEqual([row[0] for row in table], [str(T) for T in range(0, 161, 20)])
        at_40 = next(row for row in table if row[0] == "40")
        self.assertEqual(at_40[2], "46")

    def test_page_has_a_curve_for_each_variable_that_matters_and_it_falls(self):
        _, _, page = self.shown(HOT, "--set", "lubricants.oil={grade: sae_5w30, pressure_viscosity: {law: barus, alpha: 20e-9 1/Pa}}")
        self.assertEqual(list(page.charts), ["Viscosity over temperature", "Viscosity over pressure", "Viscosity over shear rate"])
        for title, falls in zip(page.charts, (1, -1, 1)):
            self.assertTrue(page.charts[title], title)
            for path in page.charts[title]:
                y = [float(point.split(",")[1]) if "," in point else float(point.split()[-1])
                     for point in path.replace("M", "L").split("L") if point.strip()]
                self.assertGreater(len(y), 100)
                self.assertGreater(falls * (y[-1] - y[0]), 0, title)  # y of a picture grows downwards

    def test_table_over_pressure_and_shear_rate_is_that_of_the_laws(self):
        run = hersey("oil", HOT, "--set", "lubricants.oil={grade: sae_5w30, pressure_viscosity: {law: barus, alpha: 20e-9 1/Pa}}",
                     "--at", "100degC", "--pressure", "0Pa", "50MPa", "--shear-rate", "0 1/s", "1e6 1/s", "--json")
        self.assertEqual(run.returncode, OK, run.stderr)
        mu = {(row["pressure"], row["shear_rate"]): row["viscosity"] for row in json.loads(run.stdout)["rows"]}
        self.assertAlmostEqual(mu[50e6, 0] / mu[0, 0], math.exp(20e-9 * 50e6), places=6)  # Barus: round-off of text
        for p in (0, 50e6):  # Cross with a critical stress of 10.26 kPa, as the grade is printed
            expected = 0.5 + 0.5 / (1 + (1e6 * mu[p, 0] / 10.26e3) ** 0.8)
            self.assertAlmostEqual(mu[p, 1e6] / mu[p, 0], expected, places=3)  # four digits of the stress


class Bearing(unittest.TestCase):
    def test_bearing_whose_oil_grows_too_thin_has_run_away(self):
        run = hersey("bearing", HOT, *SMALL, "--load", "1000kN")
        self.assertEqual(run.returncode, FAILED)
        self.assertRegex(run.stderr, r"main: thermal runaway: oil that warms to \d+ degC at \d+ deg, z = \S+ mm is too thin")
        self.assertIn("the film bears at most", run.stderr)

    def test_bearing_whose_heat_needs_oil_that_cannot_be_has_run_away(self):
        run = hersey("bearing", HOT, *SMALL, "--load", "600kN", "--speed", "60000rpm")
        self.assertEqual(run.returncode, FAILED)
        self.assertRegex(run.stderr, r"thermal runaway: .* oil of \d+ degC at \d+ deg, z = \S+ mm only, and no oil is one above 400 degC")

    def test_bearing_of_one_effective_temperature_runs_away_as_well(self):
        runs_away = r"thermal runaway: the balance of heat does not close with oil below \d+ degC, and no oil is one above 400 degC"
        for heat, *point in (("cooling: {area: 0.01 m^2, heat_transfer: 10 W/m^2/K, ambient: 30 degC}",),
                             ("supply_temperature: 50 degC", "--load", "100N", "--speed", "60000rpm")):
            run = hersey("bearing", HOT, *SMALL, "--set", "bearings.main.thermal={model: global, " + heat + "}", *point)
            self.assertEqual(run.returncode, FAILED)
            self.assertRegex(run.stderr, runs_away)

    def refused(self, what, instead, *overrides):
        sets = [word for override in overrides for word in ("--set", override)]
        run = hersey("bearing", HOT, *SMALL, "--thermal-coefficients", "total", *sets)
        self.assertEqual(run.returncode, WRONG_INPUT)
        for words in ("--thermal-coefficients", "bearings.main", f"'total' of {what}", f"'frozen', or {instead}"):
            self.assertIn(words, run.stderr)

    def test_total_coefficients_of_walls_that_expand_are_refused(self):
        self.refused("walls that expand", "a clearance without `expansion`",
                     "bearings.main.thermal.expansion={shell: 12e-6 1/K, journal: 12e-6 1/K, reference: 20 degC}")

    def test_total_coefficients_of_walls_in_a_network_are_refused(self):
        self.refused("nodes of a network", "walls and oil by themselves",
                     "thermal={nodes: {block: {heat_capacity: 1 kJ/K}, air: {fixed: 30 degC}}, paths: {outside: {between: [block, air], conductance: 20 W/K}}}",
                     "bearings.main.thermal.shell={wall: node, node: block}")


if __name__ == "__main__":
    unittest.main(verbosity=2)
