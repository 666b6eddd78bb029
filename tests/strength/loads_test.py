#!/usr/bin/python3
"""Loads of a run for strength programs, read by readers of the test's own; stresses over a run.

python loads_test.py HERSEY [tests]
"""

import csv
import itertools
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERSEY = os.path.abspath(sys.argv.pop(1))
ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))

AS_FILM = 1e-6  # what the program promises: force and moment of the film
DIGITS = 1e-9   # numbers of text files have ten digits or more

# Nodes of the faces of CalculiX' elements, corners only where the element is of first order.
FACES = {"C3D10": [[1, 2, 3, 5, 6, 7], [1, 4, 2, 8, 9, 5], [2, 4, 3, 9, 10, 6], [3, 4, 1, 10, 8, 7]],
         "C3D8": [[1, 2, 3, 4], [5, 8, 7, 6], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 8, 4], [4, 8, 5, 1]]}
CORNERS = {"C3D10": 4, "C3D8": 8, "CTETRA": 4, "CHEXA": 8}


def text_of(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def hersey(*arguments, expect=0):
    done = subprocess.run([HERSEY, *map(str, arguments)], capture_output=True, text=True, timeout=600, stdin=subprocess.DEVNULL)
    assert done.returncode == expect, f"{arguments}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def shapes(count, a, b):
    """Shape functions of a face at (a, b) and their derivatives; triangles in [0, 1], quadrilaterals in [-1, 1]."""
    if count in (3, 6):
        corner, d = np.array([1 - a - b, a, b]), np.array([[-1, -1], [1, 0], [0, 1]], float)
        if count == 3:
            return corner, d
        mids = [(0, 1), (1, 2), (2, 0)]
        n = np.concatenate([corner * (2 * corner - 1), [4 * corner[i] * corner[k] for i, k in mids]])
        dn = np.concatenate([(4 * corner - 1)[:, None] * d, [4 * (corner[i] * d[k] + corner[k] * d[i]) for i, k in mids]])
        return n, dn
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    n = (1 + signs[:, 0] * a) * (1 + signs[:, 1] * b) / 4
    return n, np.stack([signs[:, 0] * (1 + signs[:, 1] * b), signs[:, 1] * (1 + signs[:, 0] * a)], axis=1) / 4


def wrench_of_face(x, inside):
    """Force and moment about the origin of a pressure of 1 that pushes on a face with nodes x towards the point inside."""
    g, w = np.polynomial.legendre.leggauss(6)
    force, moment = np.zeros(3), np.zeros(3)
    for (s, ws), (t, wt) in itertools.product(zip(g, w), zip(g, w)):
        a, b, weight = s, t, ws * wt
        if len(x) in (3, 6):  # the square collapses into the triangle
            a, b = (1 + s) / 2, (1 + t) / 2 * (1 - (1 + s) / 2)
            weight *= (1 - a) / 4
        n, dn = shapes(len(x), a, b)
        at, push = n @ x, weight * np.cross(dn[:, 0] @ x, dn[:, 1] @ x)
        push = push if push @ (inside - at) > 0 else -push
        force, moment = force + push, moment + np.cross(at, push)
    return np.concatenate([force, moment])


class CalculixMesh:
    def __init__(self, path):
        self.nodes, self.elements, self.keywords = {}, {}, []
        keyword, type_, pending = "", "", []
        for line in text_of(path).splitlines():
            line = line.strip()
            if line.startswith("**"):
                continue
            if line.startswith("*"):
                keyword, *options = [part.strip() for part in line.upper().split(",")]
                self.keywords.append(line)
                type_ = next((o.split("=")[1] for o in options if o.startswith("TYPE=")), "")
                continue
            if keyword == "*NODE":
                label, *x = line.split(",")
                self.nodes[int(label)] = np.array([float(v) for v in x])
            elif keyword == "*ELEMENT":
                pending += [int(v) for v in line.split(",") if v.strip()]
                if not line.endswith(","):
                    self.elements[pending[0]] = (type_, pending[1:])
                    pending = []

    def wrench(self, element, face):
        type_, nodes = self.elements[element]
        x = np.array([self.nodes[nodes[k - 1]] for k in FACES[type_][face - 1]])
        inside = np.mean([self.nodes[n] for n in nodes[:CORNERS[type_]]], axis=0)
        return wrench_of_face(x, inside)


def calculix_steps(path):
    """Pressures by (element, face) of each step."""
    steps, keyword = [], ""
    for line in text_of(path).splitlines():
        line = line.strip()
        if line.startswith("*"):
            keyword = line.split(",")[0].upper()
            if keyword == "*STEP":
                steps.append({})
        elif keyword == "*DLOAD":
            element, face, value = [part.strip() for part in line.split(",")]
            steps[-1][int(element), int(face[1:])] = float(value)
    return steps


def nastran_cards(path):
    """Bulk data in small and large fields as lists of fields."""
    cards, bulk = [], False
    for line in text_of(path).splitlines():
        line = line.rstrip("\n")
        if line.startswith("BEGIN BULK"):
            bulk = True
        elif bulk and not line.startswith("$"):
            name, is_large = line[:8].strip(), line[:8].rstrip().endswith("*")
            width = 16 if is_large else 8
            fields = [line[i:i + width].strip() for i in range(8, len(line), width)]
            if name.rstrip("*").strip("+") == "":
                cards[-1] += fields
            else:
                cards.append([name.rstrip("*")] + fields)
            if is_large:
                cards[-1] += [""] * (-(len(cards[-1]) - 1) % 4)
    return cards


def ring_mesh(path, inner, outer, width, around=48, along=4, begin=0):
    """Hexahedra in one layer about the z-axis lengths in mm, with the sets of nodes `inside` and `outside` and three of one node at one end;
    numbers begin at the line `begin`."""
    def label(layer, i, k):
        return 1 + layer + 2 * ((i % around) + around * k)

    lines = ["*NODE"]
    for k, i, layer in itertools.product(range(along + 1), range(around), range(2)):
        phi, r = 2 * math.pi * (i + begin) / around, (inner, outer)[layer]
        lines.append(f"{label(layer, i, k)}, {r * math.cos(phi):.12g}, {r * math.sin(phi):.12g}, {width * (k / along - 0.5):.12g}")
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=all")
    for n, (k, i) in enumerate(itertools.product(range(along), range(around))):
        corners = [label(a, i + b, z) for z in (k, k + 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        lines.append(", ".join(map(str, [n + 1] + corners)))
    for layer, name in enumerate(("inside", "outside")):
        lines.append(f"*NSET, NSET={name}")
        lines += [str(label(layer, i, k)) for k, i in itertools.product(range(along + 1), range(around))]
    for name, i in (("here", 0), ("across", around // 2), ("beside", around // 4)):
        lines += [f"*NSET, NSET={name}", str(label(0, i, 0))]
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


def weights_along(z):
    """Weights of nodal values in an integral: over each interval the mean of the parabolas through it and a neighbour."""
    weights, n = np.zeros(len(z)), len(z)
    for k in range(n - 1):
        sides = [s for s in (k - 1, k + 2) if 0 <= s < n]
        for s in sides:
            x = np.array([z[k], z[k + 1], z[s]])
            moments = [(z[k + 1] ** (m + 1) - z[k] ** (m + 1)) / (m + 1) for m in range(3)]
            weights[[k, k + 1, s]] += np.linalg.solve(np.vander(x, 3, increasing=True).T, moments) / len(sides)
    return weights


def vtu_reader():
    """The reader of .vtu files of libs/fem/test/read_vtu.py, a script that reads a series where it is run."""
    source = text_of(ROOT, "libs/fem/test/read_vtu.py")
    names = {}
    exec(source[:source.index("pvd = sys.argv[1]")], names)  # its functions alone
    return lambda path: names["arrays"](path)[2]


class LoadsTest(unittest.TestCase):
    """The rod of examples/flexible_big_end over a quarter of a turn."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        text = text_of(ROOT, "examples/flexible_big_end/model.yaml")
        text = text[:text.index("study:")].replace("../meshes/", "").replace("duration: 20 rev", "duration: 90 deg")
        text = re.sub(r" *settle:.*\n", "", text).replace("fields_every: 45 deg", "fields_every: 15 deg\n  meshes_at: [30 deg, 60 deg]")
        shutil.copy(os.path.join(ROOT, "examples/meshes/conrod.msh"), cls.folder)
        cls.model = os.path.join(cls.folder, "model.yaml")
        with open(cls.model, "w", encoding="utf-8") as file:
            file.write(text)
        hersey("run", cls.model, "--set", "load=2000N", "--output", cls.folder)
        cls.results = os.path.join(cls.folder, "results.h5")
        cls.loads = os.path.join(cls.folder, "loads")
        for form, units in (("calculix", "mm"), ("nastran", "si"), ("vtkhdf", "mm")):
            cls.printed = hersey("export", cls.results, "--loads", form, "--units", units, "--hold", "small_end:xz",
                                 "--instant", "all", "--output", cls.loads, "--force")
        with h5py.File(cls.results) as f:
            film = f["bearings/big_end"]
            cls.times = film["fields/time"][:]
            rows = [int(np.argmin(abs(f["time"][:] - t))) for t in cls.times]
            assert not film["force_asperity"][:].any()  # no asperities touch, and the bearing's axes are the body's
            cls.force = film["force_pressure"][:][rows]
            phi, z = film["fields/phi"][:], film["fields/z"][:]
            weights = film.attrs["radius"] * 2 * math.pi / len(phi) * weights_along(z)
            cls.moment = []  # the results' own contains that of the shear along the axis
            for pressure in film["fields/pressure"][:]:
                at_z = pressure * weights * z
                cls.moment.append([-np.sin(phi) @ at_z.sum(axis=1), np.cos(phi) @ at_z.sum(axis=1)])

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def assert_is_the_films(self, wrenches):
        self.assertEqual(len(wrenches), len(self.times))
        for wrench, force, moment in zip(wrenches, self.force, self.moment):
            size = np.linalg.norm(force)
            self.assertLess(np.linalg.norm(wrench[:2] - force[:2]), AS_FILM * size)
            self.assertLess(abs(wrench[2]), 1e-3 * size)  # along an even bore there is no force but the mesh's own
            self.assertLess(np.linalg.norm(wrench[3:5] - moment), AS_FILM * size * 0.0078)  # half the width

    def test_calculix_steps_have_the_films_force_and_moment(self):
        mesh = CalculixMesh(os.path.join(self.loads, "rod_mesh.inp"))
        steps = calculix_steps(os.path.join(self.loads, "rod_steps.inp"))
        unit = {face: mesh.wrench(*face) for face in steps[0]}
        sums = [sum(p * unit[face] for face, p in step.items()) for step in steps]
        self.assert_is_the_films([np.concatenate([w[:3], w[3:] / 1e3]) for w in sums])  # N.mm
        self.assertTrue(any(k.upper().startswith("*BOUNDARY") for k in mesh.keywords))
        self.assertTrue(any("NAME=film_big_end" in k for k in mesh.keywords))

    def test_calculix_history_is_the_steps_over_time(self):
        steps = calculix_steps(os.path.join(self.loads, "rod_steps.inp"))
        text = text_of(self.loads, "rod_history.inp")
        amplitudes = {name: np.array([float(v) for v in re.split(r"[,\s]+", values.strip())]).reshape(-1, 2)
                      for name, values in re.findall(r"\*AMPLITUDE, NAME=(\S+)\n([^*]*)", text)}
        loads = re.findall(r"\*DLOAD, AMPLITUDE=(\S+)\n(\d+), P(\d), 1\.", text)
        self.assertEqual(len(loads), len(steps[0]))
        self.assertIn("*STEP, NLGEOM", text)  # CalculiX would take a linear static step in one increment
        for name, element, face in loads:
            table = amplitudes[name]
            np.testing.assert_allclose(table[:, 0], self.times - self.times[0], rtol=DIGITS, atol=0)
            np.testing.assert_allclose(table[:, 1], [s[int(element), int(face)] for s in steps], rtol=DIGITS, atol=0)

    def test_nastran_subcases_have_the_films_force_and_moment(self):
        cards = nastran_cards(os.path.join(self.loads, "rod.bdf"))
        nodes = {int(c[1]): np.array([float(v) for v in c[3:6]]) for c in cards if c[0] == "GRID"}
        elements = {int(c[1]): [int(v) for v in c[3:] if v] for c in cards if c[0] == "CTETRA"}
        edges = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]  # of the nodes behind the corners
        sums = [np.zeros(6) for _ in self.times]
        for card in cards:
            if card[0] != "PLOAD4":
                continue
            of, (on, off) = elements[int(card[2])], (int(card[7]), int(card[8]))
            corners = [k for k in range(4) if of[k] != off]
            self.assertIn(on, [of[k] for k in corners])
            mids = [4 + next(e for e, pair in enumerate(edges) if set(pair) == {corners[i], corners[(i + 1) % 3]}) for i in range(3)]
            x = np.array([nodes[of[k]] for k in corners + mids])
            sums[int(card[1]) - 1] += float(card[3]) * wrench_of_face(x, nodes[off])
        self.assert_is_the_films(sums)
        text = text_of(self.loads, "rod.bdf")
        self.assertEqual(len(re.findall(r"^SUBCASE \d+$", text, re.M)), len(self.times))
        # The same mesh as that of the other units and format.
        mesh = CalculixMesh(os.path.join(self.loads, "rod_mesh.inp"))
        self.assertEqual(sorted(mesh.nodes), sorted(nodes))
        for label, x in nodes.items():
            np.testing.assert_allclose(1e3 * x, mesh.nodes[label], rtol=0, atol=1e-7)  # ten digits of 0.2 m, in mm

    def test_written_meshes_are_read_back_as_the_body(self):
        facts = [json.loads(hersey("mesh", os.path.join(self.loads, name), "--length-unit", unit, "--json"))
                 for name, unit in (("rod_mesh.inp", "mm"), ("rod.bdf", "m"))]
        with h5py.File(self.results) as f:
            for fact in facts:
                self.assertAlmostEqual(fact["mass"] / f["bodies/rod"].attrs["mass"], 1, delta=DIGITS)

    def test_vtkhdf_has_the_pressures_over_time(self):
        steps = calculix_steps(os.path.join(self.loads, "rod_steps.inp"))
        with h5py.File(os.path.join(self.loads, "rod.vtkhdf")) as f:
            grid = f["VTKHDF"]
            self.assertEqual(list(grid.attrs["Version"]), [2, 0])
            self.assertEqual(grid.attrs["Type"], b"UnstructuredGrid")
            points, cells = int(grid["NumberOfPoints"][0]), int(grid["NumberOfCells"][0])
            self.assertEqual(grid["Points"].shape, (points, 3))
            self.assertEqual(grid["Types"].shape, (cells,))
            self.assertEqual(set(grid["Types"][:]), {22})  # quadratic triangles
            self.assertEqual(grid["Offsets"].shape, (cells + 1,))
            self.assertEqual(grid["Offsets"][-1], grid["NumberOfConnectivityIds"][0])
            self.assertEqual(grid["Connectivity"].shape, (grid["NumberOfConnectivityIds"][0],))
            self.assertLess(grid["Connectivity"][:].max(), points)
            time = grid["Steps"]
            self.assertEqual(int(time.attrs["NSteps"]), len(self.times))
            np.testing.assert_array_equal(time["Values"][:], self.times)
            for name in ("PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"):
                self.assertEqual(len(time[name]), len(self.times))
                self.assertFalse(time[name][:].any())
            data = grid["CellData"]
            faces = list(zip(data["element"][:].astype(int), data["face"][:].astype(int)))
            for k, step in enumerate(steps):
                begin = int(time["CellDataOffsets/pressure"][k])
                pressure = data["pressure"][begin:begin + cells]
                np.testing.assert_allclose(pressure, [1e6 * step[face] for face in faces], rtol=DIGITS, atol=0)

    def test_table_has_both_resultants(self):
        with open(os.path.join(self.loads, "rod_loads.csv"), encoding="ascii") as file:
            rows = list(csv.DictReader(file))
        for row, force in zip(rows, self.force):
            for k, axis in enumerate("xy"):
                for quantity in ("film", "faces"):
                    self.assertLess(abs(float(row[f"{quantity}_force_{axis} [N]"]) - force[k]), AS_FILM * np.linalg.norm(force))

    def test_instants_are_chosen_by_time_and_crank_angle(self):
        folder = os.path.join(self.folder, "chosen")
        printed = json.loads(hersey("export", self.results, "--loads", "vtkhdf", "--instant", "31deg", "--instant",
                                    f"{1e3 * self.times[-1]}ms", "--output", folder, "--json"))
        np.testing.assert_allclose(printed["instants"], [self.times[2], self.times[-1]], rtol=DIGITS)
        self.assertIn("--force", hersey("export", self.results, "--loads", "vtkhdf", "--output", folder, expect=2))
        for wrong in ("720deg", "3 s", "five"):
            self.assertIn("all", hersey("export", self.results, "--loads", "vtkhdf", "--instant", wrong, "--output", folder, "--force", expect=2))

    def test_faults_say_what_is_allowed(self):
        export = ["export", self.results, "--loads", "calculix", "--output", os.path.join(self.folder, "none")]
        for arguments, said in ((["--body", "rodd"], "rod"), (["--body", "pin"], "--mesh"), (["--bearing", "main"], "big_end"),
                                (["--hold", "foot"], "small_end"), (["--set", "load=1N"], "--set"), (["--fmu", "a.fmu"], "--fmu")):
            self.assertIn(said, hersey(*export, *arguments, expect=2))
        self.assertIn("--loads", hersey("export", self.model, expect=2))
        self.assertIn(".h5", hersey("export", self.model, "--loads", "nastran", "--output", "x", expect=2))
        self.assertFalse(os.path.exists(os.path.join(self.folder, "none")))

    def test_a_changed_mesh_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copy(self.model, folder)
            text = text_of(self.folder, "conrod.msh")
            moved = text.replace("\n37 -13 -7.8\n", "\n37 -13 -7.79\n", 1)  # a corner
            self.assertNotEqual(moved, text)
            with open(os.path.join(folder, "conrod.msh"), "w", encoding="ascii") as file:
                file.write(moved)
            for command in (["export", "--loads", "vtkhdf", "--output", folder], ["stress"]):
                said = hersey(command[0], self.results, *command[1:], "--model", os.path.join(folder, "model.yaml"), expect=2)
                self.assertIn("another shape", said)

    def test_stresses_of_a_run_are_those_of_its_pictures(self):
        path = os.path.join(self.folder, "stress.vtkhdf")
        hersey("stress", self.results, "--instant", "30deg", "--instant", "60deg", "--vtkhdf", path)
        from_file = vtu_reader()
        with h5py.File(path) as f:
            data, count = f["VTKHDF/PointData"], int(f["VTKHDF/NumberOfPoints"][0])
            for step in range(2):
                picture = from_file(os.path.join(self.folder, f"results_rod/{step:05}.vtu"))
                for name, columns in (("von_mises", 1), ("stress", 6)):
                    mine = data[name][step * count:(step + 1) * count].ravel()
                    theirs = np.array(picture[name][1])
                    self.assertEqual(picture[name][0], columns)
                    # Sums over shapes in another order.
                    np.testing.assert_allclose(mine, theirs, rtol=0, atol=1e-9 * abs(theirs).max())

    def test_instants_of_largest_stress_are_found(self):
        path = os.path.join(self.folder, "all.vtkhdf")
        every = json.loads(hersey("stress", self.results, "--instant", "all", "--vtkhdf", path, "--json"))
        found = json.loads(hersey("stress", self.results, "--largest", "2", "--json"))
        peaks = [line["von_mises"] for line in every["instants"]]
        self.assertEqual(len(peaks), every["instants_of_run"])
        self.assertEqual(found["instants"][0], max(every["instants"], key=lambda line: line["von_mises"]))
        self.assertEqual(found["largest"], found["instants"][0])
        for line in found["instants"]:
            k = next(i for i, other in enumerate(every["instants"]) if other["time"] == line["time"])
            self.assertGreaterEqual(peaks[k], max(peaks[max(k - 1, 0):k + 2]))
        with h5py.File(path) as f:
            data, count = f["VTKHDF/PointData"], int(f["VTKHDF/NumberOfPoints"][0])
            over_time = data["von_mises"][:].reshape(-1, count)
            np.testing.assert_array_equal(data["von_mises_largest"][:], over_time.max(axis=0))
            np.testing.assert_array_equal(data["time_of_largest"][:], f["VTKHDF/Steps/Values"][:][over_time.argmax(axis=0)])

    def test_stress_refuses_what_belongs_to_the_other_use(self):
        self.assertIn("--gravity", hersey("stress", self.results, "--gravity", "0,0,1", expect=2))
        self.assertIn("--body", hersey("stress", os.path.join(self.folder, "conrod.msh"), "--body", "rod", expect=2))
        self.assertIn("rod", hersey("stress", self.results, "--body", "pin", expect=2))


class RigidBodiesTest(unittest.TestCase):
    """Meshes of bodies that are rigid in their run: a shell in ground and a journal, turned and with asperities."""

    MODEL = os.path.join(ROOT, "tests/cli/bearing.yaml")

    def test_rigid_shell_and_journal_take_opposite_loads(self):
        with tempfile.TemporaryDirectory() as folder:
            hersey("run", self.MODEL, "--output", folder)
            results = os.path.join(folder, "results.h5")
            with h5py.File(results) as f:
                (name,) = f["bearings"]
                film = f["bearings"][name]
                radius, width = 1e3 * film.attrs["radius"], 1e3 * film.attrs["width"]
                shell, journal = film.attrs["inboard"], film.attrs["outboard"]
            ring_mesh(os.path.join(folder, "shell.inp"), radius, 1.5 * radius, width)
            ring_mesh(os.path.join(folder, "shaft.inp"), 0.5 * radius, radius, width)
            wrenches = {}
            for body, mesh in ((shell, "shell"), (journal, "shaft")):
                out = os.path.join(folder, mesh)
                hersey("export", results, "--loads", "calculix", "--instant", "all", "--body", body, "--mesh",
                       os.path.join(folder, mesh + ".inp"), "--length-unit", "mm", "--youngs-modulus", "210GPa",
                       "--poisson-ratio", "0.3", "--output", out)
                read = CalculixMesh(os.path.join(out, body + "_mesh.inp"))
                steps = calculix_steps(os.path.join(out, body + "_steps.inp"))
                unit = {face: read.wrench(*face) for face in steps[0]}
                wrenches[mesh] = [sum(p * unit[face] for face, p in step.items()) for step in steps]
            with h5py.File(results) as f:
                film = f["bearings"][name]
                rows = [int(np.argmin(abs(f["time"][:] - t))) for t in film["fields/time"][:]]
                turned = [rotation(f[f"bodies/{journal}/orientation"][row]) for row in rows]
                force = film["force_pressure"][:][rows]
                self.assertFalse(film["force_asperity"][:].any())
            self.assertGreater(max(abs(R[1, 0]) for R in turned), 0.5)  # the journal has rotated by 30 deg or more
            for shell_wrench, shaft_wrench, R, expected in zip(wrenches["shell"], wrenches["shaft"], turned, force):
                size = np.linalg.norm(expected)  # none at the start, where the journal is in the middle
                self.assertLessEqual(np.linalg.norm(shell_wrench[:2] - expected[:2]), AS_FILM * size)
                reaction = R @ shaft_wrench[:3]
                self.assertLessEqual(np.linalg.norm(reaction[:2] + expected[:2]), AS_FILM * size)


class NodalBodyTest(unittest.TestCase):
    """A body whose results have no amplitudes of shapes."""

    def test_stress_of_a_nodal_body_says_what_to_write(self):
        with tempfile.TemporaryDirectory() as folder:
            text = text_of(ROOT, "examples/flexible_big_end/model.yaml")
            text = text[:text.index("study:")].replace("../meshes/", "").replace("duration: 20 rev", "duration: 5 deg")
            text = re.sub(r" *settle:.*\n| *modes: 10\n", "", text).replace("form: modal", "form: nodal")
            shutil.copy(os.path.join(ROOT, "examples/meshes/conrod.msh"), folder)
            with open(os.path.join(folder, "model.yaml"), "w", encoding="utf-8") as file:
                file.write(text)
            hersey("run", os.path.join(folder, "model.yaml"), "--output", folder)
            said = hersey("stress", os.path.join(folder, "results.h5"), expect=2)
            self.assertIn("body rod is `form: nodal`", said)
            self.assertIn("`output: {meshes_at: [370 deg]}`", said)


def rotation(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


if __name__ == "__main__":
    unittest.main()
