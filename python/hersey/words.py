"""Messages of the solver in Python's words: it speaks of command lines and files, its user of calls and keys."""

from __future__ import annotations

import difflib
import re
from typing import Iterable

# What the command line calls otherwise.
_OPTIONS = {"force": "overwrite=True", "resume": "resume=True", "step-error": "step_error=True"}
_COMMANDS = {"run": "model.run()", "bearing": "model.bearing()", "check": "model.check()", "study": "hersey.study()",
             "modes": "fem.Body.modes()", "stress": "fem.Body.static()", "reduce": "fem.Body.reduce()"}

_VALUE = r"'[^']*'|\"[^\"]*\"|[^\s`;,]+"
_RULES = [
    (re.compile(r"; `hersey study` runs this one; --set PARAMETER=VALUE for each gives a single run"),
     lambda _: "; hersey.study() runs this one; model.set() of each parameter gives a single run"),
    (re.compile(rf"`?--set ([\w.]+)=({_VALUE})`?"), lambda m: f"model[{m[1]!r}] = {_bare(m[2])!r}"),
    (re.compile(r"with --set, give the other one as 'none'"), lambda _: "with model.set, give the other one as None"),
    (re.compile(r"--set: "), lambda _: ""),
    (re.compile(r"set by --set"), lambda _: "that was assigned"),
    (re.compile(r"not given; for `--set`"), lambda _: "not given; for model.set"),
    (re.compile(rf"[`']hersey ({'|'.join(_COMMANDS)})[`']"), lambda m: _COMMANDS[m[1]]),
    (re.compile(r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)"), lambda m: _OPTIONS.get(m[1], m[1].replace("-", "_"))),
]


def _bare(text: str) -> str:
    return text[1:-1] if text[0] in "'\"" else text


def in_words(text: str) -> str:
    """The same message with calls for options of the command line.

    >>> in_words("expected 0; `--set bearings.main.shell_surface=rigid` for rigid surfaces")
    "expected 0; model['bearings.main.shell_surface'] = 'rigid' for rigid surfaces"
    >>> in_words("--speed with --load or --eccentricity-ratio; 'hersey bearing' solves bearings by themselves")
    'speed with load or eccentricity_ratio; model.bearing() solves bearings by themselves'
    """
    for pattern, replacement in _RULES:
        text = pattern.sub(replacement, text)
    return text


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """ "; did you mean 'width'?", or nothing where nothing is near."""
    near = difflib.get_close_matches(str(name), list(known), 1)
    return f"; did you mean {near[0]!r}?" if near else ""
