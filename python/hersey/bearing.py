"""A bearing by itself: where it settles under a load, what it costs, how stiff it is."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Iterator, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _core
from .errors import InputError, SolutionError
from .figure import Figure
from .words import did_you_mean, in_words


class Sensitivity(NamedTuple):
    """How the figures of a bearing follow one number of its model."""

    parameter: str  #: key path, "bearings.main.radial_clearance"
    value: float  #: the number [SI]
    unit: str  #: its SI unit; "1" for a pure number
    exact: bool  #: by the Jacobian of the solution; else by the difference of two solutions
    error: str  #: why there are no derivatives; empty if there are
    derivatives: dict[str, float]  #: of every figure that has one, by its key: SI over SI


class _Kept(NamedTuple):
    """A solution as plain data: what `pickle` and `copy` take along."""

    lines: list[tuple]
    named_fields: dict[str, tuple]
    error: str
    label: str
    warnings: list[str]
    linearisations: int
    wall_time: float
    kind: str
    has_axis: bool
    position: np.ndarray
    load: np.ndarray
    clearance: float
    stiffness: np.ndarray
    damping: np.ndarray
    named_dimensions: list[tuple]

    def figures(self) -> list[tuple]:
        return self.lines

    def fields(self) -> dict[str, tuple]:
        return self.named_fields

    def dimensions(self) -> list[tuple]:
        return self.named_dimensions


class BearingSolution(Mapping):
    """Every figure of a steady bearing by its name, in SI: `solution["h_min"]` is a `Figure` [m].

    >>> import hersey
    >>> film = hersey.bearing(diameter="45 mm", width="15.6 mm", radial_clearance="34 um", viscosity="15 mPa.s",
    ...                       journal_speed="3570 rpm", load="2500 N",
    ...                       supply={"line": "widest_gap", "pressure": "0 bar"})
    >>> 5e-6 < film["h_min"] < 6e-6, film["h_min"].unit
    (True, 'm')
    """

    def __init__(self, solution: "Union[_core.BearingSolution, _Kept]"):
        self._solution = solution
        self._figures: Optional[dict[str, Figure]] = None
        #: derivatives of all figures, by key path of what they were asked for: `sensitivity` of `Model.bearing`
        self.sensitivities: dict[str, Sensitivity] = {}

    def __reduce__(self):
        s = self._solution
        if isinstance(s, _Kept):
            return _from_kept, (s, self.sensitivities)
        solved = not s.error
        kept = _Kept(s.figures(), s.fields() if solved else {}, s.error, s.label, s.warnings, s.linearisations, s.wall_time,
                     s.kind, s.has_axis, s.position, s.load, s.clearance if solved else math.nan, s.stiffness, s.damping,
                     s.dimensions() if solved else [])
        return _from_kept, (kept, self.sensitivities)

    def __eq__(self, other: object) -> bool:
        """Whether all figures, and the reasons of those that have no number, are the same."""
        if not isinstance(other, BearingSolution):
            return NotImplemented
        return self.error == other.error and self._solution.figures() == other._solution.figures()

    __hash__ = None  # type: ignore[assignment]

    def _all(self) -> dict[str, Figure]:
        if self._figures is None:
            self._figures = {line[0]: Figure.make(*line) for line in self._solution.figures()}
        return self._figures

    def __getitem__(self, key: str) -> Figure:
        figures = self._all()
        if key not in figures:
            raise KeyError(f"no figure '{key}'{did_you_mean(key, figures)}; there are {', '.join(figures)}")
        return figures[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())

    def __repr__(self) -> str:
        if self.error:
            return f"<BearingSolution {self.label}: {self.error}>"
        return "\n".join(f"{figure.name:48} {figure}" for figure in self._all().values())

    @property
    def label(self) -> str:
        """The values by which it differs from others of a sweep."""
        return self._solution.label

    @property
    def error(self) -> str:
        """Why there is no solution; empty if there is one."""
        return self._solution.error

    @property
    def warnings(self) -> list[str]:
        """Where the film goes beyond what is known of its oil."""
        return self._solution.warnings

    @property
    def kind(self) -> str:
        """Kind of the bearing as in a model file: "journal", "plane_slider", "thrust"; empty where there is no solution."""
        return self._solution.kind

    @property
    def position(self) -> np.ndarray:
        """Position of the moving surface in the coordinates of its kind [m].

        Of a journal x and y of its axis, which is its `eccentricity`; of a plane slider x of the runner's plane where it
        passes the middle of the pad's face: the film thickness there with the other sign, as x points into the pad; of a
        thrust bearing the film thickness on the axis.
        """
        return self._solution.position

    @property
    def eccentricity(self) -> np.ndarray:
        """Position of the journal, x and y [m]. Kinds whose moving surface has no axis have a `position` only."""
        if not self._solution.has_axis:
            raise AttributeError(f"a {_in_text(self.kind)} has no eccentricity: expected position, of the moving surface in "
                                 "the coordinates of its kind, or a figure, such as solution['h_min']")
        return self._solution.position

    @property
    def stiffness(self) -> np.ndarray:
        """Force on the fixed surface by the position of the moving one, forces first, then moments by slopes.

        Of a journal: force on the shell (F_x, F_y [N], M_y, -M_x [N m]) by the journal's position (e_x, e_y [m], its
        slopes), 4 x 4. Of a plane slider: force on the pad (F_x [N], -M_z, M_y [N m]) by the runner's position (x [m], its
        slopes along and across the sliding direction), 3 x 3. Of a thrust bearing: force on the stator (F_z [N], M_y, -M_x
        [N m]) by the runner's position (z [m], slopes of its axis towards x and y), 3 x 3.
        """
        return self._solution.stiffness

    @property
    def damping(self) -> np.ndarray:
        """The same by the rates of that position."""
        return self._solution.damping

    def gradient(self, figure: str) -> dict[str, float]:
        """Derivatives of one figure by key path of what it was asked for, SI over SI; `sensitivity` of `Model.bearing`.

        >>> from hersey import bearing
        >>> film = bearing(diameter="45 mm", width="20 mm", radial_clearance="30 um", viscosity="20 mPa.s",
        ...                speed="3000 rpm", load="1 kN", supply={"line": "widest_gap", "pressure": "0 bar"},
        ...                sensitivity_to=["width", "load"])
        >>> sorted(film.gradient("h_min")), film.gradient("h_min")["bearings.main.width"] > 0
        (['bearings.main.operating_point.load', 'bearings.main.width'], True)
        """
        self[figure]  # its name is one
        if not self.sensitivities:
            raise InputError("no sensitivities were asked for: expected sensitivity=True, or sensitivity_to=[...], in the "
                             "call that solved the bearing")
        return {each.parameter: each.derivatives.get(figure, math.nan) for each in self.sensitivities.values()}

    def take(self, found: Sequence[tuple]) -> None:
        """Keeps sensitivities as the solver tells them."""
        keys = list(self._all())
        for parameter, value, unit, exact, error, slopes in found:
            known = {key: slope for key, slope in zip(keys, slopes) if math.isfinite(slope)}
            self.sensitivities[parameter] = Sensitivity(parameter, value, unit or "1", exact, in_words(error), known)

    @property
    def fields(self):
        """Pressure, film thickness and all other fields as an `xarray.Dataset` over bearing angle `phi` [rad] and `z` [m],
        of a plane slider over `y` [m] along the sliding direction and `z`, of a thrust bearing over `phi` and the radius `r`
        [m]."""
        import xarray

        coordinates = {name: (name, values, {"units": unit, "long_name": text})
                       for name, unit, text, values in self._solution.dimensions()}
        data = {name: (tuple(coordinates), values, {"units": unit, "long_name": text})
                for name, (unit, text, values) in self._solution.fields().items()}
        return xarray.Dataset(data, coordinates)

    def to_pandas(self):
        """All figures as a `pandas.DataFrame`: name, value in the unit people use, unit, error of the grid."""
        import pandas

        rows = [(f.group, f.name, f.shown, f.shown_unit, None if f.grid_error is None else f.grid_error * f.shown / float(f)
                 if float(f) else None, f.words) for f in self._all().values()]
        return pandas.DataFrame(rows, index=pandas.Index(list(self._all()), name="figure"),
                                columns=["group", "name", "value", "unit", "grid error", "words"])


def solved(solution: "_core.BearingSolution") -> BearingSolution:
    """@raises SolutionError where there is none."""
    if solution.error:
        raise SolutionError(in_words(solution.error))
    return BearingSolution(solution)


def _from_kept(kept: _Kept, sensitivities: dict[str, Sensitivity]) -> BearingSolution:
    solution = BearingSolution(kept)
    solution.sensitivities = dict(sensitivities)
    return solution


def _in_text(kind: str) -> str:
    """ "plane_slider" in a sentence."""
    return kind.replace("_", " ")
