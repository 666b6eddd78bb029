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


def files_of(change):
    return re.findall(r"^\+\+\+ b/(\S+)", change, re.MULTILINE)


class Extending(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="hersey-extending-")
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def copy(self, paths):
        for path in paths:
            source, copy = os.path.join(SOURCE, path), os.path.join(self.folder, path)
            if os.path.isdir(source):
                shutil.copytree(source, copy)
            elif os.path.exists(source):  # others are new
                os.makedirs(os.path.dirname(copy), exist_ok=True)
                shutil.copy(source, copy)

    def apply(self, change):
        patch = subprocess.run(["git", "apply", "-p1"], cwd=self.folder, input=change, text=True, capture_output=True,
                               check=False)
        self.assertEqual(patch.returncode, 0, patch.stdout + patch.stderr)

    def fits(self, heading, most_files):
        change = changes()[heading]
        code = [path for path in files_of(change) if "/test/" not in path]
        self.assertTrue(code)
        self.assertLessEqual(len(code), most_files, "more files of code than were asked for")
        self.copy(files_of(change))
        self.apply(change)

    def test_change_for_a_viscosity_law_fits_the_sources(self):
        self.fits("A viscosity law", 3)

    def test_change_for_a_cavitation_model_fits_the_sources(self):
        self.fits("A cavitation model", 3)

    def test_change_for_a_joint_fits_the_sources(self):
        self.fits("A joint", 3)

    def test_change_for_a_force_fits_the_sources(self):
        self.fits("A force", 3)

    def test_change_for_an_element_fits_the_sources(self):
        self.fits("An element", 3)

    def test_change_for_an_output_quantity_fits_the_sources(self):
        self.fits("An output quantity", 3)

    def test_all_changes_compile(self):
        self.copy(("libs", "verification", "tests/support"))
        sources = []
        for change in changes().values():
            self.apply(change)
            sources += [path for path in files_of(change) if path.endswith(".cpp")]
        sources.append("libs/workbench/src/answers/scene_parts.cpp")  # draws every kind of force
        includes = [f"-I{path}" for place in ("libs/*/include", "libs/*/src") for path in glob.glob(f"{self.folder}/{place}")]
        includes += [f"-I{self.folder}", f"-I{self.folder}/verification", f"-I{self.folder}/tests/support"]
        # All of them as one, as `make` compiles them: what they include is read once.
        run = subprocess.run([COMPILER, "-std=c++20", "-fsyntax-only", "-Wall", "-Werror", *includes, "-isystem",
                              "/usr/include/eigen3", "-x", "c++", "-"], cwd=self.folder, text=True, capture_output=True,
                             input="".join(f'#include "{path}"\n' for path in dict.fromkeys(sources)), check=False)
        self.assertEqual(run.returncode, 0, run.stderr[-3000:])

    def test_every_change_of_the_page_is_tried(self):
        with open(__file__, encoding="utf-8") as file:
            tried = re.findall(r'self\.fits\("([^"]+)"', file.read())
        self.assertEqual(sorted(tried), sorted(changes()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
