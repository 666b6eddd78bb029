#!/usr/bin/python3
"""Runs the commands a reader is told to run.

Every ```sh block of the README, the documentation and the examples' pages is executed, in order, in a folder that looks
like the repository's root with the program built; ```text blocks are not.
"""

import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE, BUILD = os.path.abspath(sys.argv.pop(1)), os.path.abspath(sys.argv.pop(1))
PAGES = ["README.md", "docs/*.md", "docs/*/*.md", "examples/*/README.md"]


def blocks(text):
    """The ```sh blocks of a page, with the line each starts in."""
    for match in re.finditer(r"^```sh\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        yield text.count("\n", 0, match.start()) + 2, match.group(1)


def stand_in_for_the_repository(folder):
    """Links to the sources, with build/release being the build under test, so that nothing is written to either."""
    for name in os.listdir(SOURCE):
        if not name.startswith((".", "build")):
            os.symlink(os.path.join(SOURCE, name), os.path.join(folder, name))
    os.mkdir(os.path.join(folder, "build"))
    os.symlink(BUILD, os.path.join(folder, "build/release"))


class Commands(unittest.TestCase):
    def test_every_sh_block_runs(self):
        paths = [path for pattern in PAGES for path in sorted(glob.glob(os.path.join(SOURCE, pattern)))]
        count = 0
        for path in paths:
            with open(path, encoding="utf-8") as file:
                found = list(blocks(file.read()))
            if not found:
                continue
            with tempfile.TemporaryDirectory(prefix="hersey-docs-") as folder:
                stand_in_for_the_repository(folder)
                for line, commands in found:
                    count += 1
                    with self.subTest(f"{os.path.relpath(path, SOURCE)}:{line}"):
                        run = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=folder, text=True,
                                             capture_output=True, stdin=subprocess.DEVNULL, timeout=280)
                        self.assertEqual(run.returncode, 0, f"{commands}\n{run.stdout[-2000:]}\n{run.stderr[-2000:]}")
        self.assertGreater(count, 0, "the README has commands to try")


if __name__ == "__main__":
    unittest.main(verbosity=2)
