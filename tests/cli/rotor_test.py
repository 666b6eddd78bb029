#!/usr/bin/python3
"""`hersey rotor`: modes, unbalance response and critical speeds, against closed forms and runs in time."""

import cmath
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERSEY = os.path.abspath(sys.argv.pop(1))
RPM = math.pi / 30

# A rigid disc on springs, dampers and the cross-coupled stiffness of a seal: Jeffcott's rotor.
JEFFCOTT = """hersey: 1
parameters: {speed: 3000 rpm, k: 1 MN/m, k_y: 1 MN/m, q: 0 N/m, q_yx: 0 N/m, c: 200 N.s/m, amount: 10 g.mm, phase: 0 deg, g: 0}
gravity: 0 ${g} 0 m/s^2
bodies:
  rotor: {mass: 10 kg, inertia: {xx: 0.05 kg.m^2, yy: 0.05 kg.m^2, zz: 0.08 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, rotor], axis: z}
forces:
  support:
    type: bearing_table
    between: [ground, rotor]
    stiffness: {xx: "${k}", xy: "${q}", yx: "${q_yx}", yy: "${k_y}"}
    damping: {xx: "${c}", yy: "${c}"}
  u: {type: unbalance, on: rotor, amount: "${amount}", phase: "${phase}"}
drives:
  motor: {joint: turning, coordinate: rotation, speed: "${speed}"}
simulation: {analysis: modes, modes_about: turning}
"""

# A shaft between two bearings; hub and coupling rotate it and keep it in place along its axis.
SHAFT = """hersey: 1
parameters: {speed: 10000 rpm, elements: 16, k_x: 1e13 N/m, k_y: 1e13 N/m, c: 0 N.s/m, g: 0, mass: 1e-6 kg, i_t: 1e-9 kg.m^2, i_p: 1e-9 kg.m^2, damping: 0 us}
gravity: 0 ${g} 0 m/s^2
bodies:
  ground:
    frames: {left: {origin: 0 0 0 mm}, right: {origin: 0 0 1500 mm}}
  hub: {mass: 1 kg, inertia: {xx: 0.001 kg.m^2, yy: 0.001 kg.m^2, zz: 0.002 kg.m^2}}
  shaft:
    beam:
      points: [0 0 0 mm, 0 0 1500 mm]
      section: {circle: {diameter: DIAMETER mm}}
      material: {youngs_modulus: 211 GPa, poisson_ratio: 0.2992610837438423, density: 7810 kg/m^3}
      elements: "${elements}"
      damping: {stiffness: "${damping}"}
    frames: {left: {along: start}, a: {along: 500 mm}, b: {along: 1000 mm}, right: {along: end}}
  disc_a: {mass: "${mass}", inertia: {xx: "${i_t}", yy: "${i_t}", zz: "${i_p}"}}
  disc_b: {mass: "${mass}", inertia: {xx: "${i_t}", yy: "${i_t}", zz: "${i_p}"}}
joints:
  turning: {type: revolute, between: [ground, hub], axis: z}
  seat: {type: free, between: [hub, shaft.left]}
  fit_a: {type: fixed, between: [shaft.a, disc_a]}
  fit_b: {type: fixed, between: [shaft.b, disc_b]}
forces:
  coupling: {type: bushing, between: [hub, shaft.left], stiffness: 0 0 1e6 N/m, rotational_stiffness: 0 0 20000 N.m/rad}
  left: {type: bearing_table, between: [ground.left, shaft.left], stiffness: {xx: "${k_x}", yy: "${k_y}"}, damping: {xx: "${c}", yy: "${c}"}}
  right: {type: bearing_table, between: [ground.right, shaft.right], stiffness: {xx: "${k_x}", yy: "${k_y}"}, damping: {xx: "${c}", yy: "${c}"}}
drives:
  motor: {joint: turning, coordinate: rotation, speed: "${speed}"}
simulation: {analysis: modes, modes_about: turning}
"""


def timoshenko(n, omega, diameter):
    """Natural frequencies [rad/s] of a uniform simply supported shaft that rotates at omega; positive: forward."""
    E, nu, rho, length = 211e9, 0.2992610837438423, 7810, 1.5
    area, inertia = math.pi * diameter**2 / 4, math.pi * diameter**4 / 64
    shear = E / (2 * (1 + nu)) * area * 6 * (1 + nu) / (7 + 6 * nu)
    k = n * math.pi / length

    def determinant(w):
        return ((shear * k**2 - rho * area * w**2) * (E * inertia * k**2 + shear - rho * inertia * w**2 + 2 * rho * inertia * omega * w)
                - (shear * k) ** 2)
    euler = k**2 * math.sqrt(E * inertia / (rho * area))
    roots = []
    for sign in (1, -1):
        low, high = sign * 0.3 * euler, sign * 1.7 * euler
        for _ in range(200):
            middle = (low + high) / 2
            if (determinant(middle) > 0) == (determinant(low) > 0):
                low = middle
            else:
                high = middle
        roots.append(low)
    return roots


