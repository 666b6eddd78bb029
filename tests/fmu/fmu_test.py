#!/usr/bin/python3
"""FMUs, driven by an importer of the tests' own: every function of the C interface of both versions of the standard.

fmu_test.py HERSEY WORK [Class.test]"""

import ctypes as c
import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import unittest
import zipfile
from xml.etree import ElementTree

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import importer  # noqa: E402
from importer import DISCARD, ERROR, OK, Fmu, column_of  # noqa: E402

HERSEY = os.path.abspath(sys.argv.pop(1))
WORK = os.path.abspath(sys.argv.pop(1))

# A journal turning in a bush that floats and is pushed.
RIG = """hersey: 1
title: Small rig
parameters:
  load: 500 N
bodies:
  pin: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
  rod: {mass: 0.5 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  main: {type: revolute, between: [ground, pin], initial: {rotation_rate: 3000 rpm}}
  guide: {type: planar, between: [ground, rod], initial: {x: 0 um}}
drives:
  motor: {joint: main, coordinate: rotation, speed: 3000 rpm}
  hold: {joint: guide, coordinate: rotation, position: 0 deg}
forces:
  push: {type: force, body: rod, components: [0 N, "-${load}", {expression: "sin(t)", unit: N}]}
lubricants:
  oil: {viscosity: 15 mPa.s}
bearings:
  big_end:
    shell: rod
    journal: pin
    diameter: 45 mm
    width: 15.6 mm
    radial_clearance: 34 um
    lubricant: oil
    grid: {circumferential: 24, axial: 5}
    supply: {line: widest_gap, pressure: 1 bar}
simulation: {duration: 4 ms, step: 0.1 ms, spectral_radius: 0.6}
"""
STEP = 1e-4  # of the rig [s]
# x'' - (1 - x^2) x' + x = 0, whose period of 6.6633 s is not known beforehand.
VAN_DER_POL = """hersey: 1
parameters: {guess: 6.5 s}
bodies:
  weight: {mass: 1 kg, inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}}
joints:
  slide: {type: prismatic, between: [ground, weight], axis: x, initial: {translation: 1.5 m}}
forces:
  spring: {type: sliding_spring, joint: slide, stiffness: 1 N/m, damping: 0 N.s/m}
  rest: {type: force, body: weight, direction: x, magnitude: {expression: "(1 - slide.translation^2)*slide.translation_rate", unit: N}}
simulation:
  cycle: {period: {about: "${guess}"}, lead_in: shooting, until_converged: 1e-5}
  step: "${guess}/100"
  spectral_radius: 0.95
"""
LOAD_Y = "forces.push.components.y"
H_MIN = "bearings.big_end.h_min"
CLEARANCE = "bearings.big_end.radial_clearance"


