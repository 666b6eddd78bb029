#!/usr/bin/python3
"""bench/compare_speed.py OTHER PROGRAM [--rounds N] [--only REGEX]

How many times faster PROGRAM is than OTHER, such as the program of an earlier commit, on what people do: each job by both in turn, on one
thread, N times; the least processor time of either counts, since a shared machine only ever adds to it. Beside the ratio stand the largest memory, and by how much
the thinnest film (of the last cycle, where there are cycles), or where there is none the kinetic energy at the end, differs between both.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import h5py

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent / "examples"
GRID = "bearings.main.grid"
ONE_CYCLE = ["simulation.cycle.most=1", "simulation.cycle.until_converged=0"]
# Settings of a fourth entry are for PROGRAM alone, for what OTHER does not know.
JOBS = {
    "engine, rigid, four films, 180 deg": ("run", "engine/model", ["simulation.cycle.period=180deg", *ONE_CYCLE]),
    "engine, rod flexible, 20 deg": ("run", "engine/flexible", ["simulation.cycle.period=20deg", *ONE_CYCLE]),
    "engine, nine films on a circuit, 20 deg": ("run", "engine_oil/model", ["simulation.cycle.period=20deg", *ONE_CYCLE]),
    "engine until cycles repeat to 1 %": ("run", "engine/model", ["simulation.cycle.most=20", "simulation.cycle.until_converged=0.01"],
                                          ["simulation.cycle.lead_in=half_grids"]),
    "slider-crank, 720 deg": ("run", "slider_crank/model", []),
    "slider-crank, flexible": ("run", "flexible_slider_crank/model", []),
    "paper's big end, 2 rev": ("run", "paper_big_end/model", ["load=1000N", "clearance=0.034mm", "simulation.duration=2rev"]),
    "piston with skirt, 90 deg": ("run", "piston/model", ["simulation.duration=90deg"]),
    "hot engine, 20 deg": ("run", "engine/hot", ["simulation.cycle.period=20deg", *ONE_CYCLE]),
    "four-bar, no film": ("run", "four_bar/model", []),
    "bearing alone, K and C, 120 x 25": ("bearing", "bearing_alone/model", []),
    "bearing alone, K and C, 480 x 105": ("bearing", "bearing_alone/model", [f"{GRID}.circumferential=480", f"{GRID}.axial=105"]),
    "bearing alone, K and C, 960 x 208": ("bearing", "bearing_alone/model", [f"{GRID}.circumferential=960", f"{GRID}.axial=208"]),
    "bearing alone, K and C, 1920 x 416": ("bearing", "bearing_alone/model", [f"{GRID}.circumferential=1920", f"{GRID}.axial=416"]),
}


def figure_of(answer):
    """The figure by which two answers are compared."""
    for solution in answer.get("solutions", []):
        return solution["figures"]["h_min"]["value"]
    run = answer["runs"][0]
    with h5py.File(run["results"]) as results:
        thinnest = [bearing["cycles/fields/moft"][-1] if "cycles/fields/moft" in bearing else bearing["h_min"][()].min()
                    for bearing in results.get("bearings", {}).values() if "h_min" in bearing]
        return min(thinnest) if thinnest else results["energy/kinetic"][-1]


def answer_of(program, job, is_other):
    """Processor time [s] of one job, its largest memory [MB], and its figure."""
    kind, example, settings, *own = job
    if own and not is_other:
        settings = settings + own[0]
    with tempfile.TemporaryDirectory(prefix="hersey-speed-") as folder:
        call = [program, kind, str(EXAMPLES / f"{example}.yaml"), "--json", "--threads", "1", "--jobs", "1"]
        call += [word for setting in settings for word in ("--set", setting)]
        call += ["--output", folder, "--force"] if kind == "run" else ["--no-grid-error"]
        answer, errors = pathlib.Path(folder) / "answer.json", pathlib.Path(folder) / "errors.txt"
        with answer.open("w") as out, errors.open("w") as err:
            running = subprocess.Popen(call, stdout=out, stderr=err, env=os.environ | {"OPENBLAS_NUM_THREADS": "1", "HERSEY_CACHE": "off"})
            _, status, used = os.wait4(running.pid, 0)
            running.returncode = os.waitstatus_to_exitcode(status)
        if running.returncode != 0:
            sys.exit(f"{program} {kind} {example} ended with status {running.returncode}: {errors.read_text().strip()[-400:]}")
        return used.ru_utime, used.ru_maxrss / 1024, figure_of(json.loads(answer.read_text()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("other")
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", default="", help="jobs whose name this regular expression matches")
    given = parser.parse_args()
    print(f"{'job':<42} {'other [s]':>10} {'this [s]':>10} {'times faster':>13} {'differs by':>11} {'other [MB]':>11} {'this [MB]':>10}")
    for name, job in JOBS.items():
        if not re.search(given.only, name):
            continue
        times = {given.other: [], given.program: []}
        figures, memory = {}, {}
        for _ in range(given.rounds):
            for program, taken in times.items():
                seconds, memory[program], figures[program] = answer_of(program, job, program == given.other)
                taken.append(seconds)
        before, now = min(times[given.other]), min(times[given.program])
        was, shown = figures[given.other], figures[given.program]
        print(f"{name:<42} {before:10.2f} {now:10.2f} {before / now:13.2f} {abs(shown / was - 1):11.1e} {memory[given.other]:11.0f} {memory[given.program]:10.0f}",
              flush=True)


if __name__ == "__main__":
    main()
