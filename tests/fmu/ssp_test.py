#!/usr/bin/python3
"""Systems of FMUs by SSP 1.0: the structure that the standard publishes, and a master that knows nothing but the file.

ssp_test.py HERSEY WORK [Class.test]"""

import os
import sys
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from controller.build import UNITS, VARIABLES, build  # noqa: E402
from import_test import ROTOR, RPM, WARM, Folder  # noqa: E402  takes HERSEY and WORK off the arguments
from importer import Fmu, Instance  # noqa: E402

SSP = "http://ssp-standard.org/SSP1/"
SSD, SSC, SSV = (f"{{{SSP}SystemStructure{name}}}" for name in ("Description", "Common", "ParameterValues"))
# Which elements the schemas of SSP 1.0 have inside of which, in their order; those that are written, at least one of `+`.
CONTENT = {
    SSD + "SystemStructureDescription": ["System", "Units", "DefaultExperiment"],
    SSD + "System": ["Elements", "Connections"],
    SSD + "Elements": ["Component+"],
    SSD + "Component": ["Connectors", "ParameterBindings"],
    SSD + "Connectors": ["Connector+"],
    SSD + "Connector": [SSC + "Real"],
    SSD + "ParameterBindings": ["ParameterBinding+"],
    SSD + "ParameterBinding": ["ParameterValues"],
    SSD + "ParameterValues": [SSV + "ParameterSet"],
    SSV + "ParameterSet": [SSV + "Parameters", SSV + "Units"],
    SSV + "Parameters": [SSV + "Parameter+"],
    SSV + "Parameter": [[SSV + "Real", SSV + "Integer", SSV + "Boolean", SSV + "String"]],
    SSD + "Connections": ["Connection+"],
    SSD + "Connection": [SSC + "LinearTransformation"],
    SSD + "Units": [SSC + "Unit+"],
    SSV + "Units": [SSC + "Unit+"],
    SSC + "Unit": [SSC + "BaseUnit"],
}
REQUIRED = {SSD + "SystemStructureDescription": {"version", "name"}, SSD + "System": {"name"}, SSD + "Component": {"name"},
            SSD + "Connector": {"name", "kind"}, SSV + "ParameterSet": {"version", "name"}, SSV + "Parameter": {"name"},
            SSD + "Connection": {"startConnector", "endConnector"}, SSC + "Unit": {"name"}}


class System:
    """A system as a master sees it, which has its file and the FMUs in it."""

    def __init__(self, path, folder):
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
        self.root = ElementTree.parse(os.path.join(folder, "SystemStructure.ssd")).getroot()
        self.to_si = {unit.get("name"): [float(unit.find(SSC + "BaseUnit").get(key, value)) for key, value in (("factor", 1), ("offset", 0))]
                      for unit in self.root.find(SSD + "Units")}
        self.units, self.instances = {}, {}
        for component in self.root.iter(SSD + "Component"):
            name = component.get("name")
            for connector in component.iter(SSD + "Connector"):
                self.units[name, connector.get("name")] = connector.find(SSC + "Real").get("unit")
            fmu = Fmu(os.path.join(folder, component.get("source")), os.path.join(folder, name))
            one = self.instances[name] = Instance(fmu)
            for parameter in component.iter(SSV + "Parameter"):
                assert one.set(parameter.get("name"), float(parameter.find(SSV + "Real").get("value"))) == 0

    def exchange(self):
        """Outputs of all, then inputs: units are converted first, and the transformation follows."""
        found = []
        for connection in self.root.iter(SSD + "Connection"):
            start, end = [(connection.get(f"{side}Element"), connection.get(f"{side}Connector")) for side in ("start", "end")]
            value = self.instances[start[0]].get(start[1])
            if self.units[start] and self.units[end]:
                (factor, offset), (divisor, shift) = self.to_si[self.units[start]], self.to_si[self.units[end]]
                value = (factor * value + offset - shift) / divisor
            linear = connection.find(SSC + "LinearTransformation")
            found.append((end, value * (1 if linear is None else float(linear.get("factor")))))
        for (element, name), value in found:
            assert self.instances[element].set(name, value) == 0


