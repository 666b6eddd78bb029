#!/usr/bin/python3
"""Refinement of step and grids: what the figures of a run depend on, and with which order they converge.

    refinement.py HERSEY rig [SERIES ...]      examples/flexible_big_end, 240 degrees of crank angle from its start
    refinement.py HERSEY engine [SERIES ...]   examples/engine/flexible.yaml, the first 540 degrees, ignition at 360

SERIES are step, grid, modes and, of the rig, full-film-step (Guembel's condition: no fill is carried, the equations are
smooth in time) and mesh (which calls gmsh); without any, all but mesh. Results lie below
build/refinement, runs that exist there are not repeated. Prints a table per series. Levels go down by a factor of two; of
each three that follow each other

    order = log2((a - b)/(b - c)),   limit = c + (c - b)/(2^order - 1)   (Richardson),

both where a - b and b - c have the same sign and shrink. The last column is the finest level's distance from its limit.
"""

import os
import subprocess
import sys

import h5py
import numpy

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


class Case:
    """One machine: its model, what every run sets, and the figures taken from a run."""

    def __init__(self, model, settings, bearing, since, instants, series):
        self.model, self.settings, self.bearing, self.series = model, settings, bearing, series
        self.since, self.instants = since, instants  # extremes and losses count from `since` on [deg of crank angle]


def rig():
    # From nothing to 2500 N over 90 degrees, smoothly: the start neither rings nor depends on the step.
    smooth_push = ("{type: force, body: rod.small_end, direction: 0 -1 0, axes: ground, magnitude: {unit: N, "
                   "expression: '(main.rotation < pi/2) ? 2500*(main.rotation*2/pi)^3*"
                   "(10 - 15*main.rotation*2/pi + 6*(main.rotation*2/pi)^2) : 2500'}}")
    grid = "bearings.big_end.grid={{circumferential: {}, axial: {}}}"
    return Case(
        "examples/flexible_big_end/model.yaml",
        ["load=2500N", "variant=mesh", "simulation.duration=240deg", "simulation.step=1deg",
         "output.fields_every=240deg", f"forces.push={smooth_push}"],
        "big_end",
        0,
        (60, 120, 240),
        {
            "step": [(f"{s} deg", [f"simulation.step={s}deg"]) for s in (4, 2, 1, 0.5, 0.25, 0.125)],
            "full-film-step": [(f"{s} deg", [f"simulation.step={s}deg", "bearings.big_end.cavitation=guembel"])
                               for s in (4, 2, 1, 0.5, 0.25, 0.125)],
            "grid": [(f"{n} x {m}", [grid.format(n, m), "simulation.step=2deg"])
                     for n, m in ((30, 7), (60, 13), (120, 25), (240, 49))],
            "modes": [(f"{m} film modes", ["bearings.big_end.shell_surface={faces: big_end, modes: %d}" % m])
                      for m in (10, 20, 40, 80, 160)],
            # So many film modes that the mesh alone makes the difference.
            "mesh": [(f"size {s} mm", [f"bodies.rod.flexible.mesh={mesh_of_size(s)}", "simulation.step=2deg",
                                       "bearings.big_end.shell_surface={faces: big_end, modes: 160}"])
                     for s in (16, 8, 4)],
        })


def engine():
    films = {"main_left": (48, 9), "main_right": (48, 9), "big_end": (60, 13), "small_end": (48, 9)}

    def grids(factor):
        return [f"bearings.{name}.grid={{circumferential: {int(n * factor)}, axial: {int((m - 1) * factor) + 1}}}"
                for name, (n, m) in films.items()]

    def modes(big, small):
        return [f"bearings.big_end.shell_surface={{faces: big_end, modes: {big}}}",
                f"bearings.small_end.shell_surface={{faces: small_end, modes: {small}}}"]

    return Case(
        "examples/engine/flexible.yaml",
        ["simulation.cycle={period: 540 deg, until_converged: 0.02, most: 1}", "simulation.step=1deg",
         "output.fields_every=360deg"],
        "big_end",
        180,
        (300, 390, 540),
        {
            "step": [(f"{s} deg", [f"simulation.step={s}deg"] + grids(0.5) + modes(40, 30))
                     for s in (1, 0.5, 0.25, 0.125)],
            "grid": [(f"{int(60 * f)} x {int(12 * f) + 1}", grids(f) + modes(40, 30)) for f in (0.5, 1, 2)],
            "modes": [(f"{b} + {s} film modes", modes(b, s) + grids(0.5))
                      for b, s in ((10, 8), (20, 15), (40, 30), (60, 45), (80, 60), (160, 120))],
        })


