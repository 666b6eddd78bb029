#!/usr/bin/python3
"""Temperatures of a run's films for heat and strength programs, read by readers of the test's own.

python temperatures_test.py HERSEY [tests]
"""

import itertools
import json
import math
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

import loads_test as loads
from loads_test import AS_FILM, DIGITS, ROOT, hersey, text_of

CCX = shutil.which("ccx")
WARM = "thermal: {model: film, supply_temperature: 50 degC, layers: 3, shell: insulated, journal: %s}"


def lines_below(path, keyword):
    """Fields of the lines below each keyword of a CalculiX file, up to the next."""
    found, is_inside = [], False
    for line in text_of(path).splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            is_inside = line.upper().startswith(keyword)
        elif is_inside:
            found.append([field.strip() for field in line.split(",")])
    return found


def boundary(path):
    """Temperatures of nodes of a heat step."""
    lines = lines_below(path, "*BOUNDARY")
    assert all(line[1:3] == ["11", "11"] for line in lines)
    return {int(line[0]): float(line[3]) for line in lines}


def temperatures(path):
    """Temperatures of all nodes, the file that steps include."""
    return {int(node): float(T) for node, T in (line.split(",") for line in text_of(path).splitlines() if line[0] != "*")}


def mean_on_cylinder(mesh, faces, of_node):
    """Mean of what nodal values interpolate on faces around the z-axis, with the area of a cylinder, dphi dz."""
    g, w = np.polynomial.legendre.leggauss(6)
    area = total = 0
    for element, face in faces:
        type_, nodes = mesh.elements[element]
        nodes = [nodes[k - 1] for k in loads.FACES[type_][face - 1]]
        x, values = np.array([mesh.nodes[n] for n in nodes]), np.array([of_node[n] for n in nodes])
        for (s, ws), (t, wt) in itertools.product(zip(g, w), zip(g, w)):
            a, b, weight = s, t, ws * wt
            if len(nodes) in (3, 6):  # the square collapses into the triangle
                a, b = (1 + s) / 2, (1 + t) / 2 * (1 - (1 + s) / 2)
                weight *= (1 - a) / 4
            n, dn = loads.shapes(len(nodes), a, b)
            at = n @ x
            square = at[0] ** 2 + at[1] ** 2
            piece = weight * abs(np.cross(dn[:, 0] @ x, dn[:, 1] @ x) @ np.array([at[0], at[1], 0])) / square
            area, total = area + piece, total + piece * (n @ values)
    return total / area


def surface_of(path, name):
    """Faces of a surface in a mesh file of CalculiX."""
    (text,) = re.findall(rf"\*SURFACE, NAME={name}, TYPE=ELEMENT\n([^*]*)", text_of(path))
    return [(int(element), int(face)) for element, face in re.findall(r"(\d+), S(\d)", text)]


def mean_of_film(film, field, instants):
    """Mean over the surface and over the time of instants, from the results' nodes."""
    times = film["fields/time"][:][instants]
    z = film["fields/z"][:]
    along = loads.weights_along(z) / (z[-1] - z[0])
    means = [np.mean(T, axis=0) @ along for T in film["fields/" + field][:][instants]]  # lines are evenly spaced
    of_intervals = (np.array(means[1:]) + means[:-1]) / 2 * np.diff(times)
    return of_intervals.sum() / (times[-1] - times[0])


