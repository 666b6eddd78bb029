"""Python's values as the text a model file would have, and back."""

from __future__ import annotations

import json
import re
from typing import Any, Callable, Iterable, Iterator, Mapping

import numpy as np

from . import _core
from .figure import Figure

_PLAIN = re.compile(r"[A-Za-z0-9_+.\-](?:[A-Za-z0-9_ .+\-*/^()%µ°]*[A-Za-z0-9_.)%µ°])?")
_INTEGER = re.compile(r"[+-]?\d+")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")


def plain(value: Any) -> Any:
    """A value as JSON has it: mappings, lists, texts, and numbers, which are bare yet.

    Quantities become texts: `(value, "unit")`, those of pint, and figures of a solution.

    >>> plain({"width": (20, "mm"), "grid": {"axial": 25}}), plain(((1, 2.5), "mm"))
    ({'width': '20 mm', 'grid': {'axial': 25}}, ['1 mm', '2.5 mm'])
    """
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, Figure):
        return float(value) if value.unit == "1" else with_unit(float(value), value.unit)
    if is_pair(value):
        return with_unit(plain(value[0]), value[1])
    if hasattr(value, "to_base_units"):  # of pint: in SI, whose names are those of any program
        return _of_pint(value.to_base_units())
    if hasattr(value, "__array__"):
        return plain(np.asarray(value).tolist())
    if isinstance(value, (list, tuple, range)):
        return [plain(item) for item in value]
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, float):
        return float(value)
    if hasattr(value, "__fspath__"):
        return value.__fspath__()
    raise TypeError(f"{value!r} has no place in a model: expected a number (in SI), a text with unit such as '40 um', a pair "
                    "such as (40, 'um'), a quantity of pint's, a list or a mapping")


def is_pair(value: Any) -> bool:
    """Whether it is `(value, "unit")`: a number, or numbers, and a unit."""
    if not (isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], str)):
        return False
    number = value[0]
    if isinstance(number, (list, tuple, range)):
        return all(_is_number(item) for item in number)
    return _is_number(number) or (hasattr(number, "__array__") and not hasattr(number, "to_base_units"))


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _of_pint(quantity: Any) -> Any:
    magnitude, unit = plain(quantity.magnitude), str(quantity.units).replace("**", "^").replace(" ", "")
    return magnitude if unit == "dimensionless" else with_unit(magnitude, unit)


def with_unit(number: Any, unit: str) -> Any:
    """ "40 um", or a list of such texts."""
    if isinstance(number, list):
        return [with_unit(item, unit) for item in number]
    return f"{number!r} {unit}"


def give_units(values: dict[str, Any], bare: Iterable[tuple[str, str, str]]) -> bool:
    """Gives numbers in `values` (key path: plain value) the unit that `bare` (path, unit, parameter) says, in place.

    Returns whether there were any.

    >>> values = {"bearings.main": {"width": 0.02, "grid": {"axial": 9}}, "load": 500}
    >>> give_units(values, [("bearings.main.width", "m", ""), ("bearings.main.operating_point.load", "N", "load")]), values
    (True, {'bearings.main': {'width': '0.02 m', 'grid': {'axial': 9}}, 'load': '500 N'})
    """
    given = False
    for path, unit, parameter in bare:
        wanted = [parameter, f"parameters.{parameter}"] if parameter else [path]
        for root in values:
            given = any(_give_unit(values, root, name, unit) for name in wanted) or given
    return given


def give_study_units(values: dict[str, Any], united: Callable[[str, list[Any]], list[Any]]) -> None:
    """Gives bare numbers among a study's lists in `values` (key path: plain value) their units, in place.

    `united` tells items of a parameter with them.

    >>> values = {"study": {"parameters": {"load": [500, "2 kN"], "speed": ["50 Hz"]}}}
    >>> give_study_units(values, lambda name, items: [with_unit(item, "N") if has_numbers(item) else item for item in items])
    >>> values
    {'study': {'parameters': {'load': ['500 N', '2 kN'], 'speed': ['50 Hz']}}}
    """
    for holder, key, name in [*_of_study(values)]:
        if isinstance(holder[key], list) and has_numbers(holder[key]):
            holder[key] = united(name, holder[key])


