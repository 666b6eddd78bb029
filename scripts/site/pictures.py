#!/usr/bin/python3
"""pictures.py PROGRAM [NAME...]   draws the pictures of docs/pictures: of the results of the program, of the reference values that the
tests compare with, and of frames and signs. All of them, or those named.

Pictures are kept in the repository; docs/pictures/drawn_from.json holds what each was drawn from (`--check` compares)."""

import csv
import hashlib
import inspect
import json
import math
import os
import subprocess
import sys
import tempfile

import numpy
import h5py
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plot  # noqa: E402
import signs  # noqa: E402

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
PICTURES = os.path.join(ROOT, "docs/pictures")
LEDGER = os.path.join(PICTURES, "drawn_from.json")
BLUE, RED, GREY, GREEN, VIOLET = "#1f4e9c", "#b3261e", "#5f6368", "#2e7d32", "#6a3fa0"
matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "hersey", "font.family": "sans-serif", "font.size": 9,
                            "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.alpha": 0.3})


def data(path):
    """Rows of a comma-separated file below the root, by column; comments left out."""
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return list(csv.DictReader((line for line in file if not line.startswith("#")), skipinitialspace=True))


def column(rows, name):
    return numpy.array([float(row[name]) for row in rows])


class Program:
    """The program under a folder for what it writes."""

    def __init__(self, path, folder):
        self.path, self.folder = os.path.abspath(path), folder

    def __call__(self, *arguments):
        run = subprocess.run([self.path, *arguments], text=True, capture_output=True, cwd=ROOT, check=False)
        if run.returncode:
            sys.exit(f"{' '.join(arguments)}\nended with {run.returncode}:\n{run.stderr}")
        return run.stdout

    def file(self, name):
        return os.path.join(self.folder, name)

    def run(self, name, model, *settings):
        """The results of a run, opened."""
        arguments = [word for setting in settings for word in ("--set", setting)]
        self("run", model, *arguments, "--output", self.file(name), "--force")
        return h5py.File(os.path.join(self.file(name), "results.h5"))


def tutorial_model(program):
    """The model that the tutorial's first page writes."""
    with open(os.path.join(ROOT, "docs/tutorial/first-bearing.md"), encoding="utf-8") as file:
        text = file.read().split("<<'END'\n")[1].split("\nEND\n")[0]
    with open(program.file("bearing.yaml"), "w", encoding="utf-8") as file:
        file.write(text)
    return program.file("bearing.yaml")


def first_bearing(program):
    """Pressure and gap at mid-width over the bearing angle, and the journal in the bore."""
    program("bearing", tutorial_model(program), "--fields", program.file("fields.csv"))
    with open(program.file("fields.csv"), encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file, skipinitialspace=True) if abs(float(row["z [mm]"])) < 1e-6]
    angle = column(rows, "angle [deg]")
    figure, (left, right) = plot.subplots(1, 2, figsize=(8, 3.2), gridspec_kw={"width_ratios": [2, 1]})
    left.fill_between(angle, column(rows, "pressure [MPa]"), color=BLUE, alpha=0.25)
    left.plot(angle, column(rows, "pressure [MPa]"), color=BLUE)
    left.set(xlabel="bearing angle [deg]", ylabel="pressure at mid-width [MPa]", xlim=(0, 360), xticks=range(0, 361, 60))
    gap = left.twinx()
    gap.plot(angle, column(rows, "film thickness [um]"), color=RED)
    gap.set(ylabel="film thickness [um]", ylim=(0, None))
    gap.grid(False)
    left.yaxis.label.set_color(BLUE)
    gap.yaxis.label.set_color(RED)
    signs.bore(right, epsilon=0.59, direction=-41.0, load=-90)
    return figure


