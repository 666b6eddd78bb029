#!/usr/bin/python3
"""No file leads back to itself by what it includes: within a module a header and its source count as one, and of such
pairs one is always below the other. A circle is untied by a small header of what both speak of."""

import glob
import os
import re
import sys
import unittest

SOURCE = os.path.abspath(sys.argv.pop(1))

INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
IMPORT = re.compile(r'^(?:import|export)\b[^;"]*"\./([^"]+)"', re.MULTILINE)
# Also those that wait within a function until it is called.
FROM = re.compile(r'^ *from (?:\.|hersey(?:_study)?\.)(\w+) import', re.MULTILINE)
SEVERAL = re.compile(r'^ *from \. import (.+)', re.MULTILINE)


def stem(path):
    return os.path.splitext(os.path.basename(path))[0]


def uses(files, pattern):
    """{name of a pair: the pairs that it includes}, by the text of each file {path: text}."""
    names = {stem(path) for path in files}
    graph = {name: set() for name in names}
    for path, text in files.items():
        graph[stem(path)] |= {stem(used) for used in pattern.findall(text)} & names - {stem(path)}
    return graph


def knots(graph):
    """The largest sets of names of which each leads to every other (Tarjan's strongly connected components)."""
    found, order, lowest, open_names = [], {}, {}, []

    def visit(name):
        order[name] = lowest[name] = len(order)
        open_names.append(name)
        for other in sorted(graph[name]):
            if other not in order:
                visit(other)
            if other in open_names:
                lowest[name] = min(lowest[name], lowest[other])
        if lowest[name] == order[name]:
            at = open_names.index(name)
            if len(open_names) - at > 1:
                found.append(sorted(open_names[at:]))
            del open_names[at:]

    for name in sorted(graph):
        if name not in order:
            visit(name)
    return found


def one_by_one(text):
    """A Python file's text with an import of several of its neighbours written as one of each."""
    return SEVERAL.sub(lambda line: "\n".join(f"from .{name.split()[0]} import *" for name in line[1].split(",")), text)


def read_all(*patterns):
    files = {}
    for pattern in patterns:
        for path in glob.glob(os.path.join(SOURCE, pattern), recursive=True):
            with open(path, encoding="utf-8") as file:
                files[path] = file.read()
    return files


class Knots(unittest.TestCase):
    def faults_of(self, place, files, pattern):
        self.assertGreater(len(files), 1, f"there are files in {place}")
        graph = uses(files, pattern)
        return [f"{place}: {' '.join(knot)}\n" + "\n".join(f"    {name} -> {' '.join(sorted(graph[name] & set(knot)))}"
                                                            for name in knot) for knot in knots(graph)]

    def test_files_of_a_module_do_not_include_each_other(self):
        faults = []
        for folder in sorted(glob.glob(os.path.join(SOURCE, "libs/*"))):
            module = os.path.basename(folder)
            # What another module's header of the same name is, is no business of this one.
            own = {path: re.sub(rf'#include "hersey/(?!{module}/)[^"]*"', "", text) for path, text in
                   read_all(f"libs/{module}/include/**/*.h", f"libs/{module}/src/**/*.h", f"libs/{module}/src/**/*.cpp").items()}
            faults += self.faults_of(f"libs/{module}", own, INCLUDE)
        program = {path: re.sub(r'#include "hersey/[^"]*"', "", text)
                   for path, text in read_all("apps/cli/*.h", "apps/cli/*.cpp").items()}
        faults += self.faults_of("apps/cli", program, INCLUDE)
        if faults:
            self.fail("files that include each other:\n" + "\n".join(faults))

    def test_files_of_the_web_page_do_not_import_each_other(self):
        faults = self.faults_of("web/src", read_all("web/src/*.ts"), IMPORT)
        if faults:
            self.fail("files that import each other:\n" + "\n".join(faults))

    def test_files_of_python_packages_do_not_import_each_other(self):
        faults = []
        for package in ("python/hersey", "python/hersey_study"):
            files = {path: one_by_one(text) for path, text in read_all(f"{package}/*.py").items()}
            faults += self.faults_of(package, files, FROM)
        if faults:
            self.fail("files that import each other:\n" + "\n".join(faults))

    def test_a_circle_is_found(self):
        files = {"a.h": '#include "b.h"\n', "b.cpp": '#include "b.h"\n#include "c.h"\n', "b.h": "",
                 "c.h": '#include "a.h"\n#include "d.h"\n', "d.h": ""}
        self.assertEqual(knots(uses(files, INCLUDE)), [["a", "b", "c"]])
        files["c.h"] = '#include "d.h"\n'
        self.assertEqual(knots(uses(files, INCLUDE)), [])
        imports = {"p.ts": 'import { q } from "./q";\n', "q.ts": 'import type {\n  P,\n} from "./p";\n'}
        self.assertEqual(knots(uses(imports, IMPORT)), [["p", "q"]])
        modules = {"p.py": one_by_one("from . import n, q\n"), "q.py": "def a():\n    from .p import b\n"}
        self.assertEqual(knots(uses(modules, FROM)), [["p", "q"]])


if __name__ == "__main__":
    unittest.main(verbosity=2)
