"""What can go wrong, as exceptions."""

from __future__ import annotations

from typing import NamedTuple, Optional, Sequence


class HerseyError(RuntimeError):
    """Something went wrong in the solver; all exceptions of this package but `Stopped` are of this kind."""


class Fault(NamedTuple):
    """One thing wrong with the user's input."""

    file: str  #: the model or table it stands in; "--set" where the value was assigned
    line: int  #: from 1; 0: unknown
    column: int  #: from 1; 0: unknown
    key: str  #: key path, "bearings.big_end.diameter"; may be empty
    found: str  #: what stands there
    expected: str  #: what is allowed
    suggestion: str  #: nearest valid name or remedy; may be empty
    text: str  #: all of it in one sentence, as the program tells it


class InputError(HerseyError, ValueError):
    """The model, or what was asked of it, is wrong. Carries every fault found, in the order they stand in the file.

    `file`, `line`, `column` and `key` are those of the first fault.
    """

    def __init__(self, message: str, faults: Sequence[tuple] = ()):
        super().__init__(message)
        self.faults = [Fault(*fault) for fault in faults]

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

    def at(self, positions) -> "InputError":
        """The same with the places in the file of keys whose values were assigned from Python.

        `positions` gives (file, line, column) of a key path.
        """
        faults = []
        for fault in self.faults:
            if fault.file == "--set":
                file, line, column = positions(fault.key)
                text = fault.text.removeprefix("--set: ")
                fault = fault._replace(file=file, line=line, column=column, text=f"{file}:{line}:{column}: assigned: {text}")
            faults.append(fault)
        return InputError("\n".join(fault.text for fault in faults), faults)


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
