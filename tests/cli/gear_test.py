#!/usr/bin/python3
"""Gear meshes in models: vibrations, static forces and rotors against closed forms and small systems of their own."""

import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERSEY = os.path.abspath(sys.argv.pop(1))
RPM = math.pi / 30
Z1, Z2, MODULE = 23, 57, 4e-3

# Two wheels on fixed axes; each test adds what it needs.
PAIR = """hersey: 1
parameters: {speed: 3000 rpm, k: 400 MN/m, c: 0 N.s/m, helix: 0 deg, side: positive, torque: 0 N.m}
bodies:
  ground: {frames: {second: {origin: DISTANCE 0 0 mm}}}
  pinion: {mass: 3 kg, inertia: {xx: 0.003 kg.m^2, yy: 0.003 kg.m^2, zz: 0.004 kg.m^2}}
  wheel: {mass: 14 kg, inertia: {xx: 0.05 kg.m^2, yy: 0.05 kg.m^2, zz: 0.09 kg.m^2}}
joints:
  turning: {type: FIRST, between: [ground, pinion], axis: z}
  other: {type: SECOND, between: [ground.second, wheel], axis: z}
forces:
  mesh: {type: gear_mesh, between: [pinion, wheel], teeth: [23, 57], normal_module: 4 mm, helix_angle: "${helix}", torque_on_first: "${side}", stiffness: "${k}", damping: "${c}"}
  load: {type: torque, body: wheel, components: [0, 0, "${torque}"]}
"""
PINION, WHEEL = (3, 0.004), (14, 0.09)  # masses and moments of inertia about the axes
DRIVE = 'drives: {motor: {joint: turning, coordinate: rotation, speed: "${speed}"}}\n'
SUPPORTS = """  left: {type: bearing_table, between: [ground, pinion], stiffness: {xx: 60 MN/m, yy: 80 MN/m}}
  right: {type: bearing_table, between: [ground.second, wheel], stiffness: {xx: 150 MN/m, yy: 90 MN/m}}
"""
TURNING = "simulation: {analysis: modes, modes_about: turning}\n"

# The geared generator and turbine of Rao, Shiau and Chang (1998), as ROSS has it in the documentation of MultiRotor.
TURBINE = """hersey: 1
parameters: {per_metre: 1, side: positive}
bodies:
  ground:
    frames:
      a: {origin: 0 0 0 mm}
      b: {origin: 0 0 5500 mm}
      c: {origin: 589.15 0 6100 mm}
      e: {origin: 589.15 0 5800 mm}
      d: {origin: 589.15 0 11100 mm}
  low:
    beam: &beam
      points: [0 0 0 mm, 0 0 100 mm, 0 0 4340 mm]
      section: {circle: {diameter: 300 mm}}
      material: &steel {youngs_modulus: 207 GPa, poisson_ratio: 0.30188679245283, density: 7800 kg/m^3}
      elements: "${per_metre}*6"
    frames: {start: {along: start}, generator: {along: 100 mm}, end: {along: end}}
  thin:
    beam:
      points: [0 0 4340 mm, 0 0 5500 mm, 0 0 5800 mm]
      section: {circle: {diameter: 220 mm}}
      material: *steel
      elements: "${per_metre}*3"
    frames: {start: {along: start}, bearing: {along: 1160 mm}, end: {along: end}}
  high:
    beam:
      points: [589.15 0 5800 mm, 589.15 0 6100 mm, 589.15 0 11100 mm, 589.15 0 11200 mm]
      section: {circle: {diameter: 150 mm}}
      material: *steel
      elements: "${per_metre}*10"
    frames: {start: {along: start}, first: {along: 300 mm}, turbine: {along: 5300 mm}, end: {along: end}}
  generator: {mass: 525.7 kg, inertia: {xx: 16.1 kg.m^2, yy: 16.1 kg.m^2, zz: 32.2 kg.m^2}}
  disk: {mass: 116.04 kg, inertia: {xx: 3.115 kg.m^2, yy: 3.115 kg.m^2, zz: 6.23 kg.m^2}}
  wheel: {mass: 726.4 kg, inertia: {xx: 56.95 kg.m^2, yy: 56.95 kg.m^2, zz: 113.9 kg.m^2}}
  pinion: {mass: 5 kg, inertia: {xx: 0.002 kg.m^2, yy: 0.002 kg.m^2, zz: 0.004 kg.m^2}}
  turbine: {mass: 7.45 kg, inertia: {xx: 0.0745 kg.m^2, yy: 0.0745 kg.m^2, zz: 0.149 kg.m^2}}
joints:
  floats: {type: free, between: [ground.a, low.start]}
  floats_too: {type: free, between: [ground.e, high.start]}
  join: {type: fixed, between: [low.end, thin.start]}
  g: {type: fixed, between: [low.generator, generator]}
  k: {type: fixed, between: [low.end, disk]}
  w: {type: fixed, between: [thin.end, wheel]}
  p: {type: fixed, between: [high.start, pinion]}
  t: {type: fixed, between: [high.turbine, turbine]}
forces:
  mesh: {type: gear_mesh, between: [wheel, pinion], teeth: [328, 23], normal_module: 3.357 mm, pressure_angle: 22.5 deg, torque_on_first: "${side}", stiffness: 100 MN/m}
  b1: {type: bearing_table, between: [ground.a, low.start], stiffness: {xx: 183.9 MN/m, yy: 200.4 MN/m}, damping: {xx: 3 kN.s/m, yy: 3 kN.s/m}}
  b2: {type: bearing_table, between: [ground.b, thin.bearing], stiffness: {xx: 183.9 MN/m, yy: 200.4 MN/m}, damping: {xx: 3 kN.s/m, yy: 3 kN.s/m}}
  b3: {type: bearing_table, between: [ground.c, high.first], stiffness: {xx: 10.1 MN/m, yy: 41.6 MN/m}, damping: {xx: 3 kN.s/m, yy: 3 kN.s/m}}
  b4: {type: bearing_table, between: [ground.d, high.end], stiffness: {xx: 10.1 MN/m, yy: 41.6 MN/m}, damping: {xx: 3 kN.s/m, yy: 3 kN.s/m}}
simulation: {analysis: modes, modes_about: start}
"""


