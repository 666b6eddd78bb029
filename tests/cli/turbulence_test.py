#!/usr/bin/python3
"""A fast film of thin oil is not laminar: every output says where, warns if it is computed as laminar all the same, and a model of
turbulence changes friction, flow, fields and heat of bearings, pads and runs."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

HERSEY = os.path.abspath(sys.argv.pop(1))

# A turbine's bearing: Re = 3340 at the clearance.
TURBINE = """hersey: 1
parameters: {speed: 3000 rpm}
lubricants: {oil: {viscosity: 10 mPa.s, density: 850 kg/m^3}}
bearings:
  main:
    diameter: 500 mm
    width: 400 mm
    radial_clearance: 400 um
    lubricant: oil
    grid: {circumferential: 48, axial: 11}
    supply: {line: widest_gap, pressure: 1 bar}
    operating_point: {journal_speed: "${speed}", load: 200 kN}
"""
PAD = """hersey: 1
lubricants: {oil: {viscosity: 2 mPa.s, density: 850 kg/m^3}}
bearings:
  pad:
    kind: plane_slider
    length: 300 mm
    width: 300 mm
    lubricant: oil
    shape: [{profile: ramp, rise: 100 um}]
    turbulence: constantinescu
    operating_point: {speed: 60 m/s, film_thickness: 80 um}
