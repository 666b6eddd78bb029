#!/usr/bin/python3
"""Tests argue: a tolerance has a reason, a random number a seed."""

import glob
import os
import re
import sys
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))
BARE = re.compile(r"(?<![\w.])1e-\d+")
# What stands before a tolerance: `.epsilon(`, a comparison, a matrix's own test.
BOUND = re.compile(r"(epsilon\(|(?<![<])<=?(?![<=])[^<>;?]*|\b(isZero|isApprox|isUnitary|isIdentity|isConstant)\([^;]*)$")
CONSTANT = re.compile(r"\b(constexpr|const) double k[A-Z]\w* = 1e-\d+;")
CHECK = re.compile(r"\s*((for|if) \(.*\) )?(CHECK|REQUIRE)")


def read(path):
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        return file.read()


def tests(ending):
    found = [path for pattern in ("libs/*/test/**/*", "tests/**/*")
             for path in glob.glob(os.path.join(SOURCE, f"{pattern}.{ending}"), recursive=True)]
    return sorted(os.path.relpath(path, SOURCE) for path in found)


class Statements:
    """The lines of a C++ file, with the statement that each belongs to."""

    def __init__(self, text):
        self.lines = text.splitlines()
        self.code = [re.sub(r'"(?:\\.|[^"\\])*"', '""', line).split("//")[0].rstrip() for line in self.lines]

    def is_comment(self, i):
        return self.lines[i].lstrip().startswith("//")

    def first(self, i):
        """Where the statement of line i begins: behind the end of another one, a blank line or a comment."""
        while i > 0 and not self.is_comment(i - 1) and self.code[i - 1] and self.code[i - 1][-1] not in ";{}:":
            i -= 1
        return i

    def last(self, i):
        while i + 1 < len(self.code) and self.code[i] and self.code[i][-1] not in ";{}":
            i += 1
        return i

    def says_why(self, i):
        """A comment in the statement, above it, or above the unbroken run of checks it belongs to."""
        first = self.first(i)
        if any("//" in self.lines[k] for k in range(first, self.last(i) + 1)):
            return True
        while first > 0 and not self.is_comment(first - 1):
            before = self.first(first - 1)
            if not CHECK.match(self.lines[before]) or not CHECK.match(self.lines[first]):
                return False
            first = before
        return first > 0


class Tolerances(unittest.TestCase):
    """Expressions such as `64 * n * eps` speak for themselves; 1e-9 does not, nor does a name for it."""

    def test_bare_powers_of_ten_say_why(self):
        faults = []
        for path in tests("cpp") + tests("h"):
            file = Statements(read(path))
            for i, code in enumerate(file.code):
                is_bound = any(BOUND.search(code[:found.start()]) for found in BARE.finditer(code))
                if (is_bound or CONSTANT.search(code)) and not file.says_why(i):
                    faults.append(f"{path}:{i + 1}: {file.lines[i].strip()}")
        if faults:
            self.fail("tolerances without a reason:\n" + "\n".join(faults))


class RandomNumbers(unittest.TestCase):
    def test_every_generator_has_a_fixed_seed(self):
        unseeded = {"cpp": r"\bmt19937(_64)? \w+(;|\(\)|\{\})|random_device|default_random_engine|::Random\(|setRandom\(|\bs?rand\(",
                    "py": r"\brandom\.(Random\(\)|random\(|randint\(|uniform\(|choice\(|shuffle\(|sample\()|default_rng\(\)"}
        unseeded["h"] = unseeded["cpp"]
        faults = [f"{path}: {found[0]}" for ending, pattern in unseeded.items() for path in tests(ending)
                  if not path.startswith("tests/documents/") for found in re.finditer(pattern, read(path))]
        if faults:
            self.fail("generators without a seed:\n" + "\n".join(faults))


if __name__ == "__main__":
    unittest.main(verbosity=2)
