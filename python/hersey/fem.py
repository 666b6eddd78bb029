"""Elastic bodies of meshes by themselves: natural modes, statics with stresses, reduced bodies for models."""

from __future__ import annotations

import os
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np

from . import _core
from .overrides import plain, to_si, to_si_vector, yaml_of

_AXES = ["x", "y", "z"]
_STRESSES = ["xx", "yy", "zz", "xy", "yz", "xz"]


def _given(value: Any, unit: str) -> str:
    """A quantity as text, a number in SI; nothing where the mesh file is to say it."""
    value = plain(value)
    return f"{value!r} {unit}".strip() if isinstance(value, (int, float)) else "" if value is None else yaml_of(value)


class Body:
    """A mesh with its materials, as `hersey modes`, `hersey stress` and `hersey reduce` take it.

    `file` is a Gmsh, Abaqus or Nastran mesh in `length_unit`; `youngs_modulus`, `poisson_ratio` and `density` take the
    place of what the file says: texts with units, pairs `(210, "GPa")`, quantities of pint's, or numbers, which are SI.
    """

    def __init__(self, file: Any, length_unit: str = "m", *, youngs_modulus: Any = None, poisson_ratio: Any = None,
                 density: Any = None):
        material = [_given(youngs_modulus, "Pa"), _given(poisson_ratio, ""), _given(density, "kg/m^3")]
        self._body = _core.read_body(os.fspath(file), length_unit, [text.strip('"') for text in material])

    @property
    def sets(self) -> list[str]:
        """Names of its sets of nodes."""
        return self._body.sets

    @property
    def mass(self) -> float:
        """[kg]"""
        return self._body.mass

    @property
    def nodes(self) -> np.ndarray:
        """Positions [m], shape (nodes, 3)."""
        return self._body.nodes

    def _places(self) -> dict[str, Any]:
        x = self.nodes
        return {"node": self._body.labels, "axis": _AXES,
                **{axis: ("node", x[:, k], {"units": "m", "long_name": f"position, {axis}"}) for k, axis in enumerate(_AXES)}}

    def modes(self, hold: Sequence[str] = (), count: int = 20):
        """Natural modes, sets in `hold` at rest, as `xarray.Dataset`: `frequency` [Hz], `shape` with M-norm 1."""
        import xarray

        frequencies, shapes, rigid = self._body.modes(list(hold), count)
        data = {"frequency": ("mode", frequencies, {"units": "Hz", "long_name": "natural frequency"}),
                "shape": (("mode", "node", "axis"), np.array(shapes), {"long_name": "mode shape, M-norm 1"})}
        return xarray.Dataset(data, {"mode": np.arange(1, len(frequencies) + 1), **self._places()}, {"rigid": rigid})

    def static(self, hold: Sequence[str], *, pressure: Optional[Mapping[str, Any]] = None,
               force: Optional[Mapping[str, Any]] = None, gravity: Any = "0 0 0 m/s^2"):
        """Displacements and stresses under loads at rest, as `xarray.Dataset` over nodes.

        `pressure` on surfaces or sets ("20 MPa"), `force` spread evenly over the faces of a set ("0 -500 0 N", or three
        numbers, which are SI), `gravity` on all of it; sets in `hold` do not move.
        """
        import xarray

        result = self._body.solve_static(
            list(hold), {name: to_si(value, "Pa") for name, value in (pressure or {}).items()},
            {name: np.array(to_si_vector(value, "N")) for name, value in (force or {}).items()},
            np.array(to_si_vector(gravity, "m/s^2")))
        data = {
            "displacement": (("node", "axis"), result.displacement, {"units": "m", "long_name": "displacement"}),
            "reaction": (("node", "axis"), result.reaction, {"units": "N", "long_name": "force of supports"}),
            "stress": (("node", "component"), result.stress, {"units": "Pa", "long_name": "stress, mean of elements"}),
            "von_mises": ("node", result.von_mises, {"units": "Pa", "long_name": "von Mises' stress"}),
            "energy": ((), result.energy, {"units": "J", "long_name": "strain energy"}),
        }
        return xarray.Dataset(data, {**self._places(), "component": _STRESSES})

    def reduce(self, frames: Mapping[str, Union[str, tuple[str, str]]], modes: int = 20, *, loads: Sequence[str] = (),
               harmonics: int = 4, static_error: float = 0) -> "ReducedBody":
        """The body in few coordinates, for `bodies.X.reduced` of a model.

        `frames` are names with the set each stands on, or (set, "average"); `loads`, `harmonics` and `static_error`
        are those of `hersey reduce`.
        """
        placed = []
        for name, given in frames.items():
            set_name, connection = (given, "rigid") if isinstance(given, str) else given
            if connection not in ("rigid", "average"):
                raise ValueError(f"frame {name}: {connection!r}: expected rigid or average")
            placed.append((name, set_name, connection == "rigid"))
        return ReducedBody(self._body.reduce(placed, modes, list(loads), harmonics, static_error))


class ReducedBody:
    """Six coordinates for each frame, then the internal ones (theory manual, elastic.14); all SI."""

    def __init__(self, body: "_core.ReducedBody"):
        self._body = body

    @property
    def stiffness(self) -> np.ndarray:
        return self._body.stiffness

    @property
    def mass(self) -> np.ndarray:
        return self._body.mass

    @property
    def shapes(self) -> np.ndarray:
        """Displacements of the nodes per coordinate, shape (3 nodes, coordinates)."""
        return self._body.shapes

    @property
    def frequencies(self) -> np.ndarray:
        """Of the internal coordinates, all frames at rest [Hz]."""
        return self._body.frequencies

    def save(self, path: Any) -> None:
        """Writes the file that `hersey reduce --output` writes."""
        self._body.save(os.fspath(path))


__all__ = ["Body", "ReducedBody"]
