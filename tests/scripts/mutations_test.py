#!/usr/bin/python3
"""Faults by machine: what is changed in a line, and what is left alone.

    mutations_test.py SOURCE [Class.test_name]
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))
sys.path.insert(0, os.path.join(SOURCE, "validation"))

import mutation_operators as operators  # noqa: E402
import mutations  # noqa: E402


class Mutations(unittest.TestCase):
    def changed(self, line):
        return sorted({changed for _, changed in operators.changes(line)})

    def test_each_operator_changes_its_part_of_a_line(self):
        self.assertEqual(self.changed("if (a < b) return;"), ["if (a >= b) return;"])
        self.assertEqual(self.changed("x = a + b * c;"), ["x = a - b * c;", "x = a;"])
        self.assertEqual(self.changed("x = f(a - g(b, c), d);"), ["x = f(a + g(b, c), d);", "x = f(a, d);"])
        self.assertEqual(self.changed("x += 2 * a;"), ["x += 3 * a;", "x -= 2 * a;"])
        self.assertEqual(self.changed("return -a;"), ["return a;"])
        self.assertEqual(self.changed("x = std::max(a, 0.5);"), ["x = std::max(a, (1.5 * 0.5));", "x = std::min(a, 0.5);"])
        self.assertEqual(self.changed("ok = a && b;"), ["ok = a || b;"])

    def test_text_comments_and_checks_are_left_alone(self):
        for line in ('text = "a + b";', "// x = a + b;", "std::vector<int> n;", "const auto& x = a;", "x = a;  // 2 + 2"):
            self.assertEqual(self.changed(line), [], line)
        lines = ["  HERSEY_REQUIRE(a > 0, 1);\n", "#if A > 2\n", '  throw InputError("a" + 1);\n', "  x = a + b;\n"]
        self.assertEqual({new for *_, new in operators.of_file("film/src/x.cpp", lines)}, {"  x = a - b;\n", "  x = a;\n"})

    def test_old_text_occurs_once_and_a_seed_draws_the_same(self):
        drawn = operators.drawn(SOURCE, ["solver"], 12, "1")
        self.assertEqual(drawn, operators.drawn(SOURCE, ["solver"], 12, "1"))
        self.assertEqual(len(drawn), 12)
        for _, file, old, new, _ in drawn:
            with open(os.path.join(SOURCE, "libs", file), encoding="utf-8") as source:
                self.assertEqual(source.read().count(old), 1)
            self.assertNotEqual(old, new)

    def test_a_sample_stays_as_it_is_where_other_lines_come_and_go(self):
        lines = [f"  x = a{k} + b{k};\n" for k in range(9)]
        with tempfile.TemporaryDirectory() as folder:
            def drawn_of(of):
                os.makedirs(os.path.join(folder, "libs/film/src"), exist_ok=True)
                with open(os.path.join(folder, "libs/film/src/x.cpp"), "w", encoding="utf-8") as file:
                    file.writelines(of)
                return [fault[3] for fault in operators.drawn(folder, ["film"], 4, "7")]
            first = drawn_of(lines)
            others = [line for line in lines if not any(line[:8] == new[:8] for new in first)]
            self.assertEqual(drawn_of(["  y();\n"] + [line for line in lines if line != others[0]]), first)

    def test_changes_that_are_no_faults_are_counted_and_not_tried(self):
        for (file, part, new), reason in operators.EQUIVALENT.items():
            self.assertEqual(operators.why_equivalent(file, f"  {part}", f"  x {new};"), reason)
            if new:
                self.assertEqual(operators.why_equivalent(file, f"  {part}", "  another change;"), "")
        self.assertEqual(operators.why_equivalent(file, "  x = a;", "x = b;"), "")
        fault = mutations.Fault("solver: x", file, part, "", "", reason)
        self.assertEqual(mutations.Trial(1).verdict(fault, {}), ("equivalent", [reason]))

    def test_each_change_that_is_no_fault_has_its_line_and_its_kind(self):
        for (file, part, _), reason in operators.EQUIVALENT.items():
            with open(os.path.join(SOURCE, "libs", file), encoding="utf-8") as source:
                self.assertIn(part, source.read(), file)
            self.assertRegex(reason, "^(nothing changes|round-off|cost): ")

    def test_each_planted_fault_is_found_where_it_says(self):
        mutations.check_places(mutations.FAULTS)

    def test_quick_tests_and_new_ones_are_asked_first(self):
        class Stub(mutations.Trial):
            asked = []

            def run_parts(self, _, __, wanted):
                self.asked = self.asked + wanted
                return []

        trial = Stub(2)
        trial.costs = {"film": {"slow": 60.0, "a": 0.01, "b": 0.02, "slower": 90.0, "middling": 1.0}}
        self.assertEqual(trial.test("x", "film"), [])
        self.assertEqual(trial.asked, ["--test-case-exclude=slow,b,slower,middling", "--test-case=b", "--test-case=middling",
                                       "--test-case=slow", "--test-case=slower"])

    def test_only_the_tests_of_the_modules_asked_for_are_built(self):
        class Stub(mutations.Trial):
            built = []

            def plant(self, _):
                pass

            mend = plant

            def build(self, _, modules):
                self.built = self.built + modules
                return subprocess.CompletedProcess([], 0)

            def test(self, *_):
                return []

        above = {"film": ["film", "bearing", "model", "run"]}
        fault = mutations.Fault("film: x", "film/src/x.cpp", "a", "b")
        for options, built in (({"within": ["bearing", "solver"]}, ["film", "bearing"]), ({"is_near": True}, ["film"]),
                               ({}, above["film"] + mutations.PROGRAM)):
            trial = Stub(1, **options)
            self.assertEqual(trial.verdict(fault, above), ("survived", []))
            self.assertEqual(trial.built, built)

    def test_warnings_are_no_verdict_on_a_fault(self):
        code = mutations.UNWARNED + "bool f(bool a, bool b, bool c) { int unused = 0; return a && b || c; }"
        compiler = shutil.which("clang++")
        if compiler is None:
            self.skipTest("no clang")
        run = subprocess.run([compiler, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-x", "c++", "-"], input=code, text=True,
                             capture_output=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)


if __name__ == "__main__":
    unittest.main()