def mesh_of_size(size):
    return os.path.join(SOURCE, f"build/refinement/conrod-{size}.msh")


def make_mesh(path):
    """The connecting rod in elements of the size named in the path."""
    if os.path.exists(path):
        return
    size = os.path.basename(path)[len("conrod-"):-len(".msh")]
    os.makedirs(os.path.dirname(path), exist_ok=True)
    subprocess.run(["gmsh", "-3", "-v", "2", os.path.join(SOURCE, "examples/meshes/conrod.geo"),
                    "-setnumber", "size", size, "-o", path], check=True)


def run(hersey, case, name, settings):
    """The results file of a run, made unless it exists."""
    output = os.path.join(SOURCE, "build/refinement", name)
    results = os.path.join(output, "results.h5")
    for setting in settings:
        key, value = setting.split("=", 1)
        if key.endswith(".mesh"):
            make_mesh(value)
    if os.path.exists(results) and is_complete(results):
        return results
    command = [hersey, "run", os.path.join(SOURCE, case.model), "--output", output, "--force"]
    for setting in case.settings + settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}\nended with {done.returncode}:\n{done.stderr}")
    return results


def is_complete(results):
    with h5py.File(results) as file:
        return file.attrs.get("status") in ("completed", b"completed")


def figures(results, case):
    """Name -> (value, unit): extremes of the run, and values at instants that every step size meets."""
    with h5py.File(results) as file:
        bearing = file["bearings"][case.bearing]
        angle, time = numpy.degrees(file["crank_angle"][:]), file["time"][:]
        counts = angle >= case.since - 1e-6
        loss = bearing["power_film"][:] + bearing["power_asperity"][:]
        found = {
            "smallest film [um]": 1e6 * bearing["h_min"][:][counts].min(),
            "peak pressure [MPa]": 1e-6 * bearing["p_max"][:][counts].max(),
            "friction loss [J]": numpy.trapz(loss[counts], time[counts]),
        }
        for instant in case.instants:
            row = int(numpy.argmin(abs(angle - instant)))
            if abs(angle[row] - instant) > 1e-6:
                continue
            found[f"eccentricity ratio at {instant} deg"] = bearing["eccentricity_ratio"][row]
            found[f"smallest film at {instant} deg [um]"] = 1e6 * bearing["h_min"][row]
            found[f"peak pressure at {instant} deg [MPa]"] = 1e-6 * bearing["p_max"][row]
    return found


def order_of(a, b, c):
    """Observed order and Richardson's limit; None where the three do not approach one."""
    first, second = a - b, b - c
    if second == 0 or first / second <= 1:
        return None, None
    ratio = first / second
    return numpy.log2(ratio), c - second / (ratio - 1)


def print_table(title, labels, columns):
    """A row per figure, a column per level; orders of the triplets and the error left at the finest level."""
    print(f"\n{title}\n")
    print("| figure | " + " | ".join(labels) + " | orders | left |")
    print("|---|" + "---|" * (len(labels) + 2))
    for name in columns[0]:
        values = [column.get(name) for column in columns]
        if any(value is None for value in values):
            continue
        triplets = [order_of(*values[k:k + 3]) for k in range(len(values) - 2)]
        orders = ", ".join("-" if order is None else f"{order:.1f}" for order, _ in triplets)
        limit = triplets[-1][1] if triplets else None
        left = "-" if limit is None else f"{abs(values[-1] / limit - 1):.1e}"
        print(f"| {name} | " + " | ".join(f"{value:.6g}" for value in values) + f" | {orders} | {left} |")


def main():
    if len(sys.argv) < 3 or sys.argv[2] not in ("rig", "engine"):
        raise SystemExit(__doc__)
    hersey, which = os.path.abspath(sys.argv[1]), sys.argv[2]
    case = {"rig": rig, "engine": engine}[which]()
    for series in sys.argv[3:] or [name for name in case.series if name != "mesh"]:
        labels, columns = [], []
        for label, settings in case.series[series]:
            name = f"{which}-{series}-{label.replace(' ', '_')}"
            labels.append(label)
            columns.append(figures(run(hersey, case, name, settings), case))
        print_table(f"{case.model}, {series}", labels, columns)


if __name__ == "__main__":
    main()
