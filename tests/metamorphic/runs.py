"""Runs of machines, their results as {path of the dataset: (values, unit)}, and how near two of them are."""

import os

import h5py
import numpy as np

import tree as trees
from tree import hersey

# Errors and residuals are round-off themselves, iterations its choice; what the model file says is not the machine's.
LEFT_OUT = ("residual", "constraint_drift", "newton_iterations", "film_iterations", "mass_balance_error", "heat_balance_error",
            "balance_error", "unexplained", "oil_unexplained", "from_nowhere", "power_error", "power_error_share", "step_error", "assumptions")


def run(program, tree, folder, label="run", cpu_limit=20):
    """How `hersey run` ends, and its results."""
    output = os.path.join(folder, label)
    ending = hersey.run(program, "run", trees.write(tree, folder, label + ".yaml"), "--output", output, "--force", "--json", "--jobs", "1",
                        "--threads", "1", cpu_limit=cpu_limit)
    path = os.path.join(output, "results.h5")
    return ending, results(path) if os.path.exists(path) else {}


def results(path):
    """Numbers of all datasets but places of rows and columns."""
    found = {}

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and name.split("/")[-1] not in LEFT_OUT:
            if not name.endswith(("_row", "_column")):
                found[name] = (item[...].astype(float), item.attrs.get("units", "1"))

    with h5py.File(path) as file:
        file.visititems(visit)
    return found


def scale_key(name, unit):
    """Numbers of one section and unit are of a size; reactions of a joint that is free are the round-off of all other forces."""
    return (None if "/reaction_" in name else name.split("/")[0], unit)


def scales_of(found):
    """{scale_key: the largest number there}: what is nothing by its nature is the round-off of its neighbours."""
    scales = {}
    for name, (values, unit) in found.items():
        largest = np.abs(values[np.isfinite(values)]).max(initial=0.0)
        for key in (scale_key(name, unit), (None, unit)):
            scales[key] = max(scales.get(key, 0.0), largest)
    return scales


def differences(one, other, rtol):
    """Datasets that differ by more than rtol of the largest number in their section with their unit."""
    off = [f"{name}: in one alone" for name in sorted(set(one) ^ set(other))]
    scales = scales_of(one)
    for name in sorted(set(one) & set(other)):
        (a, unit), b = one[name], other[name][0]
        if a.shape != b.shape:
            off.append(f"{name}: {a.shape} and {b.shape}")
            continue
        if not np.array_equal(np.isnan(a), np.isnan(b)):
            off.append(f"{name}: a number in one alone")
            continue
        apart = np.nanmax(np.abs(a - b), initial=0.0) if a.size else 0.0
        if apart > rtol * scales[scale_key(name, unit)]:
            k = np.unravel_index(np.nanargmax(np.abs(a - b)), a.shape)
            off.append(f"{name}: {a[k]:.10g} and {b[k]:.10g} {unit} at {tuple(map(int, k))}")
    return off
