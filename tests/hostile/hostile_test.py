#!/usr/bin/python3
"""Files that would take all memory, all time or other people's files: each is reported within two seconds of CPU, or is
harmless. Seconds of CPU, not of the clock: tests run beside each other. Signals are obeyed within two of the clock, of
which the tests allow for a busy machine."""

import glob
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np

HERSEY = os.path.abspath(sys.argv.pop(1))
HERE = os.path.dirname(os.path.abspath(__file__))
MODEL = os.path.join(HERE, "../cli/bearing.yaml")
ROD = os.path.join(HERE, "../../examples/meshes/conrod.msh")

OK, FAILED, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130
PATIENCE = 2  # s
SEALED = 20  # bits of a file whose seal vouches for all of it alike
MEMORY = 2 << 30  # bytes of address space: far more than small models take, far less than the files ask for
MATERIAL = ("--length-unit", "mm", "--youngs-modulus", "210 GPa", "--poisson-ratio", "0.3", "--density", "7850 kg/m^3")


class Hostile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-hostile-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def hersey(self, *arguments, **options):
        def limits():
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([HERSEY, *arguments], capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL,
                              check=False, errors="replace", preexec_fn=limits, **options)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.assertLess(seconds, PATIENCE, (arguments, done.stderr[:500]))
        return done

    def refuses(self, words, *arguments, code=WRONG_INPUT, **options):
        done = self.hersey(*arguments, **options)
        self.assertEqual(done.returncode, code, (arguments, done.stdout[:500], done.stderr[:500]))
        for word in (words,) if isinstance(words, str) else words:
            self.assertIn(word, done.stderr, arguments)
        return done

    def model(self, *changes, name="model.yaml"):
        with open(MODEL, encoding="utf-8") as file:
            text = file.read()
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    # -- model files

    def test_aliases_that_multiply_are_reported_at_their_line(self):
        lines = ["hersey: 1", "a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
        lines += [f"a{i}: &a{i} [{', '.join(10 * [f'*a{i - 1}'])}]" for i in range(1, 40)]
        self.refuses((":6:", "aliases that repeat more than 100000 values", "at most"), "check",
                  self.write("wide.yaml", "\n".join(lines)))
        lines = ["hersey: 1", "title: &t " + 1000000 * "x", f"b: [{', '.join(1000 * ['*t'])}]"]
        self.refuses((":3:", "more than 16 MB"), "check", self.write("long.yaml", "\n".join(lines)))
        lines = ["hersey: 1", "a0: &a0 x"] + [f"a{i}: &a{i} [*a{i - 1}]" for i in range(1, 400)]
        self.refuses(("64 deep",), "check", self.write("deep.yaml", "\n".join(lines)))
        self.refuses("64 deep", "check", self.write("brackets.yaml", "a: " + 300 * "[" + 300 * "]"))
        self.refuses("", "check", self.write("anchors.yaml", "a: " + "".join(f"[&a{i} " for i in range(300)) + 300 * "]"))

    def test_many_keys_are_read_once_each(self):
        keys = "".join(f"k{i}: 1\n" for i in range(40000))
        self.refuses("more faults", "check", self.write("keys.yaml", "hersey: 1\n" + keys))
        keys = "".join(f"k{i}: 1\n" for i in range(110000))
        self.refuses("more than 100000 keys", "check", self.write("more.yaml", "hersey: 1\n" + keys))

    def test_parameters_that_multiply_are_reported(self):
        parameters = "".join(f'  p{i}: "{5 * (f"${{p{i - 1}}}")}"\n' for i in range(1, 30))
        path = self.write("model.yaml", "hersey: 1\nparameters:\n  p0: abcdefgh\n" + parameters)
        self.refuses("longer than 65536 characters", "check", path)
        lists = ", ".join(2000 * ['"${p}"'])
        path = self.write("model.yaml", f"hersey: 1\nparameters:\n  p: {60000 * 'x'}\ntitle: [{lists}]\n")
        self.refuses("longer than 16 MB in all", "check", path)

    def test_tables_of_tiny_periods_are_reported_at_their_line(self):
        table = "{table: {points: [[0, 1], [0.5, 2], [1, 1]], x_unit: ps, y_unit: N}, period: 1 ps}"
        changes = [('"-${load}"', table), ("step: 0.1 ms", "step: {tolerance: 1e-4}")]
        path = self.model(*changes)
        with open(path, encoding="utf-8") as file:
            line = 1 + [table in text for text in file].index(True)
        words = (f"model.yaml:{line}:", "a table that bends 4e+09 times", "at most a million", "interpolation: smooth")
        for command in (["check"], ["run", "--output", self.path("out")]):
            self.refuses(words, command[0], path, *command[1:])
        # Cheap where nothing has to be hit.
        self.hersey("check", self.model(*changes[:1]))
        self.assertEqual(self.hersey("check", self.model(*changes, ("1 ps}", "1 ps, interpolation: smooth}"))).returncode,
                         OK)
        # Over the turning shaft, which a drive moves.
        table = "{table: {points: [[0, 1], [0.5, 2], [1, 1]], x_unit: urad, y_unit: N}, over: guide.rotation, period: 1 urad}"
        path = self.model(('"-${load}"', table.replace("urad", "nrad")), changes[1])
        for command in (["check"], ["run", "--output", self.path("out")]):
            self.refuses(("a table", "repeats 6.28e+08 times"), command[0], path, *command[1:])
        self.assertFalse(os.path.exists(self.path("out")))

    def test_rows_without_end_are_reported_at_their_line(self):
        for key in ("interval", "fields_every"):
            path = self.model(("step: 0.1 ms", f"step: {{tolerance: 1e-4}}\noutput: {{{key}: 1e-14 s}}"))
            self.refuses((f"output.{key}: 2e+11 instants", "at most a million"), "run", path, "--output", self.path("out"))

    def test_grids_beyond_memory_are_reported_with_what_they_need(self):
        grid = "bearings.main.grid={circumferential: 100000, axial: 100000}"
        words = ("1e+10 nodes", "2e+04 GB", "GB of this machine")
        self.refuses(words, "check", MODEL, "--set", grid)
        self.refuses(words, "run", MODEL, "--set", grid, "--output", self.path("out"))
        self.refuses(words, "bearing", MODEL, "--set", grid)

    def test_numbers_beyond_any_machine_are_reported_with_their_key(self):
        alone = os.path.join(HERE, "../../examples/bearing_alone/model.yaml")
        thermal = ("bearings.main.thermal={model: film, supply_temperature: 50 degC, shell: {wall: ring, "
                   "outer_diameter: 1e308 mm, heat_transfer: 60 W/m^2/K, ambient: 30 degC}}")
        pocket = "bearings.main.features={p: {shape: pocket, angle: 0 deg, arc: 20 deg, length: 5 mm, depth: 1e308 mm}}"
        column = "bearings.main.compliance={model: column, composite_modulus: 70 GPa, length: 1e9 mm}"
        for key, settings in (("outer_diameter", [thermal]), ("depth", [pocket]), ("length", [column]),
                              ("density", ["lubricants.oil.density=1e308 kg/m^3"]),
                              ("journal_speed", ["bearings.main.operating_point.journal_speed=1e308 rpm"]),
                              ("journal_speed", ["bearings.main.operating_point.journal_speed=1e-308 rpm"]),
                              ("load", ["bearings.main.operating_point.load=1e-308 N"]),
                              ("load", ["bearings.main.operating_point.load=1e12 N"])):
            with self.subTest(settings=settings):
                arguments = [word for setting in settings for word in ("--set", setting)]
                self.refuses([key], "bearing", alone, *arguments)
        # A run over angles of a crank that all but rests would have no end.
        crank = os.path.join(HERE, "../../examples/slider_crank/model.yaml")
        self.refuses(["at least 1e-100 rad/s"], "run", crank, "--set", "speed=1e-308 rpm", "--output", self.path("out"))

    def test_inputs_that_are_no_files_are_reported(self):
        pipe = self.path("pipe.yaml")
        os.mkfifo(pipe)
        for command in (["check"], ["run"], ["bearing"]):
            self.refuses("a pipe", *command, pipe)
        for name, command in (("p.msh", ["mesh"]), ("p.inp", ["mesh"]), ("p.bdf", ["modes"]), ("p.h5", ["report"])):
            os.mkfifo(self.path(name))
            self.refuses("a pipe", *command, self.path(name))
        for key, value, name in (("mesh", "{mesh: p.msh, length_unit: 1 mm}", "p.msh"),
                                 ("reduced", "{reduced: p.h5}", "p.h5")):
            path = self.model(("    mass: 1 kg\n    inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}",
                               f"    flexible: {value}"))
            self.refuses(("a pipe", name), "check", path)
        table = '{table: {file: p.csv, x: t, y: f}}'
        os.mkfifo(self.path("p.csv"))
        self.refuses(("a pipe", "p.csv"), "check", self.model(('"-${load}"', table)))
        self.refuses("a device", "check", "/dev/zero")
        with open(self.path("holes.yaml"), "wb") as file:
            file.truncate(1 << 40)
        self.refuses(("a file of", "of at most"), "check", self.path("holes.yaml"))

    # -- meshes

    def test_meshes_include_files_of_their_folder(self):
        os.mkdir(self.path("meshes"))
        secret = self.write("secret.txt", "*NODE\n1,0,0,0\nsecret words\n")
        for name in ("../secret.txt", secret, "link.txt"):
            self.write("meshes/body.inp", f"*INCLUDE, INPUT={name}\n")
            if name == "link.txt":
                os.symlink(secret, self.path("meshes", name))
            done = self.refuses((f"*INCLUDE of '{name}': not in the mesh's folder", "HERSEY_INCLUDE_ANYWHERE=1"), "mesh",
                             self.path("meshes/body.inp"))
            self.assertNotIn("secret words", done.stderr)
        self.write("meshes/body.bdf", "BEGIN BULK\nINCLUDE '../secret.txt'\nENDDATA\n")
        self.refuses("not in the mesh's folder", "mesh", self.path("meshes/body.bdf"))
        self.refuses("secret words", "mesh", self.path("meshes/body.inp"),
                  env={**os.environ, "HERSEY_INCLUDE_ANYWHERE": "1"})

    def test_meshes_that_include_themselves_are_reported(self):
        self.write("body.inp", 100 * "*INCLUDE, INPUT=body.inp\n")
        self.refuses("included too deep", "mesh", self.path("body.inp"))
        for i in range(7):
            self.write(f"a{i}.inp", 100 * f"*INCLUDE, INPUT=a{i + 1}.inp\n")
        self.write("a7.inp", "** nothing\n")
        self.refuses("more than 1000 files", "mesh", self.path("a0.inp"))

    def test_more_modes_than_a_body_is_good_for_are_reported(self):
        self.refuses(("--modes: 100000 modes", "at most 1000", "nodal"), "reduce", ROD, *MATERIAL, "--frame", "big_end",
                  "--modes", "100000", "--output", self.path("rod.h5"))
        path = self.model(("    mass: 1 kg\n    inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}",
                           f"    flexible: {{mesh: {ROD}, length_unit: 1 mm, modes: 100000}}"))
        self.refuses(("flexible.modes: '100000'", "1000"), "check", path)

    # -- HDF5 files from elsewhere

    def hostile_files(self, good):
        """Copies of a good file, each with something that ours never have, and the word that tells of it."""
        def spoiled(name, spoil):
            path = self.path(f"{name}.h5")
            shutil.copy(good, path)
            with open(path, "r+b") as file:  # an older one: without a seal
                content = file.read()
                if b"\nhersey seal" in content:
                    file.truncate(content.rindex(b"\nhersey seal"))
            with h5py.File(path, "a") as file:
                spoil(file)
            return path

        def cycle(file):
            file.create_group("a/b/c")
            file["a/b/c/d"] = file["a"]

        def deep(file):
            group = file
            for _ in range(3000):
                group = group.create_group("g")

        def external_data(file):
            properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
            properties.set_external(b"/etc/passwd", 0, 800)
            h5py.h5d.create(file.id, b"outside", h5py.h5t.NATIVE_DOUBLE, h5py.h5s.create_simple((100,)), properties)

        def virtual_data(file):
            layout = h5py.VirtualLayout(shape=(4,), dtype="f8")
            layout[:] = h5py.VirtualSource("/etc/passwd", "x", shape=(4,))
            file.create_virtual_dataset("virtual", layout)

        yield "has another name", spoiled("cycle", cycle)
        yield "has another name", spoiled("root", lambda file: file.__setitem__("again", file["/"]))
        yield "deep", spoiled("deep", deep)
        yield "a soft link", spoiled("soft", lambda file: file.__setitem__("soft", h5py.SoftLink("/nodes")))
        yield "a link to another file", spoiled(
            "external", lambda file: file.__setitem__("external", h5py.ExternalLink("/etc/passwd", "/x")))
        yield "in another file", spoiled("outside", external_data)
        yield "in another file", spoiled("virtual", virtual_data)
        yield "a data set of 9.22e+09 GB", spoiled(
            "absurd", lambda file: file.create_dataset("absurd", (1 << 30, 1 << 30), "f8", chunks=(1024, 1024)))

    def results(self):
        done = self.hersey("run", MODEL, "--output", self.path("good"))
        self.assertEqual(done.returncode, OK, done.stderr)
        return self.path("good", "results.h5")

    def test_hostile_results_are_reported(self):
        good = self.results()
        for words, path in self.hostile_files(good):
            self.refuses(words, "report", path, "--output", self.path("page.html"))
            self.refuses(words, "report", good, path, "--output", self.path("page.html"))
            self.assertFalse(os.path.exists(self.path("page.html")))

    def reduced(self):
        path = self.path("rod.h5")
        subprocess.run([HERSEY, "reduce", ROD, *MATERIAL, "--frame", "pin=big_end", "--modes", "2", "--output", path],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return path

    def model_of(self, body):
        return self.model(("    mass: 1 kg\n    inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}",
                           f"    flexible: {{reduced: {os.path.basename(body)}}}"))

    def test_hostile_reduced_bodies_are_reported(self):
        for words, path in self.hostile_files(self.reduced()):
            self.refuses(words, "check", self.model_of(path))

    def test_reduced_bodies_are_finite_and_definite(self):
        good = self.reduced()

        def change(name, place, value):
            def spoil(file):
                numbers = file[name][...]
                numbers[place] = value
                if name in ("K", "M"):
                    numbers[place[::-1]] = value
                file[name][...] = numbers
            return spoil

        for words, spoil in (("finite numbers", change("Phi", (0, 0), np.nan)), ("not finite", change("K", (1, 2), np.inf)),
                             ("negative", change("M", (7, 7), -1.0)), ("negative", change("K", (7, 7), -1e9)),
                             ("not finite", change("internal_omega", 0, np.nan)),
                             ("impossible entry", change("mass/values", 5, np.nan))):
            path = self.path("spoiled.h5")
            shutil.copy(good, path)
            with open(path, "r+b") as file:
                file.truncate(file.read().rindex(b"\nhersey seal"))
            with h5py.File(path, "a") as file:
                spoil(file)
            self.refuses(words, "check", self.model_of(path))

    # -- one bit

    def flipped(self, good, count, seed):
        """Copies of a file, each with one bit changed; places spread over the file, its first block more than the rest."""
        chance = random.Random(seed)
        with open(good, "rb") as file:
            content = bytearray(file.read())
        end = content.rfind(b"\nhersey seal")  # without these words, which vouch for the rest, the rest is as it was
        end = end if end >= 0 else len(content)
        path = self.path("flipped" + os.path.splitext(good)[1])
        for k in range(count):
            place = chance.randrange(min(end, 4096) if k % 4 == 0 else end)
            content[place] ^= 1 << (bit := chance.randrange(8))
            with open(path, "wb") as file:
                file.write(content)
            yield place, path
            content[place] ^= 1 << bit

    def test_a_bit_of_results_is_reported(self):
        for place, path in self.flipped(self.results(), SEALED, 1):
            with self.subTest(byte=place):
                self.refuses("flipped.h5", "report", path, "--output", self.path("page.html"))

    def test_a_bit_of_unfinished_results_ends_no_report_in_a_crash(self):
        path = self.results()
        with open(path, "r+b") as file:  # as a run that was killed leaves them: without a seal
            file.truncate(file.read().rindex(b"\nhersey seal"))
        for place, path in self.flipped(path, 50, 2):
            done = self.hersey("report", path, "--output", self.path("page.html"))
            with self.subTest(byte=place):
                self.assertIn(done.returncode, (OK, FAILED, WRONG_INPUT), done.stderr)
                if done.returncode != OK:
                    self.assertIn("hersey: ", done.stderr)

    def test_a_bit_of_a_reduced_body_is_reported(self):
        good = self.reduced()
        model = self.model_of("flipped.h5")
        for place, _ in self.flipped(good, SEALED, 3):
            with self.subTest(byte=place):
                self.refuses("flipped.h5", "check", model)

    def test_a_bit_of_a_checkpoint_is_reported(self):
        out = self.path("out")
        with subprocess.Popen([HERSEY, "run", MODEL, "--output", out, "--set", "duration=1000 s"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
            self.wait_for(os.path.join(out, "results.h5"), 0.3)
            run.send_signal(signal.SIGINT)
            run.wait(timeout=60)
        good = self.path("good.checkpoint")
        shutil.copy(os.path.join(out, "results.checkpoint"), good)
        for place, path in self.flipped(good, SEALED, 4):
            shutil.copy(path, os.path.join(out, "results.checkpoint"))
            with self.subTest(byte=place):
                self.refuses("results.checkpoint", "run", MODEL, "--output", out, "--set", "duration=1000 s", "--resume")

    # -- signals

    @staticmethod
    def wait_for(path, more=0):
        deadline = time.monotonic() + 60
        while not os.path.exists(path) and time.monotonic() < deadline:
            time.sleep(0.02)
        time.sleep(more)

    def assert_in_time(self, seconds, stop):
        """Two seconds; more where others want the same processors and disks."""
        self.assertLess(seconds, PATIENCE if os.getloadavg()[0] < os.cpu_count() else 5 * PATIENCE, stop)

    def seconds_to_end(self, arguments, stop, ready):
        """How long the program takes to end after a signal, what it returns, and what it has said."""
        with subprocess.Popen([HERSEY, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              stdin=subprocess.DEVNULL, text=True) as process:
            ready()
            self.assertIsNone(process.poll(), "it ended before the signal")
            began = time.monotonic()
            process.send_signal(stop)
            try:
                _, errors = process.communicate(timeout=20)
            finally:
                process.kill()
            return time.monotonic() - began, process.returncode, errors

    def test_signals_are_obeyed_while_a_run_starts(self):
        # A film of 400,000 nodes: its start alone takes many seconds.
        for stop in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            seconds, code, errors = self.seconds_to_end(
                ["run", MODEL, "--output", self.path(stop.name), "--set",
                 "bearings.main.grid={circumferential: 2000, axial: 201}"], stop, lambda: time.sleep(0.5))
            self.assert_in_time(seconds, stop)
            self.assertIn(code, (INTERRUPTED, -stop), errors)
            self.assertEqual(glob.glob(self.path(stop.name, "*.h5")), [])

    def test_signals_are_obeyed_in_steps_and_leave_a_checkpoint(self):
        for stop in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            out = self.path(stop.name)
            results = os.path.join(out, "results.h5")
            seconds, code, errors = self.seconds_to_end(
                ["run", MODEL, "--output", out, "--set", "duration=1000 s"], stop, lambda at=results: self.wait_for(at, 0.3))
            self.assert_in_time(seconds, stop)
            self.assertEqual(code, INTERRUPTED, errors)
            self.assertTrue(os.path.exists(os.path.join(out, "results.checkpoint")), errors)

    def test_signals_are_obeyed_while_a_mesh_is_reduced(self):
        mesh = self.block(24)  # half a minute of work
        for stop in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            seconds, code, errors = self.seconds_to_end(
                ["reduce", mesh, *MATERIAL, "--frame", "foot=foot", "--modes", "300", "--output", self.path("b.h5")],
                stop, lambda: time.sleep(0.7))
            self.assert_in_time(seconds, stop)
            self.assertEqual(code, -stop, errors)
            self.assertFalse(os.path.exists(self.path("b.h5")))

    def test_signals_are_obeyed_while_a_run_reduces_its_meshes(self):
        mesh = os.path.basename(self.block(40))
        flexible = (f"    flexible: {{mesh: {mesh}, length_unit: 1 mm, modes: 300, "
                    "material: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}}\n"
                    "    frames: {foot: {nodes: foot}}\n"
                    "  shaft:\n    mass: 1 kg\n    inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}")
        path = self.model(("  shaft:\n    mass: 1 kg\n    inertia: {xx: 1e-3 kg.m^2, yy: 1e-3 kg.m^2, zz: 1e-3 kg.m^2}",
                           "  block:\n" + flexible),
                          ("drives:", "  hold: {type: fixed, between: [ground, block.foot]}\n\ndrives:"))
        seconds, code, errors = self.seconds_to_end(["run", path, "--output", self.path("out")], signal.SIGTERM,
                                                    lambda: time.sleep(2))
        self.assert_in_time(seconds, signal.SIGTERM)
        self.assertIn(code, (INTERRUPTED, -signal.SIGTERM), errors)

    def block(self, n):
        """A cube of n^3 hexahedra, the nodes of one face in a set `foot`."""
        m = n + 1
        node = lambda i, j, k: 1 + i + m * (j + m * k)
        lines = ["*NODE, NSET=ALL"]
        lines += [f"{node(i, j, k)},{i},{j},{k}" for k in range(m) for j in range(m) for i in range(m)]
        lines += ["*ELEMENT, TYPE=C3D8, ELSET=BODY"]
        corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
        for e, (i, j, k) in enumerate(((i, j, k) for k in range(n) for j in range(n) for i in range(n)), 1):
            lines.append(f"{e}," + ",".join(str(node(i + a, j + b, k + c)) for a, b, c in corners))
        lines += ["*NSET, NSET=foot"] + [f"{node(i, j, 0)}," for j in range(m) for i in range(m)]
        return self.write("block.inp", "\n".join(lines) + "\n")


if __name__ == "__main__":
    unittest.main()
