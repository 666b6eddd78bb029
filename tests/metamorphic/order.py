"""Order in the grid of every number that `hersey bearing` prints, by machine over its figures.

Errors against a much finer grid go up and down with where the borders of film and features lie between nodes: their root mean square
over some grids of near-by size is compared with that over grids of twice the nodes each way.
"""

import math
import re

import tree as trees

# Errors of balances, which are round-off.
NOT_OF_THE_FILM = ("mass_balance_error", "heat_balance_error", "power_error", "power_error_share")

COEFFICIENT = re.compile(r"(stiffness|damping|K|C)_(xx|xy|yx|yy)")
LEAST_FLOW = 1e-15  # [m^3/s], below which all flows are round-off: an edge that lets nothing out


def figures(program, tree, grid, folder):
    """{name: value in SI units} of the numbers on a grid (around, across)."""
    there = trees.changed(tree, ("bearings", "main", "grid"), {"circumferential": str(grid[0]), "axial": str(grid[1])})
    ending, found = trees.bearing(program, there, folder, cpu_limit=120)
    if ending.kind != "answer":
        raise RuntimeError(f"{grid[0]} x {grid[1]}: {ending.text}")
    return {key: value for key, (value, _) in found.items() if isinstance(value, float) and key not in NOT_OF_THE_FILM}


def scale_of(key, found):
    """What an error is measured by: of a matrix its largest entry, of a flow the largest one, of places a radian, of shares 1, of
    temperatures how far they lie apart."""
    if match := COEFFICIENT.fullmatch(key):
        return max(abs(value) for name, value in found.items() if name.startswith(match[1] + "_") and COEFFICIENT.fullmatch(name))
    if "angle" in key or key in ("attitude", "load_on_shear") or key.endswith("_share"):
        return 1.0
    if "flow" in key:
        largest = max(abs(value) for name, value in found.items() if "flow" in name)
        return largest if largest > LEAST_FLOW else 0.0
    if key.startswith("T_"):
        temperatures = [value for name, value in found.items() if name.startswith("T_") and "angle" not in name and not name.endswith("_z")]
        return max(temperatures) - min(temperatures)
    if key.startswith("heat_"):
        return max(abs(value) for name, value in found.items() if name.startswith("heat_"))
    return abs(found[key])


class Order:
    """How errors of figures fall from coarse grids to fine ones, `limit` their values on a much finer one."""

    def __init__(self, limit, coarse, fine):
        self.limit, self.coarse, self.fine = limit, coarse, fine

    @classmethod
    def of(cls, program, tree, folder, coarse, finest):
        """From the grids `coarse` to grids of twice the nodes each way, by the grid `finest`."""
        return cls(figures(program, tree, finest, folder), [figures(program, tree, grid, folder) for grid in coarse],
                   [figures(program, tree, (2 * around, 2 * across - 1), folder) for around, across in coarse])

    def error(self, solutions, key):
        """Root mean square over the grids, of the figure's scale; None where it is no number on one of them."""
        scale = scale_of(key, self.limit)
        if scale == 0 or any(key not in found for found in solutions):
            return None
        return math.sqrt(sum(((found[key] - self.limit[key]) / scale) ** 2 for found in solutions) / len(solutions))

    def rows(self):
        """(figure, error on the coarse grids, on the fine ones, order)."""
        for key in sorted(self.limit):
            errors = self.error(self.coarse, key), self.error(self.fine, key)
            if None not in errors:
                yield key, *errors, math.log2(errors[0] / errors[1]) if min(errors) > 0 else math.inf


# (model, its cavitation): grids that are compared, and the one that stands for the limit.
CASES = {
    ("PLAIN", "mass_conserving"): ([(32, 9), (36, 9), (40, 11)], (192, 49)),
    ("PLAIN", "reynolds"): ([(32, 9), (36, 9), (40, 11)], (192, 49)),
    ("PLAIN", "guembel"): ([(32, 9), (36, 9), (40, 11)], (192, 49)),
    ("HOT", "mass_conserving"): ([(36, 7), (40, 9), (48, 11)], (192, 41)),
    ("GLOBAL", "mass_conserving"): ([(36, 17), (40, 17), (44, 21)], (192, 97)),
    ("GLOBAL", "reynolds"): ([(36, 17), (40, 17), (44, 21)], (192, 97)),
    ("GLOBAL", "guembel"): ([(36, 17), (40, 17), (44, 21)], (192, 97)),
}

LEAST_ORDER = 1.5  # of two, where the fine grids leave more than:
LEAST_ERROR = 1e-3

# What is not of second order, with the error that the fine grids may leave of the figure's scale. (models, cavitation, figures): error.
LESS = {
    # The mean over four places of the grid's lines leaves the fourth harmonic of its jumps (bearing.38).
    ("PLAIN|HOT", "mass_conserving", r"(C|K|damping|stiffness)_.."): 1e-2,
    # The front of a conserved film moves from node to node (film.56): half a cell, [rad].
    (".*", "mass_conserving", "reformation_angle"): 0.05,
    # That of a groove at an end of which the film begins on its corners.
    ("GLOBAL", "reynolds|guembel", "reformation_angle"): 0.1,
    (".*", ".*", "rupture_angle"): 5e-3,
    # Next to the mass without bounds that a film of which K_yx passes through zero carries.
    ("PLAIN", "reynolds", "critical_mass|stability_number|threshold_speed"): 0.3,
    # What an edge above p_cav lets into a film under tension: only a grid sees it that sees a strip as narrow as p_edge over its slope.
    (".*", "guembel", "flow_left|flow_right|side_flow"): 0.5,
    # Pressure at the corners of a groove falls without bounds: what leaves there comes in with a lower order.
    ("GLOBAL|HOT", ".*", "flow_.*|side_flow|h_min_features"): 1e-2,
    # The last cell before a groove and the first after it (bearing.md, error of the grid), and what follows from them.
    ("HOT", ".*", "T_.*|attitude|load_angle|sommerfeld_.*"): 2e-2,
    # The thinnest oil, at that groove, over the gap there.
    ("HOT", ".*", "reynolds_max|taylor_max"): 3e-2,
}


def allowed(model, cavitation, key):
    errors = [error for (models, laws, figures), error in LESS.items()
              if re.fullmatch(models, model) and re.fullmatch(laws, cavitation) and re.fullmatch(figures, key)]
    return max(errors, default=0.0)


def lower(program, all_models, name, cavitation, folder):
    """Lines on figures that are of less than second order and more than allowed off."""
    tree = trees.changed(trees.load(getattr(all_models, name)), ("bearings", "main", "cavitation"), cavitation)
    for key, coarse, fine, order in Order.of(program, tree, folder, *CASES[name, cavitation]).rows():
        if order < LEAST_ORDER and fine > max(LEAST_ERROR, allowed(name, cavitation, key)):
            yield f"{name}, {cavitation}: {key} off by {coarse:.1e}, on twice the nodes by {fine:.1e}: order {order:.2f}"
