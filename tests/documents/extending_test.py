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


class Extending(unittest.TestCase):
    def test_changes_of_the_page_compile(self):
        with open(os.path.join(SOURCE, "docs/extending.md"), encoding="utf-8") as file:
            changes = re.findall(r"^```diff\n(.*?)^```$", file.read(), re.MULTILINE | re.DOTALL)
        self.assertTrue(changes, "the page shows a change")
        for change in changes:
            with tempfile.TemporaryDirectory(prefix="hersey-extending-") as folder:
                for part in ("libs", "verification", "tests/support"):
                    shutil.copytree(os.path.join(SOURCE, part), os.path.join(folder, part))
                patch = subprocess.run(["git", "apply", "-p1"], cwd=folder, input=change, text=True, capture_output=True,
                                       check=False)
                self.assertEqual(patch.returncode, 0, patch.stdout + patch.stderr)
                includes = [f"-I{path}" for path in glob.glob(os.path.join(folder, "libs/*/include")) +
                            glob.glob(os.path.join(folder, "libs/*/src"))]
                includes += [f"-I{folder}/verification", f"-I{folder}/tests/support"]
                touched = [path for path in re.findall(r"^\+\+\+ b/(\S+)", change, re.MULTILINE) if path.endswith(".cpp")]
                self.assertTrue(touched)
                for path in touched:
                    run = subprocess.run([COMPILER, "-std=c++20", "-fsyntax-only", "-Wall", "-Werror", *includes, "-isystem",
                                          "/usr/include/eigen3", path], cwd=folder, text=True, capture_output=True, check=False)
                    self.assertEqual(run.returncode, 0, run.stderr[-3000:])


if __name__ == "__main__":
    unittest.main(verbosity=2)