def first_bearing_sweep(program):
    program("bearing", tutorial_model(program), "--sweep", "clearance=20um:90um:15", "--csv", program.file("sweep.csv"))
    with open(program.file("sweep.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file, skipinitialspace=True))
    clearance = column(rows, "bearings.main.radial_clearance [um]")
    figure, (left, right) = plot.subplots(1, 2, figsize=(8, 2.8))
    left.plot(clearance, column(rows, "h_min [um]"), "o-", color=BLUE, markersize=3)
    left.set(xlabel="radial clearance [um]", ylabel="smallest film [um]")
    right.plot(clearance, column(rows, "power_film [W]"), "o-", color=RED, markersize=3)
    right.set(xlabel="radial clearance [um]", ylabel="friction [W]", ylim=(0, None))
    return figure


def big_end(program):
    sizes = ("bearings.big_end.diameter=48mm", "bearings.big_end.width=18mm", "lubricants.oil.viscosity=10mPa.s", "simulation.step=1deg")
    runs = {"as it was": (program.run("before", "examples/slider_crank/model.yaml", "simulation.step=1deg"), GREY),
            "48 x 18 mm, 10 mPa.s": (program.run("mine", "examples/slider_crank/model.yaml", *sizes), BLUE)}
    figure, (left, right) = plot.subplots(1, 2, figsize=(8, 3.2), gridspec_kw={"width_ratios": [1, 2]})
    turn = numpy.linspace(0, 2 * math.pi, 100)
    left.plot(numpy.cos(turn), numpy.sin(turn), color="black", linewidth=0.8)
    for label, (results, colour) in runs.items():
        bearing = results["bearings/big_end"]
        c = bearing.attrs["radial_clearance"]
        path = bearing["eccentricity"][:]
        left.plot(path[:, 0] / c, path[:, 1] / c, color=colour, linewidth=0.9)
        right.plot(numpy.degrees(3000 * 2 * math.pi / 60 * results["time"][:]), 1e6 * bearing["h_min"][:], color=colour, label=label, linewidth=1)
    left.set(aspect="equal", xticks=[], yticks=[], title="path of the pin")
    left.title.set_fontsize(9)
    signs.bare(left, 1.1)
    right.set(xlabel="crank angle [deg]", ylabel="smallest film [um]", xlim=(0, 720), xticks=range(0, 721, 90), ylim=(0, 20))
    right.legend(frameon=False)
    return figure


def engine(program):
    results = program.run("engine", "examples/engine/model.yaml", "simulation.cycle.most=2", "simulation.step=1deg")
    figure, axes = plot.subplots(figsize=(8, 3.2))
    angle = numpy.degrees(3000 * 2 * math.pi / 60 * results["time"][:]) - 720
    for name, colour in (("big_end", BLUE), ("small_end", RED), ("main_left", GREEN), ("main_right", GREY)):
        axes.semilogy(angle, 1e6 * results[f"bearings/{name}/h_min"][:], color=colour, label=name, linewidth=1)
    axes.set(xlabel="crank angle in the second cycle [deg]", ylabel="smallest film [um]", xlim=(0, 720), xticks=range(0, 721, 90))
    axes.legend(frameon=False, ncol=4, loc="upper right")
    return figure


def flexible_rod(program):
    figure, axes = plot.subplots(figsize=(8, 3))
    coarse = ("simulation.step=2deg", "bearings.big_end.grid.circumferential=36", "bearings.big_end.grid.axial=7")
    for label, model, colour, more in (("rigid", "model.yaml", GREY, ("bearings.big_end.width=15.6mm",)), ("rod that bends", "flexible_rod.yaml", BLUE, ())):
        results = program.run(label.split()[0], f"examples/slider_crank/{model}", *coarse, *more)
        axes.plot(numpy.degrees(3000 * 2 * math.pi / 60 * results["time"][:]), 1e6 * results["bearings/big_end/h_min"][:], color=colour, label=label, linewidth=1)
    axes.set(xlabel="crank angle [deg]", ylabel="smallest film [um]", xlim=(0, 720), xticks=range(0, 721, 90), ylim=(0, 20))
    axes.legend(frameon=False)
    return figure


def rotor(program):
    results = program.run("rotor", "examples/flexible_rotor/model.yaml")
    position = results["bodies/disc/position"][:]
    figure, axes = plot.subplots(figsize=(8, 3))
    speed = numpy.linspace(0, 4500, len(position))  # from rest to 4500 rpm, evenly in 3 s
    axes.plot(speed, 1e3 * numpy.hypot(position[:, 0], position[:, 1]), color=BLUE, linewidth=1)
    axes.axvline(2119, color=RED, linestyle="--", linewidth=1)
    axes.annotate("critical speed", (2119, 1.6), (1300, 1.6), color=RED)
    axes.set(xlabel="speed [rpm]", ylabel="distance from the axis [mm]", xlim=(0, 4500), ylim=(0, None))
    return figure


def msh_sets(path):
    """Positions of the nodes of each physical group of a Gmsh file (format 4.1)."""
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        text = file.read()
    part = {name: text.split(f"${name}\n")[1].split(f"\n$End{name}")[0].splitlines() for name in ("PhysicalNames", "Entities", "Nodes", "Elements")}
    names = {(int(line.split()[0]), int(line.split()[1])): line.split('"')[1] for line in part["PhysicalNames"][1:]}
    counts, group, at = [int(word) for word in part["Entities"][0].split()], {}, 1
    for dimension, count in enumerate(counts):
        for line in part["Entities"][at:at + count]:
            words = line.split()[4 if dimension == 0 else 7:]
            group |= {(dimension, int(line.split()[0])): names[dimension, int(tag)] for tag in words[1:1 + int(words[0])]}
        at += count
    positions, at = {}, 1
    while at < len(part["Nodes"]):
        count = int(part["Nodes"][at].split()[3])
        tags, points = part["Nodes"][at + 1:at + 1 + count], part["Nodes"][at + 1 + count:at + 1 + 2 * count]
        positions |= {int(tag): [float(x) for x in point.split()[:3]] for tag, point in zip(tags, points)}
        at += 1 + 2 * count
    found, at = {}, 1
    while at < len(part["Elements"]):
        dimension, entity, _, count = map(int, part["Elements"][at].split())
        if (dimension, entity) in group:
            found.setdefault(group[dimension, entity], set()).update(
                int(tag) for line in part["Elements"][at + 1:at + 1 + count] for tag in line.split()[1:])
        at += 1 + count
    return {name: numpy.array([positions[tag] for tag in sorted(tags)]) for name, tags in found.items()}


def mesh(program):
    """Where the named sets of the rod's mesh are: the nodes seen along the bores."""
    printed = json.loads(program("mesh", "examples/meshes/conrod.msh", "--length-unit", "mm", "--json"))
    sets = msh_sets("examples/meshes/conrod.msh")
    figure, axes = plot.subplots(figsize=(8, 3.2))
    for name, colour, size in (("rod", GREY, 1), ("cap", VIOLET, 1), ("big_end", BLUE, 4), ("small_end", RED, 4)):
        points = sets[name]
        axes.plot(points[:, 1], points[:, 0], ".", color=colour, markersize=size, rasterized=True, label=f"{name}: {printed['sets']['nodes'][name]} nodes")
    axes.set(aspect="equal", xlabel="y [mm]", ylabel="x [mm]")
    axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1, 0.5), markerscale=3)
    return figure


