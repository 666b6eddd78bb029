"""What a check has found."""

import math


# Compared with integrals over the nodes of the fields, whose error is an estimate from every second node.
ESTIMATED = ("load", "oil volume", "power: film by own integral", "power: bodies + pump = dissipated + stored")

FALLS_TO = 0.65


class Findings(list):
    """Pairs (invariant, text) of invariants that do not hold."""

    def __init__(self, *found):
        super().__init__(*found)
        self.sizes = dict(found[0].sizes) if found and isinstance(found[0], Findings) else {}

    def require(self, invariant, holds, text):
        if not holds:
            self.append((invariant, text))

    def bound(self, invariant, size, allowed, text):
        """`size` must not exceed `allowed`; NaN is no size."""
        if math.isnan(size) or size > allowed:
            self.sizes[invariant] = size
            self.append((invariant, f"{size:.3g} (allowed {allowed:.3g}) {text}"))

    def has_estimated(self):
        return any(invariant in ESTIMATED for invariant, _ in self)

    def drop_estimated(self, finer, times=2):
        """Leaves out what a grid so many times finer finds smaller, by a first order at least: the grid's error, estimated too low.

        The first refinement may fail to show it: a border within a cell lies elsewhere in the finer one.
        """
        falls = {i for i in ESTIMATED if finer.sizes.get(i, 0) <= FALLS_TO ** math.log2(times) * self.sizes.get(i, 0)}
        self[:] = [f for f in self if f[0] not in falls]
