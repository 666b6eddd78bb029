"""One random steady bearing: solved, checked, and solved again in other ways that must give the same."""

import os

import program as hersey
import steady
from bearings import PI, reservoirs_touch
from findings import Findings
from program import write

# Solvers stop at a residual of 1e-8 of the largest flow through a node's volume, the search at 1e-8 of the load. Thin films
# amplify both by 1/(1 - epsilon)^2.
SAME = 1e-5

# Of computing time for a finer grid of a small case [s]. Most take less than one; where film and heat turn without coming
# together, waiting longer ends in no answer either, and then refinement is not looked at.
FINER_LIMIT = 2


class Runs:
    """Solves variants of a case and remembers the model of each."""

    def __init__(self, program, folder):
        self.program, self.folder, self.models = program, folder, {}

    def solve(self, case, label, cpu_limit=hersey.CPU_LIMIT):
        """(ending, answer or None)"""
        text = case.text()
        self.models[label] = text
        model, fields = (os.path.join(self.folder, label + end) for end in (".yaml", ".csv"))
        write(model, text)
        ending = hersey.run(self.program, "bearing", model, "--json", "--no-grid-error", "--jobs", "1", "--fields", fields,
                            cpu_limit=cpu_limit)
        if ending.kind != "answer":
            return ending, None
        document = ending.document
        document = (document.get("solutions") or [{}])[0]
        if not document.get("figures"):
            return hersey.Ending("crash", "exit code 0 without figures"), None
        return ending, steady.Answer(document, fields)


def tolerance(case, answer):
    """Relative to the scale of each figure: a thin film amplifies what the solver leaves."""
    thin = max(answer["h_min"], 1e-3 * case.bearing.c) / case.bearing.c
    return SAME * max(1.0, (0.2 / thin) ** 2)


def examine(program, rng, folder, is_small=False):
    """(ending, text, findings, models) of one case."""
    case = steady.random_steady(rng, is_small)
    runs = Runs(program, folder)
    ending, answer = runs.solve(case, "model")
    if answer is None:
        return ending.kind, ending.text, [], runs.models
    found = Findings(steady.check(case, answer))
    if found.has_estimated():
        finer = case.on_grid(2)
        _, finer_answer = runs.solve(finer, "finer")
        found.drop_estimated(steady.check(finer, finer_answer) if finer_answer else found)
    failed = {"model"} if found else set()
    for label, invariant, variant, options in variants(case, answer, rng):
        other_ending, other = runs.solve(variant, label)
        before = len(found)
        if other_ending.kind in ("hangs", "assertion", "crash", "refused"):
            found.append((invariant, f"{label}: {other_ending.kind}: {other_ending.text}"))
        elif other is not None:
            off = steady.differences(case, answer, other, tolerance(case, answer), **options)
            if off and case.load and answer["eccentricity_ratio"] < 1:
                off = differences_there(case, answer, variant, runs, label, options) or []
            if off and solver_may_differ(case, invariant, other):
                off = []
            found.require(invariant, not off, f"{label}: {'; '.join(off)}")
        elif invariant != "one answer of all solvers":
            found.append((invariant, f"{label}: no answer: {other_ending.text}"))
        if len(found) > before:
            failed |= {"model", label}
    failed |= compare_constant_oils(case, answer, runs, found)
    failed |= compare_on_nodes(case, runs, found)
    if refine(case, answer, runs, found, FINER_LIMIT if is_small else hersey.CPU_LIMIT):
        failed |= {"model", "fine", "finest", "last"}
    return "answer", "", list(found), {k: v for k, v in runs.models.items() if k in failed}


def differences_there(case, answer, variant, runs, label, options):
    """Likewise at the position that the case's load was found at: a load may have two equilibria."""
    angle = answer["eccentricity_angle"] * (-1 if options.get("is_mirrored_phi") else 1) + options.get("turn", 0.0)
    _, there = runs.solve(variant.at((answer["eccentricity_ratio"], angle)), label + "_there")
    if there is None:
        return [f"no answer at eccentricity ratio {answer['eccentricity_ratio']:.6g}"]
    return steady.differences(case, answer, there, tolerance(case, answer), **options)


def solver_may_differ(case, invariant, other):
    """Where shapes that turn close the gap on oil that does not fill it, more than one fill is in balance with the rates as they
    are: the balance of a node then holds less oil the more it has (docs/random-models.md). Each solver finds one."""
    turns = [case.bearing.varies_on("journal") and case.journal_speed, case.bearing.varies_on("shell") and case.shell_speed]
    return invariant == "one answer of all solvers" and (any(turns) or case.radial_velocity) and abs(other["mass_balance_error"]) < 1e-9


def variants(case, answer, rng):
    """The same case by other solvers and under its symmetries.

    A load may have two equilibria, one by the pressure of the supply and one by the wedge, and each solver's search ends in one of them;
    at one position there is one film.
    """
    for solver in ("multigrid", "sor"):
        there = (answer["eccentricity_ratio"], answer["eccentricity_angle"])
        if there[0] < 1:  # surfaces that give way may overlap; such a position cannot be given
            yield solver, "one answer of all solvers", case.with_solver(solver).at(there), {}
    yield "mirrored_z", "mirror z", case.mirrored_z(), {"is_mirrored_z": True}
    # refined grids begin at phi = 0 and are no mirror images of themselves
    if not any(place["towards"] != "edges" for place in case.bearing.refine):
        yield "mirrored_phi", "mirror phi", case.mirrored_phi(), {"is_mirrored_phi": True}
        turn = rng.randrange(1, case.bearing.n_phi) * 2 * PI / case.bearing.n_phi
        yield "turned", "turned by whole cells", case.turned(turn), {"turn": turn}
    if len(case.bearing.features) > 1 or len(case.bearing.profiles) > 1:
        yield "reordered", "order of features", case.reordered(), {}