def example_bearing_alone(program):
    program("bearing", "examples/bearing_alone/model.yaml", "--sweep", "speed=1rpm:10000rpm:17:log", "--csv", program.file("stribeck.csv"), "--no-grid-error")
    with open(program.file("stribeck.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file, skipinitialspace=True))
    figure, axes = plot.subplots(figsize=(4.8, 3))
    axes.loglog(column(rows, "hersey"), column(rows, "friction_journal"), "o-", color=BLUE, markersize=3)
    axes.set(xlabel="Hersey number", ylabel="friction coefficient")
    return figure


def report(program):
    """The first screen of a report, photographed in headless Chromium: a picture of its own, nothing for matplotlib."""
    page, picture = program.file("report.html"), os.path.join(PICTURES, "report.png")
    program("bearing", "examples/hot_bearing/model.yaml", "--report", page)
    subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--window-size=1180,850",
                    "--virtual-time-budget=8000", f"--screenshot={picture}", f"file://{page}"], capture_output=True, check=True)


def example_hot_bearing(program):
    figure, axes = plot.subplots(figsize=(4.8, 3))
    for model, colour, label in (("isothermal", GREY, "no heat"), ("global", GREEN, "one temperature"), ("model", RED, "film with temperature")):
        program("bearing", f"examples/hot_bearing/{model}.yaml", "--fields", program.file(f"{model}.csv"), "--no-grid-error")
        with open(program.file(f"{model}.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file, skipinitialspace=True))
        middle = min(abs(float(row["z [mm]"])) for row in rows)
        rows = [row for row in rows if abs(float(row["z [mm]"])) == middle]
        axes.plot(column(rows, "angle [deg]"), column(rows, "pressure [MPa]"), color=colour, label=label, linewidth=1)
    axes.set(xlabel="bearing angle [deg]", ylabel="pressure [MPa]", xlim=(0, 360), xticks=range(0, 361, 90))
    axes.legend(frameon=False)
    return figure


def example_piston(program):
    """A cycle of a piston: where it is, what its two sides bear, and what it loses."""
    results = program.run("piston", "examples/piston/model.yaml")
    skirt = results["bearings/skirt"]
    angle = numpy.degrees(3000 * 2 * math.pi / 60 * results["time"][:])
    figure, axes = plot.subplots(1, 3, figsize=(10, 2.9))
    axes[0].plot(angle, 1e6 * skirt["offset_top"][:], color=BLUE, label="top of the skirt")
    axes[0].plot(angle, 1e6 * skirt["offset_bottom"][:], color=RED, label="bottom of the skirt")
    axes[0].set(ylabel="towards the thrust side [um]")
    axes[1].plot(angle, skirt["side_force"][:], color=BLUE, label="side force")
    axes[1].plot(angle, 10 * skirt["skirt_friction"][:], color=RED, label="10 x friction force")
    axes[1].set(ylabel="force [N]")
    axes[2].plot(angle, 1e6 * skirt["h_min_thrust"][:], color=BLUE, label="thrust side")
    axes[2].plot(angle, 1e6 * skirt["h_min_antithrust"][:], color=RED, label="antithrust side")
    axes[2].set(ylabel="minimum film thickness [um]", ylim=(0, None))
    for axis in axes:
        axis.set(xlabel="crank angle [deg]", xlim=(0, 720), xticks=range(0, 721, 180))
        axis.legend(frameon=False, fontsize=8)
    figure.tight_layout()
    return figure


def example_start_stop(program):
    """A start and a stop: what carries the load over the speed, and what wears off meanwhile."""
    results = program.run("start_stop", "examples/start_stop/model.yaml")
    bush, time = results["bearings/bush"], results["time"][:]
    speed = 30 / math.pi * bush["speed"][:]
    contact = numpy.linalg.norm(bush["force_asperity"][:], axis=1)
    figure, axes = plot.subplots(1, 3, figsize=(10, 2.9))
    axes[0].plot(time, speed, color=GREY)
    axes[0].set(xlabel="time [s]", ylabel="speed [rpm]")
    up = time < 1
    axes[1].semilogy(speed[up], contact[up], color=BLUE, label="on the way up")
    axes[1].semilogy(speed[~up], contact[~up], color=RED, label="on the way down")
    axes[1].axhline(0.05 * 2000, color=GREY, linewidth=0.8, linestyle="--", label="5 % of the load")
    axes[1].set(xlabel="speed [rpm]", ylabel="asperities carry [N]", xlim=(0, 300), ylim=(1, None))
    axes[1].legend(frameon=False, fontsize=8)
    axes[2].plot(time, 1e9 * bush["worn_volume_fixed"][:], color=BLUE)
    axes[2].set(xlabel="time [s]", ylabel="worn by 1000 cycles [mm3]", ylim=(0, None))
    figure.tight_layout()
    return figure


def example_running_in(program):
    """A bush that runs in, with a roughness that stays and one that wears off."""
    figure, axes = plot.subplots(1, 3, figsize=(10, 2.9))
    for name, settings, colour, label in (("stays", (), GREY, "roughness stays"),
                                          ("falls", ("bearings.bush.wear.running_in={roughness: 0.3 um, depth: 0.5 um}",), BLUE, "roughness runs in")):
        results = program.run(name, "examples/wear/model.yaml", *settings)
        bush, hours = results["bearings/bush"], 5000 * results["time"][:] / 3600
        axes[0].semilogy(hours, bush["power_asperity"][:], color=colour, label=label)
        axes[1].plot(hours, 1e9 * bush["worn_volume_fixed"][:], color=colour)
        worn, phi, z = bush["fields/fixed_wear"][-1], bush["fields/phi"][:], bush["fields/z"][:]
        line = worn.max(axis=1).argmax()
        axes[2].plot(1e3 * z, 1e6 * worn[line], color=colour, label=f"at {math.degrees(phi[line]):.0f} deg")
    axes[0].set(xlabel="hours of running", ylabel="friction of contact [W]")
    axes[0].legend(frameon=False, fontsize=8)
    axes[1].set(xlabel="hours of running", ylabel="worn volume [mm3]", ylim=(0, None))
    axes[2].set(xlabel="along the axis [mm]", ylabel="worn depth in the end [um]", ylim=(0, None))
    axes[2].legend(frameon=False, fontsize=8)
    figure.tight_layout()
    return figure


def paper_case(program):
    """Settled states of the reference's finest grid against the steady solution of the same bearing."""
    rows = [row for row in data("verification/data/paper_case.csv")
            if row["compliance"] == "False" and row["condition"].startswith(("mass", "JFO", "Elrod", "Reynolds", "Swift"))]
    finest = max(int(row["n_theta"]) for row in rows)
    figure, axes = plot.subplots(1, 2, figsize=(8, 3))
    for c, colour in ((34.0, BLUE), (68.0, RED)):
        chosen = [row for row in rows if float(row["c_um"]) == c and int(row["n_theta"]) == finest]
        condition = chosen[0]["condition"]
        chosen = [row for row in chosen if row["condition"] == condition]
        load = column(chosen, "W_N")
        axes[0].plot(load, column(chosen, "ecc_ratio"), "o", color=colour, mfc="none", label=f"reference, c = {c:.0f} um")
        axes[1].plot(load, column(chosen, "pmax_MPa"), "o", color=colour, mfc="none")
        program("bearing", "examples/bearing_alone/model.yaml", "--set", "bearings.main.asperities={model: none}", "--set",
                f"bearings.main.radial_clearance={c}um", "--sweep", "load=" + ",".join(f"{w:.0f}N" for w in load),
                "--csv", program.file("paper.csv"), "--no-grid-error")
        with open(program.file("paper.csv"), encoding="utf-8") as file:
            found = list(csv.DictReader(file, skipinitialspace=True))
        axes[0].plot(load, column(found, "eccentricity_ratio"), color=colour, linewidth=1, label="hersey")
        axes[1].plot(load, column(found, "p_max [MPa]"), color=colour, linewidth=1)
    axes[0].set(xlabel="load [N]", ylabel="eccentricity ratio", ylim=(0, 1))
    axes[1].set(xlabel="load [N]", ylabel="peak pressure [MPa]", ylim=(0, None))
    axes[0].legend(frameon=False, fontsize=8)
    return figure


def benchmarks(_):
    figure, axes = plot.subplots(1, 2, figsize=(8, 2.8))
    rows = data("verification/data/four_bar_n2.csv")
    axes[0].plot(column(rows, "t"), column(rows, "B0x"), color=BLUE, label="x")
    axes[0].plot(column(rows, "t"), column(rows, "B0y"), color=RED, label="y")
    axes[0].set(xlabel="time [s]", ylabel="point B0 of two four-bars [m]")
    axes[0].legend(frameon=False)
    rows = data("verification/data/flyball_governor.csv")
    axes[1].plot(column(rows, "t"), column(rows, "s"), color=BLUE)
    axes[1].set(xlabel="time [s]", ylabel="sleeve of the governor [m]")
    return figure


def finite_360(program):
    figure, axes = plot.subplots(figsize=(5.5, 3))
    rows = data("verification/data/finite_360.csv")
    for ratio, colour in zip(sorted({float(row["L_over_D"]) for row in rows}), (BLUE, RED, GREEN, GREY)):
        chosen = [row for row in rows if float(row["L_over_D"]) == ratio]
        axes.semilogy(column(chosen, "epsilon"), column(chosen, "S"), "o", color=colour, mfc="none", label=f"reference, L/D = {ratio:g}")
        program("bearing", tutorial_model(program), "--set", f"bearings.main.width={60 * ratio}mm", "--set", "bearings.main.cavitation={model: reynolds, pressure: 0 bar}",
                "--set", "bearings.main.supply.pressure=0bar", "--sweep", "eccentricity_ratio=" + ",".join(row["epsilon"] for row in chosen),
                "--csv", program.file("finite.csv"), "--no-grid-error", "--eccentricity-angle", "-45deg")
        with open(program.file("finite.csv"), encoding="utf-8") as file:
            axes.semilogy(column(chosen, "epsilon"), column(list(csv.DictReader(file, skipinitialspace=True)), "sommerfeld_S"), color=colour, linewidth=1)
    axes.set(xlabel="eccentricity ratio", ylabel="Sommerfeld number S")
    axes.legend(frameon=False, fontsize=8)
    return figure


def bearing_signs(_):
    return signs.bearing_signs()


def frame_signs(_):
    return signs.frame_signs()


DRAWN = (first_bearing, first_bearing_sweep, big_end, engine, flexible_rod, rotor, mesh, example_bearing_alone, report, example_hot_bearing,
         example_piston, example_start_stop, example_running_in, paper_case, benchmarks, finite_360, bearing_signs, frame_signs)
SOURCES = {"first_bearing": ["docs/tutorial/first-bearing.md"], "first_bearing_sweep": ["docs/tutorial/first-bearing.md"],
           "big_end": ["examples/slider_crank/model.yaml"], "engine": ["examples/engine/model.yaml"],
           "flexible_rod": ["examples/slider_crank/flexible_rod.yaml", "examples/meshes/conrod.msh"],
           "rotor": ["examples/flexible_rotor/model.yaml"], "mesh": ["examples/meshes/conrod.msh"],
           "example_bearing_alone": ["examples/bearing_alone/model.yaml"], "report": ["examples/hot_bearing/model.yaml"],
           "example_hot_bearing": ["examples/hot_bearing/model.yaml"],
           "example_piston": ["examples/piston/model.yaml", "examples/slider_crank/gas_pressure.csv"],
           "example_start_stop": ["examples/start_stop/model.yaml"], "example_running_in": ["examples/wear/model.yaml"],
           "paper_case": ["verification/data/paper_case.csv"], "finite_360": ["verification/data/finite_360.csv"],
           "benchmarks": ["verification/data/four_bar_n2.csv", "verification/data/flyball_governor.csv"],
           "bearing_signs": ["scripts/site/signs.py"], "frame_signs": ["scripts/site/signs.py"]}


def drawn_from(function):
    """What a picture depends on besides the program: its function and the files it reads."""
    text = hashlib.sha256(inspect.getsource(function).encode())
    for path in SOURCES[function.__name__]:
        with open(os.path.join(ROOT, path), "rb") as file:
            text.update(file.read())
    return text.hexdigest()[:16]


def is_there(name):
    return any(os.path.exists(os.path.join(PICTURES, name + ending)) for ending in (".svg", ".png"))


def main():
    if sys.argv[1:] == ["--check"]:
        with open(LEDGER, encoding="utf-8") as file:
            ledger = json.load(file)
        stale = [f.__name__ for f in DRAWN if ledger.get(f.__name__) != drawn_from(f) or not is_there(f.__name__)]
        sys.exit(f"docs/pictures: {', '.join(stale)} no longer as drawn; run: make pictures" if stale else 0)
    names = sys.argv[2:]
    ledger = {}
    if os.path.exists(LEDGER):
        with open(LEDGER, encoding="utf-8") as file:
            ledger = json.load(file)
    with tempfile.TemporaryDirectory() as folder:
        program = Program(sys.argv[1], folder)
        for function in DRAWN:
            name = function.__name__
            if names and name not in names or not names and ledger.get(name) == drawn_from(function):
                continue
            figure = function(program)
            if figure is not None:
                figure.tight_layout()
                figure.savefig(os.path.join(PICTURES, f"{name}.svg"), metadata={"Date": None})
                plot.close(figure)
            ledger[name] = drawn_from(function)
            print(name, flush=True)
            with open(LEDGER, "w", encoding="utf-8") as file:
                json.dump(dict(sorted(ledger.items())), file, indent=1)
                file.write("\n")


if __name__ == "__main__":
    main()