class WarmFilmTest(unittest.TestCase):
    """A warm film between a shell in ground and a journal, each on a mesh of its own: rigid in the run."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        text = text_of(ROOT, "tests/cli/bearing.yaml")
        text = text.replace("load: 100 N", "load: 2 kN")
        cls.of = {}  # results
        for name, journal in (("cold", None), ("warm", "insulated"), ("even", "{wall: given, temperature: 70 degC}")):
            content = text
            if journal:
                content = text.replace("oil: {viscosity: 15 mPa.s}", "oil: {grade: iso_vg_32}").replace(
                    "    supply:", f"    {WARM % journal}\n    supply:")
            path = os.path.join(cls.folder, name + ".yaml")
            with open(path, "w", encoding="utf-8") as file:
                file.write(content)
            hersey("run", path, "--output", os.path.join(cls.folder, name))
            cls.of[name] = os.path.join(cls.folder, name, "results.h5")
        cls.results = cls.of["warm"]
        with h5py.File(cls.results) as f:
            film = f["bearings/main"]
            radius, width = 1e3 * film.attrs["radius"], 1e3 * film.attrs["width"]
            cls.instants = list(range(len(film["fields/time"])))
            cls.times = film["fields/time"][:]
            cls.of_film = {side: mean_of_film(film, field, cls.instants)
                           for side, field in (("shell", "shell_temperature"), ("shaft", "journal_temperature"))}
            spread = np.ptp(film["fields/shell_temperature"][-1])
        assert spread > 1, spread  # K: there is something to map
        cls.inner = 0.8 * radius
        loads.ring_mesh(os.path.join(cls.folder, "shell.inp"), radius, 1.5 * radius, width)
        loads.ring_mesh(os.path.join(cls.folder, "shaft.inp"), cls.inner, radius, width)
        cls.radius, cls.width = radius, width

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def export(self, name, *options, body="ground", mesh="shell", form="calculix", results=None, expect=0):
        out = os.path.join(self.folder, name)
        said = hersey("export", results or self.results, "--loads", form, "--body", body, "--mesh",
                      os.path.join(self.folder, mesh + ".inp"), "--length-unit", "mm", "--youngs-modulus", "210GPa",
                      "--poisson-ratio", "0.3", "--output", out, "--force", *options, expect=expect)
        return said if expect else out

    def test_mean_over_the_faces_is_the_films(self):
        for body, mesh in (("ground", "shell"), ("shaft", "shaft")):
            out = self.export("mean", "--conductivity", "46W/m/K", "--instant", "all", body=body, mesh=mesh)
            of_node = boundary(os.path.join(out, body + "_heat.inp"))
            file = os.path.join(out, body + "_mesh.inp")
            faces = surface_of(file, "film_main")
            self.assertEqual(len(faces), 48 * 4)
            mean = mean_on_cylinder(loads.CalculixMesh(file), faces, of_node)
            self.assertLess(abs(mean - self.of_film[mesh]), AS_FILM * abs(mean))

    def test_mean_over_time_is_that_of_its_instants(self):
        out = self.export("all", "--conductivity", "46W/m/K", "--instant", "all")
        of_all = boundary(os.path.join(out, "ground_heat.inp"))
        sums = dict.fromkeys(of_all, 0)
        for k, t in enumerate(self.times):
            before, after = self.times[max(k - 1, 0)], self.times[min(k + 1, len(self.times) - 1)]
            out = self.export("one", "--conductivity", "46W/m/K", "--instant", f"{1e3 * t}ms")
            for node, T in boundary(os.path.join(out, "ground_heat.inp")).items():
                sums[node] += T * (after - before) / 2 / (self.times[-1] - self.times[0])
        for node, T in of_all.items():
            self.assertAlmostEqual(sums[node] / T, 1, delta=DIGITS)

    def test_nodes_follow_the_film(self):
        """At the nodes of a mesh finer than the film's grid: the film's own temperature, linear between its nodes."""
        for body, mesh, field in (("ground", "shell", "shell_temperature"), ("shaft", "shaft", "journal_temperature")):
            out = self.export("last", "--conductivity", "46W/m/K", "--instant", f"{1e3 * self.times[-1]}ms", body=body, mesh=mesh)
            nodes = loads.CalculixMesh(os.path.join(out, body + "_mesh.inp")).nodes
            with h5py.File(self.results) as f:
                film = f["bearings/main"]
                phi, z, T = film["fields/phi"][:], 1e3 * film["fields/z"][:], film["fields/" + field][-1]
                R = loads.rotation(f["bodies/shaft/orientation"][-1]) if body == "shaft" else np.identity(3)
            self.assertTrue(body == "ground" or abs(R[1, 0]) > 0.5)  # it has rotated by 30 deg or more
            errors = []
            for node, value in boundary(os.path.join(out, body + "_heat.inp")).items():
                x, y, at_z = R @ nodes[node]
                lines = [np.interp(math.atan2(y, x), phi, column, period=2 * math.pi) for column in T.T]
                errors.append(value - np.interp(at_z, z, lines))
            # Linear pieces of 22.5 deg by linear faces of 7.5 deg: kinks at the film's nodes are what is missed.
            self.assertLess(max(map(abs, errors)), 0.1 * np.ptp(T))
            self.assertLess(np.sqrt(np.mean(np.square(errors))), 0.02 * np.ptp(T))

    def test_uniform_film_is_a_uniform_boundary(self):
        out = self.export("even", "--conductivity", "46W/m/K", "--instant", "all", body="shaft", mesh="shaft", results=self.of["even"])
        of_node = boundary(os.path.join(out, "shaft_heat.inp"))
        self.assertEqual(len(of_node), 48 * 5)
        for value in of_node.values():
            self.assertAlmostEqual(value / 70, 1, delta=DIGITS)
        # Nothing cools the body: it has this temperature everywhere.
        for value in temperatures(os.path.join(out, "shaft_temperatures.inp")).values():
            self.assertAlmostEqual(value / 70, 1, delta=DIGITS)
        self.assertIn("--cooling", text_of(out, "shaft_heat.inp"))

    def test_a_mesh_that_begins_elsewhere_takes_the_same_temperatures(self):
        at = {}
        for mesh, begin in (("shell", 0), ("turned", 5)):
            if begin:
                loads.ring_mesh(os.path.join(self.folder, mesh + ".inp"), self.radius, 1.5 * self.radius, self.width, begin=begin)
            out = self.export(mesh, "--conductivity", "46W/m/K", "--instant", "all", mesh=mesh)
            nodes = loads.CalculixMesh(os.path.join(out, "ground_mesh.inp")).nodes
            at[mesh] = sorted((*np.round(nodes[n], 6), T) for n, T in boundary(os.path.join(out, "ground_heat.inp")).items())
        # Sums in another order, over angles with the round-off of a rotation.
        np.testing.assert_allclose(at["shell"], at["turned"], rtol=0, atol=1e-6)

    def test_units_and_programs_have_the_same_heat(self):
        options = ["--conductivity", "46W/m/K", "--expansion", "12e-6 1/K", "--cooling", "outside=80W/m^2/K:20degC",
                   "--cooling", "outside=20W/m^2/K:45degC"]
        mm = self.export("mm", *options)
        si = self.export("si", *options, "--units", "si")
        bulk = {unit: self.export("bdf_" + unit, *options, "--units", unit, form="nastran") for unit in ("mm", "si")}
        self.assertEqual(boundary(os.path.join(mm, "ground_heat.inp")), boundary(os.path.join(si, "ground_heat.inp")))
        in_mm, in_si = (temperatures(os.path.join(out, "ground_temperatures.inp")) for out in (mm, si))
        self.assertEqual(in_mm, in_si)
        for out, scale in ((mm, 1e-3), (si, 1)):  # N/(mm s K) in W/(m^2 K)
            file = os.path.join(out, "ground_mesh.inp")
            self.assertEqual(lines_below(file, "*CONDUCTIVITY"), [["46"]])  # W/(m K) = mW/(mm K)
            self.assertIn("*EXPANSION, ZERO=20\n1.2e-05\n", text_of(file))
            film = lines_below(os.path.join(out, "ground_heat.inp"), "*FILM")
            self.assertEqual(len(film), 48 * 4)
            for _, _, ambient, transfer in film:  # one sum for each face: 80 at 20 degC and 20 at 45 degC
                self.assertAlmostEqual(float(ambient), 25, delta=DIGITS * 298)
                self.assertAlmostEqual(float(transfer) / (100 * scale), 1, delta=DIGITS)
        for unit, scale in (("mm", 1e-3), ("si", 1)):  # as above
            cards = loads.nastran_cards(os.path.join(bulk[unit], "ground_heat.bdf"))
            of = {name: [c for c in cards if c[0] == name] for name in {c[0] for c in cards}}
            self.assertEqual(len(of["CHBDYG"]), 48 * 4)
            self.assertEqual(len(of["CONV"]), 48 * 4)
            (conducts,), (cools,) = ([c for c in of["MAT4"] if bool(c[2]) == is_solid] for is_solid in (True, False))
            self.assertAlmostEqual(float(conducts[2]) / 46, 1, delta=DIGITS)
            self.assertAlmostEqual(float(cools[5]) / (100 * scale), 1, delta=DIGITS)
            self.assertEqual({(c[2], c[5]) for c in of["CONV"]}, {(of["PCONV"][0][1], of["SPOINT"][0][1])})
            self.assertEqual(of["PCONV"][0][2], cools[1])
            fixed = {int(c[2]): float(c[4]) for c in of["SPC"]}
            self.assertAlmostEqual(fixed.pop(int(of["SPOINT"][0][1])), 25, delta=DIGITS * 298)
            for node, T in boundary(os.path.join(mm, "ground_heat.inp")).items():
                self.assertAlmostEqual(fixed[node] / T, 1, delta=DIGITS)
            statics = loads.nastran_cards(os.path.join(bulk[unit], "ground.bdf"))
            of_nodes = {int(c[2]): float(c[3]) for c in statics if c[0] == "TEMP"}
            self.assertEqual(sorted(of_nodes), sorted(in_mm))
            for node, T in of_nodes.items():
                self.assertAlmostEqual(T / in_mm[node], 1, delta=DIGITS)
            (material,) = [c for c in statics if c[0] == "MAT1"]
            self.assertEqual([float(v) for v in material[6:8]], [12e-6, 20])
            self.assertIn("TEMPERATURE(LOAD) = ", text_of(bulk[unit], "ground.bdf"))
            self.assertIn("SOL 153\n", text_of(bulk[unit], "ground_heat.bdf"))

    def test_heat_through_a_tube_is_that_of_the_closed_form(self):
        k, h, ambient = 46, 2000, 20
        out = os.path.join(self.folder, "tube")
        said = json.loads(hersey(
            "export", self.of["even"], "--loads", "calculix", "--body", "shaft", "--mesh", os.path.join(self.folder, "shaft.inp"),
            "--length-unit", "mm", "--youngs-modulus", "210GPa", "--poisson-ratio", "0.3", "--output", out, "--json",
            "--conductivity", f"{k}W/m/K", "--cooling", f"inside={h}W/m^2/K:{ambient}degC"))["temperatures"]
        resistance = (math.log(self.radius / self.inner) / k + 1 / (h * 1e-3 * self.inner)) / (2 * math.pi * 1e-3 * self.width)
        self.assertAlmostEqual(said["films"]["main"] / 70, 1, delta=DIGITS)
        heat = (70 - ambient) / resistance
        # One layer of flat faces: the mean of radii for the logarithm, chords for arcs, 0.4 % and 0.1 %.
        self.assertAlmostEqual(said["heat_from_films"] / heat, 1, delta=0.006)
        self.assertAlmostEqual(said["warmest"] / 70, 1, delta=DIGITS)

    def test_temperatures_lie_between_those_of_films_and_surroundings(self):
        out = self.export("between", "--conductivity", "46W/m/K", "--cooling", "outside=5000W/m^2/K:20degC")
        fixed = boundary(os.path.join(out, "ground_heat.inp"))
        of_nodes = temperatures(os.path.join(out, "ground_temperatures.inp"))
        for node, T in of_nodes.items():
            self.assertEqual(T, fixed.get(node, T))
            self.assertGreater(T, 20)
            self.assertLessEqual(T, max(fixed.values()))
        self.assertLess(min(of_nodes.values()), min(fixed.values()) - 1)  # K: the outside is colder

    def test_steps_are_warm_where_the_body_expands(self):
        cold = self.export("stiff", "--conductivity", "46W/m/K")
        warm = self.export("grows", "--conductivity", "46W/m/K", "--expansion", "12e-6 1/K", "--reference-temperature", "30degC")
        for name in ("ground_steps.inp", "ground_history.inp"):
            self.assertNotIn("*TEMPERATURE", text_of(cold, name))
            self.assertIn("*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 30\n", text_of(warm, name))
            self.assertIn("*INCLUDE, INPUT=ground_temperatures.inp", text_of(warm, name))
        self.assertNotIn("*EXPANSION", text_of(cold, "ground_mesh.inp"))
        steps = text_of(warm, "ground_steps.inp")
        self.assertEqual(steps.count("*TEMPERATURE\n"), steps.count("*STEP\n"))

    def test_faults_say_what_is_allowed(self):
        self.assertIn("thermal: {model: film}", self.export("no", "--conductivity", "46W/m/K", results=self.of["cold"], expect=2))
        for options, said in ((["--cooling", "outside=80W/m^2/K:20degC"], "--conductivity"), (["--expansion", "12e-6 1/K"], "--conductivity"),
                              (["--conductivity", "-1W/m/K"], "46W/m/K"), (["--conductivity", "46W/m/K", "--cooling", "outsid=80W/m^2/K:20degC"], "outside"),
                              (["--conductivity", "46W/m/K", "--temperature", "80degC"], "SET=80degC"),
                              (["--conductivity", "46W/m/K", "--expansion", "-1 1/K"], "12e-6 1/K")):
            self.assertIn(said, self.export("no", *options, expect=2))
        self.assertIn("calculix", self.export("no", "--conductivity", "46W/m/K", form="vtkhdf", expect=2))
        self.assertFalse(os.path.exists(os.path.join(self.folder, "no")))

    @unittest.skipUnless(CCX, "CalculiX (ccx) is not installed")
    def test_calculix_finds_the_same_temperatures(self):
        for units, scale in (("mm", 1e-3), ("si", 1)):  # W in N mm/s
            out = self.export("ccx_" + units, "--conductivity", "46W/m/K", "--expansion", "12e-6 1/K", "--cooling",
                              "outside=800W/m^2/K:20degC", "--units", units, "--instant", "all")
            ours = temperatures(os.path.join(out, "ground_temperatures.inp"))
            theirs = frd_fields(calculix(out, "ground_heat"), "NDTEMP")[-1]
            for node, T in ours.items():
                self.assertAlmostEqual(theirs[node][0] / T, 1, delta=1e-5)  # six digits of the .frd file


    @unittest.skipUnless(CCX, "CalculiX (ccx) is not installed")
    def test_uniform_temperature_expands_the_body_in_calculix(self):
        supports = ["--hold", "here", "--hold", "across:yz", "--hold", "beside:z"]  # six, that let it grow
        moved = {}
        for name, options in (("cold", []), ("warm", ["--conductivity", "46W/m/K", "--expansion", "12e-6 1/K"])):
            out = self.export("expands_" + name, "--instant", "1ms", "--instant", "2ms", *supports, *options, body="shaft", mesh="shaft", results=self.of["even"])
            moved[name] = frd_fields(calculix(out, "shaft_steps"), "DISP")
            history = frd_fields(calculix(out, "shaft_history"), "DISP")
            largest = max(np.abs(list(moved[name][-1].values())).max(), 0.01)  # mm
            for node, u in moved[name][-1].items():  # without NLGEOM and with it: strains of 6e-4, and three nodes that bear the load
                np.testing.assert_allclose(history[-1][node], u, rtol=0, atol=5e-3 * largest)
        nodes = loads.CalculixMesh(os.path.join(out, "shaft_mesh.inp")).nodes
        for cold, warm in zip(moved["cold"], moved["warm"]):
            for node, x in nodes.items():
                growth = 12e-6 * (70 - 20) * (x - nodes[1])
                # mm: six digits of 30 um, twice
                np.testing.assert_allclose(np.subtract(warm[node], cold[node]), growth, rtol=0, atol=1e-7)


class ConductingBodyTest(unittest.TestCase):
    """The pedestal of examples/hot_pedestal under a shaft that turns, until its cycles repeat themselves."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        text = text_of(ROOT, "examples/hot_pedestal/model.yaml").replace("../meshes/", "")
        for old, new in (("between: [ground, shaft]}", "between: [ground, shaft], initial: {rotation_rate: 3000 rpm}}\n\n"
                          "drives:\n  motor: {joint: turn, coordinate: rotation, speed: 3000 rpm}\n\n"
                          "forces:\n  weight: {type: force, body: shaft, components: [0 N, -3 kN, 0 N], axes: ground}"),
                         ("circumferential: 60, axial: 13", "circumferential: 40, axial: 9"),
                         ("{duration: 1 ms, step: 0.1 ms}", "{step: 0.2 ms, cycle: {period: 20 ms}}\noutput: {fields_every: 2 ms}")):
            assert old in text
            text = text.replace(old, new)
        shutil.copy(os.path.join(ROOT, "examples/meshes/bearing_housing.msh"), cls.folder)
        with open(os.path.join(cls.folder, "model.yaml"), "w", encoding="utf-8") as file:
            file.write(text)
        hersey("run", os.path.join(cls.folder, "model.yaml"), "--output", cls.folder)
        cls.results = os.path.join(cls.folder, "results.h5")
        cls.out = os.path.join(cls.folder, "loads")
        cls.said = json.loads(hersey("export", cls.results, "--loads", "calculix", "--hold", "foot", "--output", cls.out, "--json"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_heat_is_that_of_the_run(self):
        with h5py.File(self.results) as f:
            film = f["bearings/main"]
            last = f["time"][:] > film["cycles/fields/begin"][-1]
            heat, body = np.mean(film["heat_to_shell"][last]), film["T_body_max"][-1]
            self.assertGreater(film["cycles/fields/complete"][-1], 0)
        heat_of = self.said["temperatures"]
        # From its surface's temperature alone: the mesh under a film that gives as much everywhere along its width, and
        # a body that waits for the mean of a cycle.
        self.assertAlmostEqual(heat_of["heat_from_films"] / heat, 1, delta=0.01)
        self.assertAlmostEqual(heat_of["warmest"], body, delta=0.2)
        self.assertAlmostEqual(heat_of["coldest"], 30, delta=1e-9 * 303)  # K: the foot's, in round-off

    def test_mean_over_curved_faces_is_the_films(self):
        file = os.path.join(self.out, "pedestal_mesh.inp")
        mean = mean_on_cylinder(loads.CalculixMesh(file), surface_of(file, "film_main"), boundary(os.path.join(self.out, "pedestal_heat.inp")))
        with h5py.File(self.results) as f:
            film = f["bearings/main"]
            begin, end = film["cycles/fields/begin"][-1], film["cycles/fields/end"][-1]
            times = film["fields/time"][:]
            expected = mean_of_film(film, "shell_temperature", (times > begin - 1e-6) & (times < end + 1e-6))  # s: of steps of 0.2 ms
        self.assertLess(abs(mean - expected), AS_FILM * expected)

    def test_options_stand_in_place_of_the_model(self):
        out = os.path.join(self.folder, "other")
        hersey("export", self.results, "--loads", "calculix", "--output", out, "--conductivity", "40W/m/K", "--expansion", "0 1/K",
               "--cooling", "foot=500W/m^2/K:30degC")
        mesh = text_of(out, "pedestal_mesh.inp")
        self.assertEqual(lines_below(os.path.join(out, "pedestal_mesh.inp"), "*CONDUCTIVITY"), [["40"]])
        self.assertNotIn("*EXPANSION", mesh)
        self.assertNotIn("*TEMPERATURE", text_of(out, "pedestal_steps.inp"))
        fixed = boundary(os.path.join(self.out, "pedestal_heat.inp"))
        free = boundary(os.path.join(out, "pedestal_heat.inp"))
        self.assertEqual({fixed[node] for node in fixed.keys() - free.keys()}, {30})
        cooled = {line[3] for line in lines_below(os.path.join(out, "pedestal_heat.inp"), "*FILM")}
        self.assertEqual(cooled, {"0.5"})

    def test_faces_of_films_are_not_cooled(self):
        film = set(surface_of(os.path.join(self.out, "pedestal_mesh.inp"), "film_main"))
        cooled = {(int(line[0]), int(line[1][1:])) for line in lines_below(os.path.join(self.out, "pedestal_heat.inp"), "*FILM")}
        self.assertGreater(len(cooled), len(film))
        self.assertFalse(film & cooled)

    @unittest.skipUnless(CCX, "CalculiX (ccx) is not installed")
    def test_calculix_finds_the_same_temperatures_in_a_body(self):
        ours = temperatures(os.path.join(self.out, "pedestal_temperatures.inp"))
        theirs = frd_fields(calculix(self.out, "pedestal_heat"), "NDTEMP")[-1]
        for node, T in ours.items():
            self.assertAlmostEqual(theirs[node][0] / T, 1, delta=1e-5)  # six digits of the .frd file


def calculix(folder, job):
    done = subprocess.run([CCX, job], cwd=folder, capture_output=True, text=True, timeout=600, stdin=subprocess.DEVNULL)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout[-2000:]
    return os.path.join(folder, job + ".frd")


def frd_fields(path, name):
    """Values at nodes of each result called `name` in a file of CalculiX' results."""
    fields, is_inside = [], False
    for line in text_of(path).splitlines():
        if line.startswith(" -4"):
            is_inside = line.split()[1] == name
            if is_inside:
                fields.append({})
        elif line.startswith(" -3"):
            is_inside = False
        elif is_inside and line.startswith(" -1"):
            fields[-1][int(line[3:13])] = [float(line[k:k + 12]) for k in range(13, len(line.rstrip()), 12)]
    return fields


if __name__ == "__main__":
    unittest.main()
