#!/usr/bin/python3
"""A second opinion on a journal bearing: solves the bearing of a model file by finite elements and prints its figures.

    second_film.py MODEL [--rows N] [--json]

It shares neither code nor formulas with the program. Each figure comes with a bound of its error, from meshes of half and a quarter of
the cells. Keys that it does not know are refused.
"""

import argparse
import json
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from figures import at_position, under_load  # noqa: E402
from film import NoAnswer  # noqa: E402
from read_model import Unknown, read  # noqa: E402


PARTS = (4, 2, 1)  # of the rows and columns of the finest mesh


def mesh_size(bearing, rows):
    """Columns so that elements are about square, within reason."""
    return min(max(math.ceil(rows * 2 * math.pi * bearing.R / bearing.L), 4 * rows), 12 * rows)


def opinion(path, rows=16):
    """Figures {name: (value, error)} of a model file on about `rows` cells over the width: errors from what fewer gave."""
    bearing, motion, load = read(path)
    columns = mesh_size(bearing, rows)
    answers, start = [], None
    for part in PARTS:
        size = max(columns // part, 12), max(rows // part, 2)
        if load:
            answer, film = under_load(bearing, motion, *load, *size, start)
            start = film.motion.centre
        else:
            answer = at_position(bearing, motion, *size)
        answers.append(answer)
    return {key: (answers[2][key], spread(*(a[key] for a in answers), key.endswith("angle") or key == "attitude")) for key in answers[2]}


def spread(coarse, middle, fine, is_angle=False):
    """How far the finest may be off: all that the last refinement changed, as at first order, or a quarter of the one before where
    chance made it small."""
    first, last = middle - coarse, fine - middle
    if is_angle:
        first, last = math.remainder(first, 2 * math.pi), math.remainder(last, 2 * math.pi)
    return max(abs(last), 0.25 * abs(first))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model")
    parser.add_argument("--rows", type=int, default=16)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    try:
        found = opinion(arguments.model, arguments.rows)
    except (Unknown, NoAnswer) as error:
        print(f"{arguments.model}: {error}", file=sys.stderr)
        return 2 if isinstance(error, Unknown) else 1
    if arguments.json:
        print(json.dumps({key: {"value": value, "error": error} for key, (value, error) in found.items()}, indent=2))
    else:
        for key, (value, error) in found.items():
            print(f"{key:20} {value:14.6g} +- {error:.2g}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
