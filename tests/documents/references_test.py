#!/usr/bin/python3
"""What documents and code point at exists: linked files, functions and tests in the theory manual's closing tables, the
equations that the code names and the tests that its docstrings name."""

import glob
import os
import re
import sys
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))


def read(path):
    with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
        return file.read()


def pages(*patterns):
    return sorted(os.path.relpath(path, SOURCE) for pattern in patterns
                  for path in glob.glob(os.path.join(SOURCE, pattern)))


def code_files():
    """Every source file, tests included, by path."""
    found = []
    for top in ("libs", "apps", "verification", "bench", "tests", "web/src"):
        for ending in ("h", "cpp", "ts", "py"):
            found += glob.glob(os.path.join(SOURCE, top, "**", f"*.{ending}"), recursive=True)
    return sorted(os.path.relpath(path, SOURCE) for path in found)


def checked_files():
    """Code that means what it names: all but this folder, which talks about names."""
    return [path for path in code_files() if not path.startswith("tests/documents/")]


CHAPTERS = ("circuit", "damper", "film-surface", "flexible-bodies", "film", "bearing", "contact", "beams", "elastic", "hydrostatic", "integrator",
            "mechanisms", "pads", "rings", "rotors", "skirt", "slider", "thermal", "thrust", "wear", "turbulence")
# `film.3`, and `(film.3) to (film.6)`, `film.3 to film.6`, `film.3 to 6`, also over the end of a comment's line.
NUMBER = re.compile(rf"(?<![\w.-])({'|'.join(CHAPTERS)})\.(\d+)(?!\w)")
RANGE = re.compile(rf"(?<![\w.-])({'|'.join(CHAPTERS)})\.(\d+)\)?(?:\s|//+|#)+to(?:\s|//+|#)+\(?(?:\1\.)?(\d+)(?!\w)")


def equations_named_in(text):
    """Numbers of equations, `film.3`, each as often as it is named; what a range spans counts as named."""
    spans = [f"{chapter}.{number}" for chapter, first, last in RANGE.findall(text)
             for number in range(int(first), int(last) + 1)]
    return spans + [f"{chapter}.{number}" for chapter, number in NUMBER.findall(text)]


def equations_shown_in(page):
    """Numbers in the order of the page: at the end of a line, after two spaces, or behind the title of a paragraph."""
    shown = re.findall(r"^\*\*[^*\n]+\*\* \(([\w-]+\.\d+)\)|\S.*?\s{2,}\(([\w-]+\.\d+)\)[,.:;]?$", page, re.MULTILINE)
    return list(dict.fromkeys(title or end for title, end in shown))


class Equations(unittest.TestCase):
    def setUp(self):
        self.shown = {page: equations_shown_in(read(page)) for page in pages("docs/theory/*.md")}
        self.all = {number for numbers in self.shown.values() for number in numbers}

    def test_equations_that_are_named_exist(self):
        faults = [f"{path} names ({number}), which the theory manual does not show"
                  for path in checked_files() + pages("*.md", "docs/*.md", "docs/*/*.md")
                  for number in sorted(set(equations_named_in(read(path))) - self.all)]
        if faults:
            self.fail("\n".join(faults))

    def test_equations_are_numbered_in_their_order(self):
        for page, numbers in self.shown.items():
            expected = [f"{numbers[0].split('.')[0]}.{k}" for k in range(1, len(numbers) + 1)]
            self.assertEqual(numbers, expected, f"the equations of {page}")

    def test_every_equation_is_named_in_code(self):
        named = {number for path in checked_files() for number in equations_named_in(read(path))}
        faults = [f"no code names ({number})" for number in sorted(self.all - named)]
        if faults:
            self.fail("\n".join(faults))


class NamedTests(unittest.TestCase):
    """`@verified_by some_test.cpp: Claim_Holds, Another_..., other_test.cpp, tests/folder`."""

    def setUp(self):
        self.tests = {os.path.basename(path): path for path in code_files()}

    def test_files_and_claims_exist(self):
        faults, count = [], 0
        for path in checked_files():
            text = re.sub(r"\s*\n\s*///?", "", read(path))
            for named in re.findall(r"@verified_by\s+([\w./]+(?::\s*\w+)?(?:,\s*[\w./]+(?::\s*\w+)?)*)", text):
                file = None
                for name in re.findall(r"[\w./]+", named):
                    count += 1
                    file = name if "/" in name or name.endswith((".cpp", ".py")) else file
                    if not self.holds(file, name):
                        faults.append(f"{path} names {name}" + (f" of {file}" if name != file else "") + ", which does not exist")
        self.assertGreater(count, 40)
        if faults:
            self.fail("\n".join(faults))

    def holds(self, file, name):
        if file is not None and "/" in file:
            return os.path.exists(os.path.join(SOURCE, file))
        return file in self.tests and (name == file or f'"{name.rstrip(".")}' in read(self.tests[file]))


