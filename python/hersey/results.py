"""A results file: its summary, its tables, its fields when they are asked for."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Iterator, Optional, Sequence

import numpy as np

from . import _core
from .reading import complete_rows, opened, read_group
from .words import did_you_mean


class Summary(Mapping):
    """How a run went: status, steps, times [s], energies [J]; nested mappings as `hersey run --json` gives them."""

    def __init__(self, content: dict[str, Any]):
        self._content = content

    def __getitem__(self, key: str) -> Any:
        return self._content[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._content)

    def __len__(self) -> int:
        return len(self._content)

    def __repr__(self) -> str:
        return (f"<Summary: {self['status']} at t = {self['t_end']:.6g} s after {self['steps']} steps, "
                f"{self['wall_time']:.3g} s>")


class Results:
    """The results of one run. Nothing is read before it is asked for.

    `results["bearings/big_end"]` is a group as `xarray.Dataset` with named dimensions, coordinates and units;
    `results.bearing("big_end")` and `results.film("big_end")` are short for those of films. Everything is SI.
    """

    def __init__(self, path: Any, summary: Optional[Summary] = None):
        self.path = Path(os.fspath(path))
        if not self.path.exists():
            raise FileNotFoundError(f"{self.path}: no such results file")
        #: of the run that wrote it, if that was made from here
        self.summary = summary

    def __repr__(self) -> str:
        return f"<Results {self.path}: {self.title or 'without title'}, {self.status}>"

    @property
    def attributes(self) -> dict[str, Any]:
        """Of the file: title, status, message, the model's text, ..."""
        with opened(self.path) as file:
            return dict(file.attrs)

    @property
    def title(self) -> str:
        return str(self.attributes.get("title", ""))

    @property
    def status(self) -> str:
        """completed, stopped, failed, or running."""
        return str(self.attributes["status"])

    @property
    def groups(self) -> list[str]:
        """Paths of all groups that hold data, for `results[path]`."""
        import h5py

        found: list[str] = []

        def visit(name: str, item: Any) -> None:
            if isinstance(item, h5py.Group) and any(isinstance(part, h5py.Dataset) for part in item.values()):
                found.append(name)

        with opened(self.path) as file:
            file.visititems(visit)
        return found

    @property
    def bearings(self) -> list[str]:
        """Names of the bearings."""
        with opened(self.path) as file:
            return list(file.get("bearings", {}))

    def __getitem__(self, group: str):
        """A group as `xarray.Dataset`; large ones are read where they are used."""
        try:
            return read_group(self.path, group or "/")
        except KeyError:
            groups = self.groups
            raise KeyError(f"no group '{group}' in {self.path}{did_you_mean(group, groups)}; there are {', '.join(groups)}") from None

    def bearing(self, name: Optional[str] = None):
        """Series of a bearing over time [s], with the crank angle as a coordinate where the machine has a crank."""
        return self._with_crank(self[f"bearings/{self._called(name)}"])

    def film(self, name: Optional[str] = None):
        """Stored fields of a film over time [s], bearing angle `phi` [rad] and `z` [m], read where they are used; of a plane
        slider over `y` [m], along the sliding direction, in place of `phi`, of a thrust bearing over the radius `r` [m] in
        place of `z`."""
        return self._with_crank(self[f"bearings/{self._called(name)}/fields"])

    def _called(self, name: Optional[str]) -> str:
        names = self.bearings
        if name is None and len(names) == 1:
            return names[0]
        if name not in names:
            found = "several bearings" if name is None else f"no bearing {name!r}"
            near = did_you_mean(name or "", names)
            raise KeyError(f"{found} in {self.path}{near}: expected one of {', '.join(names) or 'none'}")
        return name

    def _with_crank(self, data):
        with opened(self.path) as file:
            if "crank_angle" not in file or "time" not in data.dims:
                return data
            crank = file["crank_angle"]
            rows = complete_rows(file, "")
            time, angle = file["time"][:rows], crank[:rows]
            attributes = {key: crank.attrs[key] for key in ("units", "long_name") if key in crank.attrs}
        wanted = data["time"].values
        at = np.interp(wanted, time, angle) if len(time) else np.full(wanted.shape, np.nan)
        return data.assign_coords(crank_angle=("time", at, attributes))

    def table(self):
        """The closing table as a `pandas.DataFrame`, in SI: group, name, value, unit, where."""
        import pandas

        rows = json.loads(_core.summary_table_json([os.fspath(self.path)]))
        return pandas.DataFrame(rows).drop(columns="run").set_index(["group", "name"])

    def report(self, out: Any, title: str = "") -> Path:
        """Writes the report: one HTML file, no network, any browser."""
        _core.write_report([os.fspath(self.path)], os.fspath(out), title, [])
        return Path(os.fspath(out))


def open_results(path: Any) -> Results:
    """Opens a results file, or the one in a folder."""
    path = Path(os.fspath(path))
    return Results(path / "results.h5" if path.is_dir() else path)


def report(results: Any, out: Any, title: str = "", names: Sequence[str] = ()) -> Path:
    """One report of several results, laid over each other, by `names` where they are given, or as the study they are of."""
    files = [os.fspath(item.path if isinstance(item, Results) else item) for item in results]
    _core.write_report(files, os.fspath(out), title, list(names))
    return Path(os.fspath(out))
