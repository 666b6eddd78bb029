"""Numbers that know what they are."""

from __future__ import annotations

import math
from typing import Optional


class Figure(float):
    """A number in SI that carries its name and unit; a plain float in every other way.

    `words` says why it is no number (NaN) where it has none, `grid_error` is the estimated error of the grid in SI,
    `shown` the number in the unit people use.
    """

    __slots__ = ("key", "name", "group", "unit", "shown_unit", "shown", "grid_error", "words")
    key: str
    name: str
    group: str
    unit: str
    shown_unit: str
    shown: float
    grid_error: Optional[float]
    words: str

    @classmethod
    def make(cls, key, name, group, shown_unit, unit, size, shown, grid_error=-1.0, words="") -> "Figure":
        figure = cls(math.nan if words else shown * size)
        figure.key, figure.name, figure.group, figure.unit = key, name, group, unit or "1"
        figure.shown_unit, figure.shown, figure.words = shown_unit, shown, words
        figure.grid_error = grid_error * size if grid_error >= 0 else None
        return figure

    def __reduce__(self):
        return Figure.make, (self.key, self.name, self.group, self.shown_unit, self.unit,
                             float(self) / self.shown if self.shown else 1.0, self.shown,
                             -1.0 if self.grid_error is None else self.grid_error, self.words)

    def __str__(self) -> str:
        return self.words or f"{self.shown:.5g} {self.shown_unit}".rstrip()

    def __repr__(self) -> str:
        return f"<{self.name}: {self}>"