def _of_study(values: dict[str, Any]) -> Iterator[tuple[dict[str, Any], str, str]]:
    """Where the values of a study's parameters stand, and the names of these."""
    prefix, ways = "study.parameters.", {"": ("study", "parameters"), "study": ("parameters",), "study.parameters": ()}
    for root, value in values.items():
        if root.startswith(prefix):
            yield values, root, root.removeprefix(prefix)
        if root not in ways:
            continue
        for part in ways[root]:
            value = value.get(part) if isinstance(value, dict) else None
        if isinstance(value, dict):
            yield from ((value, name, name) for name in value)


def _give_unit(values: dict[str, Any], root: str, path: str, unit: str) -> bool:
    if root and path != root and not path.startswith(root + "."):
        return False
    rest = path[len(root):].lstrip(".")
    holder: Any = values
    key: Any = root
    for part in rest.split(".") if rest else ():
        holder, key = holder[key], part
        if isinstance(holder, list) and key.isdigit() and int(key) < len(holder):
            key = int(key)
        elif not (isinstance(holder, dict) and key in holder):
            return False
    if not _is_number(holder[key]):
        return False
    holder[key] = with_unit(holder[key], unit)
    return True


def has_numbers(value: Any) -> bool:
    """Whether any number is bare in a plain value."""
    if isinstance(value, dict):
        return any(has_numbers(item) for item in value.values())
    if isinstance(value, list):
        return any(has_numbers(item) for item in value)
    return _is_number(value)


def to_si(value: Any, unit: str) -> float:
    """The number [SI] of a quantity of a known unit: a number is SI already.

    >>> to_si("45 mm", "m"), to_si((45, "mm"), "m"), to_si(0.045, "m")
    (0.045, 0.045, 0.045)
    """
    value = plain(value)
    return float(value) if _is_number(value) else _core.parse_quantity(yaml_of(value), unit)


def to_si_vector(value: Any, unit: str) -> list[float]:
    """Three of them: a list, an array, or "0 0 -9.81 m/s^2"."""
    if isinstance(value, str):
        parts = value.split(None, 3)
        value = [f"{part} {parts[3]}" for part in parts[:3]] if len(parts) == 4 else parts
    items = plain(value)
    if not isinstance(items, list) or len(items) != 3:
        raise ValueError(f"{value!r}: expected three components, such as '0 0 -9.81 {unit}'")
    return [to_si(item, unit) for item in items]


def yaml_of(value: Any) -> str:
    """The value as it would be written after `key:`; `None` is the word none.

    >>> yaml_of("40 um"), yaml_of(25), yaml_of({"axial": 25}), yaml_of([1, "2 mm"])
    ('40 um', '25', '{"axial": 25}', '[1, "2 mm"]')
    """
    value = plain(value)
    if value is None:
        return "none"
    if isinstance(value, str):
        return value if _PLAIN.fullmatch(value) else json.dumps(value, ensure_ascii=False)
    return json.dumps(value, ensure_ascii=False)


def assignment(path: str, value: Any) -> str:
    """`path=value` as `hersey --set` takes it."""
    return f"{path}={yaml_of(value)}"


def assignments(values: Mapping[str, Any]) -> list[str]:
    """All of them."""
    return [assignment(path, value) for path, value in values.items()]


def listed(values: Any) -> list[Any]:
    """The values of a sweep, plain: of a list, an array, a pair with a list; one value is a list of one.

    >>> listed((range(2), "mm")), listed("40 um"), listed([])
    (['0 mm', '1 mm'], ['40 um'], [])
    """
    is_one_thing = isinstance(values, (str, Mapping)) or is_pair(values) or hasattr(values, "__array__")
    if not is_one_thing and hasattr(values, "__iter__"):
        values = list(values)
    items = plain(values)
    return items if isinstance(items, list) else [items]


def value_of(written: Any) -> Any:
    """What stands in a model as Python has it: bare numbers as numbers, quantities as texts.

    >>> value_of({"grid": ["25", "1e-3"], "width": "20 mm"})
    {'grid': [25, 0.001], 'width': '20 mm'}
    """
    if isinstance(written, dict):
        return {key: value_of(item) for key, item in written.items()}
    if isinstance(written, list):
        return [value_of(item) for item in written]
    if isinstance(written, str) and _INTEGER.fullmatch(written):
        return int(written)
    if isinstance(written, str) and _NUMBER.fullmatch(written):
        return float(written)
    return written
