#!/usr/bin/python3
"""FMUs in a model: a controller in C, of both versions of the standard, and hersey's own FMU, run beside a machine.

import_test.py HERSEY WORK [Class.test]"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import fmu_test  # noqa: E402  takes HERSEY and WORK off the arguments
from controller.build import UNITS, VARIABLES, build, description  # noqa: E402

HERSEY, WORK = fmu_test.HERSEY, fmu_test.WORK

INERTIA, PROPORTIONAL, INTEGRAL, LOAD, WANTED = 0.02, 0.4, 3.0, 0.5, 100.0
END = 0.2

# A rotor that a motor brings to its speed against a constant load.
ROTOR = f"""hersey: 1
bodies:
  rotor: {{mass: 1 kg, inertia: {{xx: 1e-2 kg.m^2, yy: 1e-2 kg.m^2, zz: {INERTIA} kg.m^2}}}}
joints:
  shaft: {{type: revolute, between: [ground, rotor], initial: {{rotation_rate: 60 rad/s}}}}
fmus:
  controller:
    file: controller.fmu
    step: 1 ms
    inputs: {{speed: shaft.rotation_rate, wanted: {WANTED} rad/s}}
    parameters: {{"gain[1].proportional": {PROPORTIONAL} N.m.s/rad, "gain[1].integral": {INTEGRAL}}}
forces:
  motor: {{type: torque, body: rotor, direction: z, magnitude: {{fmu: controller, output: torque}}}}
  load: {{type: torque, body: rotor, direction: z, magnitude: -{LOAD} N.m}}
simulation: {{duration: {END} s, step: 0.5 ms}}
"""
# The same with hersey's own controller.
OWN = ROTOR[:ROTOR.index("fmus:")] + f"""forces:
  motor: {{type: speed_control, joint: shaft, speed: {WANTED} rad/s, proportional: {PROPORTIONAL} N.m.s/rad, integral: {INTEGRAL} N.m/rad}}
""" + ROTOR[ROTOR.index("  load:"):]
assert "fmus" not in OWN


def closed_form(t):
    """Speed of the rotor with a controller that never waits: J w'' + kp w' + ki w = ki wanted."""
    damping, stiffness = PROPORTIONAL / INERTIA, INTEGRAL / INERTIA
    roots = np.roots([1, damping, stiffness]).astype(complex)
    start, rate = 60 - WANTED, (PROPORTIONAL * (WANTED - 60) - LOAD) / INERTIA
    a = np.linalg.solve([[1, 1], roots], [start, rate])
    return WANTED + np.real(a[0] * np.exp(roots[0] * t) + a[1] * np.exp(roots[1] * t))


def recurrence(step, count, hold="constant"):
    """Speed at the exchanges, and the torque from each on: the rotor under the controller's outputs, exactly."""
    speed, stored, given = 60.0, 0.0, 60.0
    torque = before = PROPORTIONAL * (WANTED - speed)
    speeds, torques = [speed], [torque]
    for _ in range(count):
        mean = torque + {"constant": 0, "ramp": before - torque, "extrapolated": torque - before}[hold] / 2
        given = speed
        speed += step / INERTIA * (mean - LOAD)
        stored += INTEGRAL * (WANTED - given) * step
        before, torque = torque, PROPORTIONAL * (WANTED - given) + stored
        speeds.append(speed), torques.append(torque)
    return np.array(speeds), np.array(torques)


class Folder(unittest.TestCase):
    """A folder with models and FMUs, and a temporary folder whose content is known."""

    @classmethod
    def setUpClass(cls):
        os.makedirs(WORK, exist_ok=True)
        cls.folder = tempfile.mkdtemp(prefix="import ", dir=WORK)  # with a space, as users have them
        cls.temporary = os.path.join(cls.folder, "tmp")
        os.mkdir(cls.temporary)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def hersey(self, *words, expect=0, **environment):
        done = subprocess.run([HERSEY, *map(str, words)], capture_output=True, text=True, check=False,
                              env={**os.environ, "TMPDIR": self.temporary, **environment})
        self.assertEqual(done.returncode, expect, f"{words}\n{done.stdout}{done.stderr}")
        self.assertEqual(os.listdir(self.temporary), [], "unpacked FMUs are left")
        return done.stdout + done.stderr

    def results(self, model, *sets, name="out"):
        out = os.path.join(self.folder, name)
        self.hersey("run", model, "--output", out, "--force", *[word for one in sets for word in ("--set", one)])
        return os.path.join(out, "results.h5")


