#!/usr/bin/python3
"""Folders of a module are floors: of any two, one at most uses the other, straight or through others. A source and its
header count as one file, which lies where the source does. A public header without a source lies in no folder: whoever
includes it uses all that it includes."""

import glob
import os
import sys
import unittest

from knots_test import INCLUDE, SOURCE, knots, stem


def folder_of(files):
    """{name of a pair: its folder below src, "" for src itself}; public headers without a source are left out."""
    return {stem(path): os.path.dirname(path).partition("src")[2].strip("/") for path in files if path.startswith("src/")}


def uses(files, module):
    """{(file, file used): whatever lies in between} of all pairs that lie in folders, by the text of each {path: text}."""
    direct = {stem(path): set() for path in files}
    for path, text in files.items():
        for name in INCLUDE.findall(text):
            if not name.startswith("hersey/") or name.startswith(f"hersey/{module}/"):
                direct[stem(path)] |= {stem(name)} & direct.keys() - {stem(path)}
    lies_in, found = folder_of(files), {}
    for name in lies_in:
        through = [(used, ()) for used in sorted(direct[name])]
        seen = set()
        while through:
            used, way = through.pop(0)
            if used in seen:
                continue
            seen.add(used)
            if used in lies_in:
                found[name, used] = way
            else:
                through += [(further, (*way, used)) for further in sorted(direct[used])]
    return found


def below(folder, parent):
    """The folder of `parent` in which `folder` lies, or "." where it is `parent` itself; None where it lies elsewhere."""
    if folder == parent:
        return "."
    prefix = parent + "/" if parent else ""
    return folder[len(prefix):].split("/")[0] if folder.startswith(prefix) else None


def circles(files, module):
    """Lines that tell each set of neighbouring folders that use each other, and by which files."""
    lies_in, faults = folder_of(files), []
    arrows = uses(files, module)
    parents = {""}
    for folder in set(lies_in.values()):
        parts = folder.split("/")
        parents |= {"/".join(parts[:k]) for k in range(1, len(parts) + 1)}
    for parent in sorted(parents):
        graph, by = {}, {}
        for (name, used), way in sorted(arrows.items()):
            here, there = below(lies_in[name], parent), below(lies_in[used], parent)
            if here is None or there is None or here == there:
                continue
            graph.setdefault(here, set()).add(there)
            graph.setdefault(there, set())
            by.setdefault((here, there), []).append(" > ".join((name, *way, used)))
        for knot in knots(graph):
            faults.append(f"{module}/src/{parent}: {' '.join(knot)}")
            faults += [f"    {here} -> {there}: {', '.join(names[:3])}{', ...' if len(names) > 3 else ''}"
                     for (here, there), names in sorted(by.items()) if here in knot and there in knot]
    return faults


def files_of(module):
    root = os.path.join(SOURCE, "libs", module)
    files = {}
    for path in glob.glob(os.path.join(root, "include/**/*.h"), recursive=True) + \
            glob.glob(os.path.join(root, "src/**/*.*"), recursive=True):
        if path.endswith((".h", ".cpp")):
            with open(path, encoding="utf-8") as file:
                files[os.path.relpath(path, root)] = file.read()
    return files


class Folders(unittest.TestCase):
    def test_folders_of_a_module_do_not_use_each_other(self):
        faults = []
        for folder in sorted(glob.glob(os.path.join(SOURCE, "libs/*"))):
            files = files_of(os.path.basename(folder))
            self.assertGreater(len(files), 1, folder)
            faults += circles(files, os.path.basename(folder))
        if faults:
            self.fail("folders that use each other:\n" + "\n".join(faults))

    def test_a_circle_of_folders_is_found(self):
        files = {"src/a/x.h": "", "src/a/x.cpp": '#include "b/y.h"\n', "src/b/y.h": "", "src/b/z.cpp": ""}
        self.assertEqual(circles(files, "m"), [])
        files["src/b/z.cpp"] = '#include "a/x.h"\n'
        self.assertEqual(circles(files, "m"), ["m/src/: a b", "    a -> b: x > y", "    b -> a: z > x"])

    def test_a_public_header_lies_where_its_source_does(self):
        files = {"include/hersey/m/x.h": "", "src/a/x.cpp": "", "src/a/w.cpp": '#include "b/y.h"\n', "src/b/y.h": "",
                 "src/b/z.cpp": '#include "hersey/m/x.h"\n'}
        self.assertEqual(circles(files, "m")[0], "m/src/: a b")
        files["src/b/z.cpp"] = '#include "hersey/other/x.h"\n'
        self.assertEqual(circles(files, "m"), [])

    def test_a_public_header_without_source_is_looked_through(self):
        files = {"include/hersey/m/both.h": '#include "hersey/m/x.h"\n', "include/hersey/m/x.h": "", "src/a/x.cpp": "",
                 "src/a/w.cpp": '#include "b/y.h"\n', "src/b/y.h": '#include "hersey/m/both.h"\n'}
        self.assertEqual(circles(files, "m"), ["m/src/: a b", "    a -> b: w > y", "    b -> a: y > both > x"])

    def test_a_folder_and_those_within_it_count(self):
        files = {"src/a/x.h": "", "src/a/w.cpp": '#include "a/in/y.h"\n', "src/a/in/y.h": '#include "a/x.h"\n'}
        self.assertEqual(circles(files, "m")[0], "m/src/a: . in")
        # Neighbours of different folders: the folders use each other.
        files = {"src/a/p/x.h": "", "src/a/q/w.cpp": '#include "b/y.h"\n', "src/b/y.h": "", "src/b/z.cpp": '#include "a/p/x.h"\n'}
        self.assertEqual(circles(files, "m")[0], "m/src/: a b")


if __name__ == "__main__":
    unittest.main(verbosity=2)
