#!/usr/bin/python3
"""bench/cost_at_error.py PROGRAM [--rounds N] [--only REGEX] [--update]

What an answer of a stated error costs: each job on ever finer grids or with ever shorter steps, on one thread, beside the errors of the figures
people ask for. Their true values are those of the finest of all, which is not listed, continued to nothing by the order that the last three show.
The least processor time of N rounds counts, since a shared machine only ever adds to it. --update puts the table into docs/cost.md.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "cost.md"
BEGIN, END = "<!-- the table of bench/cost_at_error.py -->", "<!-- its end -->"


def grids(bearing, first, second, sizes):
    """One refinement after the other, by the settings of both directions."""
    return {f"{a} x {b}": [f"{bearing}.{first}={a}", f"{bearing}.{second}={b}"] for a, b in sizes}


def steps(unit, lengths, extra=()):
    return {f"{length} {unit}": [f"simulation.step={length}{unit}", *extra] for length in lengths}


def film(bearing, name=""):
    """The thinnest film and the highest pressure of a bearing, in the second half of a run, which the start no longer decides."""
    return {f"min bearings/{bearing}/h_min": f"MOFT{name}", f"max bearings/{bearing}/p_max": f"POFP{name}"}


def tolerances(values):
    return {f"to {value}": [f"simulation.step={{tolerance: {value}}}", "simulation.integrator=dormand_prince"] for value in values}


JOURNAL = [(30, 7), (60, 13), (120, 25), (240, 49), (480, 97)]
# Name, command, example, what both have in common, the refinements (the last one is the reference), figures with the names they have in the table.
JOBS = [
    ("journal bearing, load given, K and C", "bearing", "bearing_alone/model", [],
     grids("bearings.main.grid", "circumferential", "axial", JOURNAL),
     {"h_min": "h_min", "p_max": "p_max", "stiffness_xx": "K_xx", "damping_xx": "C_xx"}),
    ("hot journal bearing, load given", "bearing", "hot_bearing/model", [],
     grids("bearings.main.grid", "circumferential", "axial", [(60, 13), (120, 25), (240, 49), (480, 97)]),
     {"h_min": "h_min", "T_max": "T_max", "power_film": "loss"}),
    ("bearing of tilting pads, K and C", "bearing", "tilting_pads/bearing", [],
     grids("bearings.front.grid", "circumferential", "axial", [(60, 7), (120, 13), (240, 25), (480, 49)]),
     {"h_min": "h_min", "p_max": "p_max", "stiffness_xx": "K_xx", "damping_xx": "C_xx"}),
    ("thrust bearing of tilting pads", "bearing", "thrust_pads/tilting", [],
     grids("bearings.thrust.grid", "along", "radial", [(17, 11), (33, 21), (65, 41), (129, 81)]),
     {"h_min": "h_min", "p_max": "p_max", "power_film": "loss"}),
    ("squeeze-film damper, orbit given", "bearing", "squeeze_film_damper/model", [],
     grids("bearings.damper.grid", "circumferential", "axial", [(60, 31), (120, 61), (240, 121), (480, 241)]),
     {"p_max": "p_max", "orbit_damping": "damping", "orbit_stiffness": "stiffness"}),
    ("slider-crank with big end, 720 deg", "run", "slider_crank/model", [],
     steps("deg", [1, 0.5, 0.25, 0.125]), film("big_end")),
    ("piston with skirt and pin, 360 deg", "run", "piston/model", ["simulation.duration=360deg"],
     steps("deg", [1, 0.5, 0.25]), film("skirt")),
    ("engine, four films, two cycles", "run", "engine/model", ["simulation.cycle.most=2", "simulation.cycle.until_converged=0"],
     steps("deg", [1, 0.5, 0.25]), film("big_end", " of the big end") | film("small_end", " of the small end")),
    ("double pendulum, 3 s", "run", "double_pendulum/model", ["simulation.duration=3s"],
     tolerances(["1e-3", "1e-5", "1e-7", "1e-9", "1e-11"]), {"energy/kinetic": "kinetic energy at the end"}),
    ("four-bar, closed loop, 1 s", "run", "four_bar/model", [],
     steps("ms", [4, 2, 1, 0.5, 0.25]), {"energy/kinetic": "kinetic energy at the end"}),
]


def figures_of_run(results, names):
    """By the smallest or largest number of a series in the second half of the run, or its last one."""
    import h5py

    with h5py.File(results) as file:
        half = file["time"][()] >= 0.5 * file["time"][-1]
        values = {}
        for name in names:
            *which, path = name.split()
            numbers = file[path][()]
            values[name] = {"min": numbers[half].min(), "max": numbers[half].max()}[which[0]] if which else numbers[-1]
    return values


def answer_of(program, job, settings):
    """Processor time [s], largest memory [MB] and figures of one refinement."""
    _, kind, example, common, _, figures = job
    with tempfile.TemporaryDirectory(prefix="hersey-cost-") as folder:
        call = [program, kind, str(ROOT / "examples" / f"{example}.yaml"), "--json", "--threads", "1", "--jobs", "1"]
        call += [word for setting in [*common, *settings] for word in ("--set", setting)]
        call += ["--output", folder, "--force"] if kind == "run" else ["--no-grid-error"]
        answer, errors = pathlib.Path(folder) / "answer.json", pathlib.Path(folder) / "errors.txt"
        with answer.open("w") as out, errors.open("w") as err:
            running = subprocess.Popen(call, stdout=out, stderr=err, env=os.environ | {"HERSEY_CACHE": "off"})
            _, status, used = os.wait4(running.pid, 0)
            running.returncode = os.waitstatus_to_exitcode(status)
        if running.returncode != 0:
            sys.exit(f"{' '.join(call)} ended with status {running.returncode}: {errors.read_text().strip()[-400:]}")
        document = json.loads(answer.read_text())
        if kind == "run":
            values = figures_of_run(document["runs"][0]["results"], figures)
        else:
            values = {name: document["solutions"][0]["figures"][name]["value"] for name in figures}
        return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, values


def limit_of(values):
    """Continues the last three values of refinements by halves; by the second order where they show none of their own."""
    before, last, finest = values[-3:]
    first, second = last - before, finest - last
    ratio = first / second if second else 0.0
    return finest + second / (ratio - 1 if ratio > 2 else 3)


def rows_of(program, job, rounds):
    name, _, _, _, refinements, figures = job
    answers = []
    for settings in refinements.values():
        taken = [answer_of(program, job, settings) for _ in range(rounds)]
        answers.append((min(seconds for seconds, _, _ in taken), *taken[0][1:]))
    truth = {figure: limit_of([values[figure] for _, _, values in answers]) for figure in figures}
    rows = []
    for label, (seconds, memory, values) in list(zip(refinements, answers))[:-1]:
        errors = ", ".join(f"{short} {100 * abs(values[figure] / truth[figure] - 1):.2g} %" for figure, short in figures.items())
        rows.append((name, label, errors, f"{seconds:.2g}" if seconds < 10 else f"{seconds:.0f}", f"{memory:.0f}"))
        name = ""
    return rows


def machine():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), "unknown")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--only", default="", help="jobs whose name this regular expression matches")
    parser.add_argument("--update", action="store_true")
    given = parser.parse_args()
    lines = ["| job | grid or step | errors | processor time [s] | memory [MB] |", "|---|---|---|---|---|"]
    print("\n".join(lines))
    for job in JOBS:
        if not re.search(given.only, job[0]):
            continue
        for row in rows_of(given.program, job, given.rounds):
            lines.append("| " + " | ".join(row) + " |")
            print(lines[-1], flush=True)
    note = f"One thread of a shared {machine()}, the least of {given.rounds} rounds."
    print("\n" + note)
    if given.update:
        text = PAGE.read_text()
        before, after = text.split(BEGIN)[0], text.split(END)[1]
        PAGE.write_text(before + BEGIN + "\n\n" + "\n".join(lines) + "\n\n" + note + "\n\n" + END + after)


if __name__ == "__main__":
    main()
