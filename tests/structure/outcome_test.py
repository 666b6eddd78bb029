#!/usr/bin/python3
"""Everything that may end without an answer is an Outcome (core/outcome.h) and asked by solved(): other spellings do not
come back (docs/decisions/0016-one-outcome.md)."""

import glob
import os
import re
import sys
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))

ROOMS = ("libs", "apps", "python/src", "tests", "validation", "verification", "bench", "examples")
PAGES = ("docs/cpp-library.md", "docs/extending.md")

# Call sites, and types that would bring them back.
ASKED = re.compile(r"(?:\.|->)(?:(?:converged|consistent|balanced|is_taken|has_failed|ok|succeeded)\(\)|(?:converged|ok)\b(?!\s*\())")
EMPTY = re.compile(r"\b(?:trouble|error)\.empty\(\)")
STATUS = re.compile(r"[!=]= ?(?:\w+::)*(?:StepStatus::converged|InitialiseStatus::consistent|KinematicsStatus::solved|"
                    r"FactorStatus::factorised|Ending::\w+)")
MEMBER = re.compile(r"^\s+(?:\[\[nodiscard\]\] )?bool (?:converged|consistent|solved|ok|succeeded)(?:\(\)| = |;)", re.MULTILINE)
DERIVED = re.compile(r"struct (\[\[nodiscard\]\] )?(\w+) : (?:public )?(?:hersey::)?Outcome(?:Of<|\b)")
COMMENT = re.compile(r"//[^\n]*")
STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')

# Numbers and tables of this name, no outcomes.
NO_OUTCOME = {"libs/report/src/summary.cpp": {"error.empty()"}}


def faults(path, text):
    """What breaks the rule in the text of a source."""
    code = STRING.sub('""', COMMENT.sub("", text))
    found = [match.group() for pattern in (ASKED, EMPTY, STATUS) for match in pattern.finditer(code)]
    if path.endswith(".h") and not path.endswith("core/outcome.h"):
        found += [match.group().strip() for match in MEMBER.finditer(code)]
    return [each for each in found if each not in NO_OUTCOME.get(path, ())]


def without_nodiscard(text):
    """Types derived from an outcome that may be thrown away unnoticed."""
    return [name for is_kept, name in DERIVED.findall(text) if not is_kept]


def sources():
    for room in ROOMS:
        for path in glob.glob(os.path.join(SOURCE, room, "**", "*"), recursive=True):
            if path.endswith((".h", ".cpp")):
                yield os.path.relpath(path, SOURCE)
    yield from PAGES


class OneOutcome(unittest.TestCase):
    def test_all_that_may_end_without_an_answer_is_asked_by_solved(self):
        found, derived = [], 0
        for path in sources():
            with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
                text = file.read()
            found += [f"{path}: {each}" for each in faults(path, text)]
            derived += len(DERIVED.findall(text))
        self.assertEqual(found, [])
        self.assertGreater(derived, 20)  # the pattern finds them at all

    def test_types_of_outcomes_cannot_be_dropped_unnoticed(self):
        found = []
        for path in sources():
            if path.endswith(".h"):
                with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
                    found += [f"{path}: {name}" for name in without_nodiscard(file.read())]
        self.assertEqual(found, [])

    def test_old_spellings_are_found(self):
        for line in ("if (summary.converged) return;", "if (!step.converged()) return;", "REQUIRE(start.consistent());",
                     "if (!modes.ok) return;", "if (solver_->factorise().ok()) return;", "if (trouble.empty()) return;",
                     "if (!solution.error.empty()) return;", "if (advance.has_failed()) return;",
                     "if (step.status != StepStatus::converged) return;"):
            self.assertNotEqual(faults("x.cpp", line), [], line)
        self.assertNotEqual(faults("x.h", "struct A {\n  bool converged = false;\n};"), [])
        self.assertEqual(without_nodiscard("struct A : Outcome {"), ["A"])
        for line in ("if (cycles.converged(change)) return;", 'say("not .converged() yet");', "a.converge();",
                     "summary.status = StepStatus::converged;", "if (balanced(row)) return;"):
            self.assertEqual(faults("x.cpp", line), [], line)


if __name__ == "__main__":
    unittest.main()
