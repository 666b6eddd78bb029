"""The first steps with a model of one's own: init, explain, check --expanded, the progress bar and the closing table."""

import fcntl
import json
import os
import pathlib
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
import unittest

HERSEY = sys.argv.pop(1)
SOURCE = pathlib.Path(sys.argv.pop(1))
OK, WRONG_INPUT = 0, 2


class FirstSteps(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def hersey(self, *arguments):
        return subprocess.run([HERSEY, *arguments], capture_output=True, text=True, cwd=self.folder, check=False)

    def begin_and_run(self, model, *larger_steps):
        """Writes a model and runs the command that init names to its end, in fewer steps where they are reported; its output."""
        written = self.hersey("init", model, "my_model")
        self.assertEqual(written.returncode, OK, written.stderr)
        check = self.hersey("check", "my_model.yaml")
        self.assertEqual((check.returncode, check.stderr), (OK, ""))
        command = written.stdout.splitlines()[-1].split()
        self.assertEqual(command[0], "hersey")
        run = self.hersey(*command[1:], *(word for step in larger_steps for word in ("--set", "simulation.step=" + step)))
        self.assertEqual(run.returncode, OK, run.stderr)
        self.assertIn("minimum film thickness", run.stdout)
        return run.stdout

    def test_init_alone_lists_the_models(self):
        run = self.hersey("init")
        self.assertEqual(run.returncode, OK)
        for name in ("bearing", "hydrostatic", "tilting_pads", "thrust", "tilting_thrust", "floating_ring", "damper", "skirt", "rotor", "big_end", "engine", "turbocharger", "flexible_rod"):
            self.assertIn(f"\n  {name} ", run.stdout)

    def test_recipes_are_the_pages_of_the_documentation(self):
        pages = {page.stem: page.read_text(encoding="utf-8") for page in (SOURCE / "docs" / "recipes").glob("*.md")}
        told = {recipe["name"]: recipe["text"] for recipe in json.loads(self.hersey("recipes", "--json").stdout)}
        self.assertEqual(told, pages)
        listed = self.hersey("recipes").stdout
        for name, text in pages.items():
            self.assertRegex(listed, rf"\n  {name} +{re.escape(text.splitlines()[0][2:])}\n")
            self.assertEqual(self.hersey("recipes", name).stdout, text)
            self.assertIn("```sh\n", text)  # which the test of its page runs
        wrong = self.hersey("recipes", "sise-a-bearing")
        self.assertEqual(wrong.returncode, WRONG_INPUT)
        self.assertIn("did you mean 'size-a-bearing'?", wrong.stderr)

    def test_init_bearing_runs(self):
        self.begin_and_run("bearing")

    def test_init_hydrostatic_runs(self):
        self.begin_and_run("hydrostatic")

    def test_init_tilting_pads_runs(self):
        self.begin_and_run("tilting_pads")

    def test_init_thrust_runs(self):
        self.begin_and_run("thrust")

    def test_init_tilting_thrust_runs(self):
        self.begin_and_run("tilting_thrust")

    def test_init_floating_ring_runs(self):
        self.begin_and_run("floating_ring")

    def test_init_damper_runs(self):
        self.begin_and_run("damper")

    def test_init_skirt_runs(self):
        self.begin_and_run("skirt")

    def test_init_rotor_runs(self):
        self.begin_and_run("rotor", "0.5 ms")

    def test_init_big_end_runs(self):
        self.begin_and_run("big_end", "3 deg")

    def test_init_engine_runs(self):
        self.begin_and_run("engine", "2 deg")

    def test_init_turbocharger_runs(self):
        self.begin_and_run("turbocharger", "150 us")

    def test_init_flexible_rod_runs(self):
        self.begin_and_run("flexible_rod", "1.5 deg")

    def test_init_refuses_to_overwrite_and_names_the_nearest_model(self):
        (self.folder / "mine.yaml").write_text("kept")
        run = self.hersey("init", "rotor", "mine.yaml")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("mine.yaml: a file that exists already", run.stderr)
        self.assertEqual((self.folder / "mine.yaml").read_text(), "kept")
        run = self.hersey("init", "rotr", "other")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("did you mean 'rotor'?", run.stderr)
        self.assertFalse((self.folder / "other.yaml").exists())

    def test_explain_tells_meaning_unit_default_and_keys(self):
        text = self.hersey("explain", "bearings.main.supply.pressure").stdout
        for part in ("bearings.<name>.supply.pressure", "Supply pressure.", "default  0 Pa", "MPa", "such as 2 bar"):
            self.assertIn(part, text)
        self.assertIn("widest_gap", self.hersey("explain", "bearings.supply").stdout)
        asperities = self.hersey("explain", "bearings.main.asperities").stdout
        self.assertIn("model: greenwood_tripp", asperities)
        self.assertIn("elastic_factor", asperities)

    def test_explain_alone_lists_the_sections(self):
        text = self.hersey("explain").stdout
        for section in ("bodies", "bearings", "lubricants", "simulation", "templates"):
            self.assertRegex(text, rf"(?m)^    {section} ")

    def test_explain_of_an_unknown_key_names_the_nearest(self):
        run = self.hersey("explain", "bearings.main.suply")
        self.assertEqual(run.returncode, WRONG_INPUT)
        self.assertIn("did you mean 'supply'?", run.stderr)

    def test_every_key_of_the_schema_is_explained(self):
        schema = json.loads(self.hersey("schema").stdout)
        kinds = schema["properties"]["bearings"]["additionalProperties"]["anyOf"]
        self.assertGreater(len(kinds), 1)
        for key in sorted({key for kind in kinds for key in kind["properties"]}):
            if key not in ("use", "kind"):
                run = self.hersey("explain", "bearings.main." + key)
                self.assertEqual(run.returncode, OK, key + run.stderr)

    def test_expanded_model_is_the_same_model(self):
        self.hersey("init", "bearing", "a")
        text = (self.folder / "a.yaml").read_text().replace("bearings:\n  main:\n", "bearings:\n  main:\n    use: plain\n")
        text = text.replace("    lubricant: oil\n", "").replace(
            "lubricants:\n", "templates:\n  plain: {lubricant: oil}\nlubricants:\n")
        (self.folder / "a.yaml").write_text(text)
        expanded = self.hersey("check", "--expanded", "a.yaml", "--set", "load=3 kN")
        self.assertEqual(expanded.returncode, OK, expanded.stderr)
        self.assertNotIn("$", expanded.stdout)
        self.assertNotIn("template", expanded.stdout)
        (self.folder / "b.yaml").write_text(expanded.stdout)
        first, second = (json.loads(self.hersey("bearing", name, "--json", "--no-grid-error", *more).stdout)
                         for name, more in (("a.yaml", ("--set", "load=3 kN")), ("b.yaml", ())))
        figures = [json.dumps(one, sort_keys=True) for one in (first, second)]
        figures = [re.sub(r'"[^"]*(time|seconds|file|model)[^"]*": ("[^"]*"|[-\d.e]+)', "", one) for one in figures]
        self.assertEqual(*figures)

    def test_closing_table_of_nine_bearings_fits_a_screen(self):
        for name in ("inline_four.yaml", "gas_pressure.csv"):
            shutil.copy(SOURCE / "examples/engine" / name, self.folder)
        run = self.hersey("run", "inline_four.yaml", "--output", "out", "--set",
                          "simulation={crank: main, duration: 2 deg, step: 0.5 deg, spectral_radius: 0.8}")
        self.assertEqual(run.returncode, OK, run.stderr)
        lines = run.stdout.splitlines()
        self.assertTrue(24 <= len(lines) <= 40, run.stdout)
        self.assertIn("worst of all bearings", run.stdout)
        for bearing in ("main_1", "main_5", "big_end_1", "big_end_4"):
            self.assertRegex(run.stdout, rf"(?m)^  {bearing} ")
        everything = self.hersey("report", "--all", "out/results.h5")
        self.assertGreater(len(everything.stdout.splitlines()), 150)

    def test_progress_is_a_bar_on_a_terminal_and_lines_elsewhere(self):
        self.hersey("init", "rotor", "a")
        command = [HERSEY, "run", "a.yaml", "--set", "simulation.duration=10ms", "--force"]
        piped = subprocess.run(command, capture_output=True, cwd=self.folder, check=False)
        self.assertNotIn(b"\r", piped.stderr)
        master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=slave, cwd=self.folder) as run:
            os.close(slave)
            seen = b""
            while True:
                try:
                    part = os.read(master, 65536)
                except OSError:  # the program has ended
                    break
                seen += part
            run.wait()
        os.close(master)
        bars = re.findall(r"\r\x1b\[K(\[=*>? *\] [^\r]*)", seen.decode())
        self.assertTrue(bars, seen)
        for bar in bars:
            self.assertLess(len(bar), 80)
            self.assertGreaterEqual(bar.index("]"), 21)


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    unittest.main()