# A rotor in a film without rupture, whose answer to a small unbalance is linear, and on a spring.
FILM = """hersey: 1
gravity: 0 -9.81 0 m/s^2
bodies:
  rotor: {mass: 40 kg, inertia: {xx: 0.35 kg.m^2, yy: 0.35 kg.m^2, zz: 0.332 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, rotor], axis: z}
drives:
  motor: {joint: turning, coordinate: rotation, speed: 1500 rpm}
lubricants:
  oil: {viscosity: 40 mPa.s, density: 850 kg/m^3}
bearings:
  main:
    shell: ground
    journal: rotor
    diameter: 50 mm
    width: 25 mm
    radial_clearance: 60 um
    lubricant: oil
    cavitation: full_film
    grid: {circumferential: 32, axial: 7}
forces:
  other: {type: bearing_table, between: [ground, rotor], stiffness: {xx: 20 MN/m, yy: 20 MN/m}, damping: {xx: 5 kN.s/m, yy: 5 kN.s/m}}
  u: {type: unbalance, on: rotor, amount: 20 g.mm, phase: 30 deg}
"""
# Two shafts with teeth between them; the wheel's turns the other way.
GEARED = """hersey: 1
parameters: {speed: 3000 rpm, torque: 0 N.m, k_xy: 0 MN/m, mesh: 400 MN/m, mesh_c: 1 kN.s/m, k: 20 MN/m, side: positive}
bodies:
  ground: {frames: {second: {origin: 160 0 0 mm}}}
  pinion: {mass: 3 kg, inertia: {xx: 0.003 kg.m^2, yy: 0.003 kg.m^2, zz: 0.004 kg.m^2}}
  wheel: {mass: 14 kg, inertia: {xx: 0.05 kg.m^2, yy: 0.05 kg.m^2, zz: 0.09 kg.m^2}}
joints:
  turning: {type: planar, between: [ground, pinion], axis: z}
  other: {type: planar, between: [ground.second, wheel], axis: z, initial: {rotation: 40 deg}}
forces:
  mesh: {type: gear_mesh, between: [pinion, wheel], teeth: [23, 57], normal_module: 4 mm, helix_angle: 0 deg, torque_on_first: "${side}", stiffness: "${mesh}", damping: "${mesh_c}"}
  load: {type: torque, body: wheel, components: [0, 0, "${torque}"]}
  left: {type: bearing_table, between: [ground, pinion], stiffness: {xx: 60 MN/m, yy: 80 MN/m}, damping: {xx: 20 kN.s/m, yy: 20 kN.s/m}}
  right: {type: bearing_table, between: [ground.second, wheel], stiffness: {xx: "${k}", yy: "${k}", xy: "-${k_xy}", yx: "${k_xy}"}, damping: {xx: 8 kN.s/m, yy: 8 kN.s/m}}
  u: {type: unbalance, on: pinion, amount: 10 g.mm}
drives: {motor: {joint: turning, coordinate: rotation, speed: "${speed}"}}
simulation: {analysis: steady}
"""
LINEAR = "simulation: {analysis: modes, modes_about: turning}"


