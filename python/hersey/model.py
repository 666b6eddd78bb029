"""A model file in hand: read, changed, solved, run."""

from __future__ import annotations

import itertools
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Callable, Optional, Union

from . import _core
from .bearing import BearingSolution, solved
from .errors import InputError
from .functions import Function
from .overrides import assignment, plain, value_of, yaml_of

PathLike = Union[str, "os.PathLike[str]"]


class Model:
    """A model as checked by the strict reader of `hersey check`; every value in it can be read and replaced.

    >>> model = Model.from_dict({"lubricants": {"oil": {"viscosity": "15 mPa.s"}},
    ...     "bearings": {"main": {"diameter": "45 mm", "width": "15.6 mm", "radial_clearance": "34 um",
    ...                           "lubricant": "oil",
    ...                           "operating_point": {"journal_speed": "3570 rpm", "load": "2500 N"}}}})
    >>> model["bearings.main.radial_clearance"] = "40 um"
    >>> model["bearings.main.radial_clearance"]
    '40 um'
    >>> model["bearings.main.radial_clearance"] = "40 kPa"
    Traceback (most recent call last):
    hersey.errors.InputError: ...
    """

    def __init__(self, checked: "_core.CheckedModel", solver: Optional["_core.BearingSolver"] = None):
        self._checked = checked
        self._solver = solver or _core.BearingSolver()  # knows the bodies it has seen
        self._functions: dict[str, Function] = {}

    # Where models come from

    @classmethod
    def load(cls, path: PathLike, **values: Any) -> "Model":
        """Reads a model file; `values` replace parameters ("load", "500 N") as `set` does.

        Raises `InputError` with every fault of the file.
        """
        return cls(_core.read_file(os.fspath(path), [assignment(name, value) for name, value in values.items()]))

    @classmethod
    def from_text(cls, text: str, file: PathLike = "model.yaml") -> "Model":
        """A model from YAML; `file` names it in messages and is where tables and meshes are sought beside."""
        return cls(_core.read_text(text, os.fspath(file), []))

    @classmethod
    def from_dict(cls, content: Mapping[str, Any], folder: PathLike = ".") -> "Model":
        """A model from nested mappings with the keys of a model file; `folder` is where tables and meshes are sought.

        Lines in messages are those of `text`.
        """
        content = {"hersey": 1, **plain(content)}
        return cls.from_text(json.dumps(content, indent=2, ensure_ascii=False), Path(folder) / "dictionary")

    def copy(self) -> "Model":
        """Another model with the same values; changing one leaves the other."""
        return self._as(self._checked)

    def _as(self, checked: "_core.CheckedModel") -> "Model":
        model = Model(checked, self._solver)
        model._functions = dict(self._functions)
        return model

    # What stands in it

    @property
    def file(self) -> str:
        return self._checked.file

    @property
    def title(self) -> str:
        return self._checked.title

    @property
    def description(self) -> str:
        return self._checked.description

    @property
    def text(self) -> str:
        """The model file as it was read."""
        return self._checked.text

    @property
    def changes(self) -> list[str]:
        """What was assigned since, as `hersey run --set` takes it."""
        return list(self._checked.overrides)

    @property
    def bearings(self) -> list[str]:
        """Names of the bearings."""
        return self._checked.bearings

    @property
    def warnings(self) -> list[str]:
        """What can be computed but is hardly meant."""
        return self._checked.warnings

    @property
    def study(self) -> dict[str, list[str]]:
        """Parameters that the file's study varies, with their values as written."""
        return dict(self._checked.study)

    def to_dict(self) -> dict[str, Any]:
        """All of the model as written, changes in place."""
        return self[""]

    def __getitem__(self, path: str) -> Any:
        """The value at a key path or of a parameter, as written ("40 um"); numbers without unit as numbers.

        A key that the file leaves to its default is not there: `InputError` names those that are.
        """
        written = _core.written_json(self.text, self.file, self.changes, self._path(path))
        return value_of(json.loads(written))

    def __setitem__(self, path: str, value: Any) -> None:
        """Replaces the value at a key path or of a parameter and checks the whole model again; see `set`."""
        self.set({path: value})

    def __contains__(self, path: str) -> bool:
        try:
            self[path]
        except InputError:
            return False
        return True

    def get(self, path: str, default: Any = None) -> Any:
        """The value at a key path, or `default` where the file has none."""
        return self[path] if path in self else default

    def set(self, values: Optional[Mapping[str, Any]] = None, **named: Any) -> "Model":
        """Replaces several values at once, which may be wrong one by one: a load for an eccentricity, say.

        Values are texts with units, numbers where no unit is due, lists, mappings; `None` is the word none; where an
        expression may stand a `Function`, Python's own. Raises
        `InputError` with file, line and key, and leaves the model as it was.
        """
        values = {**(values or {}), **named}
        given = {path: value for path, value in values.items() if isinstance(value, Function)}
        stand_ins = {path: function.stand_in() for path, function in given.items()}
        checked = self._with({**values, **stand_ins})
        kept = {path: function for path, function in self._functions.items() if path not in values}
        functions = {**kept, **given}
        if given:
            _with_functions(checked, functions)  # each has its place
        self._checked, self._functions = checked, functions
        return self

    def _runnable(self):
        """The model with Python's functions in place, and their counters."""
        return _with_functions(self._checked, self._functions) if self._functions else (self._checked, [])

    def _path(self, path: str) -> str:
        """A parameter's name stands for its value, as with --set."""
        parameters = json.loads(_core.written_json(self.text, self.file, [], ""))
        return f"parameters.{path}" if path in (parameters or {}).get("parameters", {}) else path

    def _with(self, values: Mapping[str, Any]) -> "_core.CheckedModel":
        if not values:
            return self._checked
        kept = [change for change in self._checked.overrides if change.partition("=")[0] not in values]
        return self._read(kept + [assignment(path, value) for path, value in values.items()])

    def _read(self, overrides: list[str]) -> "_core.CheckedModel":
        try:
            return _core.read_text(self.text, self.file, overrides)
        except InputError as error:
            raise error.at(self._checked.position_of) from None

    def __repr__(self) -> str:
        changed = f", {len(self.changes)} values changed" if self.changes else ""
        return f"<Model {self.file}: {self.title or 'without title'}{changed}>"

    # A bearing by itself

    def bearing(self, name: Optional[str] = None, *, grid_error: bool = True, thermal_coefficients: str = "frozen",
                **values: Any) -> BearingSolution:
        """Solves one bearing by itself at its operating point, which `values` may change for this once.

        `values` are parameters, the bearing's own keys (`width="20 mm"`), those of its operating point (`load="2 kN"`,
        `speed="3000 rpm"`) and `clearance` and `viscosity`; for other keys copy and `set` the model. A load takes the
        place of an eccentricity and the other way round.

        `grid_error` estimates the error of the grid by two coarser ones; `thermal_coefficients="total"` lets
        temperatures follow the motion in stiffness and damping. Raises `SolutionError` where there is no solution.
        """
        _require_coefficients(thermal_coefficients)
        name = self._bearing_called(name)
        checked = self._with(self._keys(name, values)) if values else self._checked
        return solved(self._solver.solve(checked, name, grid_error, thermal_coefficients))

    def sweep(self, name: Optional[str] = None, *, grid_error: bool = True, thermal_coefficients: str = "frozen",
              threads: int = 0, **values: Any) -> "Any":
        """Solves one bearing at all combinations of `values`, several at a time, as an `xarray.Dataset`.

        Each of `values` is a list, named as in `bearing`. Its numbers become the coordinate of a dimension of that
        name; every figure becomes a variable in SI with `units` and `long_name`. Where there is no solution figures
        are NaN and the variable `error` says why.
        """
        from .sweep import sweep

        _require_coefficients(thermal_coefficients)
        name = self._bearing_called(name)
        paths = {given: next(iter(self._keys(name, {given: None}))) for given in values}
        fixed = {given: list(items)[0] for given, items in values.items()}
        others = {path: value for path, value in self._keys(name, fixed).items() if path not in paths.values()}
        base = self._with({**others, **{paths[given]: value for given, value in fixed.items()}})
        combinations = []
        for chosen in itertools.product(*values.values()):
            texts = [yaml_of(value) for value in chosen]
            label = ", ".join(f"{given} = {text}" for given, text in zip(values, texts))
            changes = [f"{path}={text}" for path, text in zip(paths.values(), texts)]
            combinations.append((label, base.overrides + changes, texts))
        found = _core.solve_all(base, combinations, name, grid_error, thermal_coefficients, threads)
        return sweep(values, found)

    def _bearing_called(self, name: Optional[str]) -> str:
        if name is None and len(self.bearings) == 1:
            return self.bearings[0]
        if name not in self.bearings:
            raise InputError(f"{self.file}: no bearing {name!r}: expected one of {', '.join(self.bearings) or 'none'}"
                             if name is not None else
                             f"{self.file}: several bearings: expected the name of one, {', '.join(self.bearings)}")
        return name

    def _keys(self, name: str, values: Mapping[str, Any]) -> dict[str, Any]:
        """Key paths of what `values` name, and of what they take the place of."""
        written = json.loads(_core.written_json(self.text, self.file, self.changes, ""))
        parameters, here = written.get("parameters") or {}, written["bearings"][name]
        point = here.get("operating_point") or {}
        path = f"bearings.{name}."
        short = {"speed": path + "operating_point.journal_speed",
                 "clearance": path + ("diametral_clearance" if "diametral_clearance" in here else "radial_clearance"),
                 "viscosity": f"lubricants.{self._checked.lubricant_of(name)}.viscosity"}
        found: dict[str, Any] = {}
        for key, value in values.items():
            if key in parameters:
                found[key] = value
            elif key in short:
                found[short[key]] = value
            elif key in _POINT:
                found[f"{path}operating_point.{key}"] = value
            else:
                found[path + key] = value
        for given, other in (("load", "eccentricity_ratio"), ("eccentricity_ratio", "load")):
            if f"{path}operating_point.{given}" in found and given in values and other not in values and other in point:
                found[f"{path}operating_point.{other}"] = None
        return found

    # A machine in motion

    def check(self) -> list[str]:
        """Builds the machine and finds its start, as a run does first: what the user should know though it runs."""
        return self._runnable()[0].check()

    def runs(self) -> list["Model"]:
        """A model for each combination of the file's study; the model itself where it has none."""
        models = []
        varied = {name: texts for name, texts in self.study.items()
                  if not any(change.startswith(name + "=") for change in self.changes)}
        for chosen in itertools.product(*varied.values()):
            changes = self.changes + [f"{name}={text}" for name, text in zip(varied, chosen)]
            models.append(self._as(self._read(changes)))
        return models

    def run(self, output: Optional[PathLike] = None, *, overwrite: bool = False, resume: bool = False,
            step_error: bool = False, progress: Union[bool, Callable[["_core.Progress"], Any]] = False):
        """Simulates the model and returns its `Results`.

        `output` is the folder of `results.h5`, or the file itself (`*.h5`); results/NAME where it is left out, as with
        `hersey run`. An existing file is kept (`FileExistsError`) unless `overwrite`; `resume` goes on where a run was
        interrupted. `progress=True` shows how far it has come, by tqdm where that is installed; a function is called
        with a `Progress` after every step.

        The interpreter is free for other threads meanwhile. Ctrl-C ends the run after its step and raises `Stopped`, a
        run that fails raises `RunError`: both have the results so far. A study is several models: see `runs`.
        """
        from .running import run

        return run(self, output, overwrite=overwrite, resume=resume, step_error=step_error, progress=progress)


_POINT = ("journal_speed", "shell_speed", "load", "load_angle", "eccentricity_ratio", "eccentricity_angle",
          "radial_velocity", "journal_angle")


def _require_coefficients(name: str) -> None:
    if name not in ("frozen", "total"):
        raise InputError(f"thermal_coefficients: {name!r}: expected 'frozen' or 'total'")


def _with_functions(checked: "_core.CheckedModel", functions: Mapping[str, Function]):
    return _core.with_functions(checked, [(path, each.function, each.derivative, len(each.variables))
                                          for path, each in functions.items()])
