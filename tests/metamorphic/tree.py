"""Models as trees of text: paths to their values, quantities with dimensions, and runs of the program on them."""

import copy
import os
import re
import sys

import yaml

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../random"))

import program as hersey  # noqa: E402

# Powers of length, mass and time of each unit, and its size in SI; temperatures and angles have none.
UNITS = {"m": ((1, 0, 0), 1), "mm": ((1, 0, 0), 1e-3), "um": ((1, 0, 0), 1e-6), "kg": ((0, 1, 0), 1), "s": ((0, 0, 1), 1),
         "ms": ((0, 0, 1), 1e-3), "us": ((0, 0, 1), 1e-6), "N": ((1, 1, -2), 1), "kN": ((1, 1, -2), 1e3), "Pa": ((-1, 1, -2), 1), "kPa": ((-1, 1, -2), 1e3),
         "MPa": ((-1, 1, -2), 1e6), "GPa": ((-1, 1, -2), 1e9), "bar": ((-1, 1, -2), 1e5), "mPa": ((-1, 1, -2), 1e-3), "rpm": ((0, 0, -1), 1),
         "rad": ((0, 0, 0), 1), "deg": ((0, 0, 0), 1), "K": ((0, 0, 0), 1), "degC": ((0, 0, 0), 1), "W": ((2, 1, -3), 1),
         "J": ((2, 1, -2), 1), "l": ((3, 0, 0), 1e-3), "min": ((0, 0, 1), 60), "mW": ((2, 1, -3), 1e-3), "1": ((0, 0, 0), 1)}

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
QUANTITY = re.compile(rf"({NUMBER}(?:\s+{NUMBER})*)(?:\s+([A-Za-z1][\w.^/*-]*))?")


def dimension(unit):
    """Powers of length, mass and time: of `kg.m^2/s`, (2, 1, -1)."""
    total, sign = [0, 0, 0], 1
    for part in re.findall(r"[./]|[^./]+", unit or "1"):
        if part in "./":
            sign = 1 if part == "." else -1
            continue
        name, power = re.fullmatch(r"([A-Za-z]+|1)\^?(-?\d+)?", part).groups()
        for k, p in enumerate(UNITS[name][0]):
            total[k] += sign * int(power or 1) * p
    return tuple(total)


def load(text):
    return yaml.load(text, Loader=yaml.BaseLoader)


def leaves(tree, path=()):
    """(path, text) of all values."""
    if isinstance(tree, dict):
        for key, value in tree.items():
            yield from leaves(value, (*path, key))
    elif isinstance(tree, list):
        for k, value in enumerate(tree):
            yield from leaves(value, (*path, k))
    else:
        yield path, tree


def changed(tree, path, value):
    """The tree with another value there; None: without it."""
    other = copy.deepcopy(tree)
    place = other
    for key in path[:-1]:
        if isinstance(place, dict):
            place = place.setdefault(key, {})
        else:
            place = place[key]
    if value is None:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return other


def at(tree, path):
    for key in path:
        tree = tree[key]
    return tree


def named(path):
    return ".".join(map(str, path))


def write(tree, folder, name="model.yaml"):
    path = os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        yaml.safe_dump(tree, file, sort_keys=False, width=10000)
    return path


def bearing(program, tree, folder, *options, cpu_limit=20):
    """How `hersey bearing` ends, and its figures {name: (value, unit)}."""
    ending = hersey.run(program, "bearing", write(tree, folder), "--json", "--jobs", "1", *(options or ("--no-grid-error",)),
                        cpu_limit=cpu_limit)
    solutions = ending.document.get("solutions") or [{}]
    return ending, {key: (f["value"], f["unit"]) for key, f in solutions[0].get("figures", {}).items()}
