#!/usr/bin/python3
"""Tables of bearing coefficients: `hersey bearing --coefficients`, and machines on such tables."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

HERSEY = os.path.abspath(sys.argv.pop(1))
EXAMPLES = pathlib.Path(os.path.abspath(__file__)).parent.parent.parent / "examples"
ALONE = str(EXAMPLES / "bearing_alone" / "model.yaml")
PLACES = ("xx", "xy", "yx", "yy")

# A rotor in a full film whose oil carries tension, so that no node ruptures and nothing marks a place around.
ROTOR = """hersey: 1
parameters: {speed: 3000 rpm}
gravity: 0 -9.81 0 m/s^2
bodies:
  rotor: {mass: 40 kg, inertia: {xx: 0.35 kg.m^2, yy: 0.35 kg.m^2, zz: 0.332 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, rotor], axis: z}
drives:
  motor: {joint: turning, coordinate: rotation, speed: "${speed}"}
simulation: {analysis: modes, modes_about: turning}
"""
FILM = """
lubricants:
  oil: {viscosity: 10 mPa.s, density: 850 kg/m^3}
bearings:
  main:
    shell: ground
    journal: rotor
    diameter: 50 mm
    width: 25 mm
    radial_clearance: 60 um
    lubricant: oil
    cavitation: full_film
    grid: {circumferential: 48, axial: 9}
"""
TABLE = """
forces:
  main: {type: bearing_table, between: [ground, rotor], file: main.csv}
"""


class CoefficientTables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-coefficients-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "film.yaml").write_text(ROTOR + FILM, encoding="utf-8")
        (self.folder / "table.yaml").write_text(ROTOR + TABLE, encoding="utf-8")

    def hersey(self, *arguments, code=0):
        done = subprocess.run([HERSEY, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def table(self, model, name, *arguments, code=0):
        """A written table, and the solutions it is of."""
        done = self.hersey("bearing", model, "--no-grid-error", "--json", "--coefficients", self.folder / name, *arguments, code=code)
        return (self.folder / name).read_text(encoding="utf-8"), json.loads(done.stdout)["solutions"]

    def modes(self, model, speed):
        """Eigenvalues, slowest whirl first, and the rotor's position."""
        import h5py
        self.hersey("run", self.folder / model, "--set", f"speed={speed}", "--output", self.folder / "out", "--force")
        with h5py.File(next((self.folder / "out").rglob("*.h5"))) as file:
            modes = file["modes/fields"]
            values = modes["eigenvalue_real"][...].ravel() + 1j * modes["eigenvalue_imaginary"][...].ravel()
            return values, file["bodies/rotor/position"][-1]

    def test_a_rotor_on_a_table_is_that_on_its_film(self):
        self.table(self.folder / "film.yaml", "main.csv", "--load", "392.4N", "--load-angle", "-90deg",
                   "--sweep", "speed=2000rpm,3000rpm,4000rpm")
        for speed in ("2000rpm", "3000rpm", "4000rpm"):
            film, at = self.modes("film.yaml", speed)
            table, beside = self.modes("table.yaml", speed)
            self.assertEqual(len(film), len(table))
            for a, b in zip(film, table):
                self.assertLess(abs(a - b), 1e-6 * abs(a))  # digits of the table, and of both searches
            for a, b in zip(at, beside):
                self.assertAlmostEqual(a, b, delta=1e-6 * 60e-6)

        # A table says nothing of the other sense of rotation, nor of faster shafts.
        for speed in ("-3000rpm", "4100rpm"):
            done = self.hersey("run", self.folder / "table.yaml", "--set", f"speed={speed}", "--output", self.folder / "out", "--force", code=2)
            self.assertIn("the table of coefficients has speeds from 2000 to 4000 rpm", done.stderr)

    def test_tables_of_other_programs_are_read_by_their_rules(self):
        sweep = ("--sweep", "speed=3000rpm,1000rpm,9000rpm")
        text, solutions = self.table(ALONE, "c.toml", "--coefficients-for", "ross", *sweep)
        solutions.sort(key=lambda one: one["figures"]["journal_speed"]["value"])

        def figures(key):
            return [one["figures"][key]["value"] for one in solutions]

        # BearingElement.load: the first table of the file has the arguments of the class.
        arguments = list(tomllib.loads(text).values())[0]
        self.assertLessEqual(set(arguments), {"n", "tag", "frequency"} | {c + p for c in "kc" for p in PLACES})
        expected = {"frequency": figures("journal_speed")}
        for place in PLACES:
            expected[f"k{place}"] = figures(f"stiffness_{place}")
            expected[f"c{place}"] = figures(f"damping_{place}")
        for key, values in expected.items():
            for a, b in zip(arguments[key], values, strict=True):
                self.assertAlmostEqual(a, b, delta=1e-11 * abs(b))  # digits written

        # Fortran's fixed columns: 3 (A80), (3I10), then (I10, F10.2) and twice (4E15.7) for each speed.
        lines = self.table(ALONE, "c.txt", "--coefficients-for", "ansys", *sweep)[0].splitlines()
        self.assertTrue(all(len(line) <= 80 for line in lines))
        self.assertEqual([int(lines[3][k:k + 10]) for k in (0, 10, 20)], [3, 0, 1])  # SI, rpm
        for row, speed in enumerate((1000, 3000, 9000)):
            first, stiffness, damping = lines[4 + 3 * row:7 + 3 * row]
            self.assertEqual((int(first[:10]), float(first[10:20])), (row + 1, speed))
            for line, name in ((stiffness, "k"), (damping, "c")):
                for k, place in enumerate(PLACES):
                    b = expected[name + place][row]
                    self.assertAlmostEqual(float(line[15 * k:15 * k + 15]), b, delta=1e-7 * abs(b))  # digits written

    def test_what_is_no_table_is_refused_with_the_reason(self):
        for sweep, reason in (("load=100N,200N", "two solutions at"), ("speed=-3000rpm,3000rpm", "positive speeds")):
            done = self.hersey("bearing", ALONE, "--no-grid-error", "--coefficients", self.folder / "no.csv", "--sweep", sweep, code=2)
            self.assertRegex(done.stderr, re.escape(reason))
            self.assertFalse((self.folder / "no.csv").exists())


if __name__ == "__main__":
    unittest.main()
