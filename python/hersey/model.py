"""A model file in hand: read, changed, solved, run."""

from __future__ import annotations

import itertools
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Callable, Iterable, Optional, Sequence, Union

from . import _core
from .bearing import BearingSolution, solved
from .errors import Fault, InputError, Stopped
from .functions import Function
from .names import BearingNames
from .overrides import assignments, give_study_units, give_units, has_numbers, listed, plain, value_of, with_unit, yaml_of
from .running import run
from .sweep import sweep
from .words import did_you_mean

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

    def __init__(self, checked: "_core.Session", solver: Optional["_core.BearingSolver"] = None,
                 is_dictionary: bool = False):
        self._checked = checked
        self._solver = solver or _core.BearingSolver()  # knows the bodies it has observed
        self._functions: dict[str, Function] = {}
        self._is_dictionary = is_dictionary  # no file: messages name keys, not lines

    # Where models come from

    @classmethod
    def load(cls, path: PathLike, **values: Any) -> "Model":
        """Reads a model file; `values` replace parameters ("load", "500 N") as `set` does.

        Raises `InputError` with every fault of the file.
        """
        file, given = os.fspath(path), {name: plain(value) for name, value in values.items()}
        return cls(_in_si(lambda: _core.read_file(file, assignments(given)), given,
                          lambda: _core.bare_numbers(Path(file).read_text(encoding="utf-8"), file, assignments(given))))

    @classmethod
    def from_text(cls, text: str, file: PathLike = "model.yaml") -> "Model":
        """A model from YAML; `file` names it in messages and is where tables and meshes are sought beside."""
        return cls(_core.read_text(text, os.fspath(file), []))

    @classmethod
    def from_dict(cls, content: Mapping[str, Any], folder: PathLike = ".") -> "Model":
        """A model from nested mappings with the keys of a model file; `folder` is where tables and meshes are sought.

        Values are as `set` takes them: numbers are SI. Messages name keys.
        """
        file, values = os.fspath(Path(folder) / "dictionary"), {"": {"hersey": 1, **plain(content)}}

        def text() -> str:
            return json.dumps(values[""], indent=2, ensure_ascii=False)

        parameters = values[""].get("parameters")
        give_study_units(values, lambda name, items: _in_unit_of(_path_among(parameters, name), items, text(), file, []))
        try:
            checked = _in_si(lambda: _core.read_text(text(), file, []), values, lambda: _core.bare_numbers(text(), file, []))
        except InputError as error:
            raise error.of_dictionary(file) from None
        return cls(checked, is_dictionary=True)

    def copy(self) -> "Model":
        """Another model with the same values; changing one leaves the other."""
        return self._as(self._checked)

    def __copy__(self) -> "Model":
        return self.copy()

    def __deepcopy__(self, memo: dict[int, Any]) -> "Model":
        return self.copy()

    def __reduce__(self):
        return _from_parts, (self.text, self.file, self.changes, self._functions, self._is_dictionary)

    def __eq__(self, other: object) -> bool:
        """Whether both say the same: every value as written, changes in place, and the folder they look for files in."""
        if not isinstance(other, Model):
            return NotImplemented
        return (self.to_dict() == other.to_dict() and self._functions == other._functions
                and Path(self.file).absolute().parent == Path(other.file).absolute().parent)

    __hash__ = None  # type: ignore[assignment]  # it can be changed

    def _as(self, checked: "_core.Session") -> "Model":
        model = Model(checked, self._solver, self._is_dictionary)
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
        try:
            written = _core.written_json(self.text, self.file, self.changes, self._path(path))
        except InputError as error:
            raise self._located(error.hinting(lambda _: did_you_mean(path, self._parameters()))) from None
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

        Values are texts with units ("40 um"), pairs `(40, "um")`, quantities of pint's, numbers, which are SI where a unit
        is due, lists, arrays, mappings; `None` is the word none; where an expression may stand a `Function`, Python's own.
        Raises `InputError` with file, line and key, and leaves the model as it was.
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
        return _path_among(self._parameters(), path)

    def _parameters(self) -> dict[str, Any]:
        """Those of the file."""
        written = json.loads(_core.written_json(self.text, self.file, [], ""))
        return (written or {}).get("parameters") or {}

    def _with(self, values: Mapping[str, Any]) -> "_core.Session":
        if not values:
            return self._checked
        kept = [change for change in self._checked.overrides if change.partition("=")[0] not in values]
        given = {path: plain(value) for path, value in values.items()}
        give_study_units(given, lambda name, items: _in_unit_of(self._path(name), items, self.text, self.file, kept))
        return _in_si(lambda: self._read(kept + assignments(given)), given,
                      lambda: _core.bare_numbers(self.text, self.file, kept + assignments(given)))

    def _read(self, overrides: list[str]) -> "_core.Session":
        try:
            return _core.read_text(self.text, self.file, overrides)
        except InputError as error:
            raise self._located(error) from None

    def _located(self, error: InputError) -> InputError:
        """The error with the places of the model's file; those of a dictionary are its keys."""
        return error.of_dictionary(self.file) if self._is_dictionary else error.at(self._checked.position_of)

    @property
    def _name(self) -> str:
        """What messages begin with."""
        return "the model" if self._is_dictionary else self.file

    def __repr__(self) -> str:
        changed = f", {len(self.changes)} values changed" if self.changes else ""
        return f"<Model {self.file}: {self.title or 'without title'}{changed}>"

    # A bearing by itself

    def bearing(self, name: Optional[str] = None, *, grid_error: bool = True, thermal_coefficients: str = "frozen",
                sensitivity: bool = False, sensitivity_to: Union[str, Sequence[str]] = (), **values: Any) -> BearingSolution:
        """Solves one bearing by itself at its operating point, which `values` may change for this once.

        `values` are parameters, the bearing's own keys (`width="20 mm"`), those of its operating point (`load="2 kN"`,
        `speed="3000 rpm"`), `viscosity`, and `clearance` of a journal; for other keys copy and `set` the model. They are as
        `set` takes them. A load takes the place of a position (the `eccentricity_ratio` of a journal, the `film_thickness`
        of a plane slider) and the other way round.

        `sensitivity` asks for the derivatives of every figure by what decides about a bearing, `sensitivity_to` by any
        numbers of the model, named as `values` are or by key paths: `BearingSolution.sensitivities` and `gradient`.

        `grid_error` estimates the error of the grid by two coarser ones; `thermal_coefficients="total"` lets
        temperatures follow the motion in stiffness and damping. Raises `SolutionError` where there is no solution.
        """
        _require_coefficients(thermal_coefficients)
        name = self._bearing_called(name)
        keys = [sensitivity_to] if isinstance(sensitivity_to, str) else list(sensitivity_to)
        try:
            checked = self._with(self._keys(name, values)) if values else self._checked
            found = self._solver.solve(checked, name, grid_error, thermal_coefficients)
            solution = solved(found)
            if sensitivity or keys:
                paths = [self._path(next(iter(self._keys(name, {key: None})))) if "." not in key else key for key in keys]
                solution.take(_core.sensitivities(checked, found, name, thermal_coefficients, sensitivity, paths))
        except InputError as error:
            raise self._located(self._hinting(error, name, [*values, *keys])) from None
        return solution

    def sweep(self, name: Optional[str] = None, *, grid_error: bool = True, thermal_coefficients: str = "frozen",
              threads: int = 0, **values: Any) -> "Any":
        """Solves one bearing at all combinations of `values`, several at a time, as an `xarray.Dataset`.

        Each of `values` is a list or an array, named as in `bearing`: texts with units, numbers, which are SI, or a pair
        `(numbers, "unit")`. Its numbers become the coordinate of a dimension of that name; every figure becomes a
        variable in SI with `units` and `long_name`. Where there is no solution figures are NaN and the variable `error`
        says why. A list without values gives a data set without points.

        Ctrl-C ends it when the points under way are done and raises `Stopped`, whose `results` have all that are.
        """
        _require_coefficients(thermal_coefficients)
        name = self._bearing_called(name)
        lists = {given: listed(items) for given, items in values.items()}
        if not all(lists.values()):
            self._require_names(name, lists)
            return sweep(lists, [], _core.figure_keys(self._names(name).kind))
        try:
            base, lists, combinations = self._combinations(name, lists)
            found, raised = _core.solve_all(base, combinations, name, grid_error, thermal_coefficients, threads)
        except InputError as error:
            raise self._located(self._hinting(error, name, values)) from None
        results = sweep(lists, found)
        if isinstance(raised, KeyboardInterrupt):
            done = sum(solution.error != _core.not_begun for solution in found)
            raise Stopped(f"stopped with {done} of {len(found)} points done", results) from None
        if raised is not None:
            raise raised
        return results

    def _require_names(self, name: str, names: Iterable[str]) -> None:
        """That each of `names` is one of the bearing's, of which a list without values says nothing else."""
        for given in names:
            try:
                self._with(self._keys(name, {given: "?"}))  # of what kind a value has to be does not matter here
            except InputError as error:
                if any(_is_unknown(fault, given) for fault in error.faults):
                    raise self._located(self._hinting(error, name, [given])) from None

    def _combinations(self, name: str, lists: Mapping[str, list[Any]]):
        """The model at the first values, the lists with units, and of each combination label, changes, and texts."""
        paths = {given: next(iter(self._keys(name, {given: None}))) for given in lists}
        fixed = {given: items[0] for given, items in lists.items()}
        others = {path: value for path, value in self._keys(name, fixed).items() if path not in paths.values()}
        united = {given: self._with_units(paths[given], items, others) if has_numbers(items) else items
                  for given, items in lists.items()}
        base = self._with({**others, **{paths[given]: items[0] for given, items in united.items()}})
        combinations = []
        for chosen in itertools.product(*united.values()):
            texts = [yaml_of(value) for value in chosen]
            label = ", ".join(f"{given} = {text}" for given, text in zip(lists, texts))
            changes = [f"{path}={text}" for path, text in zip(paths.values(), texts)]
            combinations.append((label, base.overrides + changes, texts))
        return base, united, combinations

    def _with_units(self, path: str, items: list[Any], others: Mapping[str, Any]) -> list[Any]:
        """Items with the SI unit of `path` behind bare numbers, where `others` are changed as well."""
        kept = [change for change in self.changes if change.partition("=")[0] not in others]
        return _in_unit_of(path, items, self.text, self.file, kept + assignments(others))

    def _hinting(self, error: InputError, name: str, given: Iterable[str]) -> InputError:
        """With the nearest name for what is no key of the bearing: of parameters, of its operating point, of options."""
        known = [*self._parameters(), *self._names(name).known, *_OPTIONS]

        def hint(fault: Fault) -> str:
            for key in given:
                if _is_unknown(fault, key):
                    return "" if key in known else did_you_mean(key, known)
            return ""

        return error.hinting(hint)

    def _bearing_called(self, name: Optional[str]) -> str:
        if name is None and len(self.bearings) == 1:
            return self.bearings[0]
        if name not in self.bearings:
            raise InputError(f"{self._name}: no bearing {name!r}{did_you_mean(name, self.bearings)}: expected one of "
                             f"{', '.join(self.bearings) or 'none'}" if name is not None else
                             f"{self._name}: several bearings: expected the name of one, {', '.join(self.bearings)}")
        return name

    def _keys(self, name: str, values: Mapping[str, Any]) -> dict[str, Any]:
        """Key paths of what `values` name, and of what they take the place of."""
        written = json.loads(_core.written_json(self.text, self.file, self.changes, ""))
        parameters, point = written.get("parameters") or {}, written["bearings"][name].get("operating_point") or {}
        names = self._names(name)
        found = {key if key in parameters else names.path_of(key): value for key, value in values.items()}
        for given, other in (names.load_or_position, names.load_or_position[::-1]):
            if given and names.path_of(given) in found and given in values and other not in values and other in point:
                found[names.path_of(other)] = None
        return found

    def _names(self, name: str) -> BearingNames:
        return BearingNames(self._checked.names_of(name), name)

    # A machine in motion

    def check(self) -> list[str]:
        """Builds the machine and finds its start, as a run does first: what the user should know though it runs."""
        try:
            return self._runnable()[0].check()
        except InputError as error:
            raise self._located(error) from None

    def runs(self) -> list["Model"]:
        """A model for each combination of the file's study; the model itself where it has none."""
        try:
            runs = self._checked.runs() or [self.changes]
        except InputError as error:
            raise self._located(error) from None
        return [self._as(self._read(changes)) for changes in runs]

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
        return run(self, output, overwrite=overwrite, resume=resume, step_error=step_error, progress=progress)