class Links(unittest.TestCase):
    def test_relative_links_lead_to_files(self):
        faults = []
        for page in pages("*.md", "docs/*.md", "docs/*/*.md", "examples/*/README.md"):
            for target in re.findall(r"\]\(([^)\s#]+)(?:#[^)]*)?\)", read(page)):
                path = os.path.join(SOURCE, os.path.dirname(page), target)
                if "://" not in target and not os.path.exists(path):
                    faults.append(f"{page} links to {target}, which does not exist")
        if faults:
            self.fail("\n".join(faults))


class BearingPage(unittest.TestCase):
    def test_every_group_of_figures_has_a_place_on_the_page(self):
        groups = re.findall(r'\breturn \{\s*"([^"]+)",', read("libs/study/src/bearing_figures.cpp"))
        self.assertIn("film", groups)
        page = read("web/src/bearing_page.ts")
        for group in groups:
            if group != "stiffness and damping" and f'"{group}"' not in page:  # those are matrices of their own
                self.fail(f"figures of the group '{group}' are on no page")


class TheoryTables(unittest.TestCase):
    """Rows `| (film.3) | `film/reynolds.cpp: balance` | `reynolds_test.cpp: Flux_IsConserved`, `Another` |`."""

    def setUp(self):
        self.faults = []
        self.files = code_files()
        self.words = {}

    def test_equation_numbers_are_unique(self):
        for page in pages("docs/theory/*.md"):
            numbers = re.findall(r"\s{2,}\(([\w-]+\.\d+)\)[,.:;]?$", read(page), re.MULTILINE)
            repeated = {number for number in numbers if numbers.count(number) > 1}
            self.assertFalse(repeated, f"{page} numbers two equations alike")

    def test_functions_and_tests_exist(self):
        for page in pages("docs/theory/*.md"):
            text = read(page)
            for cells in self.rows(page, text):
                for number in re.findall(r"\((\w+\.\d+)\)", cells[0]):
                    if text.count(f"({number})") < 2:
                        self.faults.append(f"{page}: ({number}) is in the table only")
                for cell in cells[1:]:
                    self.check_references(page, cell)
        if self.faults:
            self.fail("\n".join(self.faults))

    def test_tables_hold_every_equation(self):
        for page in pages("docs/theory/*.md"):
            text = read(page)
            listed = {number for cells in self.rows(page, text) for number in equations_named_in(cells[0])}
            self.faults += [f"{page}: ({number}) is not in the closing table"
                            for number in equations_shown_in(text) if number not in listed]
        if self.faults:
            self.fail("\n".join(self.faults))

    def rows(self, page, text):
        table = re.search(r"^\|\s*equation.*\|\s*$\n\|[-:| ]+\|\n((?:\|.*\n?)+)", text, re.MULTILINE | re.IGNORECASE)
        if table is None:
            self.faults.append(f"{page} has no closing table equation | function | test")
            return
        for line in table.group(1).splitlines():
            yield [cell.strip() for cell in line.strip().strip("|").split("|")]

    def check_references(self, page, cell):
        """Each `file: name` and each `name`: the file exists and holds it; a name before any file is in some file."""
        current = self.files
        for reference in re.findall(r"`([^`]+)`", cell):
            name = reference
            if re.match(r"[\w/.-]+\.(h|cpp|ts|py)\b", reference):
                path, _, name = (part.strip() for part in reference.partition(":"))
                # `film/x.cpp` stands for libs/film/src/x.cpp, `x_test.cpp` for the test of that name in any module.
                *folders, base = path.split("/")
                current = [file for file in self.files
                           if os.path.basename(file) == base and set(folders) <= set(file.split("/"))]
                if not current:
                    self.faults.append(f"{page} names {path}, which does not exist")
                    return
            for word in re.findall(r"[A-Za-z_]\w*", name):
                if not any(self.holds(file, word) for file in current):
                    place = current[0] if len(current) == 1 else "any source file"
                    self.faults.append(f"{page} names {word}, which is not in {place}")

    def holds(self, path, word):
        """The file has this word, or is the program of this name."""
        if path not in self.words:
            self.words[path] = set(re.findall(r"\w+", read(path)))
        stem = os.path.splitext(os.path.basename(path))[0]
        return stem == word or word in self.words[path]


if __name__ == "__main__":
    unittest.main(verbosity=2)
