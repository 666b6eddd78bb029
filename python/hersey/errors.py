"""What can go wrong, as exceptions."""

from __future__ import annotations

import re
from typing import Callable, NamedTuple, Optional, Sequence

from .words import in_words


class HerseyError(RuntimeError):
    """Something went wrong in the solver; all exceptions of this package but `Stopped` are of this kind."""


class Fault(NamedTuple):
    """One thing wrong with the user's input."""

    file: str  #: the model or table it stands in; empty where there is none: of a dictionary, or of a value assigned
    line: int  #: from 1; 0: unknown
    column: int  #: from 1; 0: unknown
    key: str  #: key path, "bearings.big_end.diameter"; may be empty
    found: str  #: what stands there
    expected: str  #: what is allowed
    suggestion: str  #: nearest valid name or remedy; may be empty
    text: str  #: all of it in one sentence


class InputError(HerseyError, ValueError):
    """The model, or what was asked of it, is wrong. Carries every fault found, in the order they stand in the file.

    `file`, `line`, `column` and `key` are those of the first fault.
    """

    def __init__(self, message: str, faults: Sequence[tuple] = ()):
        self.faults = [_in_words(Fault(*fault)) for fault in faults]
        super().__init__("\n".join(fault.text for fault in self.faults) if self.faults else in_words(message))

    @property
    def file(self) -> str:
        return self.faults[0].file if self.faults else ""

    @property
    def line(self) -> int:
        return self.faults[0].line if self.faults else 0

    @property
    def column(self) -> int:
        return self.faults[0].column if self.faults else 0

    @property
    def key(self) -> str:
        return self.faults[0].key if self.faults else ""

    def at(self, positions: Callable[[str], tuple[str, int, int]]) -> "InputError":
        """The same with the places in the file of keys whose values were assigned from Python.

        `positions` gives (file, line, column) of a key path.
        """
        return self._with([_placed(fault, positions) for fault in self.faults])

    def of_dictionary(self, file: str) -> "InputError":
        """The same without lines of a file that is none: keys tell where things stand in a dictionary."""
        return self._with([_without_file(fault, file) for fault in self.faults])

    def hinting(self, hint: Callable[[Fault], str]) -> "InputError":
        """The same with a remedy, "did you mean ...?", for faults that have none."""
        faults = []
        for fault in self.faults:
            found = "" if fault.suggestion else hint(fault)
            if found:
                text = fault.text.replace(fault.found, fault.found + found, 1).replace(f"{found}; ", f"{found} ", 1)
                fault = fault._replace(suggestion=found.removeprefix("; "), text=text)
            faults.append(fault)
        return self._with(faults)

    def _with(self, faults: Sequence[Fault]) -> "InputError":
        return InputError("\n".join(fault.text for fault in faults), faults) if faults else self


_ASSIGNED = "assigned: "


def _in_words(fault: Fault) -> Fault:
    """What was assigned or given by name has no file: it says so in the text."""
    text = fault.text
    if fault.file.startswith("--"):
        text = text.removeprefix(fault.file + ": ")
        text = (_ASSIGNED if fault.file == "--set" else in_words(fault.file) + ": ") + text
    return fault._replace(file="" if fault.file.startswith("--") else fault.file, found=in_words(fault.found),
                          expected=in_words(fault.expected), suggestion=in_words(fault.suggestion), text=in_words(text))


def _placed(fault: Fault, positions: Callable[[str], tuple[str, int, int]]) -> Fault:
    if fault.file or not fault.text.startswith(_ASSIGNED):
        return fault
    file, line, column = positions(fault.key)
    place = ":".join(str(part) for part in (file, line, column) if part)
    return fault._replace(file=file, line=line, column=column, text=f"{place}: {fault.text}")


def _without_file(fault: Fault, file: str) -> Fault:
    if fault.file not in ("", file):
        return fault
    text = re.sub(rf"^{re.escape(file)}:(\d+:)*(\d+:)? ", "", fault.text).removeprefix(_ASSIGNED)
    parts = [re.sub(r"(parameter \w+) in line \d+", r"\1", part) for part in (fault.found, fault.expected, fault.suggestion, text)]
    found, expected, suggestion, text = parts
    return fault._replace(file="", line=0, column=0, found=found, expected=expected, suggestion=suggestion, text=text)


class SolutionError(HerseyError):
    """A steady bearing has no solution that could be found; the message says why."""


class RunError(HerseyError):
    """A run ended early by itself: no convergence at the smallest step, or results that could not be written.

    `results` has everything up to then, `summary` how far it came; `message` says why it ended.
    """

    def __init__(self, message: str, results=None, summary=None):
        super().__init__(message)
        self.message, self.results, self.summary = message, results, summary


class UserFunctionError(HerseyError):
    """A function given from Python raised, or gave something that is no finite number.

    `name` is the key path it was given for, `t` the time of the run [s] it had come to, `results` what was written
    until then; the exception it raised, if it raised one, is the `__cause__`.
    """

    def __init__(self, message: str, name: str = "", t: Optional[float] = None, results=None):
        super().__init__(message)
        self.name, self.t, self.results = name, t, results


class Stopped(KeyboardInterrupt):
    """Ctrl-C ended a run after its current step. `results` and `summary` have everything up to then.

    `model.run(output, resume=True)` goes on from there.
    """

    def __init__(self, message: str, results=None, summary=None):
        super().__init__(message)
        self.results, self.summary = results, summary
