"""A bearing from its dimensions, without a model file."""

from __future__ import annotations

from typing import Any, Sequence, Union

from . import _core
from .bearing import BearingSolution
from .errors import InputError
from .model import Model
from .names import BearingNames
from .words import did_you_mean

_BEARING, _OIL = "main", "oil"


def bearing(*, viscosity: Any = None, lubricant: Any = None, grid_error: bool = True,
            thermal_coefficients: str = "frozen", sensitivity: bool = False,
            sensitivity_to: Union[str, Sequence[str]] = (), **keys: Any) -> BearingSolution:
    """Solves one bearing from its dimensions.

    Parameters are the keys of a bearing in a model file, of a journal bearing or of what `kind` names: `diameter`, `width`,
    `radial_clearance` (or `diametral_clearance`) of a journal, `length` and `width` of a plane slider, and all others of
    docs/model-file.md. Those of its operating point stand beside them: `speed`, and `load` or a position (of a journal
    `eccentricity_ratio` and `eccentricity_angle`, of a plane slider `film_thickness`). The oil is its `viscosity`
    ("15 mPa.s") or a whole `lubricant` (a mapping as in a model file). Quantities are texts with units, pairs such as
    `(45, "mm")`, quantities of pint's, or numbers, which are SI. `sensitivity` and `sensitivity_to` are those of
    `Model.bearing`.

    Raises `InputError` for anything a model file would not allow, `SolutionError` where there is no solution.

    >>> bearing(diameter="45 mm", width="20 mm", radial_clearance="30 um", viscosity="20 mPa.s", speed="3000 rpm",
    ...         eccentricity_ratio=0.6)["load"].unit
    'N'
    >>> bearing(kind="plane_slider", length="50 mm", width="50 mm", viscosity="20 mPa.s", speed="3 m/s", load="5 kN",
    ...         shape=[{"profile": "ramp", "rise": "20 um"}])["h_min"].unit
    'm'
    """
    return bearing_model(viscosity=viscosity, lubricant=lubricant, **keys).bearing(
        grid_error=grid_error, thermal_coefficients=thermal_coefficients, sensitivity=sensitivity, sensitivity_to=sensitivity_to)


def bearing_model(*, viscosity: Any = None, lubricant: Any = None, **keys: Any) -> Model:
    """The same as a `Model` with the one bearing "main", to sweep or to write down."""
    of_kind = _core.names_of_kind(str(keys.get("kind", "")), _BEARING, _OIL)
    names = None if of_kind is None else BearingNames(of_kind, _BEARING)  # the reader tells of a kind that is none
    here, point_of = f"bearings.{_BEARING}.", f"bearings.{_BEARING}.operating_point."
    own: dict[str, Any] = {}
    point: dict[str, Any] = {}
    for key, value in keys.items():
        path = names.path_of(key) if names else here + key
        if path.startswith(point_of):
            point[path.removeprefix(point_of)] = value
        else:
            own[path.removeprefix(here)] = value
    oil = dict(lubricant or {})
    if viscosity is not None:
        oil["viscosity"] = viscosity
    content: dict[str, Any] = {**own, "lubricant": _OIL, **({"operating_point": point} if point else {})}
    whole: dict[str, Any] = {"title": names.title if names else "", "lubricants": {_OIL: oil}, "bearings": {_BEARING: content}}
    try:
        return Model.from_dict(whole)
    except InputError as error:
        known = [*(names.known if names else ()), "lubricant", "grid_error", "thermal_coefficients", "sensitivity_to"]
        unknown = {f"unknown key '{key}'": key for key in own}
        raise error.hinting(lambda fault: did_you_mean(unknown[fault.found], known) if fault.found in unknown else "") from None
