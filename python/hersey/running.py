"""A run from its beginning to its results."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import Any, Callable, Optional, Union

from . import _core
from .errors import InputError, RunError, Stopped
from .functions import cost_of, raise_fault_of
from .results import Results, Summary


def results_file(model: Any, output: Optional[Any]) -> Path:
    """Where results go: as `hersey run` chooses, or `output`, a folder or an .h5 file."""
    if output is None:
        return Path("results") / _core.model_name(model.file) / "results.h5"
    path = Path(os.fspath(output))
    return path if path.suffix == ".h5" else path / "results.h5"


def require_one_run(model: Any) -> None:
    """@raises InputError for a study of several runs, and for bearings alone."""
    varied = [name for name, texts in model.study.items()
              if len(texts) > 1 and not any(change.startswith(name + "=") for change in model.changes)]
    if varied:
        raise InputError(f"{model._name}: the model's study varies {', '.join(varied)}: expected one run; "
                         f"model.set({varied[0]}=...) fixes it, model.runs() gives a model for each combination")
    if model._checked.is_of_bearings_alone:
        raise InputError(f"{model._name}: bearings alone: expected bodies and a simulation to run; "
                         "model.bearing() solves bearings by themselves")


class _Bar:
    """A bar of tqdm's where there is tqdm, else a line now and then."""

    def __init__(self, label: str):
        self._label, self._shown_at = label, 0.0
        self._bar: Any = None

    def __call__(self, progress: "_core.Progress") -> None:
        share = (progress.t - progress.t_start) / max(progress.t_end - progress.t_start, 1e-300)
        try:
            from tqdm.auto import tqdm
        except ImportError:
            if progress.elapsed - self._shown_at > 5:
                self._shown_at = progress.elapsed
                print(f"{self._label} {100 * share:.0f} %, t = {progress.t:.5g} s", file=sys.stderr)
            return
        if self._bar is None:
            self._bar = tqdm(total=100, desc=self._label, unit="%", bar_format="{l_bar}{bar}| {elapsed}<{remaining}{postfix}")
        if share * 100 - self._bar.n >= 0.1 or share >= 1:
            moft = f", MOFT {1e6 * progress.moft:.2f} um" if progress.moft < 1 else ""
            self._bar.set_postfix_str(f"t {progress.t:.5g} s{moft}", refresh=False)
            self._bar.update(min(100 * share, 100) - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


def run(model: Any, output: Optional[Any], *, overwrite: bool, resume: bool, step_error: bool,
        progress: Union[bool, Callable[["_core.Progress"], Any]]) -> Results:
    """See `Model.run`."""
    require_one_run(model)
    file = results_file(model, output)
    bar = _Bar(model.title or Path(model.file).stem) if progress is True else None
    listener = bar or (progress if callable(progress) else None)
    checked, calls = model._runnable()

    def has_fault() -> bool:
        return any(each.fault for each in calls)

    try:
        text, raised, t = _core.simulate(checked, os.fspath(file), overwrite, resume, step_error, listener, has_fault)
    except InputError as error:
        raise model._located(error) from None
    except FileExistsError as error:
        raise FileExistsError(f"{error}; overwrite=True replaces it, resume=True goes on with it") from None
    finally:
        if bar:
            bar.close()
    if not text:
        raise_fault_of(calls, t, None)
    content = json.loads(text)
    if calls:
        content["functions"] = cost_of(calls)
    summary = Summary(content)
    results = Results(file, summary=summary)
    raise_fault_of(calls, t, results)
    if isinstance(raised, KeyboardInterrupt):
        raise Stopped(f"stopped at t = {summary['t_results']:.6g} s, results in {file}; resume=True goes on from there",
                      results, summary) from None
    if raised is not None:
        raise raised
    if summary["status"] == "failed":
        raise RunError(f"{summary['message']}; results up to t = {summary['t_results']:.6g} s are in {file}", results,
                       summary)
    return results