def compare_constant_oils(case, answer, runs, found):
    """The film of an oil that does not thin is the same whether it has a temperature or not."""
    if not case.bearing.heat or case.bearing.heat.model != "film":
        return set()
    there = (answer["eccentricity_ratio"], answer["eccentricity_angle"])
    if there[0] >= 1:
        return set()
    ending, with_heat = runs.solve(case.at(there).of_constant_oil("film"), "layers")
    _, without = runs.solve(case.at(there).of_constant_oil("isothermal"), "isothermal")
    if without is None:
        return set()
    if with_heat is None and "no oil is one above" in ending.text:
        return set()  # of an oil that does not thin the heat alone is too much
    if with_heat is None:
        found.append(("layers of one viscosity", f"no answer with layers, one without: {ending.text}"))
        return {"layers", "isothermal"}
    off = steady.differences(case, without, with_heat, tolerance(case, without))
    found.require("layers of one viscosity", not off, "; ".join(off))
    return {"layers", "isothermal"} if off else set()


def compare_on_nodes(case, runs, found):
    """Where lines and borders of features lie on nodes the mirrored and the turned machine have the same numbers, too: round-off
    decides nothing."""
    b = case.bearing
    has_line = b.supply and b.supply[0] != "widest_gap"
    if b.refine or bool(b.features) == bool(has_line):  # where a line's cells meet a feature's the one or the other has its way
        return set()
    # A journal's features lie where it has turned, and on no nodes. Left out as well: guembel, whose strips beside features follow
    # the nodes, and features fed at the cavitation pressure, beside which power is known to some 1e-5 only.
    if any(f.on == "journal" or f.pressure == b.p_cav for f in b.features) or (b.features and b.cavitation == "guembel"):
        return set()
    snapped = case.on_nodes()
    _, one = runs.solve(snapped, "on_nodes")
    if one is None:  # features that are larger or lie elsewhere need not be a machine
        return set()
    turn = (b.n_phi // 3) * 2 * PI / b.n_phi
    failed = set()
    for label, variant, options in (("mirrored_on_nodes", snapped.mirrored_phi(), {"is_mirrored_phi": True}),
                                    ("turned_on_nodes", snapped.turned(turn), {"turn": turn})):
        ending, other = runs.solve(variant, label)
        if other is None:
            found.append(("same with places on nodes", f"{label}: no answer: {ending.text}"))
        else:
            off = steady.differences(snapped, one, other, tolerance(snapped, one), **options)
            # How far a parabola may reach for a peak beside a feature is limited by the nodes that lie in it.
            off = [text for text in off if not (b.features and text.startswith("p_max "))]
            if off and snapped.load and one["eccentricity_ratio"] < 1:
                off = differences_there(snapped, one, variant, runs, label, options)
            found.require("same with places on nodes", not off, f"{label}: {'; '.join(off)}")
            if not off:
                continue
        failed |= {"on_nodes", label}
    return failed


def refine(case, coarse, runs, found, limit):
    """Load and flow converge: from grid to twice as fine grid the difference falls, or is small already.

    First order is what a border within a cell leaves; two grids may see a border differently, hence a share of the figure
    itself on top. Where the first three grids are too coarse to tell, the last three of four decide.
    """
    if case.load or case.bearing.refine:
        return False
    _, fine = runs.solve(case.on_grid(2), "fine", limit)
    _, finest = runs.solve(case.on_grid(4), "finest", limit) if fine else (None, None)
    if not finest:
        return False
    bad = not_converging(case, coarse, fine, finest)
    if bad:
        _, last = runs.solve(case.on_grid(8), "last")
        bad = bad if last is None else not_converging(case, fine, finest, last)
    found.require("refinement", not bad, "; ".join(bad))
    return bool(bad)


def not_converging(case, coarse, fine, finest):
    """Figures whose differences between three grids do not fall."""
    b, bad = case.bearing, []
    # a bearing's own flow and load, where those at hand are nothing
    flow = 0.02 * (abs(case.journal_speed) * b.c + abs(case.radial_velocity)) * b.R * b.L
    capacity = b.mu * abs(case.journal_speed + case.shell_speed) * (b.R / b.c) ** 2  # near the middle forces cancel
    load = 1e-3 * max(abs(finest.p).max(), capacity, 1e3) * b.R * b.L
    figures = [("load", load)]
    if reservoirs_touch(b):
        # Where a line meets an edge of another pressure, the flow grows with the logarithm of the grid, and what it feeds,
        # a pocket it crosses, with it.
        figures = [("load", 0.1 * (max(b.fed_pressures()) - min(b.fed_pressures())) * b.R * b.L)]
    elif b.cavitation != "guembel" or max(b.p_edge) <= b.p_cav:
        # Along an edge above p_cav a film under tension is full on a strip as narrow as that pressure over its slope: what
        # flows and rubs there converges once the grid sees the strip, which may be far finer than the last.
        figures += [("power_film", 0.0), ("side_flow", flow), ("flow_supply", flow)]
    for key, floor in figures:
        values = [answer[key] for answer in (coarse, fine, finest)]
        first, second = abs(values[1] - values[0]), abs(values[2] - values[1])
        if second > max(0.75 * first, 0.05 * abs(values[2])) + floor:
            bad.append(f"{key} {values[0]:.6g}, {values[1]:.6g}, {values[2]:.6g}")
    return bad
