"""One random machine: run, checked, and run again mirrored, in another order and with more threads."""

import os
from dataclasses import dataclass

import numpy as np

import machine_checks
import machines
import program as hersey
from findings import Findings
from program import write


class Runs:
    def __init__(self, program, folder):
        self.program, self.folder, self.models = program, folder, {}

    def run(self, machine, label, threads=1):
        """(ending, results or None)"""
        text = machine.text()
        self.models[label] = text
        model, output = os.path.join(self.folder, label + ".yaml"), os.path.join(self.folder, label)
        write(model, text)
        ending = hersey.run(self.program, "run", model, "--output", output, "--json", "--jobs", "1",
                            "--threads", str(threads))
        path = os.path.join(output, "results.h5")
        if ending.kind not in ("answer", "message") or not os.path.exists(path):
            return ending, None
        return ending, machine_checks.Results(path)


def examine(program, rng, folder, is_small=False):
    """(ending, text, findings, models) of one case. What a run that failed left behind must hold as well."""
    machine = machines.random_machine(rng, is_small)
    runs = Runs(program, folder)
    ending, results = runs.run(machine, "model")
    if results is None:
        return ending.kind, ending.text, [], runs.models
    found = Findings(machine_checks.check(machine, results))
    for times, label in ((2, "fine"), (4, "finest")):
        if found.has_estimated():
            finer = machine.on_grid(times)
            _, finer_results = runs.run(finer, label)
            found.drop_estimated(machine_checks.check(finer, finer_results) if finer_results else found, times)
    failed = {"model"} if found else set()
    if ending.kind == "answer":
        for label, invariant, variant, symmetry in variants(machine):
            off = Findings()
            compare(machine, results, *runs.run(variant, label), label, invariant, symmetry, off)
            if off and label == "mirrored_z":
                off = mirror_or_order(machine, results, runs, off)
            found += off
            if off:
                failed |= {"model", *(text.split(":")[0] for _, text in off)}
    if results.status == "completed" and any(b.heat for b in machine.named_bearings().values()):
        before = len(found)
        compare_bits(results, runs.run(machine, "threads", threads=3)[1], found)
        if len(found) > before:
            failed |= {"model"}
    models = {k: v for k, v in runs.models.items() if k in failed or ending.kind not in ("answer", "message")}
    return ending.kind, ending.text if ending.kind != "answer" else "", list(found), models


@dataclass
class Symmetry:
    flip_z: bool = False
    flip_phi: bool = False
    tolerance: float = 1e-5


def variants(machine):
    # Both in one run: neither undoes what the other shows.
    yield "mirrored_z", "mirror z", machine.mirrored_z().reordered(), Symmetry(flip_z=True)
    if not any(place["towards"] != "edges" for b in machine.named_bearings().values() for place in b.refine):
        yield "mirrored_phi", "mirror phi", machine.mirrored_phi(), Symmetry(flip_phi=True)


def mirror_or_order(machine, results, runs, both):
    """What of a machine mirrored and in another order differs: each of them by itself, or only both together."""
    off = Findings()
    for label, invariant, variant, symmetry in (
            ("mirrored_only", "mirror z", machine.mirrored_z(), Symmetry(flip_z=True)),
            ("reordered", "order of bodies", machine.reordered(), Symmetry())):
        compare(machine, results, *runs.run(variant, label), label, invariant, symmetry, off)
    return off or both


def compare_bits(one, other, found):
    """Threads change no result."""
    for name, film in one.films.items():
        numbers = {key: row for key, row in film.rows.items() if other and row.dtype.kind == "f"}
        bad = [key for key, row in numbers.items() if not np.array_equal(row, other.films[name].rows[key], equal_nan=True)]
        found.require("threads change nothing", other is not None and not bad, f"{name}: {', '.join(bad) or 'no results'}")


def compare(machine, one, ending, other, label, invariant, symmetry, found):
    if ending.kind == "message" and one.rejected > 0:
        return  # it went through steps so large that Newton's method, begun elsewhere, may end in words
    if ending.kind != "answer":
        found.append((invariant, f"{label}: {ending.kind}: {ending.text}"))
        return
    if len(one.time) != len(other.time) or np.abs(one.time - other.time).max() > 1e-9 * one.time[-1]:
        # Where a step was rejected or its error estimated, round-off may decide about the next one; rows of other instants
        # cannot be compared.
        chosen = machine.numerics.kind == "error" or max(one.rejected, other.rejected) > 0
        found.require(invariant, chosen, f"{label}: {len(one.time)} and {len(other.time)} rows of fixed steps")
        return
    if max(one.rejected, other.rejected) > 0:
        return  # nor the answers of steps so large that Newton's method, begun elsewhere, may find another
    for name, b in machine.named_bearings().items():
        rows, others = one.films[name].rows, other.films[name].rows
        power, flow = rows["power_film"].max(), max(np.abs(rows[k]).max() for k in ("flow_left", "flow_right", "flow_supply"))
        flow = max(flow, 1e-6 * abs(machine.speed) * b.R * b.c * b.L)
        # The largest node, not the peak between nodes: over a pocket all have one pressure, and round-off says around which.
        scales = {"h_min": b.c, "p_max_node": rows["p_max_node"].max(), "power_film": power, "flow_left": flow, "flow_right": flow,
                  "flow_supply": flow, "oil_volume": rows["oil_volume"].max()}
        if "T_max" in rows:
            rise = max(float(rows["T_max"].max()) - min(b.heat.given()), 1.0)
            scales |= {"T_max": rise, "T_journal": rise, "heat_dissipated": power}
        swapped = {"flow_left": "flow_right", "flow_right": "flow_left"} if symmetry.flip_z else {}
        for key, scale in scales.items():
            off = np.abs(rows[key] - others[swapped.get(key, key)])
            k = int(np.argmax(off))
            if scale > 0 and off[k] > symmetry.tolerance * scale:
                found.append((invariant, f"{label}: {name} {key} {rows[key][k]:.8g} and {others[swapped.get(key, key)][k]:.8g} at t = {one.time[k]:.6g} s"))
                break
