#!/usr/bin/python3
"""Random machines with oil circuits, wear and a piston's skirt: results that must not depend on how a machine is written down.

    fitted_machines.py HERSEY [--seed S] [--count N] [--only NAME] [--output DIR]

Each machine is run as it is and written in other ways: in another order, in a mirror, turned, with elements of the circuit the other way
about or in two parts, with wear counted otherwise, with three threads, and interrupted and resumed. docs/random-models.md lists the relations.
A case that fails is left in the folder of `--output` with the command that repeats it.
"""

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import time

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import program  # noqa: E402
from fitted_engine import Engine  # noqa: E402
from fitted_rotor import Rotor  # noqa: E402
from model_text import yaml  # noqa: E402

SAME = 1e-5  # of each series' own scale: steps are solved to 1e-8 of their largest term, forces of stiff films amplify it
KINDS = {"rotor": Rotor, "engine": Engine}


class Run:
    """Series of one run by name, as `bearings/b0/h_min`, and what stopped it."""

    def __init__(self, path):
        self.series = {}
        with h5py.File(path) as file:
            self.rejected = int(file["solver/rejected_steps"][-1])
            self.completed = file.attrs["status"] == "completed"
            self.time = file["time"][:]
            file.visititems(self.take)

    def take(self, name, item):
        """Rows of films, joints and circuit; what a run cost is no result."""
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and name.startswith(("bearings/", "circuit/", "joints/")):
            self.series[name] = item[:]


def arguments_of(hersey, model, output, threads):
    return [hersey, "run", model, "--output", output, "--json", "--jobs", "1", "--threads", str(threads)]


def solved(hersey, text, folder, label, threads=1):
    model, output = os.path.join(folder, label + ".yaml"), os.path.join(folder, label)
    program.write(model, text)
    ending = program.run(*arguments_of(hersey, model, output, threads))
    path = os.path.join(output, "results.h5")
    return ending, Run(path) if ending.kind == "answer" and os.path.exists(path) else None


def interrupted(hersey, text, folder, seconds):
    """The run ended by Ctrl-C after this long, then resumed; None where it was too quick."""
    model, output = os.path.join(folder, "interrupted.yaml"), os.path.join(folder, "interrupted")
    program.write(model, text)
    arguments = arguments_of(hersey, model, output, 1)
    with subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        time.sleep(seconds)
        process.send_signal(signal.SIGINT)
        process.communicate()
    if process.returncode != 130:
        return None, None
    ending = program.run(*arguments, "--resume")
    return ending, Run(os.path.join(output, "results.h5")) if ending.kind == "answer" else None


def scale_of(name, one):
    """By which differences of a series count: its largest number, and that of the series it is a part of."""
    of = {"flow_": "flow_", "torque_": "torque_", "power_": "power_film", "drawn_": "drawn_", "heat_": "heat_"}
    folder, _, figure = name.rpartition("/")
    family = next((begin for start, begin in of.items() if figure.startswith(start)), figure)
    alike = [np.nanmax(np.abs(row), initial=0) for key, row in one.series.items() if key.startswith(f"{folder}/{family}") and row.size]
    return max(alike, default=0.0)


# Of which the pairs are made: what the machine does, what films carry, lose and let flow, what circuits carry and what wears.
FIGURES = ("h_min", "p_max_node", "power_film", "power_asperity", "flow_", "oil_volume", "side_force", "skirt_friction", "offset_top",
           "offset_bottom", "pressure_", "drawn_", "worn_volume_fixed", "worn_volume_moving", "wear_fixed", "stored", "h_min_thrust",
           "h_min_antithrust", "source_power", "open_area_", "T_max", "T_side", "T_journal", "heat_to_oil", "temperature_")


def is_figure(name):
    figure = name.rpartition("/")[2]
    return "/fields/" not in name and any(figure == key or key.endswith("_") and figure.startswith(key) for key in FIGURES)


