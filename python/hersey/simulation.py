"""A machine stepped from Python: for control, co-simulation, and programs that decide as they go."""

from __future__ import annotations

import json
import os
from typing import Any, NamedTuple, Optional, Union

from . import _core
from .errors import InputError, RunError
from .functions import cost_of, raise_fault_of
from .overrides import to_si
from .results import Results, Summary
from .running import require_one_run, results_file
from .words import did_you_mean


class Port(NamedTuple):
    """What can be set, or read, between two steps."""

    name: str  #: of an input its key path in the model, of an output its path in the results with dots
    unit: str  #: SI; "1" for a pure number
    text: str  #: what it is
    shape: tuple[int, ...] = ()  #: (): one number
    components: tuple[str, ...] = ()  #: of one dimension, where they have names: "x", "y", "z"


class Simulation:
    """A model on its way through time; takes the steps of `hersey run`, to the last bit where no input is set.

    >>> sim = Simulation(model)                                     # doctest: +SKIP
    >>> while sim.step():                                           # doctest: +SKIP
    ...     sim["forces.push.components.y"] = -500 - 1e7 * sim["bearings.main.h_min"]

    Reading is by the names of `outputs`, setting by those of `inputs`: loads, drives and supply pressures that the model
    gives as a number or as a function. One that is set keeps its value until it is set again or released; a changed force
    or speed is a jump in time. Numbers are SI; a text with a unit is converted.

    Without `output` nothing is written; with it, results as `Model.run` writes them, whole after `finish()`, which
    leaving a `with` block does as well. Other threads run during a step; Ctrl-C is heard between two calls.
    """

    def __init__(self, model: Any, output: Optional[Any] = None, *, overwrite: bool = False):
        """`model` is a `Model`; what is done to it afterwards changes nothing here.

        `output` is a folder or an .h5 file. Raises `InputError` where the model cannot start, `FileExistsError`.
        """
        require_one_run(model)
        self._file = None if output is None else results_file(model, output)
        checked, self._calls = model._runnable()
        try:
            self._core = _core.Simulation(checked, "" if self._file is None else os.fspath(self._file), overwrite)
        except RuntimeError as error:
            raise_fault_of(self._calls, 0.0, None)
            if isinstance(error, InputError):
                raise model._located(error) from None
            raise
        self.inputs = {name: Port(name, unit, text) for name, unit, text, _ in self._core.inputs()}
        self.outputs = {name: Port(name, unit, text, tuple(shape), tuple(components))
                        for name, unit, text, shape, components in self._core.outputs()}
        self._places = {name: place for place, name in enumerate(self.outputs)}
        self.message = ""  #: why it ended

    @property
    def time(self) -> float:
        """Of the last accepted step [s]."""
        return self._core.time

    @property
    def start(self) -> float:
        """Where it began [s]."""
        return self._core.start

    @property
    def end(self) -> float:
        """Start plus the model's `simulation.duration` [s]."""
        return self._core.end

    def step(self) -> bool:
        """One step of the solver; False where there is none any more, `message` says why.

        Raises `RunError` where no step can be found; `time` is then that of the last good one.
        """
        return self._advanced(*self._core.step())

    def advance_to(self, t: Any) -> bool:
        """As many steps as it takes to be at `t` exactly, a number [s] or a quantity; False where the run ended before."""
        t = to_si(t, "s")
        if not t >= self.time:
            raise InputError(f"advance_to({t!r}): expected a time not before {self.time!r} s")
        return self._advanced(*self._core.advance_to(t))

    def _advanced(self, status: str, message: str) -> bool:
        self.message = message
        if status == "failed":
            results = None if self._file is None else self.finish()
            raise_fault_of(self._calls, self.time, results)
            raise RunError(f"{message}; t = {self.time:.6g} s", results, self.summary)
        return status == "advanced"

    def __getitem__(self, name: str) -> Any:
        """The output `name` at `time` [SI]: a float, or an array of the shape that `outputs` tells."""
        _require(name, self.outputs, "output")
        values = self._core.output(self._places[name])
        return values if values.ndim else float(values)

    def __setitem__(self, name: str, value: Any) -> None:
        """Holds the input `name` at `value` from now on: a number [SI], a text with unit, `(value, "unit")`, one of pint's."""
        _require(name, self.inputs, "input")
        self._core.set(name, to_si(value, self.inputs[name].unit))

    def input(self, name: str) -> float:
        """The value that an input has now [SI]."""
        _require(name, self.inputs, "input")
        return self._core.input(name)

    def release(self, name: str) -> None:
        """Gives an input back to the model."""
        _require(name, self.inputs, "input")
        self._core.release(name)

    def save(self) -> "_core.SavedState":
        """State and inputs, in memory: going on from it gives the same bits."""
        return self._core.save()

    def restore(self, state: "_core.SavedState") -> None:
        """Goes back, or on, to what `save` gave, also that of another simulation of the same model; without results only."""
        self._core.restore(state)
        self.message = ""

    @property
    def summary(self) -> Summary:
        """The figures of all steps so far."""
        return self._summary_of(self._core.summary_json())

    def _summary_of(self, text: str) -> Summary:
        content = json.loads(text)
        if self._calls:
            content["functions"] = cost_of(self._calls)
        return Summary(content)

    def finish(self) -> Union[Results, Summary]:
        """Closes the results; no step follows. The `Results`, or without a file the summary."""
        summary = self._summary_of(self._core.finish_json())
        return summary if self._file is None else Results(self._file, summary=summary)

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(self, *_: Any) -> None:
        self.finish()

    def __repr__(self) -> str:
        return f"<Simulation: t = {self.time:.6g} s of {self.end:.6g} s, {len(self.inputs)} inputs, {len(self.outputs)} outputs>"


def _require(name: str, known: dict[str, Port], kind: str) -> None:
    if name in known:
        return
    raise InputError(f"{name!r}: unknown {kind}{did_you_mean(name, known) or ';'} Simulation.{kind}s has them all")


__all__ = ["Port", "Simulation"]