class BeamElements:
    """Both shafts of TURBINE by cubic elements of Timoshenko's beam, undamped and at rest: x, y, two slopes and the twist of each node."""

    E, G, RHO = 207e9, 79.5e9, 7800

    def __init__(self, per_segment):
        low = self.shaft([0.1, 4.24, 1.16, 0.3], [0.3, 0.3, 0.22, 0.22], per_segment)
        high = self.shaft([0.3, 5, 0.1], [0.15] * 3, per_segment)
        for node, disk in ((1, (525.7, 16.1, 32.2)), (2, (116.04, 3.115, 6.23)), (4, (726.4, 56.95, 113.9))):
            self.add_disk(low[1], node * per_segment, *disk)
        for node, disk in ((0, (5, 0.002, 0.004)), (2, (7.45, 0.0745, 0.149))):
            self.add_disk(high[1], node * per_segment, *disk)
        for K, nodes, k in ((low[0], (0, 3), (183.9e6, 200.4e6)), (high[0], (1, 3), (10.1e6, 41.6e6))):
            for node in nodes:
                for axis in (0, 1):
                    K[5 * node * per_segment + axis, 5 * node * per_segment + axis] += k[axis]
        first = len(low[0])
        self.K, self.M = (np.block([[a, np.zeros((first, len(b)))], [np.zeros((len(b), first)), b]]) for a, b in zip(low, high))
        lever = np.zeros(len(self.K))
        alpha, wheel = math.radians(22.5), 20 * per_segment
        lever[[wheel, wheel + 1, wheel + 4]] = math.sin(alpha), math.cos(alpha), 0.5086
        lever[[first, first + 1, first + 4]] = -math.sin(alpha), -math.cos(alpha), 0.03567
        self.K += 1e8 * np.outer(lever, lever)

    @staticmethod
    def add_disk(M, node, mass, across, along):
        for k, value in enumerate((mass, mass, across, across, along)):
            M[5 * node + k, 5 * node + k] += value

    def shaft(self, lengths, diameters, per_segment):
        segments = [(length / per_segment, d) for length, d in zip(lengths, diameters) for _ in range(per_segment)]
        K, M = np.zeros((2, 5 * len(segments) + 5, 5 * len(segments) + 5))
        nu = self.E / (2 * self.G) - 1
        for i, (L, d) in enumerate(segments):
            area, inertia = math.pi * d**2 / 4, math.pi * d**4 / 64
            phi = 12 * self.E * inertia / (self.G * area * L**2 * 6 * (1 + nu) / (7 + 6 * nu))
            k = self.E * inertia / ((1 + phi) * L**3) * np.array(
                [[12, 6 * L, -12, 6 * L], [6 * L, (4 + phi) * L**2, -6 * L, (2 - phi) * L**2],
                 [-12, -6 * L, 12, -6 * L], [6 * L, (2 - phi) * L**2, -6 * L, (4 + phi) * L**2]])
            m = self.RHO * area * L / 420 * np.array([[156, 22 * L, 54, -13 * L], [22 * L, 4 * L**2, 13 * L, -3 * L**2],
                                                      [54, 13 * L, 156, -22 * L], [-13 * L, -3 * L**2, -22 * L, 4 * L**2]])
            m += self.RHO * inertia / (30 * L) * np.array([[36, 3 * L, -36, 3 * L], [3 * L, 4 * L**2, -3 * L, -(L**2)],
                                                           [-36, -3 * L, 36, -3 * L], [3 * L, -(L**2), -3 * L, 4 * L**2]])
            for across, slope, sign in ((0, 3, 1), (1, 2, -1)):
                at = np.ix_(*2 * [[5 * i + across, 5 * i + slope, 5 * i + 5 + across, 5 * i + 5 + slope]])
                turned = np.diag([1, sign, 1, sign])
                K[at] += turned @ k @ turned
                M[at] += turned @ m @ turned
            twist = np.ix_([5 * i + 4, 5 * i + 9], [5 * i + 4, 5 * i + 9])
            K[twist] += 2 * self.G * inertia / L * np.array([[1, -1], [-1, 1]])
            M[twist] += self.RHO * 2 * inertia * L / 6 * np.array([[2, 1], [1, 2]])
        return K, M

    def frequencies(self, count):
        """The lowest [rad/s], without the motion in which both shafts rotate."""
        return np.sqrt(np.abs(np.sort(np.linalg.eigvals(np.linalg.solve(self.M, self.K)).real)))[1:count + 1]