def differences(one, other, writing):
    """Of the series of `one` from those of `other` under the writing's names and signs."""
    if max(one.rejected, other.rejected) > 0:
        return []  # round-off may have decided whether a step was rejected, and with that about the steps after it
    if not np.array_equal(one.time.shape, other.time.shape):
        return [f"{len(one.time)} and {len(other.time)} rows"]
    found = []
    for name in filter(is_figure, one.series):
        key, sign = writing.name(name)
        if key is None:
            continue
        if key not in other.series:
            found.append(f"{name}: no {key}")
            continue
        first, again = one.series[name], sign * other.series[key]
        both_empty = np.isnan(first) & np.isnan(again)
        off = np.where(both_empty, 0, np.abs(first - again))
        scale = scale_of(name, one)
        if not off.max() <= SAME * scale:
            k = int(np.argmax(off))
            found.append(f"{name}: {first[k]:.9g}, {again[k]:.9g} at t = {one.time[k]:.6g} s of {one.time[-1]:.6g} s")
    return found


def bits(one, other):
    """Names of series that are not the same to the bit."""
    return [f"{name}: another bit" for name, row in one.series.items()
            if name not in other.series or not np.array_equal(row, other.series[name], equal_nan=True)][:5]


def balance(one):
    """What every run must fulfil: oil, energy and circuits are balanced, and wear only grows."""
    found = []
    for name, row in one.series.items():
        figure = name.rpartition("/")[2]
        if figure == "balance_error" and not np.abs(row).max() < 1e-6:  # steps are solved to 1e-8 of their largest term
            found.append(f"{name} of {np.abs(row).max():.3g}")
        if figure.startswith("worn_volume") and np.diff(row).min(initial=0) < 0:
            found.append(f"{name} falls")
        may_be_missing = figure.startswith(("rupture", "reformation", "centre_", "T_side")) or name.count("/") > 2 or figure == "h_min_centre"
        if not may_be_missing and not np.isfinite(row).all():
            found.append(f"{name} has values that are no numbers")
    return found


def examine(hersey, seed, name, output):
    """(ending, text, findings, model) of one case."""
    case = KINDS[name.split("-")[0]](random.Random(f"{seed}-{name}"))
    folder = os.path.join(output, name)
    shutil.rmtree(folder, ignore_errors=True)
    text = yaml(case.model())
    begin = time.time()
    ending, one = solved(hersey, text, folder, "model")
    lasted = time.time() - begin
    if one is None:
        return ending.kind, ending.text, [], text
    findings = balance(one)
    for label, writing in case.writings():
        again, other = solved(hersey, yaml(writing.model), folder, label)
        first = one
        if writing.base:
            same, first = solved(hersey, yaml(writing.base), folder, label + "_base")
            if first is None and other is None and (same.kind, again.kind) == ("message", "message"):
                continue  # neither has an answer, and both say why
        if other is None:
            findings.append(f"{label}: {again.kind}: {again.text}")
        elif first is None:
            findings.append(f"{label}: without an answer, in another writing it has one")
        else:
            findings += [f"{label}: {found}" for found in differences(first, other, writing)]
    again, other = solved(hersey, text, folder, "threads", threads=3)
    findings += [f"threads: {found}" for found in (bits(one, other) if other else [again.text])]
    again, other = interrupted(hersey, text, folder, case.rng.uniform(0.2, 0.9) * lasted)
    if again is not None:
        findings += [f"resumed: {found}" for found in (bits(one, other) if other else [again.text])]
    return "answer", ending.warnings, findings, text


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("hersey")
    parser.add_argument("--seed", default=None)
    parser.add_argument("--count", type=int, default=30, help="of each kind")
    parser.add_argument("--only")
    parser.add_argument("--output", default="build/random-fitted-machines")
    arguments = parser.parse_args()
    seed = arguments.seed or str(random.randrange(10**6))
    names = [arguments.only] if arguments.only else [f"{kind}-{k}" for k in range(arguments.count) for kind in KINDS]
    failed, endings = 0, {}
    for name in names:
        ending, text, findings, _ = examine(os.path.abspath(arguments.hersey), seed, name, os.path.abspath(arguments.output))
        endings[ending] = endings.get(ending, 0) + 1
        if ending not in ("answer", "message") or findings:
            failed += 1
            print(f"{name} (--seed {seed} --only {name}): {ending} {text if not findings else ''}")
            print("".join(f"    {found}\n" for found in findings[:8]), end="", flush=True)
        elif ending == "message":
            print(f"{name}: {text.splitlines()[-1] if text else ''}", flush=True)
    print(f"seed {seed}: {len(names)} machines, {failed} failing; {endings}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
