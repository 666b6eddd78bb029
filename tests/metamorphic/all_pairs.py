#!/usr/bin/python3
"""All pairs of machines, defaults, numbers that act and absurd numbers, of which `make test` has a share; orders in the grid of all
figures of bearings.

    all_pairs.py HERSEY [MACHINE ...]

Some ten minutes of one processor. Prints what does not hold, and numbers that move nothing, which is right for some: moments of
inertia of bodies that do not turn about that axis, the length of a direction, a density where no heat is carried.
"""

import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import machine_models  # noqa: E402
import machine_numbers  # noqa: E402
import machine_pairs as pairs  # noqa: E402
import models  # noqa: E402
import order  # noqa: E402
import schema  # noqa: E402
import tree as trees  # noqa: E402

# Numbers that nothing asks for in these machines.
INERT = {"CRANK": ("bodies.crank.inertia.xx", "bodies.crank.inertia.yy", "bodies.rod.inertia.xx", "bodies.rod.inertia.yy", "bodies.piston.inertia",
                   "forces.gas.direction", "lubricants.oil.density")}


def of_machine(program, name, folder):
    """What does not hold, line by line."""
    tree = trees.load(getattr(machine_models, name))
    pair = pairs.Pair(program, folder, tree)
    for title, differences in pairs.PAIRS.items():
        yield from (f"{title}: {text}" for text in differences(pair, name))
    for path, default in schema.Schema(program).defaults_left_out(tree):
        yield from (f"{trees.named(path)}, its default {default}: {text}" for text in pairs.default_that_acts(pair, path, default))
    dead, _ = machine_numbers.dead(program, tree, folder)
    yield from (f"moves nothing: {text}" for text in dead if not text.startswith(INERT.get(name, ())))
    yield from (f"absurd: {text}" for text in machine_numbers.bad_endings(program, tree, folder))


def of_orders(program, folder):
    """Figures of bearings that are of less than second order in the grid."""
    for name, cavitation in order.CASES:
        yield from order.lower(program, models, name, cavitation, folder)


def main():
    program, names = os.path.abspath(sys.argv[1]), sys.argv[2:] or ("CRANK", "WHIP", "ROTOR", "WORKSHOP")
    off = 0
    for name in names:
        with tempfile.TemporaryDirectory(prefix="hersey-pairs-") as folder:
            for text in of_machine(program, name, folder):
                off += 1
                print(f"{name}: {text}", flush=True)
        print(f"{name} done", flush=True)
    with tempfile.TemporaryDirectory(prefix="hersey-order-") as folder:
        for text in of_orders(program, folder):
            off += 1
            print(text, flush=True)
    return 1 if off else 0


if __name__ == "__main__":
    sys.exit(main())
