"""Every value of a model, one at a time: moved a little it moves the answer; absurd it is answered or refused."""

import re

import relations
import tree as trees

# Values that tell and do not act, or act where these models are not: no answer can depend on them.
TELLS = ("hersey", "title", "description")

NUMBER_WITH_UNIT = re.compile(rf"({trees.NUMBER})(\s+\S+)?")

ABSURD = ("nan", "inf", "-inf", "0", "-1", "1e308", "-1e308")



def numeric_leaves(tree):
    """(path, number, unit with its blank) of every single number."""
    for path, text in trees.leaves(tree):
        match = NUMBER_WITH_UNIT.fullmatch(text)
        if match and path[-1] not in TELLS:
            yield path, float(match[1]), match[2] or ""


def moved(tree, path, number, unit):
    """Every number a tenth larger, whole ones by one."""
    is_whole = not unit and number == int(number) and path[-1] in ("circumferential", "axial", "layers", "count")
    value = str(int(number) + 1) if is_whole else f"{1.1 * number if number else 0.1!r}"
    return trees.changed(tree, path, value + unit)


def dead_keys(program, tree, folder, paths=None):
    """Paths of numbers that can be moved without anything else moving, [(path, ending)]."""
    _, before = trees.bearing(program, tree, folder)
    dead = []
    for path, number, unit in numeric_leaves(tree):
        if paths and trees.named(path) not in paths:
            continue
        ending, after = trees.bearing(program, moved(tree, path, number, unit), folder)
        if ending.kind == "answer" and not relations.close(before, after, 1e-13):
            dead.append(trees.named(path))
    return dead


def bad_endings(program, tree, folder, values=ABSURD, paths=None, cpu_limit=10):
    """(path, value, ending, first line) where an absurd number ends badly."""
    found = []
    for path, _, unit in numeric_leaves(tree):
        if paths and trees.named(path) not in paths:
            continue
        for value in values:
            text = value + unit
            ending, _ = trees.bearing(program, trees.changed(tree, path, text), folder, cpu_limit=cpu_limit)
            reported = ending.text.splitlines()[0] if ending.text else ""
            if ending.kind in ("hangs", "crash", "assertion") or (ending.kind != "answer" and "internal error" in ending.text):
                found.append((trees.named(path), text, ending.kind, reported))
            elif ending.kind == "answer" and any(f["value"] is not None and not isinstance(f["value"], str) and f["value"] != f["value"]
                                                 for s in ending.document.get("solutions", []) for f in s["figures"].values()):
                found.append((trees.named(path), text, "NaN", reported))
    return found
