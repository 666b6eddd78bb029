#!/usr/bin/python3
"""A film's c is its scale; as the measure of a bearing it is read in one place, bearing/clearance.h. What reads models
puts it there."""

import glob
import os
import re
import sys
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))

READS = re.compile(r"\b(?:film|model)_?(?:\(\))?\.c\b")


def readers(files):
    return [f"{path}:{k}: {line.strip()}" for path, text in files.items()
            for k, line in enumerate(text.split("\n"), 1) if READS.search(line.split("//")[0])]


class Clearance(unittest.TestCase):
    def test_bearings_read_it_in_one_place(self):
        files = {}
        for module in ("bearing", "run", "study", "report"):
            for path in glob.glob(os.path.join(SOURCE, "libs", module, "**", "*.*"), recursive=True):
                if "/test/" in path or path.endswith("bearing/clearance.h"):
                    continue
                with open(path, encoding="utf-8") as file:
                    files[os.path.relpath(path, SOURCE)] = file.read()
        self.assertGreater(len(files), 100)
        self.assertEqual(readers(files), [], "use bearing::clearance()")

    def test_readers_are_found(self):
        for line in ("h > film.c;", "e / model_.c", "1e6 * model().c;", "bearing.film.c - 1"):
            self.assertNotEqual(readers({"x.cpp": line}), [], line)
        for line in ("film.compliance", "clearance(model)", "// film.c"):
            self.assertEqual(readers({"x.cpp": line}), [], line)


if __name__ == "__main__":
    unittest.main()
