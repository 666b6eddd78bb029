"""Studies: many runs of one model, by the program `hersey study`."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path
from typing import Any, Optional, Union

from . import _core
from .errors import InputError, RunError, Stopped
from .model import Model, PathLike
from .overrides import assignments, has_numbers, plain

WRONG_INPUT = 2


class Study:
    """What a study has found; its folder has more, study.html among it."""

    def __init__(self, folder: PathLike):
        self.folder = Path(folder)
        with open(self.folder / "results.json", encoding="utf-8") as file:
            #: Everything as plain data: the content of results.json.
            self.data: dict[str, Any] = json.load(file)

    @property
    def table(self) -> "Any":
        """Every completed run as a row of a `pandas.DataFrame`: values of the parameters, then the figures.

        Columns are named with their units, "clearance [um]"; where values of a parameter are words they stay as written.
        """
        import pandas

        table = pandas.read_csv(self.folder / "runs.csv", index_col="run", dtype={p["name"]: str for p in self._parameters})
        for parameter in self._parameters:
            name, unit = parameter["name"], parameter["unit"]
            if not parameter["is_words"]:
                known = dict(zip(parameter["values"], parameter["numbers"]))
                table[name] = [known[text] if text in known else float(text.split(" ")[0]) for text in table[name]]
                table = table.rename(columns={name: f"{name} [{unit or '1'}]"})
        return table

    @property
    def best(self) -> "Any":
        """The rows of `table` that none other beats in all that is minimised or maximised; of one objective the best."""
        return self.table.loc[self.data["best"]]

    @property
    def figures(self) -> "Any":
        """Mean, deviation and percentiles of each figure as a `pandas.DataFrame`."""
        import pandas

        rows = {}
        for figure in self.data["figures"]:
            scatter = dict(figure["scatter"] or {})
            scatter.update({f"{share} %": value for share, value in scatter.pop("percentiles", {}).items()})
            rows[figure["key"]] = {"unit": figure["unit"], **scatter}
        return pandas.DataFrame.from_dict(rows, orient="index")

    @property
    def indices(self) -> "Any":
        """Sobol indices of the figures that have a surrogate: first order and total, a row for each parameter."""
        import pandas

        columns = {(figure["key"], order): figure["surrogate"][order] for figure in self.data["figures"]
                   if figure["surrogate"] for order in ("first", "total")}
        return pandas.DataFrame(columns, index=[p["name"] for p in self._parameters])

    @property
    def search(self) -> Optional[dict[str, Any]]:
        """How an optimum was looked for: methods, whether with exact derivatives or why not, number of runs."""
        return self.data.get("search")

    @property
    def failed(self) -> dict[str, int]:
        """Reasons of failed runs, and how many have each."""
        return {failure["reason"]: failure["count"] for failure in self.data["failed"]}

    @property
    def report(self) -> Path:
        """The page with all pictures."""
        return self.folder / "study.html"

    @property
    def _parameters(self) -> list[dict[str, Any]]:
        return self.data["parameters"]

    def __repr__(self) -> str:
        return f"<Study {self.folder}: {self.data['completed']} of {self.data['planned']} runs, plan {self.data['plan']}>"


def find_program() -> str:
    """The program `hersey`: what HERSEY_PROGRAM names, the one beside a built package, or the one on the path."""
    beside = Path(__file__).absolute().parents[2] / "hersey"
    for candidate in (os.environ.get("HERSEY_PROGRAM"), str(beside) if beside.is_file() else None, shutil.which("hersey")):
        if candidate:
            return candidate
    raise FileNotFoundError("the program hersey, which does studies, is not on the path: expected it there, or where "
                            "HERSEY_PROGRAM says; `make program` builds it")


def study(model: Union[Model, PathLike], output: Optional[PathLike] = None, *, jobs: int = 0, again: bool = False,
          on: str = "local", runner: str = "", progress: bool = False, **values: Any) -> Study:
    """Does the study of a model file, or what of it is not done yet, and returns what it says.

    `model` is a file, or a `Model` of one with its changes; `values` replace parameters as in `Model.load`. `output` is
    the study's folder (studies/NAME where it is left out). `jobs` runs are at work at the same time (0: one for each
    processor), `again` does failed runs again, `on` is "local" or "slurm", `runner` a command that answers the runs in
    the solver's place, `progress=True` lets the program's table be observed.

    Raises `InputError` for a study that cannot be done, `RunError` where no run has an answer, `Stopped` at Ctrl-C: every
    finished run is kept then, and the same call goes on. Runs that fail stop nothing, see `Study.failed`.
    """
    file, changes = _file_of(model)
    given = {name: plain(value) for name, value in values.items()}
    if has_numbers(given):  # SI: what it is the model knows
        known = model if isinstance(model, Model) else Model.load(file)
        changes = known.copy().set(given).changes
        given = {}
    folder = Path(output) if output is not None else Path("studies") / _core.model_name(file)
    command = [find_program(), "study", file, "--out", str(folder), "--on", on,
               *(f"--set={change}" for change in [*changes, *assignments(given)])]
    if jobs:
        command += ["--jobs", str(jobs)]
    if again:
        command.append("--again")
    if runner:
        command += ["--runner", runner]
    ended = _result_of(command, progress)
    if ended.returncode == WRONG_INPUT:
        raise InputError((ended.stderr or "the study cannot be done; the reason is printed above").strip())
    if ended.returncode not in (0, 1) or ended.stdout is None or "study:" not in ended.stdout:
        raise RunError((ended.stderr or "the study has no answer; the reason is printed above").strip())
    return Study(folder)


def _result_of(command: list[str], progress: bool) -> "subprocess.CompletedProcess[str]":
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=None if progress else subprocess.PIPE, text=True)
    try:
        out, err = process.communicate()
    except KeyboardInterrupt:  # the program has heard it, too
        process.wait()
        raise Stopped("stopped; every finished run is kept, and the same call goes on") from None
    return subprocess.CompletedProcess(command, process.returncode, out, err)


def _file_of(model: Union[Model, PathLike]) -> tuple[str, list[str]]:
    if not isinstance(model, Model):
        return os.fspath(model), []
    if model._functions:
        raise InputError(f"{model.file}: functions of Python's: expected expressions in a study, whose runs are processes "
                         "of their own")
    if not os.path.isfile(model.file):
        raise InputError(f"{model.file}: no file: expected a model that was loaded from one; model.text can be written to it")
    return model.file, model.changes

