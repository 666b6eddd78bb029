"""Every number of a machine's model, one at a time: moved a little it moves a result; absurd it is answered or refused, soon."""

import re

import numpy as np

import runs
import tree as trees

ROW = re.compile(rf"({trees.NUMBER}(?:\s+{trees.NUMBER})*)(\s+\S+)?")

# No quantities of the machine: what tells, what the run goes by, and where steps' own errors end.
NOT_ACTING = ("hersey", "title", "description", "tolerance", "max_iterations", "smallest_step", "wall_time")

ABSURD = ("nan", "inf", "-inf", "0", "-1", "1e308", "-1e308", "1e-308")

# A model of a few steps that computes for longer than this hangs [s].
SOON = 10


def numbers(tree):
    """(path, place in the row, row, unit with its blank) of every number."""
    for path, text in trees.leaves(tree):
        match = ROW.fullmatch(str(text))
        if match and path[-1] not in NOT_ACTING:
            row = match[1].split()
            for k in range(len(row)):
                yield path, k, row, match[2] or ""


def with_number(tree, path, k, row, unit, value):
    return trees.changed(tree, path, " ".join([*row[:k], value, *row[k + 1:]]) + unit)


def moved(text):
    """A tenth larger, whole numbers without a unit by one; what is zero, by a bit."""
    number = float(text)
    if re.fullmatch(r"[1-9]\d*", text):
        return str(int(text) + 1) if int(text) < 100 else repr(1.01 * number)
    return repr(1.01 * number if number else 0.01)


def dead(program, tree, folder, cases=None):
    """Numbers that can be moved without any result moving, and those that the run refuses, with why."""
    _, before = runs.run(program, tree, folder, "before")
    found, refused = [], []
    for path, k, row, unit in cases or numbers(tree):
        ending, after = runs.run(program, with_number(tree, path, k, row, unit, moved(row[k])), folder)
        if ending.kind in ("refused", "message"):
            refused.append((trees.named(path), k, ending.text.splitlines()[0]))
        elif ending.kind != "answer" or not runs.differences(before, after, 1e-13):
            found.append(f"{trees.named(path)} {k}: {ending.kind}")
    return found, refused


def bad_ending(ending, results):
    """What is wrong with how an absurd number ended; empty where nothing is."""
    if ending.kind in ("hangs", "crash", "assertion") or "internal error" in ending.text or "Traceback" in ending.text:
        return f"{ending.kind}: {ending.text[:200]}"
    if ending.kind == "refused" and not re.search(r":\d+:\d+: ", ending.text):
        return f"refused without a line: {ending.text[:200]}"
    if ending.kind == "answer":
        without = [name for name, (values, _) in results.items() if np.isinf(values).any() or (np.isnan(values).any() and not may_be_nan(name))]
        if without:
            return f"completed with {', '.join(without[:3])} no numbers"
    return ""


def may_be_nan(name):
    """A cycle without one before it, a film without a cavity, a contact that does not touch have none by definition."""
    return name.startswith(("cycles/", "contacts/")) or "/cycles/" in name or name.endswith(
        ("/rupture_angle", "/reformation_angle", "/T_side", "/T_film", "h_min_centre", "h_min_features"))


def bad_endings(program, tree, folder, cases=None):
    """Of every number with every absurd value (or of the `cases`: number and value), those that end badly."""
    found = []
    for (path, k, row, unit), value in cases or ((n, value) for n in numbers(tree) for value in ABSURD):
        ending, results = runs.run(program, with_number(tree, path, k, row, unit, value), folder, cpu_limit=SOON)
        wrong = bad_ending(ending, results)
        if wrong:
            found.append(f"{trees.named(path)} {k} = {value}{unit}: {wrong}")
    return found
