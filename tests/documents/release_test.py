#!/usr/bin/python3
"""release_test.py HERSEY SOURCE   the version: one number, which CMakeLists.txt holds and everything else repeats; and its place in
the changelog."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERSEY = os.path.abspath(sys.argv.pop(1))
SOURCE = os.path.abspath(sys.argv.pop(1))
NAMING = ("CHANGELOG.md", "CMakeLists.txt", "CITATION.cff", "docs/citing.md", "docs/installing.md", "bench/key_figures.csv",
          "packaging/conda/recipe.yaml")


def found(pattern, path, folder=SOURCE):
    with open(os.path.join(folder, path), encoding="utf-8") as file:
        return re.findall(pattern, file.read(), re.MULTILINE)


def versions(folder=SOURCE):
    """What each file says, with the days of the release."""
    released = found(r"^## (\d+\.\d+\.\d+) \((\d{4}-\d\d-\d\d)\)$", "CHANGELOG.md", folder)[0]
    return {
        "CMakeLists.txt": found(r"^project\(hersey VERSION ([\d.]+)", "CMakeLists.txt", folder),
        "CHANGELOG.md": [released[0]],
        "CITATION.cff": found(r"^version: (.+)$", "CITATION.cff", folder),
        "docs/citing.md": found(r"version (\d+\.\d+\.\d+), ", "docs/citing.md", folder),
        "packaging/conda/recipe.yaml": found(r"^  version: ([\d.]+)$", "packaging/conda/recipe.yaml", folder),
        "docs/installing.md": found(r"_(\d+\.\d+\.\d+)-1_amd64", "docs/installing.md", folder),
    }, released[1], found(r"^date-released: (.+)$", "CITATION.cff", folder)[0]


class Release(unittest.TestCase):
    def assert_one_number(self, number, folder=SOURCE):
        stated, day, cited = versions(folder)
        for path, numbers in stated.items():
            self.assertTrue(numbers, path)
            self.assertEqual(set(numbers), {number}, path)
        self.assertEqual(cited, day, "CITATION.cff and CHANGELOG.md give two days")

    def test_one_number_everywhere(self):
        program = subprocess.run([HERSEY, "--version"], capture_output=True, text=True, check=True).stdout
        number = found(r"^project\(hersey VERSION ([\d.]+)", "CMakeLists.txt")[0]
        self.assertIn(number, program.split(), "the program was built from another version")
        self.assert_one_number(number)

    def test_only_what_comes_next_is_unreleased_and_releases_go_back_in_time(self):
        headings = found(r"^## (.+)$", "CHANGELOG.md")
        self.assertNotIn("Unreleased", headings[1:])
        released = [(tuple(map(int, number.split("."))), day) for number, day in
                    found(r"^## (\d+\.\d+\.\d+) \(([\d-]+)\)$", "CHANGELOG.md")]
        self.assertEqual(released, sorted(released, reverse=True))

    def test_the_script_of_a_release_changes_every_file(self):
        with tempfile.TemporaryDirectory() as folder:
            for path in NAMING:
                os.makedirs(os.path.dirname(os.path.join(folder, path)), exist_ok=True)
                shutil.copy(os.path.join(SOURCE, path), os.path.join(folder, path))
            release = [os.path.join(SOURCE, "scripts/release")]
            ended = {"env": {**os.environ, "HERSEY_SOURCE": folder}, "capture_output": True, "text": True, "check": False}
            with open(os.path.join(folder, "CHANGELOG.md"), encoding="utf-8") as file:
                text = file.read()
            if "\n## Unreleased\n" not in text:
                refused = subprocess.run([*release, "99.0.0"], **ended)
                self.assertEqual(refused.returncode, 2)
                self.assertIn("nothing to release", refused.stderr)
                with open(os.path.join(folder, "CHANGELOG.md"), "w", encoding="utf-8") as file:
                    file.write(text.replace("\n## ", "\n## Unreleased\n\n- Something.\n\n## ", 1))
            self.assertIn("does not come after", subprocess.run([*release, "0.0.1"], **ended).stderr)
            self.assertIn("expected MAJOR.MINOR.PATCH", subprocess.run([*release, "next"], **ended).stderr)
            self.assertEqual(subprocess.run([*release, "99.1.0"], **ended).returncode, 0)
            self.assert_one_number("99.1.0", folder)
            self.assertTrue(found(r"^example,.*,99\.1\.0,why it changed$", "bench/key_figures.csv", folder) or
                            not found(r"^example,.*,unreleased,", "bench/key_figures.csv"), "the key figures have no column of the release")


if __name__ == "__main__":
    unittest.main(verbosity=2)
