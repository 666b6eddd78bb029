"""Random bearings solved by hersey and by the second film solver (verification/second_film), each with bounds of its own errors.

Two programs by different hands agree where both are right: hersey has finite volumes on equal cells and the fill fraction at nodes, the
other finite elements on a mesh along all borders and the void between nodes.
"""

import copy
import math
import os
import random
import sys
from dataclasses import dataclass, field

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "../random"))
sys.path.insert(0, os.path.join(HERE, "../../verification/second_film"))

import bearings  # noqa: E402
import program as hersey  # noqa: E402
import second_film  # noqa: E402
import steady  # noqa: E402
from film import NoAnswer  # noqa: E402
from read_model import Unknown  # noqa: E402

# Curvature, c/R of the film's forces, is left out by both, in different places: twice that.
CURVATURE = 2

# What neither bound sees: borders and fronts that lie alike on both grids. Of a figure's own scale.
UNSEEN = 0.004

# Cells of the second solver over the width.
ROWS, ROWS_SMALL = 24, 12


@dataclass
class Comparison:
    ending: str  # "answer", or why there is none to compare
    text: str = ""
    model: str = ""
    off: list = field(default_factory=list)  # (figure, text) where both differ by more than their bounds
    ratios: dict = field(default_factory=dict)  # figure: difference over what is allowed


def within_reach(rng, is_small):
    """A random steady bearing of what the second solver knows, as `tests/random` draws it."""
    while True:
        case = steady.random_steady(rng, is_small)
        b = case.bearing
        b.heat = b.roughness = b.asperities = b.column = None
        b.refine = []
        travels = any(f.pressure is None and f.arc < 2 * math.pi and (case.journal_speed if f.on == "journal" else case.shell_speed)
                      for f in b.features)
        out_of_round = any(p.kind in ("ovality", "lobes") for p in b.profiles)
        if travels or out_of_round and (case.shell_speed or b.supply and b.supply[0] == "widest_gap"):
            continue
        if not (case.journal_speed + case.shell_speed or case.radial_velocity):
            continue
        return case


def on_nodes(case, around, along):
    other = copy.deepcopy(case)
    other.bearing.n_phi, other.bearing.n_z = around, along
    return other


def hersey_figures(run, case, folder):
    """Figures and bounds from three grids of hersey, the middle one of about square cells, or how it ended."""
    b = case.bearing
    along = 16
    around = min(max(2 * round(math.pi * b.R / b.L * along), 48), 192)
    answers = []
    for part in (0.5, 1, 2):
        path = os.path.join(folder, f"grid_{part}.yaml")
        hersey.write(path, on_nodes(case, int(around * part), int(along * part) + 1).text())
        ending = run(path)
        if ending.kind == "refused" and part == 0.5:
            continue  # too coarse for its features
        if ending.kind != "answer":
            return ending, None
        figures = ending.document["solutions"][0]["figures"]
        answers.append({key: f["value"] for key, f in figures.items() if isinstance(f["value"], (int, float))})
    answers = [answers[0], *answers][-3:]  # without the coarsest: all that the last refinement changed
    names = set(answers[0]) & set(answers[1]) & set(answers[2])
    is_angle = lambda key: key in ("attitude", "load_angle", "eccentricity_angle")
    return ending, {key: (answers[2][key], second_film.spread(*(a[key] for a in answers), is_angle(key))) for key in names}


def scales(case, one):
    """The scale of each figure that is compared."""
    b = case.bearing
    omega = abs(case.journal_speed) + abs(case.shell_speed)
    capacity = b.mu * omega * (b.R / b.c) ** 2
    load = max(one["load"][0], 5e-3 * max(one["p_max"][0], capacity, 1e3) * b.R * b.L)
    torque = max(abs(one["torque_journal"][0]), abs(one["torque_shell"][0]), load * b.c)
    found = {"load": load, "torque_journal": torque, "torque_shell": torque,
             "power_film": one["power_film"][0], "eccentricity_ratio": 1.0, "h_min": b.c}
    if not any(f.pressure is None for f in b.features):  # the end of a pocket is a ridge of the pressure, between nodes of either
        found["p_max"] = max(one["p_max"][0] - b.p_cav, 1e3)
    # A half film of guembel has no flow that both mean: where it is under tension oil comes in over an edge, or none does.
    if not bearings.reservoirs_touch(b) and b.cavitation != "guembel":
        flow = max(abs(one[key][0]) for key in ("flow_left", "flow_right", "flow_supply"))
        flow = max(flow, 0.02 * omega * b.R * b.c * b.L)
        names = ["flow_left", "flow_right", "side_flow"] + ["flow_supply"] * (b.cavitation == "mass_conserving")
        found |= {name: flow for name in names}
    return found


def compare(case, one, other):
    """What differs by more than both bounds: hersey's figures `one`, the second solver's `other`."""
    off, ratios = [], {}
    b = case.bearing
    of = scales(case, one)
    for key, scale in of.items():
        a, c = one[key], other[key]
        value = a[0] - b.p_cav if key == "p_max" else a[0]
        allowed = a[1] + c[1] + (UNSEEN + CURVATURE * b.c / b.R) * scale
        ratios[key] = abs(value - c[0]) / allowed
        if not ratios[key] <= 1:
            off.append((key, f"{value:.6g} +- {a[1]:.2g} and {c[0]:.6g} +- {c[1]:.2g}"))
    key = "eccentricity_angle" if case.load else "load_angle"
    weight = one["eccentricity_ratio"][0] if case.load else one["load"][0] / of["load"]
    difference = abs(math.remainder(one[key][0] - other[key][0], 2 * math.pi))
    allowed = one[key][1] + other[key][1] + (UNSEEN + CURVATURE * b.c / b.R) / max(weight, 1e-3)
    ratios[key] = difference / allowed
    if ratios[key] > 1:
        off.append((key, f"{one[key][0]:.6g} +- {one[key][1]:.2g} and {other[key][0]:.6g} +- {other[key][1]:.2g} rad"))
    return off, ratios


def both(program, case, folder, rows):
    """Figures with bounds by hersey and by the second solver; None where one has no answer."""
    path = os.path.join(folder, "model.yaml")
    hersey.write(path, case.text())
    other = second_film.opinion(path, rows)
    ending, one = hersey_figures(lambda model: hersey.run(program, "bearing", model, "--json", "--no-grid-error", "--jobs", "1"), case, folder)
    if one is None:
        raise NoAnswer(f"hersey: {ending.text}")
    return one, other


def examine(program, seed, name, folder, is_small=False):
    """One case by its name."""
    case = within_reach(random.Random(f"{seed}/{name}"), is_small)
    text = case.text()
    try:
        one, other = both(program, case, folder, ROWS_SMALL if is_small else ROWS)
    except NoAnswer as error:
        return Comparison("one has no answer", str(error), text)
    except Unknown as error:
        return Comparison("not compared", f"unknown to the second solver: {error}", text)
    off, ratios = compare(case, one, other)
    return Comparison("answer", "", text, off, ratios)
