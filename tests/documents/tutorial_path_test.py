#!/usr/bin/python3
"""tutorial_path_test.py HERSEY SOURCE   a new user's path: from `make demo` to the report of a bearing of one's own with changed
numbers. The commands are those of the tutorial's first page, in its order; at most ten; and what the page says they show is in the
reports that they write."""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

HERSEY = os.path.abspath(sys.argv.pop(1))
SOURCE = os.path.abspath(sys.argv.pop(1))
PAGE = "docs/tutorial/first-bearing.md"


def commands_of(page):
    """What a reader types: the lines of the page's blocks, each here-document with the line that begins it."""
    commands = []
    for block in re.findall(r"^```(?:sh|text)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL):
        for command in re.findall(r".*<<'END'\n(?:.*\n)*?END\n|.+\n", block):
            commands.append(command.strip())
    return commands


def report(path):
    """The data of a report, as its page reads them."""
    with open(path, encoding="utf-8") as file:
        return json.loads(re.search(r'<script id="hersey-data" type="application/json">(.*?)</script>', file.read(), re.DOTALL)[1])


def figures(path):
    return {f["key"]: f["value"] for f in report(path)["bearing"]["solutions"][0]["figures"]}


class NewUser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(os.path.join(SOURCE, PAGE), encoding="utf-8") as file:
            cls.page = file.read()
        cls.commands = commands_of(cls.page)
        kept = tempfile.TemporaryDirectory(prefix="hersey-new-user-")
        cls.addClassCleanup(kept.cleanup)
        cls.folder = kept.name
        # A checkout whose program is built, and no more: examples, scripts, Makefile.
        for name in ("examples", "scripts", "Makefile"):
            os.symlink(os.path.join(SOURCE, name), os.path.join(cls.folder, name))
        os.makedirs(os.path.join(cls.folder, "build/release"))
        os.symlink(HERSEY, os.path.join(cls.folder, "build/release/hersey"))
        cls.ended = [(command, cls.typed(command)) for command in cls.commands]

    @classmethod
    def typed(cls, command):
        # The program is there: what is left of `make demo` is the run, here its short form.
        if command == "make demo":
            command = "scripts/demo build/release 1"
        return subprocess.run(["bash", "-euo", "pipefail", "-c", command], cwd=cls.folder, text=True, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=120, check=False)

    def number_after(self, pattern):
        found = re.search(pattern, self.page.replace("\n", " "))
        self.assertTrue(found, f"{PAGE} does not say: {pattern}")
        return float(found[1])

    def test_every_command_of_the_page_ends_well(self):
        for command, run in self.ended:
            self.assertEqual(run.returncode, 0, f"{command}\n{run.stdout}{run.stderr}")

    def test_ten_commands_lead_from_the_demo_to_changed_numbers(self):
        self.assertEqual(self.commands[0], "make demo")
        with open(os.path.join(SOURCE, "Makefile"), encoding="utf-8") as file:
            self.assertRegex(file.read(), r"(?m)^demo: program .*\n\t@scripts/demo \$\(BUILD\)")
        changed = next(k for k, command in enumerate(self.commands) if "--set" in command and "--report" in command)
        self.assertLessEqual(changed + 1, 10, self.commands)
        self.assertLessEqual(len(self.commands), 10, self.commands)

    def test_the_demo_tells_where_its_report_is(self):
        printed = re.search(r"open in a browser: file://(\S+)", self.ended[0][1].stdout)
        self.assertTrue(printed, self.ended[0][1].stdout)
        self.assertTrue(report(printed[1])["runs"])

    def test_the_first_report_shows_what_the_page_says(self):
        found = figures(os.path.join(self.folder, "build/tutorial/bearing.html"))
        # The page gives three digits: half a unit of the last one, and its rounding.
        for key, pattern, unit in (("eccentricity_ratio", r"eccentricity ratio of ([\d.]+)", 0.0006), ("h_min", r"smallest film is ([\d.]+) um, the peak", 0.06),
                                   ("p_max", r"the peak pressure ([\d.]+) MPa", 0.006), ("attitude", r"attitude angle, ([\d.]+) degrees", 0.6)):
            self.assertAlmostEqual(found[key], self.number_after(pattern), delta=unit, msg=key)

    def test_the_changed_report_shows_the_changed_numbers(self):
        first, second = (figures(os.path.join(self.folder, "build/tutorial", name)) for name in ("bearing.html", "wider.html"))
        self.assertAlmostEqual(second["h_min"], self.number_after(r"smallest film is ([\d.]+) um now"), delta=0.06)  # three digits
        self.assertIn("twice as much oil flows through", self.page)
        self.assertAlmostEqual(second["side_flow"] / first["side_flow"], 2, delta=0.3)  # "twice", in words
        solution = report(os.path.join(self.folder, "build/tutorial/wider.html"))["bearing"]["solutions"][0]
        self.assertAlmostEqual(solution["films"][0]["clearance"], 60e-6, delta=1e-12)  # round-off of the unit


if __name__ == "__main__":
    unittest.main(verbosity=2)