class Cases:
    """What holds for both versions."""

    version = 0

    def setUp(self):
        self.fmu = os.path.join(self.folder, "controller.fmu")
        if not os.path.exists(self.fmu):
            build(self.fmu, self.version)
        self.model = self.write("rotor.yaml", ROTOR)

    def speeds(self, *sets):
        """Times, speeds, and signals of the controller at all rows."""
        with h5py.File(self.results(self.model, *sets)) as file:
            return {name: file[path][:] for name, path in (("t", "time"), ("w", "joints/shaft/rates"),
                                                           ("torque", "fmus/controller/torque"),
                                                           ("given", "fmus/controller/speed"),
                                                           ("wanted", "fmus/controller/wanted"))}

    def test_the_run_is_that_of_a_sampled_controller(self):
        self.assertIn("good", self.hersey("check", self.model))
        for hold, step, every, solver, rtol in (
                ("constant", "1 ms", 2, "0.5 ms", 1e-11),  # the integrator is exact for constant accelerations: round-off of 400 steps
                ("constant", "0.5 ms", 1, "0.5 ms", 1e-11),  # as above
                # Its error at bends of the acceleration is of second order in its step: a few 1e-6 at 0.5 ms.
                ("ramp", "1 ms", 10, "0.1 ms", 1e-6), ("extrapolated", "1 ms", 10, "0.1 ms", 1e-6)):
            with self.subTest(hold=hold, step=step):
                found = self.speeds(f"fmus.controller.step={step}", f"forces.motor.magnitude.hold={hold}",
                                    f"simulation.step={solver}")
                speeds, torques = recurrence(float(step.split()[0]) * 1e-3, (len(found["t"]) - 1) // every, hold)
                np.testing.assert_allclose(found["w"][::every], speeds, rtol=rtol)
                # A row at an exchange has what acted until then.
                np.testing.assert_allclose(found["torque"][every::every], torques[:-1], atol=rtol * PROPORTIONAL * WANTED)
                np.testing.assert_allclose(found["given"][every::every], speeds[:-1], rtol=rtol)
                self.assertEqual(set(found["wanted"]), {WANTED})

    def test_it_comes_to_speed_control_with_the_first_order(self):
        own = self.write("own.yaml", OWN)
        with h5py.File(self.results(own, "simulation.step=0.05 ms", name="own")) as file:
            expected = np.interp(np.arange(1, 21) * END / 20, file["time"][:], file["joints/shaft/rates"][:])
        np.testing.assert_allclose(expected, closed_form(np.arange(1, 21) * END / 20),
                                   atol=1e-3)  # its integral begins with the second step
        off = []
        for step in (4, 2, 1, 0.5):
            found = self.speeds(f"fmus.controller.step={step} ms")
            off.append(np.abs(np.interp(np.arange(1, 21) * END / 20, found["t"], found["w"]) -
                              closed_form(np.arange(1, 21) * END / 20)).max())
        print(f"distance from the closed form at 4, 2, 1 and 0.5 ms: {off}")
        np.testing.assert_allclose(np.log2(np.array(off[:-1]) / off[1:]), 1, atol=0.15)  # steps that are not yet small
        # The torque is one and a half communication steps old on average, and the speed changes by the first acceleration at most.
        self.assertLess(off[-1], 1.5 * 0.5e-3 * (PROPORTIONAL * 40 - LOAD) / INERTIA)

    def test_the_exchange_is_stable_up_to_its_bound(self):
        integral = f'"gain[1].integral": {INTEGRAL}'
        model = self.write("proportional.yaml", ROTOR.replace(integral, '"gain[1].integral": 0').replace(f"-{LOAD} N.m", "0 N.m"))
        off = {}
        for ratio in (0.9, 1.1):  # of k H / J
            step = ratio * INERTIA / PROPORTIONAL
            with h5py.File(self.results(model, f"fmus.controller.step={step} s", "simulation.duration=6 s",
                                        "simulation.step=5 ms")) as file:
                off[ratio] = np.abs(file["joints/shaft/rates"][-20:] - WANTED).max()
        self.assertLess(off[0.9], 1)  # |r|^n with |r|^2 = 0.9: 40 rad/s fall to 0.04
        self.assertGreater(off[1.1], 1000)  # with |r|^2 = 1.1: they rise to some thousands

    def test_steps_that_do_not_divide_each_other(self):
        found = self.speeds("fmus.controller.step=0.7 ms")
        speeds, _ = recurrence(0.7e-3, 285)
        at = [np.argmin(np.abs(found["t"] - n * 0.7e-3)) for n in range(286)]
        np.testing.assert_allclose(found["t"][at], np.arange(286) * 0.7e-3, atol=1e-12)  # round-off of times
        np.testing.assert_allclose(found["w"][at], speeds, rtol=1e-11)  # as above
        self.assertLess(np.diff(found["t"]).max(), 0.5e-3 + 1e-12)  # round-off of times
        by_error = self.speeds("fmus.controller.step=0.7 ms", "simulation.step={tolerance: 1e-6}")
        for n in range(1, 286):
            self.assertLess(np.abs(by_error["t"] - n * 0.7e-3).min(), 1e-12)  # round-off of times
        np.testing.assert_allclose(by_error["w"][-1], found["w"][-1], rtol=1e-6)  # the tolerance

    def test_momentum_and_energy_are_those_of_the_signals(self):
        found = self.speeds()
        dt = np.diff(found["t"])
        impulse = np.concatenate([[0], np.cumsum(dt * (found["torque"][1:] - LOAD))])
        np.testing.assert_allclose(INERTIA * (found["w"] - found["w"][0]), impulse, atol=1e-12)  # round-off of sums near 1
        with h5py.File(os.path.join(self.folder, "out", "results.h5")) as file:
            power, rate = file["power/loads"][:], file["power/kinetic_rate"][:]
        np.testing.assert_allclose(power[1:], (found["torque"][1:] - LOAD) * found["w"][1:], rtol=1e-11)  # round-off
        np.testing.assert_allclose(power[1:], rate[1:], rtol=1e-9)  # differences of the same

    def test_signals_are_in_the_tables_of_the_results(self):
        done = json.loads(self.hersey("schema", "--results"))
        lines = next(group["quantities"] for group in done["groups"] if group["path"] == "/fmus/<u>/")
        self.assertEqual([line["name"] for line in lines], ["<input>", "<output>"])
        with h5py.File(self.results(self.model)) as file:
            group = file["fmus/controller"]
            self.assertEqual(set(group) - {"time"}, {"speed", "wanted", "torque"})
            for name, line, unit in (("speed", 0, "rad/s"), ("wanted", 0, "rad/s"), ("torque", 1, "N.m")):
                self.assertEqual(group[name].attrs["units"], unit)
                self.assertIn(unit, lines[line]["units"])
                self.assertEqual(group[name].attrs["long_name"], lines[line]["text"].replace(f"<{('input', 'output')[line]}>", name))

    def test_parameters_of_every_type(self):
        plain = self.speeds()["w"]
        same = self.speeds("fmus.controller.parameters.name=PI", "fmus.controller.parameters.is_reversed=false",
                           "fmus.controller.parameters.fault=0")["w"]
        np.testing.assert_array_equal(plain, same)
        away = self.speeds("fmus.controller.parameters.is_reversed=true", "simulation.duration=20 ms")["w"]
        self.assertLess(away[-1], plain[40] - 10)
        # Names of variables have dots: of a value that the text has, and of one that it does not have.
        stronger = self.speeds(f"fmus.controller.parameters.gain[1].integral={2 * INTEGRAL}")["w"]
        self.assertGreater(np.abs(stronger - plain).max(), 0.1)
        without = ROTOR.replace(f', "gain[1].integral": {INTEGRAL}', "")
        self.assertNotEqual(without, ROTOR)
        with h5py.File(self.results(self.write("without.yaml", without), f"fmus.controller.parameters.gain[1].integral={INTEGRAL}")) as file:
            np.testing.assert_array_equal(file["joints/shaft/rates"][:], plain)
        # An input that the model does not connect keeps its start value.
        text = ROTOR.replace(f", wanted: {WANTED} rad/s", "").replace("parameters: {", "parameters: {wanted: 100 rad/s, ")
        with h5py.File(self.results(self.write("start.yaml", text))) as file:
            np.testing.assert_array_equal(file["joints/shaft/rates"][:], plain)

    def test_functions_of_time_and_scales(self):
        text = ROTOR.replace(f"wanted: {WANTED} rad/s", 'wanted: {expression: "100 + 50*(t > 0.1)", unit: rad/s}')
        with h5py.File(self.results(self.write("stepped.yaml", text))) as file:
            t, wanted = file["time"][:], file["fmus/controller/wanted"][:]
        self.assertEqual((set(wanted[t < 0.1001]), set(wanted[t > 0.1025])), ({100.0}, {150.0}))
        turned = ROTOR.replace("output: torque", "output: torque, scale: -1").replace(
            "parameters: {", "parameters: {is_reversed: true, ")
        plain = self.speeds()["w"]
        with h5py.File(self.results(self.write("turned.yaml", turned))) as file:
            # A minus on the gain and one on the output.
            np.testing.assert_allclose(file["joints/shaft/rates"][0], plain[0])

    def test_a_drive_follows_an_output(self):
        text = ROTOR[:ROTOR.index("forces:")] + (
            "drives:\n  motor: {joint: shaft, coordinate: rotation, acceleration: {fmu: controller, output: torque, "
            'hold: ramp, scale: "50 rad/(kg.m^2)"}}\n') + ROTOR[ROTOR.index("simulation:"):]
        # The load is no part of it: the acceleration of the rotor is torque over inertia.
        with h5py.File(self.results(self.write("drive.yaml", text))) as file:
            w, effort = file["joints/shaft/rates"][:], file["drives/motor/force_or_torque"][:]
            torque = file["fmus/controller/torque"][:]
        self.assertLess(abs(w[-1] - WANTED), abs(w[0] - WANTED) / 4)
        np.testing.assert_allclose(effort[2::2], torque[:-1:2], atol=0.5)  # a communication step late: near, not equal

    def test_a_driven_speed_is_the_output(self):
        text = ROTOR[:ROTOR.index("forces:")].replace(", initial: {rotation_rate: 60 rad/s}", "") + (
            "drives:\n  motor: {joint: shaft, coordinate: rotation, speed: {fmu: controller, output: torque, hold: ramp, "
            'scale: "0.5 rad/s/(N.m)"}}\n') + ROTOR[ROTOR.index("simulation:"):]
        model = self.write("speed.yaml", text)
        for hold, at_end in (("constant", lambda now, before: now), ("ramp", lambda now, before: now),
                             ("extrapolated", lambda now, before: 2 * now - before)):
            with self.subTest(hold=hold), h5py.File(self.results(model, f"drives.motor.speed.hold={hold}")) as file:
                w, torque = file["joints/shaft/rates"][2::2], file["fmus/controller/torque"][2::2]
                self.assertGreater(np.ptp(torque), 1)
                # The drive holds its speed as a constraint on velocities: round-off.
                np.testing.assert_allclose(w[1:], 0.5 * at_end(torque[1:], torque[:-1]), atol=1e-9)

    def test_two_fmus_share_the_work(self):
        build(os.path.join(self.folder, "other.fmu"), 5 - self.version)
        half = ROTOR.replace(f"proportional\": {PROPORTIONAL} ", f"proportional\": {PROPORTIONAL / 2} ").replace(
            f"integral\": {INTEGRAL}", f"integral\": {INTEGRAL / 2}")
        first = half[half.index("  controller:"):half.index("forces:")]
        text = half.replace(first, first + first.replace("controller:", "second:").replace("controller.fmu", "other.fmu")).replace(
            "  load:", "  more: {type: torque, body: rotor, direction: z, magnitude: {fmu: second, output: torque}}\n  load:")
        self.assertNotEqual(half, text)
        plain = self.speeds()["w"]
        with h5py.File(self.results(self.write("two.yaml", text))) as file:
            np.testing.assert_allclose(file["joints/shaft/rates"][:], plain, rtol=1e-12)  # halves and their sum: round-off
            np.testing.assert_array_equal(file["fmus/second/torque"][:], file["fmus/controller/torque"][:])

    def test_interrupted_runs_go_on_to_the_same_bits(self):
        out = os.path.join(self.folder, "interrupted")
        self.hersey("run", self.model, "--output", out, "--force", expect=130, HERSEY_TEST_INTERRUPT="0.05")
        with h5py.File(os.path.join(out, "results.h5")) as file:
            self.assertLess(file["time"][-1], 0.06)
        self.hersey("run", self.model, "--output", out, "--resume")
        with h5py.File(os.path.join(out, "results.h5")) as file, h5py.File(self.results(self.model)) as whole:
            for path in ("time", "joints/shaft/rates", "fmus/controller/torque", "fmus/controller/speed"):
                np.testing.assert_array_equal(file[path][:], whole[path][:], path)

    def test_resuming_needs_a_state(self):
        build(os.path.join(self.folder, "forgets.fmu"), self.version, saves_state=False)
        model = self.write("forgets.yaml", ROTOR.replace("controller.fmu", "forgets.fmu"))
        self.assertNotIn("checkpoint", self.hersey("check", model))
        asking = self.write("asking.yaml", ROTOR.replace("controller.fmu", "forgets.fmu").replace(
            "simulation: {", "simulation: {checkpoint: {every: 1 ms}, "))
        self.assertEqual(self.hersey("check", asking).count("simulation.checkpoint: checkpoints, but FMU controller cannot"), 1)
        out = os.path.join(self.folder, "forgets")
        self.hersey("run", model, "--output", out, "--force", expect=130, HERSEY_TEST_INTERRUPT="0.05")
        printed = self.hersey("run", model, "--output", out, "--resume", expect=2)
        self.assertIn("forgets.yaml:6", printed)
        self.assertIn("FMU controller cannot save its state", printed)
        self.hersey("run", model, "--output", out, "--force")

    def test_nothing_is_promised_that_restoring_a_state_breaks(self):
        build(os.path.join(self.folder, "returns.fmu"), self.version, flags=["-DSTATES_ARE_RESTORED"])
        self.results(self.write("returns.yaml", ROTOR.replace("controller.fmu", "returns.fmu")))

    def test_an_output_that_needs_inputs_is_0_before_them(self):
        plain = self.speeds()["w"]
        build(os.path.join(self.folder, "needs.fmu"), self.version, flags=["-DNEEDS_SPEED"])
        with h5py.File(self.results(self.write("needs.yaml", ROTOR.replace("controller.fmu", "needs.fmu")))) as file:
            np.testing.assert_array_equal(file["joints/shaft/rates"][:], plain)

    def test_outputs_are_recorded_by_any_name(self):
        # `time` is the scale of a group, "." and "/" have a meaning in paths.
        for name, recorded in (("time", "time_"), (".", "._"), ("a/b", "a|b")):
            variables = [(name, *one[1:]) if one[0] == "torque" else one for one in VARIABLES]
            build(os.path.join(self.folder, "named.fmu"), self.version, variables=variables)
            text = ROTOR.replace("controller.fmu", "named.fmu").replace("output: torque", f"output: {name}")
            with self.subTest(name=name), h5py.File(self.results(self.write("named.yaml", text))) as file:
                self.assertEqual(set(file["fmus/controller"]) - {"time"}, {"speed", "wanted", recorded})
                self.assertEqual(file["fmus/controller"][recorded].attrs["units"], "N.m")

    def test_a_library_that_crashes_is_named(self):
        out = os.path.join(self.folder, "crashed")
        crash = subprocess.run([HERSEY, "run", self.model, "--output", out, "--set", "fmus.controller.parameters.fault=6", "--set",
                                "fmus.controller.parameters.fault_time=0.05"], capture_output=True, text=True, check=False,
                               env={**os.environ, "TMPDIR": self.temporary})
        for name in os.listdir(self.temporary):  # nothing is tidied up by a program that has crashed
            shutil.rmtree(os.path.join(self.temporary, name))
        self.assertEqual(crash.returncode, 1)
        self.assertIn("controller.fmu: its library has crashed", crash.stderr)
        self.hersey("report", os.path.join(out, "results.h5"), "--output", os.path.join(out, "page.html"))  # they are still readable

    def test_warnings_are_told_at_the_end(self):
        out = os.path.join(self.folder, "warned")
        words = ("run", self.model, "--output", out, "--set", "fmus.controller.parameters.fault=5", "--set",
                 "fmus.controller.parameters.fault_time=0.0505")
        printed = self.hersey(*words, "--force")
        # Exchanges at 0.051 s, 0.052 s, ... 0.199 s: the run ends at the next one.
        self.assertIn("FMU controller: 149 warnings, the first at t = 0.051 s: ", printed)
        self.assertIn("DoStep ends with status warning: the fuse is warm", printed)
        printed = self.hersey(*words, "--force", expect=130, HERSEY_TEST_INTERRUPT="0.1")
        printed = self.hersey(*words, "--resume")
        self.assertIn("FMU controller: 149 warnings, the first at t = 0.051 s: ", printed)
        self.assertNotIn("warnings", self.hersey("run", self.model, "--output", out, "--force"))

    def test_failures_of_the_fmu(self):
        fault = "fmus.controller.parameters.fault"
        for kind, said in ((1, ["status error", "the fuse has blown"]),
                           (2, ["discard"] if self.version == 2 else ["asks for the end of the simulation"]),
                           (3, ["output torque is nan"]), (4, ["status fatal"])):
            with self.subTest(kind=kind):
                out = os.path.join(self.folder, "failed")
                printed = self.hersey("run", self.model, "--output", out, "--force", "--set", f"{fault}={kind}", "--set",
                                      "fmus.controller.parameters.fault_time=0.0505", expect=1)
                for words in [*said, "t = 0.051 s", "FMU controller"]:
                    self.assertIn(words, printed)
                with h5py.File(os.path.join(out, "results.h5")) as file:
                    self.assertAlmostEqual(file["time"][-1], 0.051)
                    self.assertEqual(file.attrs["status"], "failed")
        for setting, said in (('"gain[1].proportional"=-1', "a negative gain"), ("name=PID", "no such name")):
            model = self.write("refused.yaml", ROTOR.replace(f'"gain[1].proportional": {PROPORTIONAL} N.m.s/rad',
                                                             setting.replace("=", ": ")))
            printed = self.hersey("run", model, "--output", os.path.join(self.folder, "refused"), "--force", expect=2)
            self.assertIn(said, printed)
            self.assertIn("refused.yaml:8", printed)


class Fmi2ImportTest(Cases, Folder):
    version = 2


class Fmi3ImportTest(Cases, Folder):
    version = 3


class FaultsTest(Folder):
    """What `hersey check` says of models and FMUs that do not fit."""

    def faults(self, *changes, fmu=None):
        text = ROTOR
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        path = os.path.join(self.folder, "controller.fmu")
        if fmu is not None:
            fmu(path)
        elif not os.path.exists(path) or not zipfile.is_zipfile(path):
            build(path, 2)
        return self.hersey("check", self.write("model.yaml", text), expect=2)

    def test_names_units_and_kinds(self):
        build(os.path.join(self.folder, "controller.fmu"), 3)
        speed = "speed: shaft.rotation_rate"
        output = "output: torque"
        for changes, said in (
                ([("speed:", "sped:")], ["model.yaml:10", "no variable 'sped'", "did you mean 'speed'"]),
                ([("speed:", "torque:")], ["model.yaml:10", "'torque', whose causality is output", "speed"]),
                ([(speed, "speed: shaft.rotation_rat")], ["model.yaml:10", "no quantity 'shaft.rotation_rat'"]),
                ([(speed, "speed: joints.shaft.rate")], ["model.yaml:10", "did you mean 'joints.shaft.rates'"]),
                ([(speed, "speed: joints.shaft.coordinates")], ["model.yaml:10", "in rad", "rad/s"]),
                ([(speed, "speed: 3 N")], ["model.yaml:10", "a force", "an angular velocity"]),
                ([(output, "output: torqe")], ["model.yaml:13", "no variable 'torqe'", "torque"]),
                ([(output, "output: speed")], ["model.yaml:13", "causality is input"]),
                ([(output, "output: row")], ["model.yaml:13", "an array"]),
                ([(output, "output: count")], ["model.yaml:13", "of type Int32"]),
                ([(output, "output: flux")], ["model.yaml:13", "'T'"]),
                ([(output, "output: distance")], ["model.yaml:13", "'bananas'"]),
                ([(output, "output: torque, scale: 2 m")], ["model.yaml:13", "a torque"]),
                ([("fmu: controller", "fmu: controler")], ["model.yaml:13", "did you mean 'controller'"]),
                ([('"gain[1].integral"', '"gain[2].integral"')], ["model.yaml:11", "no variable 'gain[2].integral'"]),
                ([('"gain[1].integral": 3.0', "fault: 1.5")], ["model.yaml:11", "a whole number"]),
                ([('"gain[1].integral": 3.0', "is_reversed: 2")], ["model.yaml:11", "true or false"]),
                ([(f"{PROPORTIONAL} N.m.s/rad", "3 m")], ["model.yaml:11"]),
                ([("file: controller.fmu", "file: missing.fmu")], ["model.yaml:8", "missing.fmu"]),
                ([("duration: 0.2 s,", "duration: 0.2 s, analysis: kinematics,")], ["dynamics"]),
                ([("duration: 0.2 s,", "cycle: {period: 50 ms, lead_in: shooting},")], ["model.yaml:15:37", "lead_in: none"])):
            with self.subTest(changes=changes):
                printed = self.faults(*changes)
                for words in said:
                    self.assertIn(words, printed)

    def test_only_parameters_that_can_be_set_are_offered(self):
        variables = [(one[0], *one[1:4], "structuralParameter", *one[5:]) if one[0] == "fault" else one for one in VARIABLES]
        printed = self.faults(('"gain[1].integral"', '"gain[2].integral"'),
                              fmu=lambda path: build(path, 3, variables=variables))
        self.assertIn("did you mean 'gain[1].integral'", printed)
        self.assertIn("is_reversed", printed)
        self.assertNotIn("'fault'", printed.replace("fault_time", ""))
        self.assertIn("no parameter or input that can be set", self.faults(('"gain[1].integral": 3.0', "fault: 1")))
        os.remove(os.path.join(self.folder, "controller.fmu"))

    def test_small_motions_are_refused(self):
        build(os.path.join(self.folder, "controller.fmu"), 2)
        text = ROTOR.replace("fmus:", "drives:\n  turn: {joint: shaft, coordinate: rotation, speed: 60 rad/s}\nfmus:")
        printed = self.hersey("rotor", self.write("rotor.yaml", text), expect=2)
        self.assertIn("a machine with `fmus`", printed)

    def test_what_cannot_follow_an_output(self):
        text = ROTOR[:ROTOR.index("forces:")] + (
            "drives:\n  motor: {joint: shaft, coordinate: rotation, position: {fmu: controller, output: torque}}\n"
        ) + ROTOR[ROTOR.index("simulation:"):]
        build(os.path.join(self.folder, "controller.fmu"), 2)
        printed = self.hersey("check", self.write("position.yaml", text), expect=2)
        self.assertIn("position.yaml:13", printed)
        self.assertIn("FMUs give forces, torques, speeds and accelerations", printed)

    def test_files_that_are_no_fmus(self):
        def text_file(path):
            with open(path, "w", encoding="utf-8") as file:
                file.write("no archive " * 100)

        def with_description(text):
            def make(path):
                build(path, 2)
                with zipfile.ZipFile(path, "w") as archive:
                    archive.writestr("modelDescription.xml", text)
            return make

        def damaged(path):
            build(path, 2, method=zipfile.ZIP_STORED)
            with open(path, "rb") as file:
                content = bytearray(file.read())
            content[content.index(b"controller-of-the-tests")] ^= 1
            with open(path, "wb") as file:
                file.write(content)

        def escaping(path):
            build(path, 2)
            with zipfile.ZipFile(path, "a") as archive:
                archive.writestr("resources/../../escaped", "")

        laughs = '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><fmiModelDescription/>'
        for make, said in ((text_file, "no ZIP archive"), (damaged, "modelDescription.xml is damaged"),
                           (escaping, "would lie outside"),
                           (with_description("<a>"), "line 1"), (with_description("<a/>"), "begins with <a>"),
                           (with_description(laughs), "document type"),
                           (with_description(description(2, fmi_version="1.0")), "versions 2.0 and 3.0"),
                           (with_description(description(2, kind="ModelExchange")), "model exchange"),
                           (with_description(description(3)), "no libraries"),
                           (lambda path: build(path, 2, platform="win64"), "libraries for win64"),
                           (lambda path: build(path, 3, more=' fixedInternalStepSize="0.0003"'), "a multiple of 0.0003 s")):
            with self.subTest(said=said):
                printed = self.faults(fmu=make)
                self.assertIn(said, printed)
                self.assertIn("model.yaml:8" if "multiple" not in said else "model.yaml:9", printed)
        os.remove(os.path.join(self.folder, "controller.fmu"))


# A warm film, whose temperature an FMU is given.
WARM = ROTOR[:ROTOR.index("joints:")] + """joints:
  shaft: {type: planar, between: [ground, rotor], initial: {rotation_rate: 100 rad/s, y: -12 um}}
fmus:
  controller: {file: controller.fmu, step: 1 ms, inputs: {speed: bearings.main.T_max}}
forces:
  motor: {type: torque, body: rotor, direction: z, magnitude: {fmu: controller, output: torque, scale: 0}}
  push: {type: force, body: rotor, components: [0 N, -200 N, 0 N]}
lubricants:
  oil: {viscosity: 15 mPa.s, density: 870 kg/m^3, specific_heat: 2000 J/(kg.K), conductivity: 0.14 W/(m.K)}
bearings:
  main:
    shell: ground
    journal: rotor
    diameter: 50 mm
    width: 25 mm
    radial_clearance: 25 um
    lubricant: oil
    thermal: {model: film, supply_temperature: 40 degC}
    grid: {circumferential: 24, axial: 5}
    supply: {line: widest_gap, pressure: 1 bar}
simulation: {duration: 3 ms, step: 0.2 ms}
"""
RPM = '<BaseUnit rad="1" s="-1" factor="0.10471975511965977"/>'


class UnitsTest(Folder):
    """Numbers that go in and out in units with an offset, or without the radian."""

    def built(self, unit, **changes):
        """The controller, whose `speed` is in this unit."""
        self.assertIn(RPM, UNITS)
        build(os.path.join(self.folder, "controller.fmu"), 2, units=UNITS.replace(RPM, unit), **changes)

    def test_temperatures_are_given_in_the_unit_of_the_input(self):
        # The controller takes what it is given for rpm: its torque tells the number.
        for unit, offset in (('<BaseUnit K="1" offset="273.15"/>', 0), ('<BaseUnit K="1"/>', 273.15),
                             ('<BaseUnit K="1" factor="0.5555555555555556" offset="255.3722222222222"/>', None)):
            with self.subTest(unit=unit):
                self.built(unit)
                with h5py.File(self.results(self.write("warm.yaml", WARM))) as file:
                    film, given = file["bearings/main/T_max"][:], file["fmus/controller/speed"][:]
                    self.assertEqual([file[path].attrs["units"] for path in ("bearings/main/T_max", "fmus/controller/speed")],
                                     ["degC", "K"])
                    torque = file["fmus/controller/torque"][:]
                self.assertGreater(film[0], 39)
                np.testing.assert_allclose(given[5::5], film[:-1:5] + 273.15, rtol=1e-12)  # round-off of sums
                number = film + offset if offset is not None else film * 1.8 + 32
                # Behind the first exchange the output is that of the step before, whose input was found an exchange earlier.
                np.testing.assert_allclose(torque[10], -number[0] * np.pi / 30, rtol=1e-9)  # the factors have as many digits
        # Without a unit: in SI.
        self.built("", variables=[(*one[:6], None) if one[0] == "speed" else one for one in VARIABLES])
        with h5py.File(self.results(self.write("warm.yaml", WARM))) as file:
            np.testing.assert_allclose(file["fmus/controller/speed"][0], file["bearings/main/T_max"][0] + 273.15, rtol=1e-12)  # as above

    def test_the_radian_is_left_out_or_added(self):
        shaft = self.write("rotor.yaml", ROTOR)
        self.built(RPM)
        with h5py.File(self.results(shaft)) as file:
            plain = file["fmus/controller/torque"][:]
        # The same factor without the radian, and a torque for each radian.
        per_radian = [(*one[:6], "N.m/rad") if one[0] == "torque" else one for one in VARIABLES]
        for unit, more in ((RPM.replace(' rad="1"', ""), {}), (RPM, {"variables": per_radian})):
            self.built(unit + ('</Unit><Unit name="N.m/rad"><BaseUnit kg="1" m="2" s="-2" rad="-1"/>' if more else ""), **more)
            with self.subTest(unit=unit, more=bool(more)), h5py.File(self.results(shaft)) as file:
                np.testing.assert_array_equal(file["fmus/controller/torque"][:], plain)
        self.built(RPM.replace(' rad="1"', ""))
        for given in ("100 rad/s", '{expression: "100", unit: rad/s}', "joints.shaft.rates"):
            self.assertIn("good", self.hersey("check", self.write("given.yaml", ROTOR.replace("speed: shaft.rotation_rate", f"speed: {given}"))))
        wrong = self.write("wrong.yaml", ROTOR.replace("speed: shaft.rotation_rate", "speed: 3 N"))
        self.assertIn("expected an angular velocity or a frequency", self.hersey("check", wrong, expect=2))
        # One that is called Hz counts turns: nothing says whether its numbers are to be divided by 2 pi.
        self.built(RPM.replace(' rad="1"', "") + '</Unit><Unit name="Hz"><BaseUnit s="-1"/>',
                   variables=[(*one[:6], "Hz") if one[0] == "speed" else one for one in VARIABLES])
        self.assertIn("expected a frequency", self.hersey("check", shaft, expect=2))


# A flywheel that its bearing brings to rest: the whole machine, and the bearing alone, whose pin turns as it is told.
COAST = fmu_test.RIG.replace("  motor: {joint: main, coordinate: rotation, speed: 3000 rpm}\n", "").replace(
    "pin: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}",
    "pin: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-5 kg.m^2}}").replace("step: 0.1 ms", "step: 0.02 ms")
BEARING = fmu_test.RIG.replace("step: 0.1 ms", "step: 0.02 ms")
FLYWHEEL = """hersey: 1
bodies:
  wheel: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-5 kg.m^2}}
joints:
  main: {type: revolute, between: [ground, wheel], initial: {rotation_rate: 3000 rpm}}
fmus:
  bearing: {file: bearing.fmu, step: 0.4 ms, inputs: {drives.motor.speed: main.rotation_rate}}
forces:
  friction: {type: torque, body: wheel, direction: z, magnitude: {fmu: bearing, output: drives.motor.force_or_torque, scale: -1}}
simulation: {duration: 4 ms, step: 0.02 ms}
"""


class OwnFmuTest(Folder):
    """hersey's own FMU comes back."""

    def test_a_machine_in_two_parts_is_the_whole_one_as_exchanges_come_closer(self):
        with h5py.File(self.results(self.write("coast.yaml", COAST), name="coast")) as file:
            whole = file["joints/main/rates"][:]
        self.assertLess(whole[-1], 0.9 * whole[0])
        bearing = self.write("bearing.yaml", BEARING)
        flywheel = self.write("flywheel.yaml", FLYWHEEL)
        for version in (2, 3):
            off = []
            self.hersey("export", bearing, "--fmu", os.path.join(self.folder, "bearing.fmu"), "--force", "--fmi", version)
            for step in (0.4, 0.2, 0.1):
                with h5py.File(self.results(flywheel, f"fmus.bearing.step={step} ms", name="flywheel")) as file:
                    off.append(np.abs(file["joints/main/rates"][:] - whole).max() / (whole[0] - whole[-1]))
            print(f"FMI {version}: distance from the whole machine over the loss of speed: {off}")
            np.testing.assert_allclose(np.log2(np.array(off[:-1]) / off[1:]), 1, atol=0.2)  # steps that are not yet small
            self.assertLess(off[-1], 0.02)

    def test_results_are_no_model(self):
        results = self.results(self.write("coast.yaml", COAST), "simulation.duration=0.1 ms", name="few")
        for words in (("check", results), ("export", results, "--fmu", os.path.join(self.folder, "x.fmu")),
                      ("export", results, "--ssp", os.path.join(self.folder, "x.ssp"))):
            printed = self.hersey(*words, expect=2)
            self.assertIn("results.h5: ", printed)
            self.assertIn("the results of a run", printed)
            self.assertIn("expected a model file", printed)

    def test_a_model_with_fmus_is_not_exported(self):
        build(os.path.join(self.folder, "controller.fmu"), 2)
        printed = self.hersey("export", self.write("rotor.yaml", ROTOR), "--fmu", os.path.join(self.folder, "x.fmu"), expect=2)
        self.assertIn("rotor.yaml:6", printed)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "x.fmu")))


if __name__ == "__main__":
    unittest.main()