"""
# A journal that settles under its load, by itself and in a machine.
SPINDLE = """hersey: 1
bodies:
  shaft: {mass: 0.5 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  guide: {type: planar, between: [ground, shaft], axis: z, initial: {rotation_rate: 20000 rpm}}
drives:
  motor: {joint: guide, coordinate: rotation, speed: 20000 rpm}
forces:
  weight: {type: force, body: shaft, components: [0 N, -2000 N, 0 N], axes: ground}
lubricants: {oil: {viscosity: 1 mPa.s, density: 1000 kg/m^3}}
bearings:
  main:
    shell: ground
    journal: shaft
    diameter: 40 mm
    width: 40 mm
    radial_clearance: 60 um
    lubricant: oil
    grid: {circumferential: 32, axial: 7}
    features: {groove: {shape: axial_groove, angle: 90 deg, arc: 30 deg, length: 30 mm, pressure: 3 bar}}
    turbulence: ng_pan
    operating_point: {journal_speed: 20000 rpm, load: 2000 N}
simulation: {duration: 30 ms, step: 50 us}
output: {fields_every: 10 ms}
"""


class Turbulence(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-turbulence-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def hersey(self, *arguments, fails=False):
        done = subprocess.run([HERSEY, *arguments], capture_output=True, text=True, timeout=300, stdin=subprocess.DEVNULL, check=False,
                              cwd=self.folder)
        self.assertEqual(done.returncode != 0, fails, (arguments, done.stderr))
        return done

    def write(self, text, name="model.yaml"):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def figures(self, path, *arguments):
        solution = json.loads(self.hersey("bearing", path, "--json", "--no-grid-error", *arguments).stdout)["solutions"][0]
        return solution["figures"]

    def value(self, figures, key):
        return figures[key]["value"]

    def test_laminar_film_beyond_its_onset_is_warned_of_and_a_turbulent_one_is_not(self):
        path = self.write(TURBINE)
        warned = self.hersey("bearing", path, "--no-grid-error").stderr
        self.assertIn("above a Reynolds number of 900", warned)
        self.assertIn("`turbulence: {model: ng_pan}`", warned)
        self.assertNotIn("Reynolds", self.hersey("bearing", path, "--no-grid-error", "--set", "bearings.main.turbulence=ng_pan").stderr)
        self.assertNotIn("Reynolds", self.hersey("bearing", path, "--no-grid-error", "--set", "speed=300rpm").stderr)

    def test_models_agree_on_a_large_bearing_and_friction_grows(self):
        path = self.write(TURBINE)
        at = {model: self.figures(path, "--set", f"bearings.main.turbulence={model}")
              for model in ("none", "ng_pan", "constantinescu", "hirs")}
        power = {model: self.value(figures, "power_film") for model, figures in at.items()}
        # Friction factors of the three laws at Re about 3000 are within 20 % of each other.
        for model in ("constantinescu", "hirs"):
            self.assertLess(abs(power[model] / power["ng_pan"] - 1), 0.2)
        self.assertGreater(power["ng_pan"], 2 * power["none"])
        for figures in at.values():
            shares = [self.value(figures, f"{regime}_share") for regime in ("laminar", "transition", "turbulent")]
            self.assertAlmostEqual(sum(shares), 1, 9)
            self.assertGreater(self.value(figures, "reynolds_max"), 3000)
        # Stiffer flow along pressure carries more: the journal lies nearer to the middle.
        self.assertLess(self.value(at["ng_pan"], "eccentricity_ratio"), 0.9 * self.value(at["none"], "eccentricity_ratio"))

    def test_slow_film_is_laminar_to_the_bit(self):
        path = self.write(TURBINE)
        slow = [self.figures(path, "--set", "speed=300rpm", "--set", f"bearings.main.turbulence={model}") for model in ("none", "hirs")]
        self.assertEqual(*slow)

    def test_band_follows_the_number_that_is_asked_for(self):
        path = self.write(TURBINE)
        by = {number: self.figures(path, "--set", f"bearings.main.turbulence={{model: ng_pan, transition: {number}, onset: {onset}, full: {full}}}")
              for number, onset, full in (("reynolds", 5000, 6000), ("taylor", 41.2, 82.4))}
        self.assertEqual(self.value(by["reynolds"], "laminar_share"), 1)
        # Re sqrt(h/R) goes from 47 where the film is thinnest to 180.
        self.assertEqual(self.value(by["taylor"], "laminar_share"), 0)
        self.assertGreater(self.value(by["taylor"], "turbulent_share"), 0.5)

    def test_fields_and_heat(self):
        path = self.write(TURBINE)
        self.hersey("bearing", path, "--no-grid-error", "--set", "bearings.main.turbulence=ng_pan", "--fields", "fields.csv")
        with open(os.path.join(self.folder, "fields.csv"), encoding="utf-8") as file:
            head, *rows = [line.strip().split(", ") for line in file]
        reynolds = [float(row[head.index("Reynolds number")]) for row in rows]
        thickness = [float(row[head.index("film thickness [um]")]) for row in rows]
        for Re, h in zip(reynolds, thickness):
            self.assertAlmostEqual(Re, 850 * 100 * 3.141592653589793 * 0.25 * 1e-6 * h / 10e-3, delta=1e-5 * Re)
        hot = ["--set", "lubricants.oil={grade: iso_vg_32}", "--set",
               "bearings.main.thermal={model: film, supply_temperature: 50 degC, shell: insulated, journal: insulated}"]
        laminar, turbulent = (self.figures(path, *hot, "--set", f"bearings.main.turbulence={model}") for model in ("none", "ng_pan"))
        for figures in (laminar, turbulent):
            power, oil = self.value(figures, "power_film"), self.value(figures, "heat_to_oil")
            self.assertLess(abs(oil / power - 1), 1e-3)
        self.assertGreater(self.value(turbulent, "power_film"), 1.2 * self.value(laminar, "power_film"))

    def test_pad_has_it_too(self):
        path = self.write(PAD)
        turbulent = self.figures(path)
        laminar = self.figures(path, "--set", "bearings.pad.turbulence=none")
        self.assertGreater(self.value(turbulent, "force_runner") / self.value(laminar, "force_runner"), 1.5)
        self.assertGreater(self.value(turbulent, "load") / self.value(laminar, "load"), 1.5)
        self.assertNotIn("taylor_max", turbulent)

    def test_run_settles_where_the_bearing_by_itself_does(self):
        path = self.write(SPINDLE)
        alone = self.figures(path)
        self.assertGreater(self.value(alone, "turbulent_share"), 0.1)
        self.hersey("run", path, "--output", "out", "--json")
        import h5py
        with h5py.File(os.path.join(self.folder, "out", "results.h5"), "r") as file:
            bearing = file["bearings/main"]
            self.assertLess(abs(bearing["eccentricity_ratio"][-1] / self.value(alone, "eccentricity_ratio") - 1), 1e-3)
            self.assertLess(abs(bearing["reynolds_max"][-1] / self.value(alone, "reynolds_max") - 1), 1e-3)
            self.assertAlmostEqual(bearing["turbulent_share"][-1], self.value(alone, "turbulent_share"), delta=0.02)
            self.assertEqual(bearing["fields/reynolds_number"].shape[1:], (32, 7))
            self.assertLess(abs(bearing["power_film"][-1] / self.value(alone, "power_film") - 1), 2e-3)

    def test_what_cannot_be_is_refused_by_name(self):
        def faults(lines, model=TURBINE, after="    lubricant: oil\n"):
            path = self.write(model.replace(after, after + lines, 1), "wrong.yaml")
            return self.hersey("check", path, fails=True).stderr

        self.assertIn("an `onset` below `full`", faults("    turbulence: {model: ng_pan, onset: 2000, full: 1000}\n"))
        self.assertIn("flow factors of rough surfaces",
                      faults("    turbulence: ng_pan\n    roughness: {shell: {sigma: 1 um}}\n"))
        self.assertIn("wrong.yaml:10:40", faults("    turbulence: {model: ng_pan, onset: 0}\n"))
        self.assertIn("ng_pan", faults("    turbulence: eddies\n"))
        thinning = TURBINE.replace("density: 850 kg/m^3", "density: 850 kg/m^3, shear_thinning: {law: cross, exponent: 0.8, critical_shear_rate: 1e5 1/s}")
        self.assertIn("thins by shear", faults("    turbulence: ng_pan\n", thinning))
        self.assertIn("surfaces that are not round",
                      faults("", PAD.replace("constantinescu", "{model: hirs, transition: taylor}")))


if __name__ == "__main__":
    unittest.main()
