"""Solutions of a sweep as one data set."""

from __future__ import annotations

from typing import Any, Mapping, Sequence

import numpy as np

from .bearing import BearingSolution
from .overrides import yaml_of


def _coordinate(name: str, values: Sequence[Any]):
    """Numbers in the unit of the first value; words as they are."""
    parts = [yaml_of(value).split(None, 1) for value in values]
    if not parts:
        return name, np.zeros(0), {}
    try:
        numbers = [float(part[0]) for part in parts]
    except ValueError:
        return name, [str(value) for value in values], {}
    units = {part[1] if len(part) > 1 else "" for part in parts}
    if len(units) != 1:
        return name, [str(value) for value in values], {}
    unit = units.pop()
    return name, numbers, {"units": unit} if unit else {}


def sweep(values: Mapping[str, Sequence[Any]], found: Sequence[Any], keys: Sequence[str] = ()):
    """All figures over the swept values, in SI; without any values those of `keys` that any bearing has, empty."""
    import xarray

    names = list(values)
    shape = [len(items) for items in values.values()]
    solutions = [BearingSolution(solution) for solution in found]
    data: dict[str, Any] = {}
    swept = set(values)
    for key in keys:
        if "<" not in key and key not in swept:
            data[key] = (names, np.full(shape, np.nan))
    for at, solution in enumerate(solutions):
        for key, figure in solution.items():
            if key in swept:
                continue
            if key not in data:
                data[key] = (names, np.full(shape, np.nan), {"units": figure.unit, "long_name": figure.name})
            data[key][1][np.unravel_index(at, shape)] = float(figure)
    data["error"] = (names, np.array([solution.error for solution in solutions], dtype=object).reshape(shape),
                     {"long_name": "why there is no solution"})
    return xarray.Dataset(data, {name: _coordinate(name, items) for name, items in values.items()})
