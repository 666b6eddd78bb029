"""A bearing by itself: where its journal settles under a load, what it costs, how stiff it is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Iterator, Optional

import numpy as np

from . import _core
from .errors import SolutionError
from .figure import Figure


class BearingSolution(Mapping):
    """Every figure of a steady bearing by its name, in SI: `solution["h_min"]` is a `Figure` [m].

    >>> import hersey
    >>> film = hersey.bearing(diameter="45 mm", width="15.6 mm", radial_clearance="34 um", viscosity="15 mPa.s",
    ...                       journal_speed="3570 rpm", load="2500 N",
    ...                       supply={"line": "widest_gap", "pressure": "0 bar"})
    >>> 5e-6 < film["h_min"] < 6e-6, film["h_min"].unit
    (True, 'm')
    """

    def __init__(self, solution: "_core.BearingSolution"):
        self._solution = solution
        self._figures: Optional[dict[str, Figure]] = None

    def _all(self) -> dict[str, Figure]:
        if self._figures is None:
            self._figures = {line[0]: Figure.make(*line) for line in self._solution.figures()}
        return self._figures

    def __getitem__(self, key: str) -> Figure:
        figures = self._all()
        if key not in figures:
            raise KeyError(f"no figure '{key}'; there are {', '.join(figures)}")
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
    def eccentricity(self) -> np.ndarray:
        """Position of the journal, x and y [m]."""
        return self._solution.eccentricity

    @property
    def stiffness(self) -> np.ndarray:
        """Force on the shell (F_x, F_y [N], M_y, -M_x [N m]) by the journal's position (e_x, e_y [m], its slopes), 4 x 4."""
        return self._solution.stiffness

    @property
    def damping(self) -> np.ndarray:
        """The same by the rates of that position, 4 x 4."""
        return self._solution.damping

    @property
    def fields(self):
        """Pressure, film thickness and all other fields as an `xarray.Dataset` over bearing angle and z."""
        import xarray

        data = {name: (("phi", "z"), values, {"units": unit, "long_name": text})
                for name, (unit, text, values) in self._solution.fields().items()}
        coordinates = {"phi": ("phi", self._solution.phi, {"units": "rad", "long_name": "bearing angle"}),
                       "z": ("z", self._solution.z, {"units": "m", "long_name": "place along the axis"})}
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
        raise SolutionError(solution.error)
    return BearingSolution(solution)


_BEARING = "main"
_POINT = ("journal_speed", "shell_speed", "load", "load_angle", "eccentricity_ratio", "eccentricity_angle",
          "radial_velocity", "tilt", "journal_angle")


def bearing(*, viscosity: Any = None, lubricant: Any = None, grid_error: bool = True,
            thermal_coefficients: str = "frozen", **keys: Any) -> BearingSolution:
    """Solves one journal bearing from its dimensions.

    Parameters are the keys of a bearing in a model file, as texts with units: `diameter`, `width`, `radial_clearance`
    (or `diametral_clearance`), and all others of docs/model-file.md; those of its operating point beside them:
    `journal_speed` (or `speed`), `load` and `load_angle`, or `eccentricity_ratio` and `eccentricity_angle`. The oil is
    its `viscosity` ("15 mPa.s") or a whole `lubricant` (a mapping as in a model file).

    Raises `InputError` for anything a model file would not allow, `SolutionError` where there is no solution.

    >>> bearing(diameter="45 mm", width="20 mm", radial_clearance="30 um", viscosity="20 mPa.s", speed="3000 rpm",
    ...         eccentricity_ratio=0.6)["load"].unit
    'N'
    """
    return bearing_model(viscosity=viscosity, lubricant=lubricant, **keys).bearing(
        grid_error=grid_error, thermal_coefficients=thermal_coefficients)


def bearing_model(*, viscosity: Any = None, lubricant: Any = None, **keys: Any):
    """The same as a `Model` with the one bearing "main", to sweep or to write down."""
    from .model import Model

    if "speed" in keys:
        keys["journal_speed"] = keys.pop("speed")
    point = {key: keys.pop(key) for key in _POINT if key in keys}
    oil = dict(lubricant or {})
    if viscosity is not None:
        oil["viscosity"] = viscosity
    content: dict[str, Any] = {**keys, "lubricant": "oil"}
    if point:
        content["operating_point"] = point
    return Model.from_dict({"title": "Journal bearing", "lubricants": {"oil": oil}, "bearings": {_BEARING: content}})
