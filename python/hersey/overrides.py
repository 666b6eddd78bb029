"""Python's values as the text a model file would have, and back."""

from __future__ import annotations

import json
import re
from typing import Any, Mapping

_PLAIN = re.compile(r"[A-Za-z0-9_+.\-](?:[A-Za-z0-9_ .+\-*/^()%µ°]*[A-Za-z0-9_.)%µ°])?")
_INTEGER = re.compile(r"[+-]?\d+")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")


def plain(value: Any) -> Any:
    """A value as JSON has it: numpy's numbers and arrays, tuples and nested mappings included."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, float):
        return float(value)
    if hasattr(value, "__fspath__"):
        return value.__fspath__()
    raise TypeError(f"{value!r} has no place in a model: expected a number, a text with unit such as '40 um', "
                    "a list or a mapping")


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
