"""Bands over time: how the runs of a drawn study scatter at every instant, not at their end alone."""

import csv
import os

import numpy as np

from . import spectra

ENDING = ".end"
INSTANTS = 101
PERCENTILES = (5, 50, 95)
# With fewer runs a percentile of 5 % says nothing.
FEWEST_RUNS = 6


def bands(results, folder):
    """Mean and percentiles over time of each series whose end is a figure, of the runs whose results files are kept.

    Returns a list, empty without such figures or files; times are those that all runs reach, figures are in the units
    people use. The last instant of runs that end together has the percentiles of the figures themselves.
    """
    names = [name for name in results.names if name.endswith(ENDING)]
    files = [folder.file("runs", run + ".h5") for run in results.runs]
    files = [path for path in files if os.path.exists(path)]
    if not names or len(files) < FEWEST_RUNS:
        return []
    courses = {name: [] for name in names}
    for path in files:
        read_courses(path, courses)
    return [band(name, runs, results.units[name]) for name, runs in courses.items() if len(runs) >= FEWEST_RUNS]


def read_courses(path, courses):
    """Adds time and values of the series of one results file; figures that are no series have no course."""
    import h5py

    with h5py.File(path, "r") as file:
        for name, runs in courses.items():
            found = spectra.series_in(file, name[: -len(ENDING)])
            if found is not None and len(found[0]) > 1:
                runs.append(found)


def band(name, runs, unit):
    """Mean and percentiles of one series on even times."""
    begin, end = max(time[0] for time, _ in runs), min(time[-1] for time, _ in runs)
    time = np.linspace(begin, end, INSTANTS)
    values = np.array([np.interp(time, *run) for run in runs]) / unit["si"]
    text = unit["name"].removesuffix(" at the end").rstrip(",")
    return {"key": name[: -len(ENDING)], "name": text, "unit": unit["unit"], "runs": len(runs),
            "time": time.tolist(), "mean": values.mean(axis=0).tolist(),
            "percentiles": {str(p): np.percentile(values, p, axis=0).tolist() for p in PERCENTILES}}


def write_table(path, found):
    """All bands side by side: a column of time, then mean and percentiles of each series."""
    with open(path + ".new", "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        heads, columns = [], []
        for one in found:
            unit = f"[{one['unit'] or '1'}]"
            heads += ["time [s]", f"{one['key']} mean {unit}", *(f"{one['key']} {p} % {unit}" for p in one["percentiles"])]
            columns += [one["time"], one["mean"], *one["percentiles"].values()]
        table.writerow(heads)
        for row in zip(*columns):
            table.writerow([f"{value:.10g}" for value in row])
    os.replace(path + ".new", path)
