#!/usr/bin/python3
"""Behaviour of the command line, as documented by `hersey --help`: exit codes, messages, files kept, Ctrl-C."""

import glob
import itertools
import json
import math
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

HERSEY = os.path.abspath(sys.argv.pop(1))
HERE = os.path.dirname(os.path.abspath(__file__))
MODEL = os.path.join(HERE, "bearing.yaml")
ALONE = os.path.join(HERE, "../../examples/bearing_alone/model.yaml")

OK, FAILED, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130


def hersey(*arguments, **options):
    """Runs the program to its end and returns the finished process with its output as text."""
    return subprocess.run([HERSEY, *arguments], capture_output=True, text=True, timeout=600,
                          stdin=subprocess.DEVNULL, **options)


def hdf5(path, mode="r"):
    """The file, opened. Importing h5py takes longer than most tests here, which do without."""
    import h5py
    return h5py.File(path, mode)


def write_hollow_shaft(path, inner, outer, width, around=48, along=4, through=3):
    """Hexahedra about the z-axis, the middle in the origin, with the set of nodes `bore`; lengths in mm."""
    def label(layer, i, k):
        return 1 + layer + (through + 1) * ((i % around) + around * k)

    lines, bore = ["*NODE"], []
    for k in range(along + 1):
        for i in range(around):
            bore.append(f"{label(0, i, k)},")
            for layer in range(through + 1):
                phi, r = 2 * math.pi * i / around, inner + (outer - inner) * layer / through
                lines.append(f"{label(layer, i, k)}, {r * math.cos(phi):.12g}, {r * math.sin(phi):.12g}, "
                             f"{width * k / along - width / 2:.12g}")
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=all")
    for n, (k, i, layer) in enumerate(itertools.product(range(along), range(around), range(through))):
        corners = [label(layer + a, i + b, z) for z in (k, k + 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        lines.append(", ".join(map(str, [n + 1] + corners)))
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines + ["*NSET, NSET=bore"] + bore) + "\n")