_OPTIONS = ("grid_error", "thermal_coefficients", "sensitivity", "sensitivity_to", "threads")


def _require_coefficients(name: str) -> None:
    if name not in ("frozen", "total"):
        raise InputError(f"thermal_coefficients: {name!r}: expected 'frozen' or 'total'")


def _is_unknown(fault: Fault, key: str) -> bool:
    """Whether there is no such key."""
    return fault.found == f"unknown key '{key}'" or fault.found.endswith(f".{key}'")


def _path_among(parameters: Any, name: str) -> str:
    """A parameter's name stands for its value."""
    return f"parameters.{name}" if isinstance(parameters, Mapping) and name in parameters else name


def _in_unit_of(path: str, items: list[Any], text: str, file: str, changes: list[str]) -> list[Any]:
    """Items with the SI unit of `path` behind bare numbers, which the first that is not 0 tells: a 0 needs none."""
    numbers = [item for item in items if has_numbers(item) and item != 0]
    if not numbers:
        return items
    given = {path: numbers[0]}
    if not give_units(given, _core.bare_numbers(text, file, changes + assignments(given))):
        return items
    unit = given[path].split(" ", 1)[1]
    return [with_unit(item, unit) if has_numbers(item) else item for item in items]


def _in_si(read: Callable[[], Any], values: dict[str, Any], bare: Callable[[], Any]) -> Any:
    """What `read` gives of `values`, whose bare numbers become SI quantities where `bare` tells that they lack a unit."""
    while True:
        try:
            return read()
        except InputError:
            if not has_numbers(values) or not give_units(values, bare()):
                raise


def _from_parts(text: str, file: str, changes: list[str], functions: dict[str, Function], is_dictionary: bool) -> Model:
    """A model as `pickle` has kept it."""
    model = Model(_core.read_text(text, file, changes), is_dictionary=is_dictionary)
    model._functions = dict(functions)
    return model


def _with_functions(checked: "_core.Session", functions: Mapping[str, Function]):
    return _core.with_functions(checked, [(path, each.function, each.derivative, len(each.variables))
                                          for path, each in functions.items()])