def run(*words, expect=0):
    done = subprocess.run([HERSEY, *map(str, words)], capture_output=True, text=True)
    if done.returncode != expect:
        raise AssertionError(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


class Instance(importer.Instance):
    """An instance of the rig."""

    def march(self, count, length=STEP, first=0, output=H_MIN):
        rows = []
        for k in range(first, first + count):
            if self.step(k * length, length) != OK:
                raise AssertionError(self.log)
            rows.append(self.get(output))
        return rows


class Cases:
    """What holds for both versions."""

    version = 0

    @classmethod
    def setUpClass(cls):
        os.makedirs(WORK, exist_ok=True)
        cls.folder = tempfile.mkdtemp(prefix=f"fmi {cls.version} ", dir=WORK)  # with a space, as users have them
        cls.model = os.path.join(cls.folder, "rig.yaml")
        with open(cls.model, "w", encoding="utf-8") as file:
            file.write(RIG)
        cls.path = os.path.join(cls.folder, "rig.fmu")
        cls.printed = run("export", cls.model, "--fmu", cls.path, "--fmi", cls.version)
        cls.fmu = Fmu(cls.path, os.path.join(cls.folder, "unpacked"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def by_run(self, *changes):
        out = tempfile.mkdtemp(dir=self.folder)
        sets = [word for change in changes for word in ("--set", change)]
        run("run", self.model, "--output", out, "--force", *sets)
        with h5py.File(os.path.join(out, "results.h5")) as file:
            return list(file["bearings/big_end/h_min"][:])

    def test_solver_step_gives_the_bits_of_a_run(self):
        one = Instance(self.fmu).initialise()
        rows = [one.get(H_MIN)] + one.march(40)
        self.assertEqual(rows, self.by_run())
        one.must("Terminate")
        self.assertEqual(one.get(H_MIN), rows[-1])
        one.free()

    def test_every_output_is_that_of_the_results_file(self):
        out = tempfile.mkdtemp(dir=self.folder)
        run("run", self.model, "--output", out, "--force")
        outputs = self.fmu.names("output")
        self.assertGreater(len(outputs), 150)
        with h5py.File(os.path.join(out, "results.h5")) as file:
            columns = {name: column_of(file, name) for name in outputs}
        for steps in (1, 4):  # of the solver in one communication step
            one = Instance(self.fmu).initialise()
            for row in range(0, 41, steps):
                if row > 0:
                    self.assertEqual(one.step((row - steps) * STEP, steps * STEP), OK, one.log)
                status, values = one.access("Get", outputs, [0] * len(outputs))
                self.assertEqual(status, OK, one.log)
                # As precise as the file has them: fields in single precision.
                expected = {name: columns[name].dtype.type(value) for name, value in zip(outputs, values)}
                apart = {name: (value, columns[name][row]) for name, value in expected.items()
                         if not np.array_equal(value, columns[name][row], equal_nan=True)}
                self.assertEqual(apart, {}, f"FMU, results file at row {row} by {steps}")
            one.free()

    def test_parameters_change_the_machine(self):
        one = Instance(self.fmu).initialise(parameters={CLEARANCE: 40e-6, "parameters.load": 700})
        self.assertEqual(one.get(CLEARANCE), 40e-6)
        rows = [one.get(H_MIN)] + one.march(40)
        np.testing.assert_allclose(rows, self.by_run("bearings.big_end.radial_clearance=40um", "load=700N"),
                                   rtol=1e-9)  # 40e-6 m and 40 um differ in their last bit
        self.assertEqual(one.set(CLEARANCE, 50e-6), ERROR)
        self.assertIn("initialisation", one.log[-1][1])
        one.free()

    def test_any_communication_step(self):
        one = Instance(self.fmu).initialise()
        t = 0.0
        for length in (0.3 * STEP, 1.7 * STEP, 0.01 * STEP, 12.34 * STEP):
            self.assertEqual(one.step(t, length), OK, one.log)
            t += length
            self.assertEqual(one.get("time"), t)
        # The journal settles: by the error of steps of other lengths, not of the instant.
        reference = self.by_run("simulation.step=0.01ms")
        self.assertAlmostEqual(one.get(H_MIN) / np.interp(t / 1e-5, range(len(reference)), reference), 1, delta=0.02)
        one.free()

    def test_inputs_act(self):
        one, two = Instance(self.fmu, "one").initialise(), Instance(self.fmu, "two").initialise()
        self.assertEqual(one.get(LOAD_Y), -500)
        self.assertEqual(one.set(LOAD_Y, -500), OK)  # what it is already: not a bit changes
        self.assertEqual(two.set(LOAD_Y, -1500), OK)
        self.assertEqual(two.get(LOAD_Y), -1500)
        first, second = one.march(10), two.march(10)
        self.assertEqual(first, self.by_run()[1:11])
        self.assertLess(second[-1], first[-1])
        self.assertEqual(one.set(H_MIN, 1e-6), ERROR)
        self.assertEqual(one.set(LOAD_Y, float("nan")), ERROR)
        for instance in (one, two):
            instance.free()

    def test_two_instances_share_nothing(self):
        whole = self.by_run()[1:]
        one, two = Instance(self.fmu, "one").initialise(), Instance(self.fmu, "two").initialise()
        rows = ([], [])
        for k in range(12):
            rows[0].extend(one.march(1, first=k))
            if k % 2:
                rows[1].extend(two.march(2, first=k - 1))
        self.assertEqual(rows[0], whole[:12])
        self.assertEqual(rows[1], whole[:12])
        one.free()
        self.assertEqual(two.march(2, first=12), whole[12:14])
        two.free()

    def test_states_are_kept_and_serialised(self):
        one = Instance(self.fmu).initialise()
        one.march(5)
        one.set(LOAD_Y, -700)
        state = one.state()
        after = one.march(5, first=5)
        capital = "FMUstate" if self.version == 2 else "FMUState"
        one.must("Set" + capital, state)
        self.assertEqual(one.get("time"), 5 * STEP)
        self.assertEqual(one.get(LOAD_Y), -700)
        self.assertEqual(one.march(5, first=5), after)
        size = c.c_size_t()
        one.must(f"Serialized{capital}Size", state, c.byref(size))
        room = (c.c_char * size.value)()
        one.must("Serialize" + capital, state, room, size)
        self.assertEqual(one.call("Serialize" + capital, state, room, c.c_size_t(size.value - 1)), ERROR)
        other, again = Instance(self.fmu, "other").initialise(), c.c_void_p()
        verb = "DeSerialize" if self.version == 2 else "Deserialize"
        other.must(verb + capital, room, size, c.byref(again))
        other.must("Set" + capital, again)
        self.assertEqual(other.march(5, first=5), after)
        for wrong in (size.value - 1, 8, 0):
            self.assertEqual(other.call(verb + capital, room, c.c_size_t(wrong), c.byref(again)), ERROR)
        for instance, kept in ((one, state), (other, again)):
            instance.must("Free" + capital, c.byref(kept))
            self.assertIsNone(kept.value)
            instance.free()

    def test_reset_begins_anew(self):
        one = Instance(self.fmu).initialise(parameters={CLEARANCE: 40e-6})
        one.march(3)
        one.must("Reset")
        self.assertEqual(one.get(CLEARANCE), self.fmu.start_of(CLEARANCE))
        one.initialise()
        self.assertEqual(one.march(5), self.by_run()[1:6])
        one.free()

    def test_failing_step_is_reported_with_its_reason(self):
        one = Instance(self.fmu).initialise()
        one.march(2)
        one.set(LOAD_Y, -1e12)
        self.assertEqual(one.step(2 * STEP, STEP), ERROR)
        self.assertRegex(one.log[-1][1], "t = 0.0002 s")
        self.assertEqual(one.step(2 * STEP, STEP), ERROR)
        one.must("Reset")
        one.initialise()
        one.march(1)
        one.free()

    def test_calls_in_a_wrong_order_are_refused(self):
        one = Instance(self.fmu)
        self.assertEqual(one.step(0, STEP), ERROR)
        self.assertEqual(one.call("ExitInitializationMode"), ERROR)
        self.assertEqual(one.call("Terminate"), ERROR)
        self.assertEqual(one.access("Get", [H_MIN], [0])[0], ERROR)
        self.assertEqual(one.access("Get", [4000000], [0])[0], ERROR)
        one.initialise()
        self.assertEqual(one.step(STEP, STEP), ERROR)
        self.assertIn("the last one ended", one.log[-1][1])
        self.assertEqual(one.step(0, -STEP), ERROR)
        self.assertEqual(one.step(0, float("nan")), ERROR)
        self.assertEqual(one.march(1), self.by_run()[1:2])
        one.free()

    def test_another_token_is_refused(self):
        one = Instance(self.fmu, token="{of another}")
        self.assertIsNone(one.handle)
        self.assertIn("token", one.log[-1][1])
        nowhere = Instance(self.fmu, resources="/nowhere")
        self.assertIsNone(nowhere.handle)

    def test_bad_parameter_is_reported(self):
        one = Instance(self.fmu)
        self.assertEqual(one.set(CLEARANCE, -1e-6), OK)
        with self.assertRaisesRegex(AssertionError, "radial_clearance"):
            one.initialise()
        one.free()

    def test_library_brings_what_it_needs(self):
        listing = subprocess.run(["ldd", self.fmu.library_path], capture_output=True, text=True, check=True).stdout
        here = os.path.dirname(self.fmu.library_path)
        for line in listing.splitlines():
            name, _, path = line.strip().partition(" => ")
            if path and not re.match(r"(libc|libm|libdl|libpthread|libresolv|librt)\.so", name):
                self.assertTrue(path.startswith(here), line)

    def test_library_shows_the_standards_functions_only(self):
        names = subprocess.run(["nm", "-D", "--defined-only", self.fmu.library_path], capture_output=True, text=True,
                               check=True).stdout.split()[2::3]
        self.assertTrue(names)
        # Beside them the lock that all copies of the library in one process share.
        self.assertEqual([name for name in names if not re.match("fmi[23][A-Z]", name)], ["hersey_udunits2_lock"])

    def in_a_process(self, script, **environment):
        """What a script of its own process says; it has this file's names, and `path`, the FMU."""
        begin = (f"import sys\nsys.argv[1:] = [{HERSEY!r}, {WORK!r}]\nsys.path.insert(0, {os.path.dirname(os.path.abspath(__file__))!r})\n"
                 f"from fmu_test import *\npath, work = {self.path!r}, {self.folder!r}\n")
        kept = {name: value for name, value in os.environ.items() if name != "UDUNITS2_XML_PATH"}
        done = subprocess.run([sys.executable, "-c", begin + textwrap.dedent(script)], capture_output=True, text=True,
                              env=kept | environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_importer_takes_its_folder_away_between_simulations(self):
        """As FMPy's simulate_fmu(path) does: each time unpacked anew, and here gone before the initialisation even."""
        printed = self.in_a_process("""
            rows = []
            for parameters in ({}, {}, {CLEARANCE: 40e-6}):
                folder = tempfile.mkdtemp(dir=work)
                fmu = Fmu(path, folder)
                one = Instance(fmu)
                shutil.rmtree(folder)
                rows.append(one.initialise(parameters=parameters).march(5))
                one.must("Reset")
                assert one.initialise(parameters=parameters).march(5) == rows[-1]
                one.free()
            assert rows[0] == rows[1] != rows[2]
            environment = c.CDLL(None).getenv
            environment.restype = c.c_char_p
            print("variable:", environment(b"UDUNITS2_XML_PATH"))
        """)
        self.assertEqual(printed, "variable: None\n")  # as it was: nothing is left in the environment

    def test_environment_that_points_nowhere_does_no_harm(self):
        printed = self.in_a_process("""
            print(len(Instance(Fmu(path, tempfile.mkdtemp(dir=work))).initialise().march(2)))
        """, UDUNITS2_XML_PATH="/nowhere/udunits2.xml")
        self.assertEqual(printed, "2\n")

    def test_two_copies_of_the_library_are_initialised_by_two_threads(self):
        """Two FMUs share udunits2, which is not made for threads: reading a model parses units without end."""
        printed = self.in_a_process("""
            import threading
            instances = [Instance(Fmu(path, tempfile.mkdtemp(dir=work)), logger=False) for _ in range(2)]
            found = [[], []]
            def use(k):
                for turn in range(12):
                    found[k].append(instances[k].initialise(parameters={CLEARANCE: 40e-6}).march(1)[0])
                    instances[k].must("Reset")
            threads = [threading.Thread(target=use, args=(k,)) for k in range(2)]
            for thread in threads: thread.start()
            for thread in threads: thread.join()
            assert len(found[0]) == len(found[1]) == 12
            print(len(set(found[0] + found[1])))
        """)
        self.assertEqual(printed, "1\n")

    def test_numbers_that_are_none_are_the_importers_fault(self):
        one = Instance(self.fmu)
        for value in (float("nan"), float("inf"), -float("inf")):
            for name in (CLEARANCE, LOAD_Y):
                self.assertEqual(one.set(name, value), ERROR)
                self.assertRegex(one.log[-1][1], rf"^{name}: found {'nan' if value != value else value}; expected a finite number in")
        self.assertEqual(one.access("Set", [H_MIN], [1e-6])[0], ERROR)
        self.assertEqual(one.access("Get", [4000000], [0])[0], ERROR)
        self.assertEqual(one.access("Set", [4000000], [0])[0], ERROR)
        one.initialise().march(1)
        self.assertEqual(one.set(CLEARANCE, 40e-6), ERROR)
        self.assertEqual([text for _, text in one.log if "internal error" in text], [])
        one.free()

    def test_outputs_depend_on_no_input_before_the_next_step(self):
        """What the model structure declares: setting inputs changes no output at the same instant."""
        one = Instance(self.fmu).initialise()
        one.march(3)
        outputs = self.fmu.names("output")
        inputs = self.fmu.names("input")
        before = one.access("Get", outputs, [0] * len(outputs))[1]
        for name in inputs:
            self.assertEqual(one.set(name, 1.1 * one.get(name) + 0.01), OK, one.log)
        np.testing.assert_array_equal(one.access("Get", outputs, [0] * len(outputs))[1], before)
        one.march(1, first=3)
        self.assertNotEqual(one.access("Get", outputs, [0] * len(outputs))[1], before)
        one.free()
        structure = self.fmu.description.find("ModelStructure")
        declared = list(structure.find("Outputs")) if self.version == 2 else structure.findall("Output")
        self.assertEqual([unknown.get("dependencies") for unknown in declared], [""] * (len(outputs) + len(self.fmu.names("output", arrays=True))))

    def test_description_is_consistent(self):
        root, seen = self.fmu.description, set()
        units = {unit.get("name") for unit in root.find("UnitDefinitions")}
        for variable in root.find("ModelVariables"):
            self.assertNotIn(variable.get("name"), seen)
            seen.add(variable.get("name"))
            unit = (variable[0] if self.version == 2 else variable).get("unit")
            self.assertTrue(unit is None or unit in units, unit)
        for name, unit in ((LOAD_Y, "N"), (H_MIN, "m"), ("drives.motor.speed", "rad/s")):
            variable = self.fmu.variables[name]
            self.assertEqual((variable[0] if self.version == 2 else variable).get("unit"), unit)
        newton = next(u for u in root.find("UnitDefinitions") if u.get("name") == "N").find("BaseUnit")
        self.assertEqual(newton.attrib, {"kg": "1", "m": "1", "s": "-2"})
        experiment = root.find("DefaultExperiment")
        self.assertEqual(float(experiment.get("stopTime")), 4e-3)
        self.assertEqual(float(experiment.get("stepSize")), STEP)
        self.assertIn("inputs", self.printed)

    def test_step_of_a_machine_whose_period_is_found(self):
        """The step is a part of the period that the machine has, whatever was guessed."""
        with tempfile.TemporaryDirectory(dir=WORK) as folder:
            model, target = os.path.join(folder, "oscillator.yaml"), os.path.join(folder, "oscillator.fmu")
            with open(model, "w", encoding="utf-8") as file:
                file.write(VAN_DER_POL)
            for guess in ("6.5 s", "6.2 s"):
                run("export", model, "--fmu", target, "--fmi", self.version, "--force", "--set", f"guess={guess}")
                with zipfile.ZipFile(target) as fmu:
                    experiment = ElementTree.fromstring(fmu.read("modelDescription.xml")).find("DefaultExperiment")
                # Steps of a hundredth of the period lengthen it by some (2 pi/100)^2.
                self.assertAlmostEqual(float(experiment.get("stepSize")) / 0.066633, 1, delta=4e-3)
                periods = float(experiment.get("stopTime")) / (100 * float(experiment.get("stepSize")))
                self.assertAlmostEqual(periods, round(periods), delta=1e-9)  # round-off

    def test_description_keeps_to_the_standards_schema(self):
        """Elements in their order, attributes that there are, and the lists that a checker compares."""
        root, version = self.fmu.description, self.version
        self.assertEqual([child.tag for child in root], ["CoSimulation", "UnitDefinitions", "LogCategories",
                                                         "DefaultExperiment", "ModelVariables", "ModelStructure"])
        self.assertLessEqual(set(root.attrib), {"fmiVersion", "guid" if version == 2 else "instantiationToken", "modelName",
                                                "description", "generationTool", "variableNamingConvention"})
        capabilities = {"modelIdentifier", "needsExecutionTool", "canHandleVariableCommunicationStepSize",
                        "canBeInstantiatedOnlyOncePerProcess"}
        capabilities |= ({"canInterpolateInputs", "maxOutputDerivativeOrder", "canRunAsynchronuously", "canGetAndSetFMUstate",
                          "canNotUseMemoryManagementFunctions", "canSerializeFMUstate", "providesDirectionalDerivative"}
                         if version == 2 else {"canGetAndSetFMUState", "canSerializeFMUState", "hasEventMode",
                                               "providesDirectionalDerivatives", "providesAdjointDerivatives",
                                               "providesIntermediateUpdate", "mightReturnEarlyFromDoStep",
                                               "canReturnEarlyAfterIntermediateUpdate"})
        self.assertEqual(set(root.find("CoSimulation").attrib), capabilities)
        for unit in root.find("UnitDefinitions"):
            self.assertEqual([child.tag for child in unit], ["BaseUnit"], unit.get("name"))
        # A part is an identifier, with a place in a list, or any word between quotes.
        part = r"([A-Za-z_][A-Za-z0-9_]*|'([A-Za-z0-9_!#$%&()*+,\-./:;<>=?@\[\]^{}|~ ]|\\['\"?\\abfnrtv])+')(\[\d+(,\d+)*\])?"
        roles, outputs = set(), []
        for place, variable in enumerate(root.find("ModelVariables")):
            self.assertRegex(variable.get("name"), rf"^{part}(\.{part})*$")
            self.assertEqual(variable.get("valueReference"), str(place))
            role = variable.get("causality"), variable.get("variability"), variable.get("initial")
            start = (variable[0] if version == 2 else variable).get("start")
            self.assertEqual(start is not None, role[0] in ("parameter", "input"), variable.get("name"))
            if start is not None:
                float(start)
            roles.add(role)
            if role[0] == "output":
                outputs.append(str(place + 1) if version == 2 else variable.get("valueReference"))
        self.assertEqual(roles, {("independent", "continuous", None), ("parameter", "fixed", "exact"),
                                 ("input", "continuous", None), ("output", "continuous", "calculated")})
        structure, key = root.find("ModelStructure"), "index" if version == 2 else "valueReference"
        if version == 2:
            self.assertEqual([child.tag for child in structure], ["Outputs", "InitialUnknowns"])
            lists = [list(structure.find("Outputs")), list(structure.find("InitialUnknowns"))]
        else:
            lists = [structure.findall("Output"), structure.findall("InitialUnknown")]
            self.assertEqual([child.tag for child in structure], [child.tag for each in lists for child in each])
        for each in lists:
            self.assertEqual([unknown.get(key) for unknown in each], outputs)

    def test_archive_has_documentation_and_licences(self):
        with zipfile.ZipFile(self.path) as archive:
            names = archive.namelist()
            self.assertEqual([n for n in names if n.startswith("/") or ".." in n or n.endswith("/") or "\\" in n], [])
            self.assertIn(H_MIN, archive.read("documentation/index.html").decode())
            self.assertIn("BSD 3-Clause", archive.read("documentation/licenses/license.txt").decode())
            if os.path.exists("/usr/share/doc/libopenblas0-pthread/copyright"):
                self.assertIn("documentation/licenses/libopenblas0-pthread.txt", names)

    def test_importer_without_a_logger_is_served(self):
        one = Instance(self.fmu, logger=False).initialise()
        one.march(1)
        self.assertEqual(one.step(0, STEP), ERROR)  # nobody learns why
        one.free()

    def test_existing_file_is_kept(self):
        self.assertIn("--force", run("export", self.model, "--fmu", self.path, expect=2))
        broken = os.path.join(self.folder, "broken.yaml")
        with open(broken, "w", encoding="utf-8") as file:
            file.write(RIG.replace("34 um", "34 kg"))
        self.assertIn("radial_clearance", run("export", broken, "--fmu", self.path + "2", expect=2))
        self.assertFalse(os.path.exists(self.path + "2"))
        printed = run("export", self.model, "--fmu", self.model, "--force", expect=2)
        self.assertIn("which the model reads", printed)
        with open(self.model, encoding="utf-8") as file:
            self.assertEqual(file.read(), RIG)

    def test_every_function_answers(self):
        one = Instance(self.fmu).initialise()
        nothing = c.c_size_t(0)
        for name in self.others:
            self.assertIn(one.call(name, *[None] * 9), (OK, DISCARD, ERROR), name)
        for kind in self.kinds:
            extra = [] if self.version == 2 or kind == "Clock" else [nothing]
            if kind == "Binary":
                extra = [None, nothing]
            self.assertEqual(one.call("Get" + kind, None, nothing, None, *extra), OK, kind)
            self.assertEqual(one.call("Get" + kind, None, c.c_size_t(1), None, *extra), ERROR, kind)
            self.assertEqual(one.call("Set" + kind, None, c.c_size_t(1), None, *extra), ERROR, kind)
        one.march(1)
        one.free()


class Fmi2Test(Cases, unittest.TestCase):
    version = 2
    kinds = ["Integer", "Boolean", "String"]
    others = ["GetDirectionalDerivative", "SetRealInputDerivatives", "GetRealOutputDerivatives", "CancelStep",
              "GetIntegerStatus", "GetStringStatus", "GetStatus"]

    def test_platform_and_version(self):
        for name, value in (("fmi2GetTypesPlatform", b"default"), ("fmi2GetVersion", b"2.0")):
            function = getattr(self.fmu.library, name)
            function.restype = c.c_char_p
            self.assertEqual(function(), value)

    def test_end_of_the_model_is_a_discarded_step(self):
        one = Instance(self.fmu).initialise()
        one.march(40)
        self.assertEqual(one.step(40 * STEP, STEP), DISCARD)
        reached, ended = c.c_double(), c.c_int()
        one.must("GetRealStatus", 2, c.byref(reached))
        one.must("GetBooleanStatus", 3, c.byref(ended))
        self.assertAlmostEqual(reached.value, 4e-3, delta=1e-12)
        self.assertEqual(ended.value, 1)
        one.free()

    def test_longer_experiment_is_run(self):
        one = Instance(self.fmu).initialise(stop=6e-3)
        one.march(60)
        one.free()


class Fmi3Test(Cases, unittest.TestCase):
    version = 3
    kinds = ["Float32", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Boolean", "String",
             "Binary", "Clock"]
    others = ["GetNumberOfVariableDependencies", "GetVariableDependencies", "GetDirectionalDerivative",
              "GetAdjointDerivative", "GetOutputDerivatives", "GetIntervalDecimal", "GetIntervalFraction",
              "GetShiftDecimal", "GetShiftFraction", "SetIntervalDecimal", "SetIntervalFraction", "SetShiftDecimal",
              "SetShiftFraction", "EvaluateDiscreteStates", "UpdateDiscreteStates", "EnterContinuousTimeMode",
              "CompletedIntegratorStep", "SetTime", "SetContinuousStates", "GetContinuousStateDerivatives",
              "GetEventIndicators", "GetContinuousStates", "GetNominalsOfContinuousStates",
              "GetNumberOfEventIndicators", "GetNumberOfContinuousStates", "ActivateModelPartition",
              "EnterStepMode", "EnterEventMode", "EnterConfigurationMode", "ExitConfigurationMode"]

    def test_version(self):
        self.fmu.library.fmi3GetVersion.restype = c.c_char_p
        self.assertEqual(self.fmu.library.fmi3GetVersion(), b"3.0")

    def test_step_tells_what_it_came_to(self):
        one = Instance(self.fmu).initialise()
        self.assertEqual(one.step(0, STEP), OK)
        self.assertEqual((one.events.value, one.ends.value, one.early.value, one.reached.value),
                         (False, False, False, STEP))
        self.assertEqual(one.access("Get", [H_MIN, H_MIN], [0, 0])[0], OK)
        one.free()

    def test_end_of_the_model_asks_for_termination(self):
        one = Instance(self.fmu).initialise()
        one.march(40)
        self.assertEqual(one.step(40 * STEP, STEP), OK)
        self.assertTrue(one.ends.value)
        self.assertAlmostEqual(one.reached.value, 4e-3, delta=1e-12)
        one.must("Terminate")
        one.free()

    def test_resources_may_be_named_by_a_uri(self):
        one = Instance(self.fmu, resources="file://" + os.path.join(self.fmu.folder, "resources")).initialise()
        one.march(1)
        one.free()

    def test_other_interfaces_are_refused(self):
        for name in ("fmi3InstantiateModelExchange", "fmi3InstantiateScheduledExecution"):
            function = getattr(self.fmu.library, name)
            function.restype = c.c_void_p
            self.assertIsNone(function(*[None] * 10))


if __name__ == "__main__":
    unittest.main()