class Rotors(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-rotor-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "jeffcott.yaml").write_text(JEFFCOTT, encoding="utf-8")
        (self.folder / "shaft.yaml").write_text(SHAFT.replace("DIAMETER", "100"), encoding="utf-8")
        (self.folder / "thin.yaml").write_text(SHAFT.replace("DIAMETER", "50"), encoding="utf-8")

    def hersey(self, *arguments, code=0):
        done = subprocess.run([HERSEY, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def rotor(self, name, *arguments, **values):
        sets = [f"--set={key}={value}" for key, value in values.items()]
        return json.loads(self.hersey("rotor", self.folder / name, "--json", *sets, *arguments).stdout)

    def at(self, name, *arguments, **values):
        return self.rotor(name, *arguments, **values)["speeds"][0]

    # -- unbalance response --------------------------------------------------------------------------------------

    def test_a_jeffcott_rotor(self):
        m, k, c, u = 10, 1e6, 200, 1e-5
        found = self.rotor("jeffcott.yaml", "--sweep", "speed=500rpm:6000rpm:111", "--operating", "5500rpm")
        for one in found["speeds"]:
            w = one["speed"] * RPM
            expected = u * w**2 / complex(k - m * w**2, c * w)
            orbit = one["unbalance"]["stations"]["rotor"]
            self.assertAlmostEqual(orbit["x"] / abs(expected), 1, delta=1e-9)  # round-off near resonance
            self.assertAlmostEqual(orbit["major_axis"] / abs(expected), 1, delta=1e-9)
            self.assertAlmostEqual(orbit["minor_axis"] / abs(expected), 1, delta=1e-9)
            self.assertAlmostEqual(orbit["x_lag_deg"], -math.degrees(cmath.phase(expected)), delta=1e-6)
            self.assertAlmostEqual(orbit["y_lag_deg"], (-math.degrees(cmath.phase(expected)) + 90) % 360, delta=1e-6)
            force = one["unbalance"]["bearing_forces"]["support"]
            self.assertAlmostEqual(force["x"] / abs(complex(k, c * w) * expected), 1, delta=1e-9)
        # AF = 1/(2 zeta) but for terms of zeta^2, zeta = c/(2 sqrt(k m)); the speeds are 50 rpm apart.
        zeta = c / (2 * math.sqrt(k * m))
        peak, = found["response_peaks"]
        self.assertAlmostEqual(peak["amplification_factor"] * 2 * zeta, 1, delta=0.005)  # zeta^2
        self.assertAlmostEqual(peak["speed"] * RPM / math.sqrt(k / m), 1, delta=0.003)  # zeta^2
        self.assertAlmostEqual(peak["separation_margin"], 1 - peak["speed"] / 5500, delta=1e-9)  # round-off
        self.assertTrue(peak["is_enough"])

    def test_threads_change_no_number(self):
        (self.folder / "film.yaml").write_text(FILM + LINEAR, encoding="utf-8")
        sweep = ("--sweep", "drives.motor.speed=1200rpm:1800rpm:5")
        one, two = (self.hersey("rotor", self.folder / "film.yaml", "--json", *sweep, "--threads", n).stdout for n in (1, 2))
        self.assertEqual(one, two)

    def test_a_peak_between_few_speeds_has_an_amplitude(self):
        # So sharp that the parabola through its three highest points of 1/amplitude^2 falls below zero.
        found = self.rotor("jeffcott.yaml", "--sweep", "speed=2500rpm,3000rpm,3050rpm,8000rpm", c="2 N.s/m")
        for peak in found["response_peaks"]:
            largest = max(at["unbalance"]["stations"][peak["station"]]["major_axis"] for at in found["speeds"])
            self.assertGreaterEqual(peak["amplitude"], largest)

    def test_results_as_hdf5_are_those_as_json(self):
        import h5py
        import numpy
        values = {"k_y": "2 MN/m", "q": "0.1 MN/m", "q_yx": "-0.1 MN/m"}
        path = self.folder / "rotor.h5"
        found = self.rotor("jeffcott.yaml", "--sweep", "speed=1000rpm:6000rpm:6", "--results", path, **values)
        with h5py.File(path) as file:
            names = [name.decode() for name in file["station"][...]]
            words = list(file["modes/whirl"].attrs["words"])
            answer = {name: file[f"unbalance/{name}"][...].reshape(6, len(names)) for name in ("x_real", "x_imaginary", "major_axis")}
            self.assertEqual(file["speed"].shape, (6,))
            numpy.testing.assert_allclose(file["swept_speed"][...].ravel() * RPM, file["speed"][...], rtol=1e-12)  # round-off of the unit
            for i, at in enumerate(found["speeds"]):
                self.assertAlmostEqual(file["speed"][i] / (at["speed"] * RPM), 1, delta=1e-12)  # round-off of the unit
                for k, mode in enumerate(at["modes"]):
                    for name in ("damped_frequency", "log_decrement", "track"):
                        self.assertEqual(file[f"modes/{name}"][i, k], mode[name])
                    self.assertEqual(words[int(file["modes/whirl"][i, k])], mode["whirl"])
                for s, name in enumerate(names):
                    orbit = at["unbalance"]["stations"][name]
                    x = complex(answer["x_real"][i, s], answer["x_imaginary"][i, s])
                    self.assertAlmostEqual(abs(x) / orbit["x"], 1, delta=1e-12)  # round-off of the absolute value
                    self.assertAlmostEqual((-math.degrees(cmath.phase(x)) - orbit["x_lag_deg"] + 180) % 360 - 180, 0, delta=1e-9)  # round-off of angles
                    self.assertEqual(answer["major_axis"][i, s], orbit["major_axis"])
                stiffness = at["bearings"]["support"]["stiffness"]
                numpy.testing.assert_array_equal(file["bearings/support/stiffness"][i], [[stiffness["xx"], stiffness["xy"]], [stiffness["yx"], stiffness["yy"]]])
            numpy.testing.assert_allclose(file["critical_speeds/critical_speed"][...], [c["speed"] * RPM for c in found["critical_speeds"]], rtol=1e-12)  # round-off of the unit

    def test_response_scales_with_the_unbalance_and_follows_its_phase(self):
        one = self.at("jeffcott.yaml", k_y="2 MN/m", q="0.1 MN/m", q_yx="-0.1 MN/m")["unbalance"]["stations"]["rotor"]
        double = self.at("jeffcott.yaml", k_y="2 MN/m", q="0.1 MN/m", q_yx="-0.1 MN/m", amount="20 g.mm", phase="40 deg")["unbalance"]["stations"]["rotor"]
        for key in ("x", "y", "major_axis", "minor_axis"):
            self.assertAlmostEqual(double[key] / one[key], 2, delta=1e-9)  # round-off
        # A mark ahead by 40 deg passes earlier: the motion lags less.
        self.assertAlmostEqual((one["x_lag_deg"] - double["x_lag_deg"]) % 360, 40, delta=1e-6)  # round-off

    def test_the_other_sense_of_rotation_is_the_mirror_image(self):
        values = {"k_y": "2 MN/m"}
        one = self.at("jeffcott.yaml", **values, q="0.1 MN/m", q_yx="-0.1 MN/m")
        other = self.at("jeffcott.yaml", **values, q="-0.1 MN/m", q_yx="0.1 MN/m", speed="-3000 rpm")
        self.assertEqual((one["sense"], other["sense"]), (1, -1))
        for key in ("x", "y", "major_axis", "minor_axis"):
            self.assertAlmostEqual(one["unbalance"]["stations"]["rotor"][key] / other["unbalance"]["stations"]["rotor"][key], 1, delta=1e-9)  # round-off
        for a, b in zip(one["modes"], other["modes"], strict=True):
            self.assertAlmostEqual(a["damped_frequency"] / b["damped_frequency"], 1, delta=1e-9)  # round-off
            self.assertAlmostEqual(a["log_decrement"], b["log_decrement"], delta=1e-9)
            self.assertEqual(a["whirl"], b["whirl"])

    def test_a_grade_is_an_amount(self):
        text = JEFFCOTT.replace('amount: "${amount}"', "grade: {quality: 2.5 mm/s, mass: 10 kg, speed: 3000 rpm}")
        (self.folder / "grade.yaml").write_text(text, encoding="utf-8")
        by_mass = JEFFCOTT.replace('amount: "${amount}"', "off_axis: {mass: 4 g, eccentricity: 2.5 mm}")
        (self.folder / "mass.yaml").write_text(by_mass, encoding="utf-8")
        one = self.at("jeffcott.yaml")["unbalance"]["stations"]["rotor"]["x"]
        self.assertAlmostEqual(self.at("grade.yaml")["unbalance"]["stations"]["rotor"]["x"] / one,
                               2.5e-3 * 10 / (3000 * RPM) / 1e-5, delta=1e-9)  # round-off
        self.assertAlmostEqual(self.at("mass.yaml")["unbalance"]["stations"]["rotor"]["x"] / one, 1, delta=1e-9)
        several = JEFFCOTT.replace('amount: "${amount}"', 'amount: "${amount}", off_axis: {mass: 4 g, eccentricity: 2.5 mm}')
        (self.folder / "several.yaml").write_text(several, encoding="utf-8")
        self.assertIn("an unbalance of several sizes", self.hersey("check", self.folder / "several.yaml", code=2).stderr)

    def test_a_film_and_a_force_of_one_name_are_told_apart(self):
        text = FILM + LINEAR
        (self.folder / "two.yaml").write_text(text, encoding="utf-8")
        (self.folder / "one.yaml").write_text(text.replace("  other:", "  main:"), encoding="utf-8")
        two, one = self.at("two.yaml"), self.at("one.yaml")
        for part in ("bearings", "unbalance"):
            named, same = (state[part] if part == "bearings" else state[part]["bearing_forces"] for state in (two, one))
            self.assertEqual(set(named), {"main", "other"})
            self.assertEqual(set(same), {"bearings.main", "forces.main"})
            self.assertEqual(same["bearings.main"], named["main"])
            self.assertEqual(same["forces.main"], named["other"])

    def require_run_at(self, expected, text, speed, duration):
        """The last two revolutions of a run, as amplitudes of exp(i omega t), are the linear answer."""
        import h5py
        import numpy
        (self.folder / "time.yaml").write_text(text, encoding="utf-8")
        self.hersey("run", self.folder / "time.yaml", "--output", self.folder / "out", "--force")
        with h5py.File(next((self.folder / "out").rglob("*.h5"))) as file:
            t, r = file["time"][...], file["bodies/rotor/position"][...]
        last = t > duration - 4 * math.pi / speed + 1e-9  # of the times' round-off
        basis = numpy.stack([numpy.cos(speed * t[last]), numpy.sin(speed * t[last]), numpy.ones(last.sum())], axis=1)
        for axis, key in ((0, "x"), (1, "y")):
            (real, imaginary, _), *_ = numpy.linalg.lstsq(basis, r[last, axis], rcond=None)
            amplitude = complex(real, -imaginary)
            self.assertAlmostEqual(abs(amplitude) / expected[key], 1, delta=2e-4)  # steps of a four-hundredth of a revolution
            self.assertAlmostEqual((-math.degrees(cmath.phase(amplitude)) - expected[key + "_lag_deg"] + 180) % 360 - 180, 0, delta=0.02)

    def test_a_run_settles_at_the_response(self):
        values = {"k_y": "2 MN/m", "q": "0.1 MN/m", "q_yx": "-0.1 MN/m", "c": "2000 N.s/m"}
        expected = self.at("jeffcott.yaml", **values)["unbalance"]["stations"]["rotor"]
        text = JEFFCOTT.replace(LINEAR, "simulation: {duration: 0.2 s, step: 0.05 ms, spectral_radius: 0.95}")
        for key, value in values.items():
            start = text.index(f"{key}: ") + len(key) + 2
            text = text[:start] + value + text[text.index(",", start):]
        self.require_run_at(expected, text, 3000 * RPM, 0.2)

    def test_a_run_on_a_film_settles_at_the_response(self):
        (self.folder / "film.yaml").write_text(FILM + LINEAR, encoding="utf-8")
        expected = self.at("film.yaml")["unbalance"]["stations"]["rotor"]
        self.require_run_at(expected, FILM + "simulation: {duration: 0.4 s, step: 0.1 ms, spectral_radius: 0.95}", 1500 * RPM, 0.4)

    # -- modes ---------------------------------------------------------------------------------------------------

    def frequencies(self, name, **values):
        at = self.at(name, **values)
        return {whirl: [m["damped_frequency"] * 2 * math.pi for m in at["modes"] if m["whirl"] == whirl] for whirl in ("forward", "backward")}

    def test_gyroscopic_splitting_of_a_uniform_shaft(self):
        levels = [self.frequencies("shaft.yaml", elements=n) for n in (9, 18, 36)]
        for n in (1, 2):
            forward, backward = timoshenko(n, 10000 * RPM, 0.1)
            for whirl, exact in (("forward", forward), ("backward", -backward)):
                a, b, c = (level[whirl][n - 1] for level in levels)
                self.assertAlmostEqual((b / exact - 1) / (c / exact - 1), 4, delta=0.3)  # second order of linear elements
                self.assertAlmostEqual((64 * c - 20 * b + a) / 45 / exact, 1, delta=1e-4)  # orders two and four extrapolated

    def test_numbers_that_ross_documents(self):
        # rotor_example() of ROSS: wn = 91.797, 96.289, 275, 297 rad/s at rest; critical speeds 92, 96, 271, 300 rad/s.
        discs = {"mass": "32.58972765 kg", "i_t": "0.1780892826 kg.m^2", "i_p": "0.3295636209 kg.m^2", "k_x": "1 MN/m", "k_y": "0.8 MN/m"}
        slow = self.at("thin.yaml", **discs, elements=24, speed="1 rpm")
        found = [m["damped_frequency"] * 2 * math.pi for m in slow["modes"] if m["whirl"] != "none"]
        for value, documented in zip(found, (91.79655318, 96.28899977, 275, 297)):
            self.assertAlmostEqual(value / documented, 1, delta=0.003)
        over = self.rotor("thin.yaml", "--sweep", "speed=800rpm:3200rpm:25", **discs, elements=24)
        for found, documented in zip(over["critical_speeds"], (92, 96, 271, 300)):
            self.assertAlmostEqual(found["speed"] * RPM / documented, 1, delta=0.008)  # documented to a whole number

    def test_modes_of_a_rigid_rotor_are_those_of_the_run(self):
        import h5py
        values = {"k_y": "2 MN/m", "q": "0.1 MN/m", "q_yx": "-0.1 MN/m"}
        modes = self.at("jeffcott.yaml", **values)["modes"]
        text = JEFFCOTT.replace('  u: {type: unbalance, on: rotor, amount: "${amount}", phase: "${phase}"}\n', "")
        text = text.replace(", amount: 10 g.mm, phase: 0 deg", "")
        (self.folder / "modes.yaml").write_text(text, encoding="utf-8")
        sets = [f"--set={key}={value}" for key, value in values.items()]
        self.hersey("run", self.folder / "modes.yaml", "--output", self.folder / "out", "--force", *sets)
        with h5py.File(next((self.folder / "out").rglob("*.h5"))) as file:
            for key in ("damped_frequency", "damping_ratio"):
                for mode, value in zip(modes, file[f"modes/fields/{key}"][...].ravel(), strict=True):
                    self.assertAlmostEqual(mode[key], value, delta=1e-9 * abs(value))  # round-off

    def test_a_sagging_rotor_is_steady(self):
        # Under its weight on supports that differ in x and y: the coordinates of the beam rotate, its axis does not.
        values = {"mass": "30 kg", "i_t": "0.17 kg.m^2", "i_p": "0.33 kg.m^2", "k_x": "1 MN/m", "k_y": "0.8 MN/m", "elements": 6}
        with_gravity = self.at("thin.yaml", **values, g="-9.81")
        without = self.at("thin.yaml", **values)
        weight = 9.81 * (60 + 7810 * math.pi * 0.025**2 * 1.5)
        carried = sum(b["static_force"]["y"] for b in with_gravity["bearings"].values())
        self.assertAlmostEqual(carried / weight, 1, delta=1e-9)  # round-off of stiff elements
        # The sag couples torsion and motion along the axis to it, which do not count as whirl for that.
        self.assertEqual([m["whirl"] for m in with_gravity["modes"]][:6], [m["whirl"] for m in without["modes"]][:6])
        self.assertIn("none", [m["whirl"] for m in with_gravity["modes"]][:8])
        for a, b in zip(with_gravity["modes"][:4], without["modes"][:4], strict=True):
            self.assertAlmostEqual(a["damped_frequency"] / b["damped_frequency"], 1, delta=1e-4)  # the sag of 0.7 mm

    def test_rotating_damping_drives_whirl_beyond_the_critical_speed(self):
        # The material's damping stabilises below the first critical speed, and destabilises forward whirl above it.
        values = {"damping": "20 us", "elements": 6}
        critical = timoshenko(1, 0, 0.05)[0] / RPM
        for factor, sign in ((0.8, 1), (1.2, -1)):
            modes = [m for m in self.at("thin.yaml", **values, speed=f"{factor * critical} rpm")["modes"] if m["whirl"] == "forward"]
            self.assertEqual(math.copysign(1, modes[0]["log_decrement"]), sign)

    def test_a_shaft_that_is_not_alike_is_refused(self):
        off = JEFFCOTT.replace("rotor: {mass: 10 kg,", "rotor: {mass: 10 kg, centre_of_mass: 1 0 0 mm,")
        (self.folder / "off.yaml").write_text(off, encoding="utf-8")
        self.assertIn("is not in balance at another angle", self.hersey("rotor", self.folder / "off.yaml", code=1).stderr)
        still = JEFFCOTT.replace('speed: "${speed}"', "speed: 0 rpm").replace("speed: 3000 rpm, ", "")
        (self.folder / "still.yaml").write_text(still, encoding="utf-8")
        self.assertIn("no body that a drive rotates", self.hersey("rotor", self.folder / "still.yaml", code=2).stderr)
        unknown = self.hersey("rotor", self.folder / "jeffcott.yaml", "--stations", "rotor.top", code=2).stderr
        self.assertIn("no station 'rotor.top' on the shaft", unknown)

    # -- maps and tables -----------------------------------------------------------------------------------------

    def test_a_bearing_has_the_coefficients_of_its_table(self):
        bearing = self.at("jeffcott.yaml", k_y="2 MN/m", q="0.1 MN/m", q_yx="-0.1 MN/m", g="-9.81")["bearings"]["support"]
        for key, value in (("xx", 1e6), ("xy", 1e5), ("yx", -1e5), ("yy", 2e6)):
            self.assertAlmostEqual(bearing["stiffness"][key], value, delta=1e-3)  # round-off
        self.assertAlmostEqual(bearing["damping"]["xx"], 200, delta=1e-9)
        self.assertAlmostEqual(bearing["static_force"]["y"], 98.1, delta=1e-6)

    def test_the_map_meets_closed_forms(self):
        found = self.rotor("jeffcott.yaml", "--stiffness-map", "10kN/m:100MN/m", k_y="2 MN/m", q="0.1 MN/m", q_yx="-0.1 MN/m")
        for point in found["critical_speed_map"]:
            forward = [c["speed"] * RPM for c in point["critical_speeds"] if c["whirl"] == "forward"]
            self.assertAlmostEqual(forward[0] / math.sqrt(point["stiffness"] / 10), 1, delta=1e-6)  # of the shift
        stiff = self.rotor("shaft.yaml", "--stiffness-map", "1e13N/m:1e14N/m", elements=24)["critical_speed_map"][0]
        coarse = self.rotor("shaft.yaml", "--stiffness-map", "1e13N/m:1e14N/m", elements=12)["critical_speed_map"][0]

        def first(point, whirl):
            return next(c["speed"] * RPM for c in point["critical_speeds"] if c["whirl"] == whirl)
        for whirl, sign in (("forward", 1), ("backward", -1)):
            exact = timoshenko(1, 0, 0.1)[0]
            for _ in range(60):  # where the frequency is the speed
                exact = sign * timoshenko(1, exact, 0.1)[0 if sign > 0 else 1]
            found = (4 * first(stiff, whirl) - first(coarse, whirl)) / 3
            self.assertAlmostEqual(found / exact, 1, delta=1e-4)

    def test_margins_are_those_of_api_617(self):
        # zeta of 0.05 in y, twice that in x: AF and margins by the formulae, on either side of the operating speed.
        for speed, sign in (("7000 rpm", -1), ("1500 rpm", 1)):
            peak, = self.rotor("jeffcott.yaml", "--sweep", "speed=500rpm:8000rpm:151", "--operating", speed, c="400 N.s/m")["response_peaks"]
            af, falling = peak["amplification_factor"], 17 * (1 - 1 / (peak["amplification_factor"] - 1.5))
            self.assertGreater(af, 2.5)
            required = min(falling, 16) if sign < 0 else min(10 + falling, 26)
            self.assertAlmostEqual(100 * peak["required_margin"], required, delta=1e-9)  # round-off
            operating = float(speed.split()[0])
            self.assertAlmostEqual(peak["separation_margin"], abs(peak["speed"] - operating) / operating, delta=1e-9)
        damped, = self.rotor("jeffcott.yaml", "--sweep", "speed=500rpm:20000rpm:196", "--operating", "5000rpm", c="3000 N.s/m")["response_peaks"]
        self.assertLess(damped["amplification_factor"] or 0, 2.5)

    def test_screening_finds_the_threshold_of_a_jeffcott_rotor(self):
        # Forward whirl at sqrt(k/m) grows where Q exceeds c sqrt(k/m).
        c, threshold = 200, 200 * math.sqrt(1e6 / 10)
        found = self.rotor("jeffcott.yaml", "--cross-coupling", "rotor=10kN/m")["stability_screening"]
        self.assertAlmostEqual(found["threshold_Q"] / threshold, 1, delta=1e-6)  # of the bisection
        self.assertTrue(found["is_enough"])
        decrement = found["log_decrement"]
        self.assertEqual(decrement, sorted(decrement, reverse=True))
        self.assertFalse(self.rotor("jeffcott.yaml", "--cross-coupling", "rotor=40kN/m")["stability_screening"]["is_enough"])

    def test_screening_does_not_depend_on_the_order_of_whirls_of_one_frequency(self):
        # Slow beside its whirls, whose forward and backward one differ by their damping alone: s^2 m + c s + k -+ i Q = 0.
        m, k, c = 10, 1e6, 200
        found = self.rotor("jeffcott.yaml", "--cross-coupling", "rotor=10kN/m", speed="600 rpm")["stability_screening"]
        for q, decrement in zip(found["Q"], found["log_decrement"], strict=True):
            root = -c / (2 * m) + cmath.sqrt((c / (2 * m)) ** 2 - complex(k, -q) / m)
            self.assertAlmostEqual(decrement, -2 * math.pi * root.real / abs(root.imag), delta=1e-6)  # round-off near the double root

    # -- gears ---------------------------------------------------------------------------------------------------

    def swap_bodies(self, text):
        lines = text.splitlines()
        pinion, wheel = (next(i for i, line in enumerate(lines) if line.startswith(f"  {name}: {{mass")) for name in ("pinion", "wheel"))
        lines[pinion], lines[wheel] = lines[wheel], lines[pinion]
        return "\n".join(lines) + "\n"

    def test_a_shaft_that_teeth_turn_back_has_its_own_sense(self):
        # With hardly any stiffness of the teeth the wheel is a rotor of its own: Q = c sqrt(k/m) less what its support has.
        (self.folder / "geared.yaml").write_text(GEARED, encoding="utf-8")
        sets = {"mesh": "1 kN/m", "mesh_c": "0 N.s/m", "k_xy": "3 MN/m"}
        found = self.rotor("geared.yaml", "--cross-coupling", "wheel=2MN/m", **sets)["stability_screening"]
        # x pushed along -y by the support (yx > 0): with a shaft that rotates from y to x.
        self.assertAlmostEqual(found["threshold_Q"] / (8e3 * math.sqrt(20e6 / 14) - 3e6), 1, delta=1e-3)  # of the teeth's stiffness

    def test_geared_shafts_of_one_speed_do_not_depend_on_the_order_of_bodies(self):
        even = GEARED.replace("[23, 57]", "[40, 40]")
        (self.folder / "one.yaml").write_text(even, encoding="utf-8")
        (self.folder / "other.yaml").write_text(self.swap_bodies(even), encoding="utf-8")
        one, other = self.at("one.yaml"), self.at("other.yaml")
        self.assertEqual((one["sense"], other["sense"]), (1, 1))
        self.assertEqual([m["whirl"] for m in one["modes"]], [m["whirl"] for m in other["modes"]])

    def test_lags_are_those_of_the_shaft_with_the_unbalance(self):
        (self.folder / "one.yaml").write_text(GEARED, encoding="utf-8")
        (self.folder / "other.yaml").write_text(self.swap_bodies(GEARED), encoding="utf-8")
        (self.folder / "upright.yaml").write_text(self.swap_bodies(GEARED).replace("{rotation: 40 deg}", "{rotation: 0 deg}"), encoding="utf-8")
        lags = [self.at(name)["unbalance"]["stations"]["pinion"]["x_lag_deg"] for name in ("one.yaml", "other.yaml", "upright.yaml")]
        for lag in lags[1:]:
            self.assertAlmostEqual(lag, lags[0], delta=1e-6)  # round-off

    def test_torsion_of_geared_shafts_has_a_critical_speed(self):
        (self.folder / "geared.yaml").write_text(GEARED, encoding="utf-8")
        done = self.hersey("rotor", self.folder / "geared.yaml", "--sweep", "speed=1000rpm:6000rpm:6", "--set=mesh=1 MN/m", "--json")
        found = json.loads(done.stdout)
        torsion = [critical for critical in found["critical_speeds"] if critical["whirl"] == "none"]
        frequency = [m["damped_frequency"] for m in found["speeds"][2]["modes"] if m["whirl"] == "none"][0]
        self.assertEqual(len(torsion), 1)
        self.assertAlmostEqual(torsion[0]["speed"] / 60 / frequency, 1, delta=1e-4)  # the frequency hardly depends on the speed
        text = self.hersey("rotor", self.folder / "geared.yaml", "--sweep", "speed=1000rpm:6000rpm:6", "--set=mesh=1 MN/m").stdout
        self.assertIn(f"{frequency:.2f}", text)

    def test_teeth_that_would_part_are_warned_of(self):
        (self.folder / "geared.yaml").write_text(GEARED, encoding="utf-8")
        for side, parts in (("negative", True), ("positive", False)):
            done = self.hersey("rotor", self.folder / "geared.yaml", "--set=torque=800 N.m", f"--set=side={side}")
            self.assertEqual("mesh: its teeth would part" in done.stderr, parts, done.stderr)

    # -- what has no answer, or another one than is asked for ------------------------------------------------------

    def write(self, name, old, new, of=JEFFCOTT):
        self.assertIn(old, of)
        (self.folder / name).write_text(of.replace(old, new), encoding="utf-8")

    def test_a_shaft_that_its_support_pushes_away_diverges(self):
        found = self.rotor("jeffcott.yaml", "--cross-coupling", "rotor=1kN/m", k="-1 MN/m")
        modes = found["speeds"][0]["modes"]
        self.assertEqual([mode["whirl"] for mode in modes], ["diverges", "planar"])
        self.assertIsNone(modes[0]["log_decrement"])
        m, k, c = 10, 1e6, 200
        growth = -c / (2 * m) + math.sqrt((c / (2 * m))**2 + k / m)
        self.assertAlmostEqual(modes[0]["growth_rate"] / growth, 1, 9)
        self.assertFalse(found["stability_screening"]["is_enough"])

    def test_inertia_that_differs_between_directions_is_refused(self):
        self.write("unlike.yaml", "xx: 0.05 kg.m^2", "xx: 0.04 kg.m^2")
        free = (self.folder / "unlike.yaml").read_text(encoding="utf-8")
        free = free.replace("bodies:\n", "bodies:\n  hub: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 2e-3 kg.m^2}}\n")
        free = free.replace("{type: planar, between: [ground, rotor], axis: z}",
                            "{type: revolute, between: [ground, hub], axis: z}\n  seat: {type: free, between: [hub, rotor]}")
        free = free.replace("  u: {", "  coupling: {type: bushing, between: [hub, rotor], stiffness: 1e5 1e5 1e5 N/m, "
                            "rotational_stiffness: 1e4 1e4 2e4 N.m/rad}\n  u: {")
        (self.folder / "unlike.yaml").write_text(free, encoding="utf-8")
        done = self.hersey("rotor", self.folder / "unlike.yaml", code=2)
        self.assertIn("inertias, sections or films differ between directions", done.stderr)
        (self.folder / "alike.yaml").write_text(free.replace("xx: 0.04", "xx: 0.05"), encoding="utf-8")
        self.hersey("rotor", self.folder / "alike.yaml")

    def test_a_force_from_the_shaft_to_its_housing_is_named(self):
        self.write("other_way.yaml", "between: [ground, rotor]\n    stiffness", "between: [rotor, ground]\n    stiffness")
        done = self.hersey("rotor", self.folder / "other_way.yaml", code=2)
        self.assertIn("between: [housing, shaft]", done.stderr)

    def test_an_unbalance_across_the_shaft_is_refused(self):
        self.write("across.yaml", "0.08 kg.m^2}}", "0.08 kg.m^2}, frames: {mid: {origin: 0 0 0 mm, rotation: {axis: y, angle: 90 deg}}}}")
        text = (self.folder / "across.yaml").read_text(encoding="utf-8").replace("on: rotor,", "on: rotor.mid,")
        (self.folder / "across.yaml").write_text(text, encoding="utf-8")
        done = self.hersey("rotor", self.folder / "across.yaml", code=2)
        self.assertIn("z-axis", done.stderr)

    def test_lags_do_not_depend_on_where_the_shaft_starts(self):
        self.write("later.yaml", "axis: z}\nforces", "axis: z, initial: {rotation: 77 deg}}\nforces")
        lag, later = (self.at(name)["unbalance"]["stations"]["rotor"]["x_lag_deg"] for name in ("jeffcott.yaml", "later.yaml"))
        self.assertAlmostEqual(lag, later, 6)

    def test_two_names_of_a_place_are_both_known(self):
        self.write("named.yaml", "0.08 kg.m^2}}", "0.08 kg.m^2}, frames: {mid: {origin: 0 0 0 mm}}}")
        one, other = (self.rotor("named.yaml", "--stations", "rotor", "--cross-coupling", f"{name}=10kN/m")["stability_screening"]
                      for name in ("rotor", "rotor.mid"))
        self.assertEqual(one["threshold_Q"], other["threshold_Q"])

    def test_a_speed_without_an_answer_leaves_the_others(self):
        (self.folder / "table.csv").write_text("speed [rpm],k_xx [N/m],k_yy [N/m]\n1000,1e6,1e6\n3000,1e6,1e6\n", encoding="utf-8")
        self.write("table.yaml", """stiffness: {xx: "${k}", xy: "${q}", yx: "${q_yx}", yy: "${k_y}"}
    damping: {xx: "${c}", yy: "${c}"}""", "file: table.csv")
        done = self.hersey("rotor", self.folder / "table.yaml", "--json", "--sweep", "speed=2000rpm:4000rpm:2", code=1)
        self.assertEqual([one["solved"] for one in json.loads(done.stdout)["speeds"]].count(True), 1)
        self.assertIn("4000 rpm", done.stderr)
        self.hersey("rotor", self.folder / "table.yaml", "--sweep", "speed=4000rpm:5000rpm:2", code=2)

    def test_what_is_varied_at_one_speed_has_no_critical_speeds(self):
        found = self.rotor("jeffcott.yaml", "--sweep", "k=0.2MN/m:2MN/m:7")
        self.assertEqual(found["critical_speeds"], [])
        self.assertNotIn("response_peaks", found)

    def test_peaks_between_few_speeds_have_no_amplification_factor(self):
        few = ("rotor", self.folder / "jeffcott.yaml", "--operating", "7000rpm", "--sweep", "speed=500rpm:10500rpm:6", "--set=c=20 N.s/m")
        done = self.hersey(*few, "--json")
        peak, = json.loads(done.stdout)["response_peaks"]
        self.assertIsNone(peak["amplification_factor"])
        self.assertFalse(peak["is_resolved"])
        self.assertFalse(peak["is_enough"])
        self.assertIn("Sweep 500 rpm to 4500 rpm in smaller steps", done.stderr)
        self.assertNotIn("yes", self.hersey(*few).stdout)
        # Half of the width of the peak at 0.707 is 10 rpm.
        fine = self.hersey(*few[:5], "speed=2990rpm:3050rpm:25", "--set=c=20 N.s/m", "--json")
        peak, = json.loads(fine.stdout)["response_peaks"]
        self.assertTrue(peak["is_resolved"])
        self.assertAlmostEqual(peak["amplification_factor"] * 20 / math.sqrt(1e6 * 10), 1, delta=0.01)  # steps of a quarter of this half
        self.assertEqual(fine.stderr, "")

    def test_results_of_a_sweep_that_changes_the_stations(self):
        import h5py
        import numpy
        path = self.folder / "elements.h5"
        found = self.rotor("thin.yaml", "--sweep", "elements=6,9", "--results", path, mass="30 kg", i_t="0.17 kg.m^2", i_p="0.33 kg.m^2", k_x="1 MN/m", k_y="0.8 MN/m")
        with h5py.File(path) as file:
            names = [name.decode() for name in file["station"][...]]
            self.assertEqual(file["swept_elements"][...].ravel().tolist(), [6, 9])
            shapes = file["modes/x_real"][...]
            counts = (~numpy.isnan(shapes[:, 0, :])).sum(axis=1)
            self.assertLess(counts[0], counts[1])
            self.assertLessEqual(numpy.nanmax(numpy.abs(shapes)), 1 + 1e-12)  # round-off of the largest axis, 1
            self.assertEqual(len(names), shapes.shape[2])
            # A node of the beam has its number's name, and lies elsewhere with more elements.
            along, fixed = file["station_along"][...], file["along"][...]
            numpy.testing.assert_array_equal(numpy.isnan(along), numpy.isnan(shapes[:, 0, :]))
            moved = numpy.isnan(fixed)
            self.assertIn(True, moved)
            numpy.testing.assert_allclose(along[:, ~moved], numpy.broadcast_to(fixed[~moved], along[:, ~moved].shape), atol=1e-9)  # m: round-off
            self.assertEqual(file["bearings/left/stiffness"][1, 0, 0], found["speeds"][1]["bearings"]["left"]["stiffness"]["xx"])

    def test_results_say_what_has_no_answer(self):
        import h5py
        (self.folder / "table.csv").write_text("speed [rpm],k_xx [N/m],k_yy [N/m]\n1000,1e6,1e6\n3000,1e6,1e6\n", encoding="utf-8")
        self.write("table.yaml", """stiffness: {xx: "${k}", xy: "${q}", yx: "${q_yx}", yy: "${k_y}"}
    damping: {xx: "${c}", yy: "${c}"}""", "file: table.csv")
        for name in ("rotor.hdf5", "rotor.H5"):
            path = self.folder / name
            self.hersey("rotor", self.folder / "table.yaml", "--results", path, "--sweep", "speed=2000rpm:4000rpm:2", code=1)
            with h5py.File(path) as file:
                self.assertEqual(file["speed"].shape, (1,))
                self.assertEqual(file.attrs["status"], "failed")
                self.assertIn("4000 rpm", file.attrs["message"])
            page = self.folder / "page.html"
            done = self.hersey("report", path, "--output", page, code=2)
            self.assertIn("rotor over its speeds", done.stderr)
            self.assertFalse(page.exists())

    def test_order_of_bodies_does_not_matter(self):
        values = {"mass": "30 kg", "i_t": "0.17 kg.m^2", "i_p": "0.33 kg.m^2", "k_x": "1 MN/m", "k_y": "0.8 MN/m", "elements": 6}
        lines = (self.folder / "thin.yaml").read_text(encoding="utf-8").splitlines()
        discs = [line for line in lines if line.startswith("  disc_")]
        others = [line for line in lines if not line.startswith("  disc_")]
        at = next(i for i, line in enumerate(others) if line.startswith("  hub:"))
        (self.folder / "order.yaml").write_text("\n".join(others[:at] + discs[::-1] + others[at:]), encoding="utf-8")
        one, other = self.at("thin.yaml", **values), self.at("order.yaml", **values)
        for a, b in zip(one["modes"][:6], other["modes"][:6], strict=True):
            self.assertAlmostEqual(a["damped_frequency"] / b["damped_frequency"], 1, delta=1e-7)  # round-off of stiff elements

    def test_page_and_results(self):
        report, results = self.folder / "rotor.html", self.folder / "rotor.json"
        done = self.hersey("rotor", self.folder / "jeffcott.yaml", "--sweep", "speed=500rpm:6000rpm:23", "--operating", "5000rpm:5500rpm",
                           "--cross-coupling", "rotor=10kN/m", "--stiffness-map", "10kN/m:100MN/m", "--report", report, "--results", results)
        page = report.read_text(encoding="utf-8")
        for title in ("Campbell diagram", "Stability", "Unbalance response", "Phase", "Forces of unbalance on the shaft",
                      "Undamped critical speeds", "Peaks of the unbalance response", "Q_0/Q_A"):
            self.assertIn(title, page)
        self.assertNotIn("nan", page)
        self.assertIn("AF", done.stdout)
        self.assertEqual(len(json.loads(results.read_text(encoding="utf-8"))["speeds"]), 23)


if __name__ == "__main__":
    unittest.main()