class CommandLine(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="hersey-cli-")
        self.addCleanup(self._folder.cleanup)
        self.out = os.path.join(self._folder.name, "out")

    def results(self):
        return sorted(glob.glob(os.path.join(self.out, "**", "*.h5"), recursive=True))

    def wait_for_rows(self, process):
        """Until the results of a run under way have some rows, which go to the file every half second or so."""
        deadline = time.monotonic() + 60
        while process.poll() is None and time.monotonic() < deadline:
            try:
                with hdf5(self.results()[0]) as file:
                    if min(len(file["time"]), len(file["bearings/main/h_min"])) > 1:
                        return
            except (IndexError, KeyError, OSError, RuntimeError):  # not there yet, or in the middle of a flush
                pass
            time.sleep(0.05)
        process.kill()
        self.fail("no rows within a minute")

    def model_with(self, old, new):
        """The test model with one text replaced, in a file of its own."""
        with open(MODEL, encoding="utf-8") as file:
            text = file.read()
        self.assertIn(old, text)
        path = os.path.join(self._folder.name, "model.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace(old, new))
        return path

    def position(self, path, text):
        """`line:column` of the first occurrence of text, counted from one."""
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file, 1):
                if text in line:
                    return f"{number}:{line.index(text) + 1}"
        self.fail(f"{text} is not in {path}")

    def test_help_names_every_command_and_every_exit_code(self):
        run = hersey("--help")
        self.assertEqual(run.returncode, OK, run.stderr)
        for word in ("run", "check", "report", "schema", "130"):
            self.assertIn(word, run.stdout)
        for command in ("run", "check", "report", "schema", "bearing", "mesh", "reduce", "modes", "stress"):
            help_of_command = hersey(command, "--help")
            self.assertEqual(help_of_command.returncode, OK, help_of_command.stderr)
            self.assertGreater(len(help_of_command.stdout.splitlines()), 4)

    def test_version_is_the_project_s(self):
        run = hersey("--version")
        self.assertEqual(run.returncode, OK)
        self.assertRegex(run.stdout, r"\b\d+\.\d+\.\d+\b")

    def test_licences_name_every_library_that_is_linked(self):
        with open(os.path.join(HERE, "../../THIRD_PARTY.md"), encoding="utf-8") as file:
            printed = file.read()
        dynamic = subprocess.run(["readelf", "-d", HERSEY], capture_output=True, text=True, check=True).stdout
        libraries = re.findall(r"NEEDED.*\[lib(\w+?)[-.\]]", dynamic)
        self.assertGreater(len(libraries), 8)
        # Where the package is not called as its library: part of the C library's, of OpenBLAS' or of MUMPS'.
        packages = {"dmumps_seq": "mumps-seq", "mumps_common_seq": "mumps-seq", "hdf5_serial": "hdf5", "yaml": "yaml-cpp",
                    "gcc_s": "gcc-s1", "blas": "openblas", "lapack": "openblas"}
        for library in libraries:
            if library not in ("c", "m", "dl", "pthread"):
                self.assertIn("lib" + packages.get(library, library), printed, library)

    def test_unknown_option_or_no_command_is_a_usage_error(self):
        for arguments in ((), ("run", MODEL, "--outptu", "x"), ("rnu", MODEL), ("run",)):
            run = hersey(*arguments)
            self.assertEqual(run.returncode, WRONG_INPUT, arguments)
            self.assertTrue(run.stderr.strip(), "a usage error says what is wrong")

    def test_unknown_command_is_reported_with_the_nearest(self):
        run = hersey("rnu", MODEL)
        self.assertEqual((run.returncode, run.stderr), (WRONG_INPUT, "hersey: unknown command 'rnu': did you mean 'run'?\n"))
        run = hersey("simulate", MODEL)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("unknown command 'simulate': expected run, check, report", run.stderr)
        run = hersey("run", MODEL, "--outptu", "x")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("--outptu", run.stderr)

    def test_check_accepts_a_good_model(self):
        run = hersey("check", MODEL)
        self.assertEqual(run.returncode, OK, run.stderr)

    def test_convert_brings_an_older_model_up_to_date(self):
        with open(MODEL, encoding="utf-8") as file:
            today = file.read()
        path = self.model_with("bearings:\n", "bearings: # of today\n")
        done = hersey("convert", path, "--in-place")
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertIn("nothing to convert", done.stderr)
        old = self.model_with("lubricants:\n", "lubricants:\n  engine: {grade: sae_5w_30}  # thin\n")
        self.assertIn("`hersey convert`", hersey("check", old).stderr)
        done = hersey("convert", old)
        place = self.position(old, "sae_5w_30")
        self.assertEqual(done.stderr, f"{old}:{place}: lubricants.engine.grade: sae_5w_30 is written sae_5w30\n")
        self.assertEqual(done.stdout.replace("  engine: {grade: sae_5w30}  # thin\n", ""), today)
        self.assertEqual(hersey("convert", old, "--output", old).returncode, WRONG_INPUT)
        self.assertEqual(hersey("convert", old, "--in-place").returncode, OK)
        self.assertEqual(hersey("check", old).returncode, OK)

    def test_mesh_tells_sets_mass_and_quality(self):
        block = os.path.join(HERE, "../../libs/fem/test/data/block_22.msh")
        run = hersey("mesh", block, "--length-unit", "mm", "--density", "7850 kg/m^3", "--json")
        self.assertEqual(run.returncode, OK, run.stderr)
        mesh = json.loads(run.stdout)
        self.assertEqual(mesh["nodes"], 72)
        self.assertEqual({kind: entry["count"] for kind, entry in mesh["elements"].items()},
                         {"tet10": 6, "wedge15": 4, "hex20": 2})
        self.assertEqual(mesh["sets"]["surfaces"], {"floor": 3, "roof": 2})
        # A trapezium 10 x (8 + 9)/2 x 7 and a box 10 x 9 x 12 mm; Gmsh places nodes to 1e-11.
        self.assertAlmostEqual(mesh["mass"] / (7850 * (595 + 1080) * 1e-9), 1, delta=1e-9)
        self.assertEqual((mesh["units"]["mass"], mesh["units"]["volume"]), ("kg", "m^3"))
        vtu = os.path.join(self._folder.name, "block.vtu")
        text = hersey("mesh", block, "--length-unit", "mm", "--vtu", vtu).stdout
        with open(vtu, "rb") as file:
            self.assertIn(b'Name="shape"', file.read())
        self.assertRegex(text, r"roof +9 +- +2")

    def test_mesh_tells_bores_by_their_places_and_writes_them_as_surfaces(self):
        rod = os.path.join(HERE, "../../examples/flexible_slider_crank/rod.inp")
        run = hersey("mesh", rod, "--length-unit", "mm")
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertIn("--output FILE.msh", run.stdout)
        named = os.path.join(self._folder.name, "named.msh")
        run = hersey("mesh", rod, "--length-unit", "mm", "--output", named, "--json")
        self.assertEqual(run.returncode, OK, run.stderr)
        before = json.loads(run.stdout)
        again = hersey("mesh", named, "--json")
        self.assertEqual(again.returncode, OK, again.stderr)
        after = json.loads(again.stdout)
        self.assertEqual(after["found"], before["found"])
        for surface in before["found"]:
            self.assertEqual(after["sets"]["surfaces"][surface["name"]], surface["faces"])
        self.assertEqual(after["volume"], before["volume"])
        run = hersey("mesh", rod, "--length-unit", "mm", "--output", named)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("--force", run.stderr)
        for arguments, words in ((("--size", "4mm"), ("--size", "a CAD file")),
                                 (("--output", named + ".inp"), ("--output", ".msh"))):
            run = hersey("mesh", rod, "--length-unit", "mm", *arguments)
            self.assertEqual(run.returncode, WRONG_INPUT)
            for word in words:
                self.assertIn(word, run.stderr)

    def program_called_gmsh(self, script):
        """A folder that has nothing but a stand-in for gmsh, a shell script, and what that needs, for PATH."""
        folder = os.path.join(self._folder.name, "programs")
        os.makedirs(folder, exist_ok=True)
        path = os.path.join(folder, "gmsh")
        with open(path, "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\n" + script)
        os.chmod(path, 0o755)
        self.scratch = os.path.join(self._folder.name, "scratch")
        os.makedirs(self.scratch, exist_ok=True)
        return {**os.environ, "PATH": folder, "TMPDIR": self.scratch}

    def cad_file(self, name="part.step"):
        path = os.path.join(self._folder.name, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write("ISO-10303-21;\n#1=( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );\nEND-ISO-10303-21;\n")
        return path

    def test_mesh_of_a_cad_file_is_made_by_the_program_gmsh(self):
        part = self.cad_file()
        housing = os.path.join(HERE, "../../examples/meshes/bearing_housing.msh")
        asked = os.path.join(self._folder.name, "asked")
        environment = self.program_called_gmsh(f"/bin/cat part.geo >{asked}\n/bin/cp {housing} part.msh\n")
        run = hersey("mesh", part, "--size", "8mm", "--order", "1", env=environment)
        self.assertEqual(run.returncode, OK, run.stderr)
        with open(asked, encoding="utf-8") as file:
            script = file.read()
        self.assertIn("CharacteristicLengthMax = 8;", script)
        self.assertIn("ElementOrder = 1;", script)
        self.assertIn("in millimetres", run.stdout)
        made = os.path.join(self._folder.name, "part.msh")
        self.assertIn(f"written   {made}: in metres", run.stdout)
        self.assertRegex(run.stdout, r"bore: \{shell: part.bore, shell_surface: \{faces: bore\}, diameter: 52 mm, width: 30 mm\}")
        self.assertIn("screw_1: {nodes: screw_1, origin: -62 -51 0 mm, rotation: {axis: -1 0 0, angle: 90 deg}", run.stdout)
        # What is written is in metres: the housing's mass is that of its page.
        mesh = json.loads(hersey("mesh", made, "--density", "7850kg/m^3", "--json").stdout)
        self.assertAlmostEqual(mesh["mass"], 1.63, delta=0.005)  # its digits
        self.assertEqual(hersey("mesh", part, "--size", "8mm", env=environment).returncode, WRONG_INPUT)  # it exists
        self.assertEqual(hersey("mesh", part, "--size", "8mm", "--force", env=environment).returncode, OK)
        self.assertEqual(os.listdir(self.scratch), [])

    def test_mesh_of_a_cad_file_that_cannot_be_made_says_why(self):
        part = self.cad_file()
        made = os.path.join(self._folder.name, "part.msh")
        for script, code, words in (
                ("exit 127\n", FAILED, ("gmsh is not installed", "apt-get install gmsh")),
                ("echo 'Error   : Unknown entity'; exit 1\n", FAILED, ("exit code 1", "gmsh: Error   : Unknown entity")),
                ("kill -SEGV $$\n", FAILED, ("signal 11",)),
                ("exit 0\n", FAILED, ("no mesh of solids",)),
                ("while :; do :; done\n", FAILED, ("longer than 0.3 s", "--time-limit"))):
            run = hersey("mesh", part, "--size", "8mm", "--time-limit", "0.3s", env=self.program_called_gmsh(script))
            self.assertEqual(run.returncode, code, script)
            for word in words:
                self.assertIn(word, run.stderr)
            self.assertFalse(os.path.exists(made))
            self.assertEqual(os.listdir(self.scratch), [])
        without = {**os.environ, "PATH": self._folder.name}
        run = hersey("mesh", part, "--size", "8mm", env=without)
        self.assertEqual(run.returncode, FAILED)
        self.assertIn("gmsh is not installed", run.stderr)
        for arguments, words in (((part,), ("--size 4mm",)),
                                 ((part, "--size", "4"), ("--size", "length")),
                                 ((part, "--size", "8mm", "--length-unit", "mm"), ("--length-unit", "say their unit")),
                                 ((part + ".stp", "--size", "8mm"), ("check its path",))):
            run = hersey("mesh", *arguments, env=without)
            self.assertEqual(run.returncode, WRONG_INPUT, arguments)
            for word in words:
                self.assertIn(word, run.stderr)

    def test_mesh_of_a_cad_file_ends_with_gmsh_on_ctrl_c(self):
        started = os.path.join(self._folder.name, "started")
        environment = self.program_called_gmsh(f"echo $$ >{started}.new\n/bin/mv {started}.new {started}\n"
                                               "while :; do :; done\n")
        with subprocess.Popen([HERSEY, "mesh", self.cad_file(), "--size", "8mm"], env=environment,
                              stderr=subprocess.PIPE, text=True) as process:
            while not os.path.exists(started):
                time.sleep(0.02)
            process.send_signal(signal.SIGINT)
            self.assertIn("stopped on request", process.communicate(timeout=60)[1])
        self.assertEqual(process.returncode, INTERRUPTED)
        with open(started, encoding="utf-8") as file:
            stand_in = int(file.read())
        with self.assertRaises(ProcessLookupError):
            os.kill(stand_in, 0)
        self.assertEqual(os.listdir(self.scratch), [])

    @unittest.skipUnless(shutil.which("gmsh"), "gmsh is not installed: the meshes of CAD files are tried by a stand-in alone")
    def test_mesh_of_a_step_file_by_gmsh_itself(self):
        # A block with a bore in two halves, of two solids that touch, a screw's hole, and a fillet.
        script = os.path.join(self._folder.name, "part.geo")
        with open(script, "w", encoding="utf-8") as file:
            file.write('SetFactory("OpenCASCADE");\n'
                       "Box(1) = {-40, -30, -10, 80, 30, 20};\nBox(2) = {-40, 0, -10, 80, 30, 20};\n"
                       "Cylinder(3) = {0, 0, -20, 0, 0, 40, 22.5};\nCylinder(4) = {32, -40, 0, 0, 80, 0, 3};\n"
                       "a() = BooleanDifference{ Volume{1}; Delete; }{ Volume{3, 4}; };\n"
                       "b() = BooleanDifference{ Volume{2}; Delete; }{ Volume{3, 4}; Delete; };\n")
        step = os.path.join(self._folder.name, "part.step")
        subprocess.run(["gmsh", script, "-0", "-o", step], check=True, capture_output=True, timeout=120)
        for order, digits in ((2, 1e-6), (1, 1e-6)):  # corners lie on the cylinder: facets do not disturb the fit
            run = hersey("mesh", step, "--size", "12mm", "--around", "12", "--order", str(order), "--force",
                         "--json")
            self.assertEqual(run.returncode, OK, run.stderr)
            mesh = json.loads(run.stdout)
            bores = [surface for surface in mesh["found"] if surface.get("could_be") == "bore"]
            self.assertEqual([bore["name"] for bore in bores], ["bore_d45_at_0_0_0"])
            self.assertAlmostEqual(bores[0]["diameter"] / 0.045, 1, delta=digits)
            self.assertAlmostEqual(bores[0]["width"] / 0.020, 1, delta=digits)
            self.assertAlmostEqual(bores[0]["arc"], 2 * math.pi, delta=1e-6)
            self.assertIn(bores[0]["name"], mesh["sets"]["surfaces"])
            for name in ("plane_x_min", "plane_x_max", "plane_y_min", "plane_y_max", "plane_z_min", "plane_z_max",
                         "hole_d6_at_32_0_0"):
                self.assertIn(name, mesh["sets"]["surfaces"])

    def test_mesh_in_millimetres_read_as_metres_is_warned_of(self):
        run = hersey("mesh", os.path.join(HERE, "../../libs/fem/test/data/block_22.msh"))
        self.assertEqual(run.returncode, OK)
        self.assertIn("is the mesh in millimetres?", run.stderr)

    def test_reduce_writes_the_documented_file(self):
        rod = os.path.join(HERE, "../../examples/meshes/conrod.msh")
        file = os.path.join(self._folder.name, "rod.h5")
        arguments = ("reduce", rod, "--length-unit", "mm", "--youngs-modulus", "210 GPa", "--poisson-ratio", "0.3",
                     "--frame", "big_end:average", "--frame", "pin=small_end", "--modes", "3", "--output", file)
        run = hersey(*arguments)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("--density", run.stderr)
        run = hersey(*arguments, "--density", "7850 kg/m^3")
        self.assertEqual(run.returncode, OK, run.stderr)
        with hdf5(file) as body:
            self.assertEqual(bytes(body["format"][:]).decode(), "hersey reduced body 1")
            self.assertEqual(bytes(body["frames/1/name"][:]).decode(), "pin")
            self.assertEqual(body["Phi"].shape, (3 * body["nodes"].shape[0], 15))
            # A pull of both frames along y moves the whole body: its mass is that of the mesh, 0.462 kg.
            along_y = [4, 10]
            moved = sum(body["M"][i, j] for i in along_y for j in along_y)
            self.assertAlmostEqual(moved / sum(body["mass/values"][:]), 1, delta=1e-9)
            self.assertAlmostEqual(moved, 0.4621, delta=1e-4)
        run = hersey(*arguments, "--density", "7850 kg/m^3")
        self.assertIn("--force", run.stderr, "a file that exists is kept")
        run = hersey(*arguments, "--density", "7850 kg/m^3", "--force", "--load", "big_end", "--static-error", "1%")
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertRegex(run.stdout, r"big_end +18 +\d\d\.\d %")
        run = hersey(*arguments, "--density", "7850 kg/m^3", "--force", "--load", "bigend")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("did you mean 'big_end'", run.stderr)
        run = hersey(*arguments, "--density", "7850 kg/m^3", "--force", "--static-error", "1%")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("--load SET", run.stderr)
        run = hersey(*arguments[:-1], file + "2", "--density", "7850 kg/m^3", "--frame", "smal_end")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("'small_end'", run.stderr)

    def test_reduce_refuses_matrices_of_a_body_that_is_fixed(self):
        tetrahedron = os.path.join(self._folder.name, "t.inp")
        with open(tetrahedron, "w", encoding="utf-8") as file:
            file.write("*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=all\n17,1,2,3,4\n")
        matrix = os.path.join(self._folder.name, "one.mtx")
        with open(matrix, "w", encoding="utf-8") as file:
            file.write("%%MatrixMarket matrix coordinate real symmetric\n12 12 12\n")
            file.writelines(f"{k} {k} 1.0\n" for k in range(1, 13))
        arguments = ("reduce", tetrahedron, "--frame", "all", "--output", os.path.join(self._folder.name, "t.h5"))
        run = hersey(*arguments, "--stiffness", matrix, "--mass", matrix)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("one.mtx: a stiffness that resists", run.stderr)
        run = hersey(*arguments, "--stiffness", matrix)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("both matrices", run.stderr)

    def test_stress_of_an_orthotropic_body_with_equal_constants_is_that_of_the_isotropic_one(self):
        rod = os.path.join(HERE, "../../examples/meshes/conrod.msh")
        arguments = ("stress", rod, "--length-unit", "mm", "--hold", "small_end", "--json")
        pressed = ("--pressure", "big_end=30MPa:0,-1,0")
        run = hersey(*arguments, *pressed, "--youngs-modulus", "208GPa", "--poisson-ratio", "0.3")
        self.assertEqual(run.returncode, OK, run.stderr)
        printed = json.loads(run.stdout)
        self.assertAlmostEqual(printed["reaction"][1] / 16540.4, 1, delta=1e-5)
        nine = "208GPa,208GPa,208GPa,0.3,0.3,0.3,80GPa,80GPa,80GPa"
        run = hersey(*arguments, *pressed, "--orthotropic", nine)
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertAlmostEqual(json.loads(run.stdout)["strain_energy"] / printed["strain_energy"], 1, delta=1e-9)
        for wrong, remedy in ((nine.replace("0.3,0.3", "1.3,0.3"), "constants of no material"), ("1GPa,2GPa", "nine")):
            run = hersey(*arguments, *pressed, "--orthotropic", wrong)
            self.assertEqual(run.returncode, WRONG_INPUT)
            self.assertIn(remedy, run.stderr)
        for wrong in ("big_end=30MPa:0,1", "big_end=30MPa:0,0,0", "bigend=30MPa"):
            run = hersey(*arguments, "--pressure", wrong, "--orthotropic", nine)
            self.assertEqual(run.returncode, WRONG_INPUT)
            self.assertIn("--pressure", run.stderr)

    def test_modes_of_a_fixed_body_are_those_of_calculix(self):
        mesh = os.path.join(HERE, "../../verification/data/meshes/cant_tet10.inp")
        vtu = os.path.join(self._folder.name, "modes.vtu")
        run = hersey("modes", mesh, "--hold", "FIX", "--count", "6", "--vtu", vtu, "--json")
        self.assertEqual(run.returncode, OK, run.stderr)
        printed = json.loads(run.stdout)
        for frequency, reference in zip(printed["frequencies"], (50.252, 83.228, 309.852, 499.221, 664.174, 846.585)):
            self.assertAlmostEqual(frequency / reference, 1, delta=2e-5)
        with open(vtu, "rb") as file:
            self.assertIn(b'Name="mode_6"', file.read())
        self.assertEqual((printed["units"], printed["held"]), ({"frequencies": "Hz", "mass": "kg"}, ["FIX"]))
        free = hersey("modes", mesh, "--count", "7").stdout
        self.assertRegex(free, r"free +6 rigid motions")
        self.assertRegex(free, r"1 +0 +rigid")
        self.assertIn("315.06", free)

    def test_stress_of_a_fixed_body(self):
        mesh = os.path.join(HERE, "../../verification/data/meshes/cant_tet10.inp")
        vtu = os.path.join(self._folder.name, "stress.vtu")
        run = hersey("stress", mesh, "--hold", "FIX", "--gravity", "0,0,-9.81", "--vtu", vtu, "--json")
        self.assertEqual(run.returncode, OK, run.stderr)
        printed = json.loads(run.stdout)
        self.assertAlmostEqual(printed["largest_displacement"]["value"] / 1.5177e-4, 1, delta=2e-3)
        self.assertAlmostEqual(printed["reaction"][2] / (47.1 * 9.81), 1, delta=1e-6)
        with open(vtu, "rb") as file:
            content = file.read()
        for field in (b'Name="displacement"', b'Name="stress"', b'Name="von_mises"'):
            self.assertIn(field, content)

    def test_stress_of_a_body_that_heat_flows_through(self):
        bar = os.path.join(HERE, "../../verification/data/meshes/cant_hex20.inp")
        vtu = os.path.join(self._folder.name, "heat.vtu")
        arguments = ("stress", bar, "--hold", "FIX", "--expansion", "12e-6 1/K")
        run = hersey(*arguments, "--conductivity", "46W/m/K", "--temperature", "FIX=20degC",
                     "--cooling", "TIP=500W/m^2/K:100degC", "--vtu", vtu, "--json")
        self.assertEqual(run.returncode, OK, run.stderr)
        heat = json.loads(run.stdout)["heat"]
        resistance = 1 / (46 * 0.006) + 1 / (500 * 0.006)  # along the bar and to the air, K/W
        self.assertAlmostEqual(heat["leaving"][1]["power"] * resistance / 80, 1, delta=1e-8)
        self.assertEqual([out["name"] for out in heat["leaving"]], ["TIP", "FIX"])
        self.assertAlmostEqual(heat["hottest"]["value"], 293.15 + 80 / resistance / (46 * 0.006), delta=1e-6)
        with open(vtu, "rb") as file:
            self.assertIn(b'Name="temperature"', file.read())
        run = hersey(*arguments, "--temperature", "80degC", "--json")
        self.assertAlmostEqual(json.loads(run.stdout)["strain_energy"] / 11.13426, 1, delta=1e-6)
        self.assertIn("hottest               80.0000 degC", hersey(*arguments, "--temperature", "80degC").stdout)
        for wrong, words in (
                (("--heat", "TIP=5W", "--conductivity", "46W/m/K"), ("nowhere to go", "--cooling", "--temperature")),
                (("--heat", "TIP=5W"), ("--conductivity", "46W/m/K")),
                (("--heat", "TOP=5W", "--conductivity", "46W/m/K"), ("--heat", "'TOP'", "did you mean 'TIP'")),
                (("--cooling", "TIP=5W/m^2/K", "--conductivity", "46W/m/K"), ("--cooling", "SURFACE=80W/m^2/K:20degC")),
                (("--temperature", "80degC", "--heat", "TIP=5W"), ("--temperature", "SET=80degC")),
                (("--temperature", "FIX=80mm", "--conductivity", "46W/m/K"), ("--temperature", "a temperature"))):
            run = hersey(*arguments, *wrong)
            self.assertEqual(run.returncode, WRONG_INPUT, (wrong, run.stdout))
            for word in words:
                self.assertIn(word, run.stderr, wrong)

    def test_what_a_solid_lacks_is_reported(self):
        mesh = os.path.join(HERE, "../../verification/data/meshes/cant_tet10.inp")
        block = os.path.join(HERE, "../../libs/fem/test/data/block_22.msh")
        steel = ("--youngs-modulus", "210GPa", "--poisson-ratio", "0.3")
        for arguments, words in (
                (("stress", mesh, "--gravity", "0,0,-9.81"), ("not supported", "--hold")),
                (("stress", mesh, "--hold", "FIX"), ("--pressure", "--gravity")),
                (("stress", mesh, "--hold", "FXI", "--gravity", "0,0,-1"), ("--hold", "FXI", "did you mean 'FIX'")),
                (("stress", mesh, "--hold", "FIX:xw", "--gravity", "0,0,-1"), ("--hold", "x, y and z")),
                (("stress", mesh, "--hold", "FIX", "--gravity", "down"), ("--gravity", "three numbers")),
                (("stress", block, *steel, "--hold", "floor", "--pressure", "rof=1bar"), ("--pressure", "'roof'")),
                (("stress", block, *steel, "--hold", "floor", "--pressure", "roof"), ("--pressure", "SURFACE=20MPa")),
                (("modes", block, "--hold", "floor"), ("--youngs-modulus", "--poisson-ratio", "--density")),
                (("modes", block, *steel, "--density", "-1kg/m^3"), ("--density",)),
                (("modes", mesh, "--poisson-ratio", "0.5"), ("--poisson-ratio", "0.5"))):
            run = hersey(*arguments)
            self.assertEqual(run.returncode, WRONG_INPUT, (arguments, run.stdout))
            for word in words:
                self.assertIn(word, run.stderr, arguments)

    def test_mesh_that_is_unfit_is_refused_with_labels(self):
        folded = os.path.join(self._folder.name, "folded.inp")
        with open(folded, "w", encoding="utf-8") as file:
            file.write("*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4\n17,1,3,2,4\n")
        for arguments in ((), ("--json",)):
            run = hersey("mesh", folded, *arguments)
            self.assertEqual(run.returncode, WRONG_INPUT)
            self.assertIn("Jacobian that is not positive: 17", run.stdout + run.stderr)
        run = hersey("mesh", folded, "--length-unit", "kg")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("--length-unit", run.stderr)

    def test_material_that_the_mesh_file_lacks_is_reported_with_both_names(self):
        mesh = os.path.join(self._folder.name, "dangling.inp")
        with open(mesh, "w", encoding="utf-8") as file:
            file.write("*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=all\n1,1,2,3,4\n"
                       "*NSET,NSET=floor\n1,2,3\n"
                       "*MATERIAL,NAME=Alu\n*DENSITY\n2700\n*ELASTIC\n7e10,0.3\n"
                       "*MATERIAL,NAME=Steel\n*DENSITY\n7850\n*ELASTIC\n2.1e11,0.3\n"
                       "*SOLID SECTION,ELSET=all,MATERIAL=STELL\n")
        printed = f"{mesh}:20: the section of 'all' names the material 'STELL', which the file does not define"
        run = hersey("mesh", mesh)
        self.assertEqual(run.returncode, 0)
        self.assertIn(printed, run.stderr)
        self.assertIn("mass      unknown", run.stdout)
        run = hersey("modes", mesh, "--hold", "floor", "--count", "1")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn(printed, run.stderr)
        run = hersey("reduce", mesh, "--frame", "floor", "--output", os.path.join(self._folder.name, "dangling.h5"))
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn(printed, run.stderr)
        # What the command line says of the material stands above the file.
        constants = ("--youngs-modulus", "210GPa", "--poisson-ratio", "0.3", "--density", "7850kg/m^3")
        self.assertEqual(hersey("modes", mesh, "--hold", "floor", "--count", "1", *constants).returncode, 0)

    def test_fault_names_file_line_column_and_the_nearest_key(self):
        path = self.model_with("radial_clearance", "radial_clearence")
        for command in (["check", path], ["run", path, "--output", self.out]):
            run = hersey(*command)
            self.assertEqual(run.returncode, WRONG_INPUT, run.stdout + run.stderr)
            self.assertIn(f"{path}:{self.position(path, 'radial_clearence')}", run.stderr)
            self.assertIn("'radial_clearance'", run.stderr.replace('"', "'").replace("`", "'"))
        self.assertEqual(self.results(), [], "a run that cannot start leaves no results")

    def test_all_faults_of_a_file_are_shown_together(self):
        path = self.model_with("diameter: 45 mm", "diameter: 45 kg")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace("body: shaft", "body: shaff"))
        run = hersey("check", path)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn(f"{path}:{self.position(path, '45 kg')}", run.stderr)
        self.assertIn(f"{path}:{self.position(path, 'shaff')}", run.stderr)

    def test_missing_model_file_is_named(self):
        run = hersey("run", "/nowhere/model.yaml")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("/nowhere/model.yaml", run.stderr)

    def test_wrong_override_is_named(self):
        run = hersey("check", MODEL, "--set", "loda=500N")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("loda", run.stderr)
        self.assertIn("load", run.stderr.replace("loda", ""))

    def test_run_writes_readable_results_and_a_report(self):
        run = hersey("run", MODEL, "--output", self.out)
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertEqual(len(self.results()), 1)
        with hdf5(self.results()[0]) as file:
            self.assertEqual(file.attrs["status"], "completed")
            self.assertAlmostEqual(file["time"][-1], 2e-3, delta=1e-9)  # the end is a step, up to round-off
            self.assertGreater(file["bearings/main/h_min"][-1], 0)
        with open(os.path.join(self.out, "report.html"), encoding="utf-8") as file:
            self.assertIn("Journal in a fixed bush", file.read())

    def test_energy_that_goes_nowhere_is_reported(self):
        path = os.path.join(self._folder.name, "model.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write("""hersey: 1
gravity: 0 0 0 m/s^2
bodies:
  block: {mass: 1 kg, inertia: {xx: 1 kg.m^2, yy: 1 kg.m^2, zz: 1 kg.m^2}, frames: {far: {origin: 1 0 0 m}}}
joints:
  guide: {type: prismatic, between: [ground, block], axis: x, initial: {translation: 1 mm}}
forces:
  spring: {type: sliding_spring, joint: guide, stiffness: 1 N/mm}
simulation: {duration: 2 s, step: 100 ms, spectral_radius: 0}
""")
        ended = hersey("run", path, "--output", self.out)
        self.assertEqual(ended.returncode, OK, ended.stderr)
        self.assertRegex(ended.stderr, r"warning: 0\.0005 J, 100 % of the energy at the start and put in since, is neither stored nor lost")
        ended = hersey("run", path, "--set", "simulation.step=5ms", "--set", "simulation.spectral_radius=0.9", "--output", self.out, "--force")
        self.assertNotIn("warning", ended.stderr)

    def test_run_that_explodes_ends_as_failed(self):
        path = os.path.join(self._folder.name, "model.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write("""hersey: 1
bodies:
  m: {mass: 1 kg, inertia: {xx: 0.01 kg.m^2, yy: 0.01 kg.m^2, zz: 0.01 kg.m^2}}
joints:
  j: {type: free, between: [ground, m], initial: {position: 1 0 0 m, velocity: 0 3 0 m/s}}
forces:
  s: {type: spring_damper, between: [ground, m], stiffness: 1e6 N/m, free_length: 0.9 m}
simulation: {duration: 200 s, step: 0.2 s, spectral_radius: 0.9}
""")
        ended = hersey("run", path, "--output", self.out, "--json")
        self.assertEqual(ended.returncode, 1, ended.stderr)
        found = json.loads(ended.stdout)["runs"][0]
        self.assertEqual(found["status"], "failed")
        self.assertRegex(found["message"], r"^t = 0\.2\d* s: .* in body m, where force s acts; .* shorter `simulation.step`")
        self.assertAlmostEqual(found["energy"]["available"], 5004.5, delta=0.01)
        self.assertLess(found["energy"]["share_from_nowhere"], 0.2)
        with hdf5(self.results()[0]) as file:
            self.assertEqual(file.attrs["status"], "failed")
            self.assertEqual(file["time"][-1], found["t_results"])

    def test_override_of_parameter_and_of_key_path_reach_the_run(self):
        run = hersey("run", MODEL, "--output", self.out, "--set", "load=500 N", "--set",
                     "bearings.main.grid.circumferential=20")
        self.assertEqual(run.returncode, OK, run.stderr)
        with hdf5(self.results()[0]) as file:
            self.assertEqual(file["bearings/main/fields/pressure"].shape[1:], (20, 5))
            self.assertIn("500", str(file["parameters"].attrs["load"]))

    def test_bearing_says_how_roughness_and_surroundings_were_read(self):
        run = hersey("bearing", ALONE, "--set", "bearings.main.roughness={shell: {sigma: 0.4 um, gamma: 3}}",
                     "--set", "bearings.main.ambient_fill=0.5")
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertIn("flow factors of Patir and Cheng: rms roughness of the shell 0.4 um, gamma 3, of the journal smooth",
                      run.stdout)
        self.assertIn("left one in 0.5 of oil", run.stdout)
        run = hersey("bearing", ALONE, "--set", "bearings.main.roughness={shell: {sigma: 0.4 um, gamma: 30}}")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("roughness.shell.gamma", run.stderr)

    def test_bearing_by_itself_finds_its_position_and_its_load(self):
        run = hersey("bearing", ALONE, "--json")
        self.assertEqual(run.returncode, OK, run.stderr)
        figures = json.loads(run.stdout)["solutions"][0]["figures"]
        self.assertAlmostEqual(figures["load"]["value"], 2500, places=4)
        # paper_case.csv, c = 34 um, rigid, Reynolds rupture: 0.83476, 5.618 um, 15.136 MPa
        self.assertAlmostEqual(figures["eccentricity_ratio"]["value"], 0.8348, delta=0.001)
        self.assertEqual(figures["h_min"]["unit"], "m")
        self.assertAlmostEqual(figures["h_min"]["value"], 5.618e-6, delta=0.03e-6)
        self.assertLess(figures["h_min"]["grid_error"], 0.1e-6)
        self.assertAlmostEqual(figures["p_max"]["value"], 15.136e6, delta=0.15e6)
        in_si = {"", "m", "rad", "rad/s", "Pa", "N", "N.m", "W", "m^3", "m^3/s", "kg", "N/m", "N.s/m"}
        self.assertLessEqual({f["unit"] for f in figures.values()}, in_si)
        back = hersey("bearing", ALONE, "--json", "--eccentricity-ratio",
                      str(figures["eccentricity_ratio"]["value"]), "--eccentricity-angle",
                      f"{figures['eccentricity_angle']['value']}rad")
        self.assertEqual(back.returncode, OK, back.stderr)
        load = json.loads(back.stdout)["solutions"][0]["figures"]["load"]["value"]
        self.assertAlmostEqual(load, 2500, delta=0.1)

    def test_bearing_refuses_a_shell_that_turns_with_pockets(self):
        ended = hersey("bearing", ALONE, "--shell-speed", "100rpm", "--set",
                       "bearings.main.features={pad: {shape: pocket, on: shell, angle: 0 deg, arc: 30 deg, length: 5 mm, depth: 10 um}}")
        self.assertEqual(ended.returncode, WRONG_INPUT, ended.stdout + ended.stderr)
        self.assertIn("a rotating shell with pockets that nothing feeds", ended.stderr)
        self.assertIn("exchange journal and shell", ended.stderr)

    def test_bearing_prints_the_error_of_the_grid(self):
        run = hersey("bearing", ALONE)
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertRegex(run.stdout, r"minimum film thickness +\d\.\d+ +um +\+- 0\.0\d+ \(grid\)")
        self.assertIn("mass_conserving", run.stdout)

    def test_bearing_of_a_machine_takes_speed_and_load_as_options(self):
        run = hersey("bearing", MODEL, "--speed", "3000rpm", "--load", "200N", "--no-grid-error", "--json")
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertAlmostEqual(json.loads(run.stdout)["solutions"][0]["figures"]["load"]["value"], 200, places=4)
        without = hersey("bearing", MODEL)
        self.assertEqual(without.returncode, WRONG_INPUT)
        self.assertIn("operating_point", without.stderr)

    def test_bearing_on_a_mesh_says_how_its_shell_deforms(self):
        flexible = os.path.join(HERE, "../../examples/flexible_big_end/model.yaml")
        fields, page = (os.path.join(self._folder.name, name) for name in ("fields.csv", "page.html"))
        point = ("--set", "load=2500N", "--set", "variant=mesh", "--speed", "3570rpm", "--load", "2500N",
                 "--load-angle", "90deg")
        run = hersey("bearing", flexible, *point, "--json", "--fields", fields, "--report", page)
        self.assertEqual(run.returncode, OK, run.stderr)
        solution = json.loads(run.stdout)["solutions"][0]
        self.assertIn("supported at small_end", solution["surfaces"]["shell"])
        largest = solution["figures"]["deformation_shell"]["value"]
        with open(fields, encoding="utf-8") as file:
            self.assertTrue(file.readline().endswith(", shell displacement [um]\n"))
            self.assertAlmostEqual(max((float(row.split(",")[-1]) for row in file), key=abs), 1e6 * largest, places=5)
        with open(page, encoding="utf-8") as file:
            self.assertIn("shell_displacement", file.read())
        turning = hersey("bearing", flexible, *point, "--shell-speed", "10rpm")
        self.assertEqual(turning.returncode, WRONG_INPUT)
        self.assertIn("a shell that rotates and deforms", turning.stderr)

    def test_bearing_in_a_body_that_conducts_heat(self):
        pedestal = os.path.join(HERE, "../../examples/hot_pedestal/model.yaml")
        vtu = os.path.join(self._folder.name, "pedestal.vtu")
        grid = ("--set", "bearings.main.grid={circumferential: 40, axial: 9}", "--no-grid-error")
        run = hersey("bearing", pedestal, *grid, "--vtu", vtu, "--json")
        self.assertEqual(run.returncode, OK, run.stderr)
        figures = json.loads(run.stdout)["solutions"][0]["figures"]
        self.assertLess(figures["T_shell_max"]["value"], figures["T_body_max"]["value"] + 1)
        self.assertGreater(figures["heat_to_shell"]["value"], 0.4 * figures["heat_dissipated"]["value"])
        self.assertTrue(5e-6 < figures["bore_growth"]["value"] < 15e-6)
        with open(vtu, "rb") as file:
            self.assertIn(b'Name="temperature"', file.read())
        run = hersey("bearing", ALONE, "--vtu", vtu)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("shell: {wall: body}", run.stderr)
        run = hersey("bearing", pedestal, *grid, "--vtu", vtu, "--sweep", "load=1kN,2kN")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("2 solutions", run.stderr)
        run = hersey("bearing", pedestal, *grid, "--shell-speed", "10rpm")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("temperatures are those of a body", run.stderr)

    def test_bearing_whose_journal_is_in_a_body_as_well(self):
        pedestal = os.path.join(HERE, "../../examples/hot_pedestal/model.yaml")
        mesh, vtu = (os.path.join(self._folder.name, name) for name in ("shaft.inp", "pedestal.vtu"))
        write_hollow_shaft(mesh, inner=10, outer=26, width=30)
        shaft = (f"bodies.shaft={{flexible: {{mesh: {mesh}, length_unit: 1 mm, material: {{youngs_modulus: 210 GPa, "
                 "poisson_ratio: 0.3, density: 7850 kg/m^3}, heat: {conductivity: 46 W/m/K, expansion: 12e-6 1/K, cooling: "
                 "{bore: {heat_transfer: 100 W/m^2/K, ambient: 25 degC}}}}, frames: {axis: {nodes: bore, connection: "
                 "average, origin: 0 0 0 mm}}}")
        both = ("--set", shaft, "--set", "joints.turn.between=[ground, shaft.axis]", "--set",
                "bearings.main.journal=shaft.axis", "--set", "bearings.main.thermal.journal={wall: body}", "--set",
                "bearings.main.grid={circumferential: 40, axial: 9}")
        run = hersey("bearing", pedestal, *both, "--no-grid-error", "--vtu", vtu, "--json")
        self.assertEqual(run.returncode, OK, run.stderr)
        figures = {key: figure["value"] for key, figure in json.loads(run.stdout)["solutions"][0]["figures"].items()}
        self.assertLess(figures["T_journal"], figures["T_journal_body_max"] + 1e-6)
        self.assertTrue(5e-6 < figures["journal_growth"] < 15e-6)
        self.assertLess(figures["journal_distortion"], 0.2 * figures["journal_growth"])
        self.assertAlmostEqual(figures["clearance_of_bodies"],
                               34e-6 + figures["bore_growth"] - figures["journal_growth"], places=12)
        for file in (vtu, os.path.join(self._folder.name, "pedestal_journal.vtu")):
            with open(file, "rb") as content:
                self.assertIn(b'Name="temperature"', content.read())
        printed = hersey("bearing", pedestal, *both, "--no-grid-error")
        self.assertIn("growth of the journal's radius by temperature, mean", printed.stdout)
        self.assertIn("radial clearance with what bodies have grown (hot), mean", printed.stdout)
        run = hersey("bearing", pedestal, *both, "--set", "bearings.main.thermal.shell=insulated", "--speed", "0 rpm",
                     "--shell-speed", "10 rpm")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("a journal at rest, whose temperatures are those of a body", run.stderr)
        run = hersey("bearing", pedestal, *both, "--set", "bodies.shaft.flexible.heat.expansion=100e-6 1/K")
        self.assertIn("a seizure: the clearance of 34 um closes to", run.stderr)

    def test_bearing_sweeps_combine_and_are_written_as_a_table(self):
        table = os.path.join(self._folder.name, "table.csv")
        run = hersey("bearing", ALONE, "--set", "bearings.main.grid.circumferential=40", "--set",
                     "bearings.main.grid.axial=9", "--sweep", "load=100N:500N:3", "--sweep", "clearance=30um,40um",
                     "--csv", table, "--jobs", "2")
        self.assertEqual(run.returncode, OK, run.stderr)
        with open(table, encoding="utf-8") as file:
            lines = file.read().splitlines()
        self.assertEqual(len(lines), 7)
        self.assertTrue(lines[0].startswith("load [N], bearings.main.radial_clearance [um], "))
        self.assertEqual([line.split(", ")[:2] for line in lines[1:3]], [["100", "30"], ["100", "40"]])
        self.assertEqual({len(line.split(", ")) for line in lines}, {len(lines[0].split(", "))})

    def test_bearing_table_has_a_cell_for_each_column_whatever_a_solution_lacks(self):
        table = os.path.join(self._folder.name, "cells.csv")
        # Fed at high pressure the film at small eccentricity is whole and has no angle of rupture.
        run = hersey("bearing", ALONE, "--set", "bearings.main.grid={circumferential: 40, axial: 9}", "--set",
                     "bearings.main.supply.pressure=50 bar", "--set", "bearings.main.edge_pressure=20 bar", "--no-grid-error", "--sweep",
                     "eccentricity_ratio=0.05,0.9", "--csv", table)
        self.assertEqual(run.returncode, OK, run.stderr)
        with open(table, encoding="utf-8") as file:
            lines = [line.split(", ") for line in file.read().splitlines()]
        self.assertEqual({len(line) for line in lines}, {len(lines[0])})
        place = lines[0].index("rupture_angle [deg]")
        self.assertEqual(lines[1][place], "")
        self.assertNotEqual(lines[2][place], "")

    def test_bearing_writes_its_fields(self):
        table = os.path.join(self._folder.name, "fields.csv")
        run = hersey("bearing", ALONE, "--fields", table, "--no-grid-error")
        self.assertEqual(run.returncode, OK, run.stderr)
        with open(table, encoding="utf-8") as file:
            self.assertEqual(len(file.read().splitlines()), 120 * 25 + 1)

    def test_bearing_writes_its_report(self):
        page = os.path.join(self._folder.name, "page.html")
        run = hersey("bearing", ALONE, "--report", page, "--sweep", "load=1kN,2kN", "--no-grid-error")
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertIn("report: ", run.stdout)
        with open(page, encoding="utf-8") as file:
            self.assertIn('"label":"load = 2kN"', file.read())
        nowhere = hersey("bearing", ALONE, "--no-grid-error", "--report", os.path.join(page, "x.html"))
        self.assertEqual(nowhere.returncode, WRONG_INPUT)  # before anything is computed
        self.assertIn("cannot be written", nowhere.stderr)
        self.assertEqual(nowhere.stdout, "")

    def test_bearing_faults_are_wrong_input(self):
        for arguments, word in ((["--bearing", "mian"], "'main'"), (["--sweep", "load=1N:2N"], "first:last:count"),
                                (["--sweep", "lod=1N,2N"], "lod"), (["--load", "3 mm"], "a length"),
                                (["--speed", "0rpm", "--set", "bearings.main.asperities=none"], "drag no oil"),
                                (["--fields", "x", "--sweep", "load=1N,2N"], "single")):
            run = hersey("bearing", ALONE, *arguments)
            self.assertEqual(run.returncode, WRONG_INPUT, arguments)
            self.assertIn(word, run.stderr)

    def test_bearing_without_oil_fails_and_says_why(self):
        with open(ALONE, encoding="utf-8") as file:
            text = file.read()
        path = os.path.join(self._folder.name, "dry.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(re.sub(r"    (supply|asperities): .*\n", "", text))
        dry = hersey("bearing", path)
        self.assertEqual(dry.returncode, FAILED)
        self.assertIn("no oil in", dry.stderr)
        # With the older condition the film forms again from nowhere.
        run = hersey("bearing", path, "--set", "bearings.main.cavitation=reynolds")
        self.assertEqual(run.returncode, OK, run.stderr)

    def test_bearing_alone_cannot_be_run_but_checked(self):
        self.assertEqual(hersey("check", ALONE).returncode, OK)
        run = hersey("run", ALONE, "--output", self.out)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("hersey bearing", run.stderr)
        self.assertFalse(os.path.exists(self.out))

    def test_existing_results_are_kept_unless_forced(self):
        self.assertEqual(hersey("run", MODEL, "--output", self.out).returncode, OK)
        (path,) = self.results()
        with open(path, "rb") as file:
            before = file.read()
        again = hersey("run", MODEL, "--output", self.out)
        self.assertEqual(again.returncode, WRONG_INPUT)
        self.assertIn(os.path.basename(path), again.stderr)
        self.assertIn("--force", again.stderr)
        with open(path, "rb") as file:
            self.assertEqual(file.read(), before, "results were touched without --force")
        forced = hersey("run", MODEL, "--output", self.out, "--set", "duration=1 ms", "--force")
        self.assertEqual(forced.returncode, OK, forced.stderr)
        with hdf5(path) as file:
            self.assertAlmostEqual(file["time"][-1], 1e-3, delta=1e-9)

    def test_json_is_one_document_on_stdout(self):
        for arguments in (["check", MODEL, "--json"], ["run", MODEL, "--output", self.out, "--json"]):
            run = hersey(*arguments)
            self.assertEqual(run.returncode, OK, run.stderr)
            self.assertIsInstance(json.loads(run.stdout), (dict, list))
        document = json.loads(run.stdout)
        self.assertEqual((document["units"]["t_end"], document["units"]["energy"]), ("s", "J"))
        rows = {row["name"]: row for row in document["summary"]}
        with hdf5(document["runs"][0]["results"]) as file:
            smallest = file["bearings/main/h_min"][:].min()
        self.assertEqual(rows["minimum film thickness (MOFT)"]["unit"], "m")
        self.assertAlmostEqual(rows["minimum film thickness (MOFT)"]["value"] / smallest, 1, delta=1e-9)
        report = hersey("report", *self.results(), "--json")
        self.assertEqual(report.returncode, OK, report.stderr)
        json.loads(report.stdout)

    def test_schema_is_json_and_knows_the_top_level_keys(self):
        run = hersey("schema")
        self.assertEqual(run.returncode, OK, run.stderr)
        schema = json.loads(run.stdout)
        for key in ("bodies", "joints", "bearings", "simulation"):
            self.assertIn(key, schema["properties"])

    def test_interrupt_leaves_readable_results_and_the_documented_exit_code(self):
        with subprocess.Popen([HERSEY, "run", MODEL, "--output", self.out, "--set", "duration=1000 s"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                              text=True) as process:
            self.wait_for_rows(process)
            process.send_signal(signal.SIGINT)
            stdout, stderr = process.communicate(timeout=60)
        self.assertEqual(process.returncode, INTERRUPTED, stdout + stderr)
        (path,) = self.results()
        with hdf5(path) as file:
            self.assertEqual(file.attrs["status"], "stopped")
            self.assertGreater(len(file["time"]), 1)
            self.assertEqual(len(file["time"]), len(file["bearings/main/h_min"]))

    def test_interrupt_that_comes_twice_at_once_is_one(self):
        # A terminal signals a program and the wrapper that started it, which passes the signal on. Steps are long here.
        for pause in (0.01, 0.1):
            out = os.path.join(self.out, str(pause))
            with subprocess.Popen([HERSEY, "run", MODEL, "--output", out, "--set", "duration=1000 s", "--set",
                                   "bearings.main.grid={circumferential: 120, axial: 25}"], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True) as process:
                self.wait_for_rows(process)
                process.send_signal(signal.SIGINT)
                time.sleep(pause)
                process.send_signal(signal.SIGINT)
                _, errors = process.communicate(timeout=60)
            self.assertEqual(process.returncode, INTERRUPTED, (pause, errors))
            self.assertTrue(os.path.exists(os.path.join(out, "results.checkpoint")), (pause, errors))
            shutil.rmtree(out)

    def test_second_interrupt_ends_a_run_at_once(self):
        with subprocess.Popen([HERSEY, "run", MODEL, "--output", self.out, "--set", "duration=1000 s", "--set",
                               "bearings.main.grid={circumferential: 1000, axial: 101}"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL) as process:
            time.sleep(1)  # a start that takes many seconds
            process.send_signal(signal.SIGINT)
            time.sleep(0.5)
            self.assertIsNone(process.poll())
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=60), -signal.SIGINT)

    def test_killed_run_leaves_what_it_had_flushed(self):
        with subprocess.Popen([HERSEY, "run", MODEL, "--output", self.out, "--set", "duration=1000 s"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              stdin=subprocess.DEVNULL) as process:
            self.wait_for_rows(process)
            process.kill()
            process.wait(timeout=60)
        with hdf5(self.results()[0]) as file:
            self.assertGreater(len(file["time"]), 1)
        report = hersey("report", self.results()[0], "--output", os.path.join(self._folder.name, "killed.html"))
        self.assertEqual(report.returncode, OK, report.stderr)

    def datasets(self, path):
        """Every dataset of a results file, as bytes."""
        found = {}
        with hdf5(path) as file:
            def keep(name, item):
                if hasattr(item, "shape"):
                    found[name] = item[()].tobytes() if item.dtype.kind == "f" else str(item[()])
            file.visititems(keep)
        return found

    def test_killed_run_resumes_to_the_same_numbers(self):
        seed = random.randrange(2**32)
        print("seed", seed)
        chance = random.Random(seed)
        arguments = ["run", MODEL, "--set", "duration=0.15 s", "--set", "simulation.checkpoint.wall_time=10 ms"]
        whole, parts = os.path.join(self.out, "whole"), os.path.join(self.out, "parts")
        begun = time.monotonic()
        self.assertEqual(hersey(*arguments, "--output", whole).returncode, OK)
        span = time.monotonic() - begun
        kills = 0
        for attempt in range(30):
            resume = ["--resume"] if attempt else []
            with subprocess.Popen([HERSEY, *arguments, "--output", parts, *resume], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True) as process:
                try:
                    # Twice as fast as `span` has been, two runs would be killed all the same.
                    process.wait(timeout=chance.uniform(0.1, 0.6 if kills > 1 else 0.25) * span if kills < 6 else 120)
                except subprocess.TimeoutExpired:
                    process.kill()
                    kills += 1
                _, errors = process.communicate()
            if process.returncode == OK:
                break
            self.assertEqual(process.returncode, -signal.SIGKILL, f"seed {seed}: {errors}")
        self.assertEqual(process.returncode, OK, f"seed {seed}: {errors}")
        self.assertGreater(kills, 1, f"seed {seed}")
        expected, found = (self.datasets(os.path.join(folder, "results.h5")) for folder in (whole, parts))
        self.assertEqual(expected.keys(), found.keys())
        for name in expected:
            self.assertTrue(expected[name] == found[name], f"seed {seed}: {name} differs")
        self.assertEqual(sorted(os.listdir(parts)), ["report.html", "results.h5"])

    def study(self, duration, every):
        """A study of four loads whose runs last `duration` and write a checkpoint `every` so often."""
        path = self.model_with('  duration: "${duration}"\n', f"  duration: {duration}\n  checkpoint: {{every: {every}}}\n")
        with open(path, "a", encoding="utf-8") as file:
            file.write("study:\n  parameters: {load: [100 N, 200 N, 300 N, 400 N]}\n")
        return path

    def test_parallel_study_loses_no_run_and_no_checkpoint(self):
        path = self.study("12 ms", "1 ms")
        for jobs in ("1", "4"):
            run = hersey("run", path, "--output", os.path.join(self.out, jobs), "--jobs", jobs)
            self.assertEqual(run.returncode, OK, run.stderr)
        alone, together = (sorted(glob.glob(os.path.join(self.out, jobs, "*.h5"))) for jobs in ("1", "4"))
        self.assertEqual(len(together), 4)
        for one, other in zip(alone, together):
            self.assertEqual(self.datasets(one), self.datasets(other), other)
        self.assertEqual(sorted(os.listdir(os.path.join(self.out, "4"))),
                         sorted([*map(os.path.basename, together), "report.html"]))

    def test_parallel_study_goes_on_after_interrupts_and_kills(self):
        path = self.study("30 ms", "3 ms")
        whole, parts = os.path.join(self.out, "whole"), os.path.join(self.out, "parts")
        self.assertEqual(hersey("run", path, "--output", whole, "--jobs", "1").returncode, OK)
        arguments = ["run", path, "--output", parts, "--jobs", "4"]
        for stop in (signal.SIGINT, signal.SIGKILL, signal.SIGINT, signal.SIGTERM):
            with subprocess.Popen([HERSEY, *arguments, "--resume"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                  stdin=subprocess.DEVNULL, text=True) as process:
                try:
                    process.wait(timeout=0.15)
                except subprocess.TimeoutExpired:
                    process.send_signal(stop)
                _, errors = process.communicate(timeout=60)
            self.assertIn(process.returncode, (OK, INTERRUPTED, -stop), errors)  # -stop: before the first run began
            self.assertNotIn("cannot write", errors)
            if process.returncode == INTERRUPTED:  # every run that is not complete can go on
                for results in glob.glob(os.path.join(parts, "*.h5")):
                    with hdf5(results) as file:
                        status = file.attrs["status"]
                    self.assertEqual(os.path.exists(results[:-3] + ".checkpoint"), status == "stopped", results)
        run = hersey(*arguments, "--resume")
        self.assertEqual(run.returncode, OK, run.stderr)
        for results in glob.glob(os.path.join(whole, "*.h5")):
            self.assertEqual(self.datasets(results), self.datasets(results.replace(whole, parts)), results)

    def test_run_killed_in_its_first_instant_begins_anew(self):
        path = os.path.join(self.out, "results.h5")
        arguments = ["run", MODEL, "--output", self.out, "--set", "duration=50 ms"]
        for cut in (False, True):
            with subprocess.Popen([HERSEY, *arguments, "--force"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  stdin=subprocess.DEVNULL) as process:
                while not self.results() and process.poll() is None:
                    pass
                process.kill()
            with hdf5(path, "r+" if cut else "r") as file:
                self.assertIn("model", file, "results appear with their model")
                if cut:  # a file that an earlier version was killed over
                    del file["model"]
            run = hersey(*arguments, "--resume")
            self.assertEqual(run.returncode, OK, run.stderr)
            self.assertIn("began anew", run.stderr)
            with hdf5(path) as file:
                self.assertAlmostEqual(file["time"][-1], 0.05, delta=1e-9)
            os.remove(path)

    def test_closed_standard_streams_leave_results_alone(self):
        self.assertEqual(hersey("run", MODEL, "--output", self.out).returncode, OK)
        expected = self.datasets(os.path.join(self.out, "results.h5"))
        for closed in ((0,), (1,), (2,), (1, 2), (0, 1, 2)):
            out = os.path.join(self.out, "-".join(map(str, closed)))

            def close(descriptors=closed):
                for descriptor in descriptors:
                    os.close(descriptor)

            with subprocess.Popen([HERSEY, "run", MODEL, "--output", out], preexec_fn=close) as process:
                self.assertEqual(process.wait(timeout=60), OK, closed)
            self.assertEqual(self.datasets(os.path.join(out, "results.h5")), expected, closed)
            with open(os.path.join(out, "results.h5"), "rb") as file:
                self.assertNotIn(b"steps in", file.read(), closed)

    def test_reader_of_messages_that_goes_away_does_not_end_a_run(self):
        path = self.model_with('  duration: "${duration}"\n  step: 0.1 ms',
                               "  cycle: {period: 5 ms, until_converged: 0, most: 40}\n  step: 0.1 ms")
        read, write = os.pipe()
        with subprocess.Popen([HERSEY, "run", path, "--output", self.out], stdout=subprocess.DEVNULL, stderr=write,
                              stdin=subprocess.DEVNULL) as process:
            os.close(write)
            os.close(read)
            self.assertEqual(process.wait(timeout=60), OK)
        with hdf5(os.path.join(self.out, "results.h5")) as file:
            self.assertEqual(file.attrs["status"], "completed")

    def test_output_that_cannot_be_written_is_reported(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            run = subprocess.run([HERSEY, "schema"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(run.returncode, FAILED)
        self.assertIn("No space left", run.stderr)

    def test_no_command_writes_over_what_it_reads(self):
        def content(path):
            with open(path, "rb") as file:
                return file.read()

        folder = self._folder.name
        self.assertEqual(hersey("run", MODEL, "--output", self.out).returncode, OK)
        results = os.path.join(self.out, "results.h5")
        block = os.path.join(folder, "block.msh")
        shutil.copy(os.path.join(HERE, "../../libs/fem/test/data/block_22.msh"), block)
        alone = os.path.join(folder, "alone.yaml")
        shutil.copy(ALONE, alone)
        model = os.path.join(folder, "r/report.html")  # a model that is called as a run's report is
        os.makedirs(os.path.dirname(model))
        shutil.copy(MODEL, model)
        solid = ["--length-unit", "mm", "--youngs-modulus", "1 GPa", "--poisson-ratio", "0.3", "--density", "1000 kg/m^3"]
        commands = [
            (results, "--output", ["report", results]),
            (block, "--vtu", ["mesh", block]),
            (block, "--vtu", ["modes", block, *solid]),
            (block, "--vtu", ["stress", block, *solid]),
            (block, "--output", ["reduce", block, *solid, "--frame", "floor", "--force"]),
            (alone, "--csv", ["bearing", alone]),
            (alone, "--fields", ["bearing", alone]),
            (alone, "--report", ["bearing", alone]),
        ]
        for file, option, command in commands:
            before = content(file)
            symbolic, hard = os.path.join(folder, "symbolic"), os.path.join(folder, "hard")
            os.symlink(file, symbolic)
            os.link(file, hard)
            for name in (file, os.path.relpath(file), symbolic, hard):
                run = hersey(*command, option, name)
                self.assertEqual(run.returncode, WRONG_INPUT, (command, name, run.stderr))
                self.assertIn(option, run.stderr)
                self.assertIn("expected a file of its own", run.stderr)
                self.assertEqual(content(file), before, (command, name))
            os.remove(symbolic)
            os.remove(hard)
        before = content(model)
        run = hersey("run", model, "--output", os.path.dirname(model), "--force")
        self.assertEqual(run.returncode, WRONG_INPUT, run.stderr)
        self.assertEqual(content(model), before)
        both = os.path.join(folder, "both")
        run = hersey("bearing", alone, "--csv", both, "--report", both)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("written by --csv too", run.stderr)

    def test_compared_runs_stand_under_their_own_names(self):
        runs = {name: os.path.join(self.out, name) for name in ("thin", "wide")}
        for (name, folder), clearance in zip(runs.items(), ("40um", "80um")):
            self.assertEqual(hersey("run", MODEL, "--output", folder, "--set",
                                    f"bearings.main.radial_clearance={clearance}").returncode, OK, name)
        files = [os.path.join(folder, "results.h5") for folder in runs.values()]
        page = os.path.join(self.out, "compared.html")
        summaries = {}
        for name, file in zip(runs, files):
            summaries[name] = {(row["group"], row["name"]): row["value"]
                               for row in json.loads(hersey("report", file, "--output", page, "--json").stdout)}
        key = ("main", "minimum film thickness at the end")
        self.assertNotEqual(summaries["thin"][key], summaries["wide"][key])
        rows = json.loads(hersey("report", *files, "--output", page, "--json").stdout)
        for name in runs:
            self.assertEqual({(row["group"], row["name"]): row["value"] for row in rows if row["run"] == name},
                             summaries[name])
        table = hersey("report", *files, "--output", page).stdout
        for name in runs:
            self.assertRegex(table, rf"(?m)^ +{name} +main .*\b{1e6 * summaries[name][key]:.5g}")

    def test_report_takes_names_for_runs(self):
        folders = [os.path.join(self.out, name) for name in ("one", "two")]
        for folder in folders:
            self.assertEqual(hersey("run", MODEL, "--output", folder).returncode, OK)
        files = [os.path.join(folder, "results.h5") for folder in folders]
        page = os.path.join(self.out, "named.html")
        rows = json.loads(hersey("report", *files, "--names", "before,after", "--output", page, "--json").stdout)
        self.assertEqual({row["run"] for row in rows}, {"before", "after"})
        with open(page, encoding="utf-8") as text:
            self.assertIn('"name":"after"', text.read())
        for names, words in (("before", "names: 1, results files: 2"), ("same,same", "'same' twice")):
            wrong = hersey("report", *files, "--names", names, "--output", os.path.join(self.out, "none.html"))
            self.assertEqual(wrong.returncode, WRONG_INPUT, names)
            self.assertIn(words, wrong.stderr)
            self.assertFalse(os.path.exists(os.path.join(self.out, "none.html")))

    def test_resume_of_another_model_is_refused(self):
        with subprocess.Popen([HERSEY, "run", MODEL, "--output", self.out, "--set", "duration=1000 s"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                              text=True) as process:
            self.wait_for_rows(process)
            process.send_signal(signal.SIGINT)
            _, stderr = process.communicate(timeout=60)
        self.assertIn("--resume", stderr)
        before = self.datasets(self.results()[0])
        run = hersey("run", MODEL, "--output", self.out, "--set", "duration=2000 s", "--resume")
        self.assertEqual(run.returncode, WRONG_INPUT, run.stderr)
        self.assertIn("line 1 was '# --set duration=1000 s' and is '# --set duration=2000 s'", run.stderr)
        self.assertEqual(before, self.datasets(self.results()[0]))
        self.assertEqual(hersey("run", MODEL, "--output", self.out, "--resume", "--force").returncode, WRONG_INPUT)

    def test_study_warns_as_single_runs_do(self):
        path = self.model_with("simulation:", "study: {parameters: {load: [50 N, 100 N]}}\nsimulation:")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        old = "initial: {rotation_rate: 3000 rpm}}"
        self.assertIn(old, text)
        for study in (True, False):  # a drive turns what is asked to rest: the start moves, and says so
            with open(path, "w", encoding="utf-8") as file:
                file.write(text.replace(old, "initial: {rotation_rate: 3000.5 rpm}}"))
            single = [] if study else ["--set", "load=50 N"]
            run = hersey("run", path, "--output", os.path.join(self.out, str(study)), "--jobs", "2", *single)
            self.assertEqual(run.returncode, OK, run.stderr)
            self.assertEqual(run.stderr.count("rad/s given, "), 1, run.stderr)
        self.assertIn("rad/s given, ", hersey("check", path).stderr)

    def test_resumed_study_runs_what_is_missing(self):
        path = self.model_with("simulation:", "study: {parameters: {load: [50 N, 100 N]}}\nsimulation:")
        self.assertEqual(hersey("run", path, "--output", self.out).returncode, OK)
        first, second = self.results()
        stamp = os.stat(first).st_mtime_ns
        os.remove(second)
        run = hersey("run", path, "--output", self.out, "--resume")
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertIn("complete already", run.stderr)
        self.assertEqual(self.results(), [first, second])
        self.assertEqual(os.stat(first).st_mtime_ns, stamp)

    def test_cycles_are_reported_as_they_end(self):
        path = self.model_with('  duration: "${duration}"\n  step: 0.1 ms',
                               "  cycle: {period: 5 ms, until_converged: 0.05, most: 40}\n  step: 0.1 ms")
        run = hersey("run", path, "--output", self.out)
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertRegex(run.stderr, r"cycle 1\ncycle 2: [\d.e+]+ % \((film thickness|peak pressure|friction) of main\)")
        self.assertIn("converged in cycle", run.stderr)
        self.assertRegex(run.stdout, r"cycle 2: change from the one before +[\d.]+ +%")

    def test_full_disk_ends_with_the_reason_and_keeps_what_was_written(self):
        def small_disk():  # writing beyond the limit, a second away, fails as on a full disk
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (6_000_000, 6_000_000))

        run = hersey("run", MODEL, "--output", self.out, "--set", "duration=1000 s", preexec_fn=small_disk)
        self.assertEqual(run.returncode, FAILED, run.stdout + run.stderr)
        (path,) = self.results()
        self.assertIn("File too large", run.stderr)
        up_to = re.search(r"results up to t = (\S+) s are in (\S+)", run.stderr)
        self.assertIsNotNone(up_to, run.stderr)
        self.assertEqual(up_to.group(2), path)
        with hdf5(path) as file:
            self.assertGreater(len(file["time"]), 1)
            self.assertAlmostEqual(file["time"][-1], float(up_to.group(1)), delta=1e-4)  # printed with six digits

    def test_timing_says_where_the_time_went(self):
        for command in (["run", MODEL, "--output", self.out], ["bearing", MODEL, "--load", "200 N", "--speed", "3000 rpm"]):
            run = hersey(*command, "--timing")
            self.assertEqual(run.returncode, OK, run.stderr)
            table = run.stderr[run.stderr.index("  computing time"):].splitlines()
            self.assertLessEqual(len(table), 25)
            phases = [line for line in table[2:] if not line.startswith("   ")]  # after the heading and the whole
            seconds = sum(float(re.search(r" (\d+\.\d+) ", line).group(1)) for line in phases)
            whole = float(re.search(r"in all +([\d.]+)", run.stderr).group(1))
            self.assertAlmostEqual(seconds, whole, delta=0.01 * whole + 0.005)  # parts are rounded to a millisecond

    def test_report_of_a_file_that_is_no_results_file_is_refused(self):
        run = hersey("report", MODEL)
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("bearing.yaml", run.stderr)

    def test_closed_gap_at_the_start_is_an_input_error_at_its_line(self):
        path = self.model_with("initial: {rotation_rate: 3000 rpm}",
                               "initial: {x: 60 um, rotation_rate: 3000 rpm}")
        run = hersey("run", path, "--output", self.out)
        self.assertEqual(run.returncode, WRONG_INPUT, run.stdout + run.stderr)
        self.assertIn("main", run.stderr)
        self.assertRegex(run.stderr, r"model\.yaml:\d+:\d+")

    def test_no_convergence_ends_with_the_reason_and_keeps_results(self):
        run = hersey("run", MODEL, "--output", self.out, "--set", "simulation.tolerance=1e-30", "--set",
                     "simulation.smallest_step=0.05 ms")
        self.assertEqual(run.returncode, FAILED, run.stdout + run.stderr)
        self.assertRegex(run.stderr, r"(?s)\bt\b.*=|time")
        with hdf5(self.results()[0]) as file:
            self.assertEqual(file.attrs["status"], "failed")


if __name__ == "__main__":
    unittest.main(verbosity=2)
