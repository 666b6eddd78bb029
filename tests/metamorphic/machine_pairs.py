"""Pairs of machines whose results are tied to each other, whatever they are."""

import re


import relations
import runs
import space
import tree as trees

# Steps are solved to 1e-8 of the largest force of a row: what another order of sums changes, some steps on.
SOLVED = 1e-7

# What a default that is written out may change: nothing, but for the order of sums.
ROUND_OFF = 1e-12

# Other roots: joints whose two bodies may be named the other way round. A body in free flight is counted from its centre of mass
# either way.
SAME_COORDINATES = {"WORKSHOP": ("shoulder", "socket", "slide", "hub", "sleeve", "thread", "sea"), "CRANK": ("bore", "wrist"), "WHIP": ("hinge",)}

# Scales of length, mass and time, and what has to be left out for them: supplies and features, beside which films of machines scale
# missing oil with 1000 rad/s (film.6); asperities, whose friction passes through zero within 1 mm/s; a ring that stores heat as steel does.
SCALES = {"WORKSHOP": ((4, 1, 1), (1, 64, 1), (1, 1, 0.25), (0.25, 8, 4)), "WHIP": ((4, 1, 1), (1, 64, 1), (1, 1, 0.25), (0.25, 8, 4)),
          "CRANK": ((4, 1, 1), (1, 1, 0.25), (0.25, 8, 4)), "ROTOR": ((4, 1, 1),)}
NOT_SIMILAR = {"CRANK": (("bearings.big_end.supply", None), ("bearings.big_end.features", None), ("bearings.big_end.asperities", None)),
               "ROTOR": (("bearings.left.thermal.shell", "insulated"),)}


def with_changes(tree, changes):
    for path, value in changes:
        tree = trees.changed(tree, tuple(path.split(".")), value)
    return tree


class Pair:
    """A machine's results against those of another that is to have the same."""

    def __init__(self, program, folder, tree):
        self.program, self.folder, self.tree = program, folder, tree
        ending, self.results = runs.run(program, tree, folder, "one")
        assert ending.kind == "answer", ending.text

    def differences(self, other, here=None, there=None, rtol=SOLVED):
        """`here` makes of this machine's results what those of `other` are to be, after `there`."""
        ending, results = runs.run(self.program, other, self.folder, "other")
        if ending.kind != "answer":
            return [f"{ending.kind}: {ending.text[:300]}"]
        return runs.differences(here(self.results) if here else self.results, there(results) if there else results, rtol)


def reordered(pair, _):
    return pair.differences(space.reordered(pair.tree))


def in_other_units(pair, _):
    return pair.differences(relations.in_other_units(pair.tree))


def turned(pair, _):
    return pair.differences(space.turned(pair.tree), space.turned_results, space.without_axes)


def mirrored(pair, _):
    return pair.differences(space.mirrored(pair.tree), space.mirrored_results,
                            lambda found: {name: found[name] for name in space.mirrored_results(found)})


def of_no_joint(found):
    return {name: value for name, value in found.items() if not name.startswith(("joints/", "couplings/", "drives/", "joint_forces/"))}


def from_another_root(pair, name):
    """Every joint of the list the other way round, and every second one."""
    joints = SAME_COORDINATES.get(name, ())
    off = []
    for some in (joints, joints[::2]) if joints else ():
        off += pair.differences(space.reversed_joints(pair.tree, some), of_no_joint, of_no_joint)
    return off


def similar(pair, name):
    off = []
    one = Pair(pair.program, pair.folder, with_changes(pair.tree, NOT_SIMILAR[name])) if name in NOT_SIMILAR else pair
    for scales in SCALES[name]:
        found = one.differences(relations.scaled(one.tree, *scales), in_si, lambda results, scales=scales: scaled_back(results, scales))
        off += [f"length, mass, time times {scales}: {text}" for text in found]
    return off


def in_si(found):
    return {name: value for name, value in found.items() if value[1] != "SI"}


def scaled_back(found, scales):
    return {name: (values / relations.size(unit, *scales), unit) for name, (values, unit) in in_si(found).items()}


PAIRS = {"order of entries": reordered, "other units": in_other_units, "turned as a whole": turned, "mirrored": mirrored,
         "another root": from_another_root, "similar machines": similar}


# -- defaults written out


# A key of another form of the same mapping, or one that the mapping takes only in company.
NOT_OF_THIS_FORM = re.compile(r"unknown key|which (kind|type|shape|profile|model|law|wall) \S+ does not have|unknown coordinate|of a beam|of surroundings that keep|a film that has none inside")


def default_that_acts(pair, path, default):
    """What a default does that is written out; empty where nothing, or where the form has no such key."""
    ending, results = runs.run(pair.program, trees.changed(pair.tree, path, {} if default == "{}" else default), pair.folder, "other")
    if ending.kind == "answer":
        return runs.differences(pair.results, results, ROUND_OFF)
    return [] if ending.kind == "refused" and NOT_OF_THIS_FORM.search(ending.text) else [f"{ending.kind}: {ending.text[:300]}"]
