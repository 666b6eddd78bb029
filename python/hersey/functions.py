"""Functions of the user's own in a model: forces, drives, pressures, controllers; oils and surfaces.

What a run evaluates again and again, a force say, is a `Function`: Python is called from the solver. What an oil or a
surface is like does not change in a run: `viscosity_law` and `surface_profile` ask the function once, on a grid, and
the solver interpolates.
"""

from __future__ import annotations

import csv
import math
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Sequence, Union

import numpy as np

from .errors import UserFunctionError
from .overrides import to_si


@dataclass
class Function:
    """A Python function where a model file may have an expression.

    `function` is called with one float for each name in `of`: "t" is the time [s], "JOINT.rotation" [rad],
    "JOINT.x" [m] and so on a joint's coordinate, "JOINT.rotation_rate" its rate [rad/s or m/s]. It returns a number in
    `unit`. A controller is such a function of coordinates and rates. It must give the same value for the same
    arguments: the solver tries and goes back.

    `derivative` is what Newton's iteration needs, and what makes a drive's speed of its position:
    "difference" (two calls for each of `of`), "complex" (one call with a complex argument, exact where `function` is
    made of operations that take one, such as numpy's), or a function that returns one derivative for each of `of`.

    >>> import math
    >>> pressure = Function(lambda angle: 500 * math.sin(angle), of="main.rotation", unit="N",
    ...                     derivative=lambda angle: 500 * math.cos(angle))
    """

    function: Callable[..., float]
    of: Union[str, Sequence[str]] = "t"
    unit: str = "1"
    derivative: Union[str, Callable[..., Any]] = "difference"
    variables: list[str] = field(init=False)

    def __post_init__(self) -> None:
        self.variables = [self.of] if isinstance(self.of, str) else list(self.of)
        if not callable(self.function):
            raise TypeError(f"{self.function!r} is no function")
        if not callable(self.derivative) and self.derivative not in ("difference", "complex"):
            raise ValueError(f"derivative {self.derivative!r}: expected 'difference', 'complex' or a function")

    def stand_in(self) -> dict[str, str]:
        """The expression that keeps its place in the model: it names the variables and is worth one unit."""
        return {"expression": " + ".join(["1", *(f"0*{name}" for name in self.variables)]), "unit": self.unit}


def _ask(name: str, function: Callable[..., Any], *arguments: float) -> float:
    """One value, or `UserFunctionError`."""
    shown = ", ".join(f"{value:.6g}" for value in arguments)
    try:
        value = function(*arguments)
    except Exception as error:
        raise UserFunctionError(f"{name}: the function raised {type(error).__name__} at ({shown}): {error}", name) from error
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = math.nan
    if not math.isfinite(number):
        raise UserFunctionError(f"{name}: the function gave {value!r} at ({shown}): expected one finite number", name)
    return number


def viscosity_law(function: Callable[..., float], temperatures: Sequence[float],
                  pressures: Sequence[float] = ()) -> dict[str, Any]:
    """An oil's `viscosity` from a function of temperature [degC], and pressure [Pa] where `pressures` are given.

    `function` returns the dynamic viscosity [Pa s] and is asked at every pair. Between the temperatures the table
    follows Walther's straight lines, between the pressures its logarithm is linear: its derivatives are exact.

    >>> law = viscosity_law(lambda T: 0.1 * 0.97 ** (T - 40), range(20, 140, 10))
    >>> law["temperatures"][0], law["viscosities"][2]
    ('20 degC', '0.1 Pa.s')
    """
    rows: list[Any] = []
    for T in temperatures:
        if len(pressures):
            rows.append([f"{_ask('viscosity', function, T, p):.15g} Pa.s" for p in pressures])
        else:
            rows.append(f"{_ask('viscosity', function, T):.15g} Pa.s")
    law: dict[str, Any] = {"law": "table", "temperatures": [f"{T:.15g} degC" for T in temperatures], "viscosities": rows}
    if len(pressures):
        law["pressures"] = [f"{p:.15g} Pa" for p in pressures]
    return law


def surface_profile(function: Callable[[float, float], float], width: Any, file: Any, *, around: int = 180,
                    along: int = 21, on: str = "shell") -> dict[str, str]:
    """An entry of a bearing's `shape` from a function of angle [rad] and z [m] that says how far a surface is open [m].

    Writes `file`, a table that the solver interpolates by monotone cubics around and linearly along; `width` is the bearing's
    [m]. Name the file as observed from the model's folder.
    """
    path, width = Path(os.fspath(file)), to_si(width, "m")
    with open(path, "w", newline="", encoding="utf-8") as out:
        rows = csv.writer(out)
        rows.writerow(["angle [rad]", "z [m]", "opening [m]"])
        for z in np.linspace(-width / 2, width / 2, along):
            for angle in np.arange(around) * (2 * math.pi / around):
                rows.writerow([repr(float(angle)), repr(float(z)), repr(_ask("profile", function, float(angle), float(z)))])
    return {"profile": "table", "file": str(path), "on": on}


def cost_of(calls: Sequence[Any]) -> dict[str, dict[str, float]]:
    """How often each function was called, and how long Python took [s]: `summary["functions"]`."""
    return {each.name: {"calls": each.calls, "seconds": each.seconds} for each in calls}


def raise_fault_of(calls: Sequence[Any], t: float, results: Any) -> None:
    """@raises UserFunctionError for the first function that failed."""
    for each in calls:
        if each.fault:
            kept = f"; results up to then are in {results.path}" if results is not None else ""
            error = UserFunctionError(f"{each.name}: the function {each.fault}, at t = {t:.6g} s of the run{kept}",
                                      each.name, t, results)
            raise error from each.exception


__all__ = ["Function", "surface_profile", "viscosity_law"]
