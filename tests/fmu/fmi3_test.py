#!/usr/bin/python3
"""What only FMI 3 has: arrays, intermediate updates with early return, terminals and icons.

fmi3_test.py HERSEY WORK [Class.test]"""

import os
import shutil
import struct
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile
import zlib

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import fmu_test  # noqa: E402  takes HERSEY and WORK off the arguments
from fmu_test import H_MIN, LOAD_Y, STEP, Instance  # noqa: E402
from importer import ERROR, OK, Fmu  # noqa: E402

AROUND = "bearings.big_end.h_min_around"


class Fmi3OnlyTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.makedirs(fmu_test.WORK, exist_ok=True)
        cls.folder = tempfile.mkdtemp(prefix="fmi 3 only ", dir=fmu_test.WORK)
        model = os.path.join(cls.folder, "rig.yaml")
        with open(model, "w", encoding="utf-8") as file:
            file.write(fmu_test.RIG.replace("supply: {line: widest_gap, pressure: 1 bar}",
                                            "features: {groove: {shape: axial_groove, angle: 90 deg, arc: 40 deg, "
                                            "length: 9 mm, pressure: 1 bar}}"))
        fmu_test.run("export", model, "--fmu", os.path.join(cls.folder, "rig.fmu"), "--fmi", 3)
        cls.fmu = Fmu(os.path.join(cls.folder, "rig.fmu"), os.path.join(cls.folder, "unpacked"))
        cls.terminals = ElementTree.parse(os.path.join(cls.fmu.folder, "terminalsAndIcons", "terminalsAndIcons.xml")).getroot()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    # Arrays

    def test_arrays_are_their_numbered_columns(self):
        arrays = self.fmu.names("output", arrays=True)
        self.assertIn(AROUND, arrays)
        numbered = {name.partition("[")[0] for name in self.fmu.names("output") if name.endswith("]")}
        self.assertEqual(set(arrays), numbered)
        one = Instance(self.fmu).initialise()
        one.march(3)
        for name in arrays:
            size = self.fmu.sizes[name]
            self.assertNotIn(f"{name}[{size + 1}]", self.fmu.references)
            self.assertEqual(one.array(name), [one.get(f"{name}[{k + 1}]") for k in range(size)])
        status, values = one.access("Get", [H_MIN, AROUND, LOAD_Y], [0] * (self.fmu.sizes[AROUND] + 2))
        self.assertEqual(status, OK)  # numbers and arrays in one call
        self.assertEqual(values, [one.get(H_MIN), *one.array(AROUND), one.get(LOAD_Y)])
        for room in (1, self.fmu.sizes[AROUND] - 1, self.fmu.sizes[AROUND] + 1):
            self.assertEqual(one.access("Get", [AROUND], [0] * room)[0], ERROR)
            self.assertIn("room for", one.log[-1][1])
        one.free()

    # Intermediate updates

    def test_intermediate_values_are_those_of_the_solvers_steps(self):
        fine = Instance(self.fmu).initialise()
        expected = fine.march(8)
        rows, times = [], []

        def update(time):
            rows.append(coarse.get(H_MIN))
            times.append(time)
            self.assertEqual(coarse.get("time"), time)

        coarse = Instance(self.fmu, update=update, intermediate=[H_MIN]).initialise()
        for k in range(2):
            self.assertEqual(coarse.step(4 * k * STEP, 4 * STEP), OK, coarse.log)
            self.assertFalse(coarse.early.value)
        self.assertEqual(rows, expected)
        for k, time in enumerate(times):
            self.assertAlmostEqual(time, (k + 1) * STEP, delta=1e-12)  # round-off of a sum of steps
        # No inputs are asked for, outputs can be read, a step of the solver is complete, and early return was not allowed.
        self.assertEqual(set(coarse.flags), {(False, True, True, False)})
        fine.free()
        coarse.free()

    def test_nothing_but_reading_is_allowed_in_an_update(self):
        found = []

        def update(_):
            found.append([one.set(LOAD_Y, -1.0), one.step(0, STEP), one.call("Reset"), one.call("Terminate"),
                          one.derivatives("Directional", [H_MIN], [LOAD_Y], [1.0], 1)[0]])

        one = Instance(self.fmu, update=update).initialise()
        self.assertEqual(one.step(0, 2 * STEP), OK, one.log)
        self.assertEqual(found, [[ERROR] * 5] * 2)
        self.assertIn("intermediate update", one.log[-1][1])
        self.assertEqual(one.get(LOAD_Y), -500)
        one.free()

    def test_a_step_returns_early_where_it_is_asked_to(self):
        whole = Instance(self.fmu).initialise()
        expected = whole.march(3)
        for asked in (STEP, 3 * STEP, 2.4 * STEP):
            one = Instance(self.fmu, update=lambda time, at=asked: at if time > 0.5 * STEP else None, early=True).initialise()
            self.assertEqual(one.step(0, 8 * STEP), OK, one.log)
            self.assertTrue(one.early.value)
            self.assertFalse(one.ends.value)
            self.assertAlmostEqual(one.reached.value, asked, delta=1e-6 * STEP)  # the instant within which two are one
            self.assertEqual(one.get("time"), one.reached.value)
            if asked != 2.4 * STEP:
                self.assertEqual(one.get(H_MIN), expected[round(asked / STEP) - 1])
            self.assertEqual(one.step(one.reached.value, STEP), OK, one.log)  # from there on
            self.assertTrue(one.derivatives("Directional", [H_MIN], [LOAD_Y], [1.0], 1)[1][0] != 0)
            one.free()
        whole.free()

    def test_an_instant_that_has_gone_by_ends_the_step_at_once(self):
        one = Instance(self.fmu, update=lambda time: 0.0 if time > 1.5 * STEP else None, early=True).initialise()
        self.assertEqual(one.step(0, 8 * STEP), OK, one.log)
        self.assertAlmostEqual(one.reached.value, 2 * STEP, delta=1e-12)  # round-off of a sum of steps
        self.assertTrue(one.early.value)
        one.free()

    def test_early_return_that_was_not_allowed_is_not_taken(self):
        one = Instance(self.fmu, update=lambda time: time, early=False).initialise()
        self.assertEqual(one.step(0, 4 * STEP), OK, one.log)
        self.assertEqual((one.early.value, one.reached.value), (False, 4 * STEP))
        one.free()

    def test_the_models_end_is_an_early_return(self):
        one = Instance(self.fmu).initialise()
        self.assertEqual(one.step(0, 41 * STEP), OK, one.log)
        self.assertEqual((one.early.value, one.ends.value), (True, True))
        one.free()

    def test_intermediate_variables_are_outputs(self):
        self.assertIsNone(Instance(self.fmu, update=lambda _: None, intermediate=[LOAD_Y]).handle)
        for name, variable in self.fmu.variables.items():
            self.assertEqual(variable.get("intermediateUpdate"), "true" if variable.get("causality") == "output" else None, name)

    # Terminals and icons

    def test_terminals_keep_to_the_standards_schema(self):
        root = self.terminals
        self.assertEqual((root.tag, root.get("fmiVersion")), ("fmiTerminalsAndIcons", "3.0"))
        self.assertEqual([child.tag for child in root], ["GraphicalRepresentation", "Terminals"])
        self.assertEqual([child.tag for child in root[0]], ["CoordinateSystem", "Icon"])
        self.assertEqual(set(root[0][0].attrib), {"x1", "y1", "x2", "y2", "suggestedScalingFactorTo_mm"})
        self.assertEqual(set(root[0][1].attrib), {"x1", "y1", "x2", "y2"})
        names = [terminal.get("name") for terminal in root[1]]
        self.assertEqual(len(set(names)), len(names))
        for terminal in root[1]:
            self.assertEqual(set(terminal.attrib), {"name", "matchingRule", "terminalKind", "description"})
            self.assertIn(terminal.get("matchingRule"), ("plug", "bus", "sequence"))
            members = [member.get("memberName") for member in terminal]
            self.assertEqual(len(set(members)), len(members))
            for member in terminal:
                self.assertEqual((member.tag, set(member.attrib)),
                                 ("TerminalMemberVariable", {"variableKind", "memberName", "variableName"}))
                variable = self.fmu.variables[member.get("variableName")]
                kind = {"input": "inflow", "output": "signal"}[variable.get("causality")]
                self.assertEqual(member.get("variableKind"), kind)

    def test_every_input_is_in_one_terminal_with_what_answers_it(self):
        members = {terminal.get("name"): {m.get("memberName"): m.get("variableName") for m in terminal}
                   for terminal in self.terminals.find("Terminals")}
        held = [name for terminal in members.values() for name in terminal.values()
                if self.fmu.variables[name].get("causality") == "input"]
        self.assertEqual(sorted(held), sorted(self.fmu.names("input")))
        push = members["forces.push"]
        self.assertEqual(push["f.y"], LOAD_Y)
        self.assertEqual(push["r.y"], "bodies.rod.position.y")
        self.assertEqual(push["v.x"], "bodies.rod.velocity.x")
        self.assertEqual(push["w.z"], "bodies.rod.angular_velocity.z")
        self.assertEqual(members["drives.motor"], {"w": "drives.motor.speed", "phi": "joints.main.coordinates",
                                                   "tau": "drives.motor.force_or_torque"})
        self.assertEqual(members["bearings.big_end.features.groove"]["q"], "bearings.big_end.flow_supply")

    def test_icon_is_a_png_file(self):
        with zipfile.ZipFile(os.path.join(self.folder, "rig.fmu")) as archive:
            png = archive.read("terminalsAndIcons/icon.png")
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        kinds, at = [], 8
        while at < len(png):
            (length,) = struct.unpack(">I", png[at:at + 4])
            body = png[at + 4:at + 8 + length]
            self.assertEqual(struct.unpack(">I", png[at + 8 + length:at + 12 + length])[0], zlib.crc32(body))
            kinds.append(body[:4])
            if body[:4] == b"IHDR":
                width, height, depth = struct.unpack(">IIB", body[4:13])
            if body[:4] == b"IDAT":
                self.assertEqual(len(zlib.decompress(body[4:])), height * (1 + width * depth // 8))
            at += 12 + length
        self.assertEqual(kinds, [b"IHDR", b"PLTE", b"tRNS", b"IDAT", b"IEND"])


if __name__ == "__main__":
    unittest.main()
