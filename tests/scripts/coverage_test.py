#!/usr/bin/python3
"""What `make coverage` counts, and what it does with branches that no test takes; compilers and programs are stood in for.

    coverage_test.py SOURCE [Class.test_name]
"""

import contextlib
import io
import os
import sys
import tempfile
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))
sys.path.insert(0, os.path.join(SOURCE, "tests/coverage"))

import coverage  # noqa: E402

CODE = """int f(int a) {
  HERSEY_REQUIRE(a > 0 && a < 9, "between \\"(\\" and )");
  if (a > 5) return 1;
  if constexpr (kFast) return 2;
  return a == 3 ? 3 : 4;
}
"""


class Coverage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-coverage-test-")
        self.addCleanup(folder.cleanup)
        self.root = folder.name
        self.build = os.path.join(self.root, "build")
        self.write("libs/film/src/a.cpp", CODE)
        self.write("tests/coverage/reasons.txt", "")
        os.makedirs(os.path.join(self.build, "profiles"))

    def write(self, path, text):
        path = os.path.join(self.root, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def report(self, found):
        """Exit code and what is printed where these are the counts."""
        real, coverage.branches = coverage.branches, lambda *_: found
        try:
            with contextlib.redirect_stdout(io.StringIO()) as out:
                return coverage.report(self.root, self.build), out.getvalue()
        finally:
            coverage.branches = real

    @staticmethod
    def counts(taken, missing=0):
        found = {("libs/film/src/a.cpp", (line, 1, line, 2), "a > 5", "true"): 1 for line in range(taken)}
        found.update({("libs/film/src/a.cpp", (line, 1, line, 2), f"b{line}", "false"): 0 for line in range(missing)})
        found["libs/solver/src/b.cpp", (1, 1, 1, 2), "c", "true"] = 1
        return found

    def test_contracts_are_found_whole_whatever_their_text_says(self):
        lines = CODE.split("\n")
        (first, last), = coverage.spans_of_contracts(lines)
        self.assertEqual((first, last), ((2, 3), (2, lines[1].rindex(")") + 1)))
        sources = coverage.Sources(self.root)
        self.assertTrue(sources.is_contract("libs/film/src/a.cpp", 2, 18))
        self.assertFalse(sources.is_contract("libs/film/src/a.cpp", 3, 7))
        self.assertEqual(sources.text("libs/film/src/a.cpp", 3, 7, 3, 12), "a > 5")
        self.assertEqual(sources.text("libs/film/src/a.cpp", 3, 14, 5, 9), "return 1; if constexpr (kFast) return 2; return")

    def test_what_is_decided_when_compiling_is_no_branch(self):
        for condition, line in (("kFast", "  if constexpr (kFast) return 2;"), ("N > 0", "const int n = N > 0 ? N : n_;"),
                                ("requires { l.f(T); }", "if (requires { l.f(T); })")):
            self.assertTrue(coverage.is_of_compiling(condition, line), condition)
        self.assertFalse(coverage.is_of_compiling("n > 0", "if (n > 0)"))

    def test_a_branch_without_a_reason_fails(self):
        status, reported = self.report(self.counts(99, 1))
        self.assertEqual(status, 1)
        self.assertIn("film: 99 of 100 branches taken, 99.0 %; 1 of the others without a reason", reported)
        self.assertIn("libs/film/src/a.cpp:0 | b0 | false", reported)
        self.write("tests/coverage/reasons.txt", "# why\nlibs/film/src/a.cpp | b0 | false | round-off only\n")
        self.assertEqual(self.report(self.counts(99, 1))[0], 0)

    def test_less_than_the_bar_fails_with_every_reason(self):
        self.write("tests/coverage/reasons.txt", "".join(f"libs/film/src/a.cpp | b{k} | false | so\n" for k in range(6)))
        status, reported = self.report(self.counts(94, 6))
        self.assertEqual(status, 1)
        self.assertIn("at least 95 % are asked for", reported)
        self.assertEqual(self.report(self.counts(95, 5))[0], 1)  # the sixth reason has nothing to say

    def test_a_reason_for_what_is_taken_fails(self):
        self.write("tests/coverage/reasons.txt", "libs/film/src/a.cpp | a > 5 | true | never\n")
        status, reported = self.report(self.counts(99))
        self.assertEqual(status, 1)
        self.assertIn("is taken or is no longer there", reported)


if __name__ == "__main__":
    unittest.main()