def teeth(helix_deg, distance=None):
    """Base radii, helix angle on the base cylinder and pressure angle in service."""
    beta, alpha_n = math.radians(helix_deg), math.radians(20)
    alpha_t = math.atan(math.tan(alpha_n) / math.cos(beta))
    r_b = [MODULE * z / 2 / math.cos(beta) * math.cos(alpha_t) for z in (Z1, Z2)]
    alpha = alpha_t if distance is None else math.acos(sum(r_b) / distance)
    return r_b, math.atan(math.tan(beta) * math.cos(alpha_t)), alpha


def distance_of(helix_deg):
    return MODULE * (Z1 + Z2) / 2 / math.cos(math.radians(helix_deg))


class Gears(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-gears-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def hersey(self, *arguments, code=0):
        done = subprocess.run([HERSEY, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def write(self, text, **values):
        for key, value in values.items():
            text, count = re.subn(rf"([{{ ]{key}: )[^,}}]*", rf"\g<1>{value}", text, count=1)
            self.assertEqual(count, 1, key)
        path = self.folder / "model.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    def pair(self, rest, first="revolute", second="revolute", distance=0.16, more=""):
        """The model's text; `more` are forces."""
        text = PAIR.replace("FIRST", first).replace("SECOND", second)
        return text.replace("DISTANCE", repr(1e3 * distance)) + more + rest

    def run_model(self, text, **values):
        self.hersey("run", self.write(text, **values), "--output", self.folder / "out", "--force")
        return next((self.folder / "out").rglob("*.h5"))

    def rotor(self, text, *arguments, **values):
        return json.loads(self.hersey("rotor", self.write(text, **values), "--json", *arguments).stdout)

    def frequencies(self, text, **values):
        """Of a rotor at its speed [rad/s]."""
        return [2 * math.pi * m["damped_frequency"] for m in self.rotor(text, **values)["speeds"][0]["modes"]]

    # -- vibrations ----------------------------------------------------------------------------------------------

    def test_two_shafts_vibrate_against_each_other(self):
        for helix in (0, 20):
            distance = distance_of(helix)
            r_b, beta_b, _ = teeth(helix)
            text = self.pair("simulation: {analysis: modes, modes_about: start}\n", distance=distance)
            c = 2e3
            with h5py.File(self.run_model(text, helix=f"{helix} deg", c=f"{c} N.s/m")) as file:
                found, damping = (file[f"modes/fields/{name}"][...] for name in ("frequency", "damping_ratio"))
            expected = math.sqrt(4e8 * math.cos(beta_b) ** 2 * (r_b[0] ** 2 / PINION[1] + r_b[1] ** 2 / WHEEL[1]))
            self.assertAlmostEqual(2 * math.pi * found.max() / expected, 1, delta=1e-9)  # round-off
            self.assertAlmostEqual(damping[found.argmax()] / (c * expected / (2 * 4e8)), 1, delta=1e-7)  # round-off of a small number

    def test_a_geared_jeffcott_pair(self):
        k = 4e8
        for side, sign in (("positive", 1), ("negative", -1)):
            r_b, _, alpha = teeth(0)
            # x and y of both wheels, and the second wheel's rotation; the drive holds the first one's.
            n = np.array([math.sin(alpha), sign * math.cos(alpha)])
            lever = np.array([*n, *-n, sign * r_b[1]])
            K = np.diag([6e7, 8e7, 15e7, 9e7, 0]) + k * np.outer(lever, lever)
            M = np.diag([PINION[0], PINION[0], WHEEL[0], WHEEL[0], WHEEL[1]])
            expected = np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(M, K)).real))
            text = self.pair(DRIVE + TURNING, "planar", "planar", more=SUPPORTS + "  u: {type: unbalance, on: pinion, amount: 10 g.mm}\n")
            found = self.rotor(text, side=side)["speeds"][0]
            for value, exact in zip([2 * math.pi * m["damped_frequency"] for m in found["modes"]], expected, strict=True):
                self.assertAlmostEqual(value / exact, 1, delta=1e-8)  # round-off of the spin's differences
            # An unbalance of the pinion moves the wheel, too.
            w = 3000 * RPM
            answer = np.linalg.solve(K - w**2 * M, 1e-5 * w**2 * np.array([1, -1j, 0, 0, 0]))
            for i, body in enumerate(("pinion", "wheel")):
                for j, axis in enumerate("xy"):
                    self.assertAlmostEqual(found["unbalance"]["stations"][body][axis] / abs(answer[2 * i + j]), 1, delta=1e-7)  # of the same

    def test_helical_wheels_couple_torsion_with_motion_along_the_axis(self):
        helix, k, k_z = 20, 4e8, 5e7
        for signed in (helix, -helix):
            r_b, beta_b, _ = teeth(signed)
            text = self.pair(DRIVE + TURNING, "revolute", "cylindrical", distance_of(helix),
                             f"  thrust: {{type: sliding_spring, joint: other, stiffness: {k_z} N/m}}\n")
            lever = np.array([math.sin(beta_b), math.cos(beta_b) * r_b[1]])
            K = np.diag([k_z, 0]) + k * np.outer(lever, lever)
            expected = np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(np.diag(WHEEL), K)).real))
            for value, exact in zip(self.frequencies(text, helix=f"{signed} deg"), expected, strict=True):
                self.assertAlmostEqual(value / exact, 1, delta=1e-8)  # round-off of the spin's differences

    def test_a_geared_turbine(self):
        # ROSS documents 74, 77, 112, 113 rad/s, of one element a segment.
        self.assertEqual(list(np.round(BeamElements(1).frequencies(4))), [74, 77, 112, 113])
        exact = BeamElements(8).frequencies(4)
        found = []
        for elements in (1, 2):
            with h5py.File(self.run_model(TURBINE, per_metre=elements)) as file:
                found.append(2 * math.pi * np.sort(file["modes/fields/damped_frequency"][...])[6:10])  # after six that displace nothing
        for a, b, value in zip(*found, exact, strict=True):
            self.assertAlmostEqual((4 * b - a) / 3 / value, 1, delta=1e-3)  # linear elements, of second order, extrapolated

    # -- forces --------------------------------------------------------------------------------------------------

    def test_a_torque_is_carried_along_the_line_of_action(self):
        torque = 800.0
        for helix, analysis in ((0, "steady"), (15, "steady"), (-15, "static")):
            distance = distance_of(helix) + 0.4e-3  # wheels with profile shift
            r_b, beta_b, alpha = teeth(helix, distance)
            text = self.pair(DRIVE + f"simulation: {{analysis: {analysis}}}\n", distance=distance)
            with h5py.File(self.run_model(text, helix=f"{helix} deg", torque=f"{torque} N.m")) as file:
                found = {name: file[f"forces/mesh/{name}"][-1] for name in file["forces/mesh"] if name.startswith("mesh_")}
                drive = file["drives/motor/force_or_torque"][-1]
            force = torque / r_b[1] / math.cos(beta_b)
            tangential = torque / (r_b[1] / math.cos(alpha))
            expected = {"mesh_force": force, "mesh_force_tangential": tangential, "mesh_force_radial": tangential * math.tan(alpha),
                        "mesh_force_axial": torque / r_b[1] * math.tan(beta_b), "mesh_deflection": force / 4e8}
            for name, value in expected.items():
                # Newton's tolerance.
                self.assertAlmostEqual(found[name], value, delta=1e-8 * max(abs(value), force if name != "mesh_deflection" else 0), msg=name)
            self.assertAlmostEqual(drive / (torque * Z1 / Z2), 1, delta=1e-8)  # Newton's tolerance

    def test_speeds_are_in_the_ratio_of_the_teeth(self):
        rest = DRIVE + "simulation: {duration: 0.2 s, step: 0.1 ms, spectral_radius: 0.8}\n"
        rate = f", initial: {{rotation_rate: {-3000 * Z1 / Z2!r} rpm}}"
        text = self.pair(rest).replace("[ground.second, wheel], axis: z", "[ground.second, wheel], axis: z" + rate)
        with h5py.File(self.run_model(text)) as file:
            turned = file["joints/other/coordinates"][-1] - file["joints/other/coordinates"][0]
            force = np.abs(file["forces/mesh/mesh_force"][...]).max()
        self.assertAlmostEqual(turned / (-2 * math.pi * 10 * Z1 / Z2), 1, delta=1e-9)  # Newton's tolerance over ten revolutions
        self.assertLess(force, 0.5)  # N: 1 nm of the teeth, of Newton's tolerance; a torque of a newton metre makes 9 N

    def test_a_start_out_of_ratio_is_refused_with_the_speed_it_wants(self):
        text = self.pair(DRIVE + "simulation: {duration: 0.2 s, step: 0.1 ms, spectral_radius: 0.8}\n")
        done = self.hersey("run", self.write(text), "--output", self.folder / "out", "--force", code=2)
        self.assertIn("wheels that do not roll in their ratio at the start: the first at 3000 rpm, the second at 0 rpm", done.stderr)
        self.assertIn("-1210.53 rpm of the second", done.stderr)
        self.assertIn("forces.mesh", done.stderr)

    def refused(self, text, **values):
        return self.hersey("run", self.write(text, **values), "--output", self.folder / "out", "--force", code=2).stderr

    def rolling_pair(self, rest, rate=-3000 * Z1 / Z2):
        """Wheels of which the second has its speed [rpm] from the joint."""
        text = self.pair(rest)
        return text.replace("[ground.second, wheel], axis: z", f"[ground.second, wheel], axis: z, initial: {{rotation_rate: {rate!r} rpm}}")

    def test_teeth_are_free_of_force_where_the_assembly_puts_the_joints(self):
        for start, position in (("0 s", "0.05 + 100*t"), ("0.0123 s", "100*t")):
            rest = f'drives: {{motor: {{joint: turning, coordinate: rotation, position: {{expression: "{position}", unit: rad}}}}}}\n'
            rest += f"simulation: {{start: {start}, duration: 2 ms, step: 0.02 ms, spectral_radius: 0.9}}\n"
            with h5py.File(self.run_model(self.rolling_pair(rest, -100 / RPM * Z1 / Z2), c="3 kN.s/m")) as file:
                force = file["forces/mesh/mesh_force"][...]
            self.assertLess(abs(force[0]), 0.01)  # N: 0.03 nm of the teeth, of the assembly's tolerance
            self.assertLess(np.abs(force).max(), 1)  # N: of Newton's tolerance

    def test_a_rounded_speed_is_corrected(self):
        rest = DRIVE + "simulation: {duration: 1 ms, step: 0.1 ms, spectral_radius: 0.8}\n"
        path = self.write(self.rolling_pair(rest, -1210), c="3 kN.s/m")
        done = self.hersey("run", path, "--output", self.folder / "out", "--force")
        self.assertIn("joints.other.initial.rotation_rate: -126.7109 rad/s given, -126.766 rad/s at the start", done.stderr)
        with h5py.File(next((self.folder / "out").rglob("*.h5"))) as file:
            rate, force = file["joints/other/rates"][0], file["forces/mesh/mesh_force"][0]
        self.assertAlmostEqual(float(np.ravel(rate)[0]) / (-3000 * RPM * Z1 / Z2), 1, delta=1e-12)  # round-off
        self.assertLess(abs(force), 0.01)  # N: round-off of angles
        self.assertIn("rotation -1210.53 rpm under `initial`", self.refused(self.rolling_pair(rest, -1200)))

    def test_two_drives_have_to_be_in_ratio(self):
        drives = DRIVE.replace("}}\n", '}, second: {joint: other, coordinate: rotation, speed: -1205 rpm}}\n')
        text = self.pair(drives + "simulation: {analysis: steady}\n")
        found = self.refused(text)
        self.assertIn("drives rotate both", found)
        self.assertIn("-1210.526316 rpm of the second", found)
        with h5py.File(self.run_model(text.replace("-1205 rpm", f"{-3000 * Z1 / Z2!r} rpm"))) as file:
            self.assertLess(abs(file["forces/mesh/mesh_force"][-1]), 1)  # N: Newton's tolerance

    def test_a_planet_rolls_on_a_wheel_that_stands_still(self):
        text = """hersey: 1
bodies:
  ground: {}
  carrier: {mass: 1 kg, inertia: {xx: 0.01 kg.m^2, yy: 0.01 kg.m^2, zz: 0.01 kg.m^2}, frames: {pin: {origin: 92 0 0 mm}}}
  planet: {mass: 2 kg, inertia: {xx: 0.003 kg.m^2, yy: 0.003 kg.m^2, zz: 0.003 kg.m^2}}
joints:
  arm: {type: revolute, between: [ground, carrier], axis: z}
  pin: {type: revolute, between: [carrier.pin, planet], axis: z}
forces:
  mesh: {type: gear_mesh, between: [ground, planet], teeth: [23, 23], normal_module: 4 mm, torque_on_first: positive, stiffness: 400 MN/m}
drives: {motor: {joint: arm, coordinate: rotation, speed: 100 rpm}}
simulation: {analysis: steady}
"""
        with h5py.File(self.run_model(text)) as file:
            self.assertAlmostEqual(float(np.ravel(file["joints/pin/rates"][-1])[0]) / (100 * RPM), 1, delta=1e-9)  # round-off
        found = self.refused(text.replace("analysis: steady", "duration: 0.1 s, step: 0.1 ms"))
        self.assertIn("200 rpm of the second", found)
        self.assertIn("give joint pin, rotation 100 rpm under `initial`", found)
        self.assertNotIn("-0 rpm", found)

    def test_wheels_that_no_joint_rotates_are_named(self):
        steady = DRIVE + "simulation: {analysis: steady}\n"
        for text in (self.pair(steady, second="prismatic"), self.pair(steady).replace("[pinion, wheel]", "[pinion, ground.second]")):
            found = self.refused(text)
            self.assertIn("no joint lets the second wheel rotate", found)
            self.assertNotIn("-0 rpm", found)

    def test_wheels_roll_by_the_joint_that_no_spring_holds(self):
        text = self.pair(DRIVE + "simulation: {analysis: steady}\n", more="  hold: {type: torsion_spring, joint: arm, stiffness: 1 MN.m/rad}\n")
        text = text.replace("joints:\n", "  housing: {mass: 30 kg, inertia: {xx: 0.5 kg.m^2, yy: 0.5 kg.m^2, zz: 0.9 kg.m^2}}\njoints:\n"
                            "  arm: {type: revolute, between: [ground.second, housing], axis: z}\n").replace("[ground.second, wheel]", "[housing, wheel]")
        with h5py.File(self.run_model(text)) as file:
            arm, other = (float(np.ravel(file[f"joints/{name}/rates"][-1])[0]) for name in ("arm", "other"))
        self.assertEqual(arm, 0)
        self.assertAlmostEqual(other / (-3000 * RPM * Z1 / Z2), 1, delta=1e-9)  # round-off

    def test_what_couplings_tie_to_a_wheel_rolls_with_it(self):
        text = self.pair("couplings: {tie: {type: gear, input: other.rotation, output: far.rotation, ratio: -2}}\n" + DRIVE
                         + "simulation: {analysis: steady}\n")
        text = text.replace("joints:\n", "  third: {mass: 2 kg, inertia: {xx: 0.01 kg.m^2, yy: 0.01 kg.m^2, zz: 0.02 kg.m^2}}\njoints:\n"
                            "  far: {type: revolute, between: [ground, third], axis: z}\n")
        with h5py.File(self.run_model(text, torque="100 N.m")) as file:
            other, far = (float(np.ravel(file[f"joints/{name}/rates"][-1])[0]) for name in ("other", "far"))
        self.assertAlmostEqual(other / (-3000 * RPM * Z1 / Z2), 1, delta=1e-9)  # round-off
        self.assertAlmostEqual(far / other, -2, delta=1e-9)  # round-off

    def test_wheels_roll_in_the_ratio_of_their_teeth_whatever_the_error(self):
        text = self.rolling_pair(DRIVE + "simulation: {duration: 1 ms, step: 0.02 ms, spectral_radius: 0.9}\n")
        text = text.replace('damping: "${c}"', 'damping: "${c}", transmission_error: {amplitude: 3 um, phase: 90 deg}')
        done = self.hersey("run", self.write(text), "--output", self.folder / "out", "--force")
        self.assertNotIn("at the start", done.stderr)  # the error's rate is none of the wheels
        with h5py.File(next((self.folder / "out").rglob("*.h5"))) as file:
            other = float(np.ravel(file["joints/other/rates"][0])[0])
        self.assertAlmostEqual(other / (-3000 * RPM * Z1 / Z2), 1, delta=1e-12)  # round-off

    def test_faults_of_a_mesh_name_its_line(self):
        steady = DRIVE + "simulation: {analysis: steady}\n"
        found = self.refused(self.pair(steady, distance=0.4))
        self.assertRegex(found, r"model.yaml:\d+:\d+: forces.mesh: .*their teeth reach each other up to 168 mm")
        text = self.pair(steady).replace('damping: "${c}"', 'damping: "${c}", transmission_error: {amplitude: 5 mm}')
        found = self.refused(text)
        self.assertRegex(found, r"forces.mesh: .*its teeth deflect by 5 mm")
        self.assertNotIn("journal", found)

    def test_wheels_too_near_are_refused(self):
        done = self.hersey("run", self.write(self.pair(DRIVE + "simulation: {analysis: steady}\n", distance=0.149)), "--output", self.folder / "out", "--force", code=2)
        self.assertIn("need more than the sum of their base radii", done.stderr)

    def test_teeth_that_would_part_are_told(self):
        text = self.pair(DRIVE + "simulation: {analysis: steady}\n")
        done = self.hersey("run", self.write(text, torque="100 N.m", side="negative"), "--output", self.folder / "out", "--force")
        self.assertIn("gear mesh mesh: for 100 % of the time its teeth would part", done.stderr)
        self.assertRegex(done.stdout, r"(?s)\ngear mesh mesh\n.*smallest mesh force +-933")  # 100 N m over the base radius
        done = self.hersey("run", self.write(text, torque="100 N.m"), "--output", self.folder / "out", "--force")
        self.assertNotIn("would part", done.stderr)

    # -- motion --------------------------------------------------------------------------------------------------

    def with_error(self, rest, amplitude):
        """Wheels of a speed that a drive and an initial rate give, with an error of their teeth."""
        rate = f", initial: {{rotation_rate: {-300 * Z1 / Z2!r} rpm}}"
        text = self.pair(rest).replace("[ground.second, wheel], axis: z", "[ground.second, wheel], axis: z" + rate)
        return text.replace('damping: "${c}"', f'damping: "${{c}}", transmission_error: {{amplitude: {amplitude} um}}')

    def test_an_error_of_the_teeth_shakes_the_wheel(self):
        k, c = 4e6, 2e3
        text = self.with_error(DRIVE + "simulation: {duration: 0.2 s, step: 0.02 ms, spectral_radius: 0.95}\n", 2)
        with h5py.File(self.run_model(text, k="4 MN/m", c="2 kN.s/m", speed="300 rpm")) as file:
            t, found = file["time"][...], file["forces/mesh/mesh_deflection"][...]
        r_b, _, _ = teeth(0)
        m, w = WHEEL[1] / r_b[1] ** 2, Z1 * 300 * RPM
        expected = 2e-6 * -m * w**2 / complex(k - m * w**2, c * w)
        last = t > 0.15  # the vibration of the start has decayed by exp(-c t/(2 m)) then
        basis = np.stack([np.cos(w * t[last]), np.sin(w * t[last]), np.ones(last.sum())], axis=1)
        (real, imaginary, _), *_ = np.linalg.lstsq(basis, found[last], rcond=None)
        self.assertLess(abs(complex(real, -imaginary) - expected), 2e-3 * abs(expected))  # steps of a 430th of a tooth

    def test_steps_by_their_error_resolve_the_teeth(self):
        found = []
        for step in ("{tolerance: 1e-4}", "2 us"):
            rest = f"simulation: {{duration: 0.02 s, step: {step}, spectral_radius: 0.95}}\n"
            text = self.with_error(DRIVE + rest, 3).replace(repr(-300 * Z1 / Z2), repr(-3000 * Z1 / Z2))
            with h5py.File(self.run_model(text, c="3 kN.s/m", torque="200 N.m")) as file:
                found.append((file["time"][...], file["forces/mesh/mesh_deflection"][...]))
        t = np.linspace(0, 0.02, 20001)
        chosen, exact = (np.interp(t, *one) for one in found)
        self.assertLess(np.abs(chosen - exact).max(), 0.1 * np.ptp(exact))  # of local errors of 1 %, over 23 teeth

    def test_energy_of_a_run_is_in_balance(self):
        shares = []
        for step in (0.04, 0.02):
            rest = f"simulation: {{duration: 0.05 s, step: {step} ms, spectral_radius: 0.95}}\n"
            text = self.with_error(DRIVE + rest, 4)
            with h5py.File(self.run_model(text, k="40 MN/m", c="2 kN.s/m", speed="300 rpm", helix="0 deg", torque="1000 N.m")) as file:
                rest = {name: file[f"energy/since_start/{name}"][-1] for name in ("put_in", "dampers", "unexplained")}
                rates = [np.abs(file[f"power/{name}"][...]).max() for name in ("balance_error", "springs")]
            self.assertGreater(rest["dampers"], 0.1)  # J: the vibration of the start is damped
            shares.append(abs(rest["unexplained"]) / rest["dampers"])
            self.assertLess(rates[0], 1e-6 * rates[1])  # Newton's tolerance
        self.assertLess(shares[1], 0.01)  # of second order of the step
        self.assertLess(shares[1], 0.5 * shares[0])

    def test_the_order_of_the_wheels_and_the_other_hand(self):
        text = self.pair(DRIVE + "simulation: {analysis: steady}\n", distance=distance_of(15))
        values = {"torque": "800 N.m"}
        with h5py.File(self.run_model(text, helix="15 deg", **values)) as file:
            one = {name: file[f"forces/mesh/{name}"][-1] for name in ("mesh_force", "mesh_force_radial", "mesh_force_axial")}
        exchanged = text.replace("[pinion, wheel], teeth: [23, 57]", "[wheel, pinion], teeth: [57, 23]")
        with h5py.File(self.run_model(exchanged, helix="-15 deg", **values)) as file:
            other = {name: file[f"forces/mesh/{name}"][-1] for name in one}
        self.assertAlmostEqual(other["mesh_force"] / one["mesh_force"], 1, delta=1e-8)  # Newton's tolerance
        self.assertAlmostEqual(other["mesh_force_axial"] / one["mesh_force_axial"], -1, delta=1e-8)  # on the other wheel
        with h5py.File(self.run_model(text, helix="-15 deg", speed="-3000 rpm", side="negative", torque="-800 N.m")) as file:
            mirrored = {name: file[f"forces/mesh/{name}"][-1] for name in one}
        for name, value in one.items():
            self.assertAlmostEqual(mirrored[name] / value, 1, delta=1e-8, msg=name)  # Newton's tolerance


if __name__ == "__main__":
    unittest.main()
