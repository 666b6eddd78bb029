#!/usr/bin/python3
"""extending_test.py SOURCE COMPILER   the changes shown in docs/extending.md fit the sources and compile."""

import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE, COMPILER = os.path.abspath(sys.argv.pop(1)), sys.argv.pop(1)


def changes():
    """Of each section with one, its change: {heading: diff}."""
    with open(os.path.join(SOURCE, "docs/extending.md"), encoding="utf-8") as file:
        sections = re.split(r"^## (.*)$", file.read(), flags=re.MULTILINE)
    found = {}
    for heading, text in zip(sections[1::2], sections[2::2]):
        blocks = re.findall(r"^```diff\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
        if blocks:
            found[heading] = "".join(blocks)
    return found


class Extending(unittest.TestCase):
    def compiles(self, heading, most_files):
        change = changes()[heading]
        files = re.findall(r"^\+\+\+ b/(\S+)", change, re.MULTILINE)
        code = [path for path in files if "/test/" not in path]
        self.assertLessEqual(len(code), most_files, "more files of code than were asked for")
        with tempfile.TemporaryDirectory(prefix="hersey-extending-") as folder:
            for part in ("libs", "verification", "tests/support"):
                shutil.copytree(os.path.join(SOURCE, part), os.path.join(folder, part))
            patch = subprocess.run(["git", "apply", "-p1"], cwd=folder, input=change, text=True, capture_output=True,
                                   check=False)
            self.assertEqual(patch.returncode, 0, patch.stdout + patch.stderr)
            includes = [f"-I{path}" for path in glob.glob(os.path.join(folder, "libs/*/include")) +
                        glob.glob(os.path.join(folder, "libs/*/src"))]
            includes += [f"-I{folder}/verification", f"-I{folder}/tests/support"]
            touched = [path for path in files if path.endswith(".cpp")]
            self.assertTrue(touched)
            # All of them as one, as `make` compiles them: what they include is read once.
            sources = "".join(f'#include "{path}"\n' for path in touched)
            run = subprocess.run([COMPILER, "-std=c++20", "-fsyntax-only", "-Wall", "-Werror", f"-I{folder}", *includes, "-isystem",
                                  "/usr/include/eigen3", "-x", "c++", "-"], cwd=folder, input=sources, text=True,
                                 capture_output=True, check=False)
            self.assertEqual(run.returncode, 0, run.stderr[-3000:])

    def test_change_for_a_viscosity_law_compiles(self):
        self.compiles("A viscosity law", 3)

    def test_change_for_a_cavitation_model_compiles(self):
        self.compiles("A cavitation model", 3)

    def test_change_for_a_joint_compiles(self):
        self.compiles("A joint", 3)

    def test_change_for_a_force_compiles(self):
        self.compiles("A force", 3)

    def test_change_for_an_element_compiles(self):
        self.compiles("An element", 3)

    def test_change_for_an_output_quantity_compiles(self):
        self.compiles("An output quantity", 3)

    def test_every_change_of_the_page_is_tried(self):
        with open(__file__, encoding="utf-8") as file:
            tried = re.findall(r'self\.compiles\("([^"]+)"', file.read())
        self.assertEqual(sorted(tried), sorted(changes()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