class SspTest(Folder):
    def written(self, text, *words):
        path = os.path.join(self.folder, "system.ssp")
        printed = self.hersey("export", self.write("rotor.yaml", text), "--ssp", path, "--force", *words)
        self.assertIn("SSP 1.0", printed)
        self.assertEqual(sorted(name for name in os.listdir(self.folder) if name.startswith("system.ssp")), ["system.ssp"])
        return path

    def check_element(self, element):
        allowed = [name if isinstance(name, list) else [name] for name in CONTENT.get(element.tag, [])]
        allowed = [[(name if name[0] == "{" else SSD + name).rstrip("+") for name in names] for names in allowed]
        at = 0
        for child in element:
            while at < len(allowed) and child.tag not in allowed[at]:
                at += 1
            self.assertLess(at, len(allowed), f"{child.tag} in {element.tag}")
            self.check_element(child)
        for name in REQUIRED.get(element.tag, ()):
            self.assertIn(name, element.attrib, element.tag)

    def test_the_structure_is_the_published_one(self):
        build(os.path.join(self.folder, "controller.fmu"), 2)
        more = ROTOR.replace("parameters: {", "parameters: {name: PI, fault: 0, is_reversed: false, ").replace(
            "output: torque", "output: torque, scale: 1.5")
        path = self.written(more)
        with zipfile.ZipFile(path) as archive:
            self.assertEqual(set(archive.namelist()), {"SystemStructure.ssd", "resources/machine.fmu", "resources/controller.fmu"})
            root = ElementTree.fromstring(archive.read("SystemStructure.ssd"))
        self.check_element(root)
        self.assertEqual((root.tag, root.get("version")), (SSD + "SystemStructureDescription", "1.0"))
        sources = {one.get("name"): one.get("source") for one in root.iter(SSD + "Component")}
        self.assertEqual(sources, {"machine": "resources/machine.fmu", "controller": "resources/controller.fmu"})
        kinds = {(component.get("name"), one.get("name")): one.get("kind") for component in root.iter(SSD + "Component")
                 for one in component.iter(SSD + "Connector")}
        for one in root.iter(SSD + "Connection"):
            self.assertEqual(kinds[one.get("startElement"), one.get("startConnector")], "output")
            self.assertEqual(kinds[one.get("endElement"), one.get("endConnector")], "input")
        self.assertEqual([one.get("factor") for one in root.iter(SSC + "LinearTransformation")], ["1.5"])
        defined = {one.get("name") for one in root.find(SSD + "Units")}
        self.assertLessEqual({one.get("unit") for one in root.iter() if one.get("unit")}, defined)

    def test_a_master_of_the_system_finds_the_run(self):
        for version in (2, 3):
            build(os.path.join(self.folder, "controller.fmu"), version)
            folder = os.path.join(self.folder, f"system {version}")
            system = System(self.written(ROTOR, "--fmi", version), folder)
            for one in system.instances.values():
                one.initialise(stop=0.2)
            # The start, as an iteration of the initialisation would find it: the controller knows the speed, the machine the torque.
            speeds = [system.instances["machine"].get("joints.shaft.rates")]
            controller = system.instances["controller"]
            assert controller.set("speed", speeds[0] * 30 / np.pi) == 0
            controller.must("ExitInitializationMode")
            for k in range(200):
                system.exchange()
                for one in system.instances.values():
                    self.assertEqual(one.step(k * 1e-3, 1e-3), 0, one.log)
                speeds.append(system.instances["machine"].get("joints.shaft.rates"))
            with h5py.File(self.results(os.path.join(self.folder, "rotor.yaml"))) as file:
                np.testing.assert_allclose(speeds, file["joints/shaft/rates"][::2], rtol=1e-11)  # round-off of 200 steps
            for one in system.instances.values():
                one.free()

    def test_temperatures_arrive_in_the_unit_of_the_input(self):
        for unit, offset in (('<BaseUnit K="1"/>', 273.15), ('<BaseUnit K="1" offset="273.15"/>', 0)):
            with self.subTest(unit=unit):
                build(os.path.join(self.folder, "controller.fmu"), 2, units=UNITS.replace(RPM, unit))
                system = System(self.written(WARM), os.path.join(self.folder, f"warm {offset}"))
                self.check_element(system.root)
                for one in system.instances.values():
                    one.initialise(stop=3e-3)
                system.exchange()
                film = system.instances["machine"].get("bearings.main.T_max")
                self.assertGreater(film, 39)
                self.assertLess(film, 100)  # degC
                np.testing.assert_allclose(system.instances["controller"].get("speed"), film + offset, rtol=1e-12)  # round-off
                with zipfile.ZipFile(os.path.join(self.folder, f"warm {offset}", "resources", "machine.fmu")) as archive:
                    told = ElementTree.fromstring(archive.read("modelDescription.xml"))
                base = next(one for one in told.iter("Unit") if one.get("name") == "degC").find("BaseUnit")
                self.assertEqual(base.attrib, {"K": "1", "offset": "273.15"})
                for one in system.instances.values():
                    one.free()

    def test_fmus_are_connected_with_each_other(self):
        build(os.path.join(self.folder, "controller.fmu"), 2)
        second = '  other: {file: controller.fmu, step: 2 ms, inputs: {speed: shaft.rotation_rate, wanted: fmus.controller.torque}}\n'
        unit = [(*one[:6], "N.m") if one[0] == "wanted" else one for one in VARIABLES]
        build(os.path.join(self.folder, "other.fmu"), 3, variables=unit)
        text = ROTOR.replace("forces:", second.replace("controller.fmu", "other.fmu") + "forces:").replace(
            "output: torque", "output: torque, hold: ramp")
        path = os.path.join(self.folder, "system.ssp")
        printed = self.hersey("export", self.write("rotor.yaml", text), "--ssp", path, "--force")
        self.assertIn("forces.motor.magnitude.hold: ramp is not in it", printed)
        with zipfile.ZipFile(path) as archive:
            root = ElementTree.fromstring(archive.read("SystemStructure.ssd"))
        self.check_element(root)
        ends = {tuple(one.get(key) for key in ("startElement", "startConnector", "endElement", "endConnector"))
                for one in root.iter(SSD + "Connection")}
        self.assertEqual(ends, {("controller", "torque", "other", "wanted"), ("controller", "torque", "machine", "forces.motor.magnitude"),
                                ("machine", "joints.shaft.rates", "controller", "speed"), ("machine", "joints.shaft.rates", "other", "speed")})

    def test_what_is_no_connection_is_refused(self):
        build(os.path.join(self.folder, "controller.fmu"), 2)
        path = os.path.join(self.folder, "refused.ssp")
        for old, new, said in (("wanted: 100.0 rad/s", "wanted: {expression: 100 + t, unit: rad/s}", "rotor.yaml:10"),
                               (ROTOR[ROTOR.index("fmus:"):ROTOR.index("forces:")], "", "--fmu FILE.fmu")):
            text = ROTOR.replace(old, new).replace("{fmu: controller, output: torque}", "0 N.m") if not new else ROTOR.replace(old, new)
            self.assertNotEqual(text, ROTOR)
            self.assertIn(said, self.hersey("export", self.write("rotor.yaml", text), "--ssp", path, expect=2))
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith("refused")], [])


if __name__ == "__main__":
    unittest.main()
