"""Random bearings whose journal goes round a given orbit: films in time by hersey and by the second film solver, each with bounds.

The orbit is a drive's, so that both films see the same gap at every instant, and forces, torques, flows and oil are compared along it.
"""

import math
import os
import random
from dataclasses import dataclass

import comparison  # finds the second solver
import h5py
import program as hersey
import second_film
from comparison import Comparison
from figures import figures
from film import Motion, NoAnswer, march
from model_text import deg, number, rpm, yaml
from read_model import read

# Where figures are compared, in parts of the orbit.
INSTANTS = (0.25, 0.5, 0.75, 1.0)

# Steps in one orbit of the finest films of each; both also on half and a quarter of them.
STEPS, STEPS_SMALL = 96, 48

PARTS = (4, 2, 1)

# An error of first order in time is what the last halving changed; half more is for what is of higher order.
HIGHER = 1.5

# A machine's film was full this long before it starts: FilmForceOptions::initial_dt [s].
FILLED = 1e-4


@dataclass
class Orbit:
    """A steady case whose journal sets out from its position with no speed, round an ellipse, once in `period` [m, s]."""

    case: object
    radii: tuple
    period: float

    def centre(self, t):
        angle = 2 * math.pi * t / self.period
        x, y = self._start()
        return x + self.radii[0] * (1 - math.cos(angle)) / 2, y + self.radii[1] * (angle - math.sin(angle)) / (2 * math.pi)

    def _start(self):
        b = self.case.bearing
        ratio, angle = self.case.position
        return ratio * b.c * math.cos(angle), ratio * b.c * math.sin(angle)

    def text(self, steps):
        b, speed = self.case.bearing, rpm(self.case.journal_speed)
        turn = f"2*pi*t/{number(self.period)}"
        (x, y), (a, c) = self._start(), self.radii
        along = {"x": f"{number(x)} + {number(a)}*(1 - cos({turn}))/2", "y": f"{number(y)} + {number(c)}*({turn} - sin({turn}))/(2*pi)"}
        drives = {"motor": {"joint": "bench", "coordinate": "rotation", "speed": speed}}
        drives |= {k: {"joint": "bench", "coordinate": k, "position": {"expression": e, "unit": "m"}} for k, e in along.items()}
        inertia = {"xx": "1e-3 kg.m^2", "yy": "1e-3 kg.m^2", "zz": "1e-3 kg.m^2"}
        initial = {"x": f"{number(1e6 * x)} um", "y": f"{number(1e6 * y)} um", "rotation": deg(self.case.journal_angle), "rotation_rate": speed}
        return yaml({
            "hersey": 1, "bodies": {"shaft": {"mass": "1 kg", "inertia": inertia}},
            "joints": {"bench": {"type": "planar", "between": ["ground", "shaft"], "axis": "z", "initial": initial}},
            "drives": drives, "lubricants": {"oil": b.lubricant()},
            "bearings": {"main": {"shell": "ground", "journal": "shaft"} | b.text()},
            "simulation": {"duration": f"{number(1e3 * self.period)} ms", "step": f"{number(1e3 * self.period / steps)} ms"}})


def drawn(rng, is_small):
    """An orbit of what the second solver knows in time: an incompressible oil, feeds that stay where they are."""
    while True:
        case = comparison.within_reach(rng, is_small)
        b = case.bearing
        b.coupling = None
        case.shell_speed, case.radial_velocity, case.load, case.tilt = 0.0, 0.0, None, (0.0, 0.0)
        travels = any(f.on == "journal" for f in b.features) or any(p.on == "journal" and p.kind == "lobes" for p in b.profiles)
        if b.is_compressible or b.bulk_modulus or travels or b.supply and b.supply[0] == "widest_gap" or not case.journal_speed:
            continue
        room = b.room() / b.c
        case.position = (rng.uniform(0, 0.5) * room, rng.uniform(-math.pi, math.pi))
        size = rng.uniform(0.1, 0.4) * b.room()
        period = rng.uniform(0.5, 3) * 2 * math.pi / abs(case.journal_speed)
        return Orbit(case, (size, rng.choice([-1, 1]) * size * rng.uniform(0.3, 1)), period)


def by_hersey(program, orbit, folder, steps):
    """[{figure: (value, error)}] at the instants."""
    b = orbit.case.bearing
    along = 16
    around = min(max(2 * round(math.pi * b.R / b.L * along), 48), 192)
    answers = []
    for part in PARTS:
        finer = Orbit(comparison.on_nodes(orbit.case, 2 * around // part, 2 * along // part + 1), orbit.radii, orbit.period)
        path = os.path.join(folder, f"in_time_{part}.yaml")
        hersey.write(path, finer.text(steps // part))
        output = os.path.join(folder, f"results_{part}")
        ending = hersey.run(program, "run", path, "--output", output, "--force")
        if ending.kind == "refused" and part == PARTS[0]:
            continue  # too coarse for its features
        if ending.kind != "answer":
            raise NoAnswer(f"hersey: {ending.kind}: {ending.text}")
        answers.append(instants_of(os.path.join(output, "results.h5"), steps // part))
    return bounded([answers[0], *answers][-3:])


def instants_of(path, steps):
    with h5py.File(path) as file:
        rows = file["bearings/main"]
        names = ("torque_journal", "torque_shell", "power_film", "flow_left", "flow_right", "p_max", "h_min")
        found = []
        for part in INSTANTS:
            k = round(part * steps)
            found.append({name: float(rows[name][k]) for name in names} | {"fill_volume": float(rows["oil_volume"][k])})
            found[-1] |= {"force_x": float(rows["force"][k][0]), "force_y": float(rows["force"][k][1])}
        return found


def by_the_second(orbit, folder, rows, steps):
    path = os.path.join(folder, "steady.yaml")
    hersey.write(path, orbit.case.text())
    bearing, start, _ = read(path)
    columns = second_film.mesh_size(bearing, rows)
    answers = []
    for part in PARTS:
        count = steps // part
        times = [k * orbit.period / count for k in range(count + 1)]
        motion = lambda t: Motion(orbit.centre(t), journal=start.journal)
        films = march(bearing, motion, times, max(columns // part, 12), max(rows // part, 2), FILLED)
        wanted = {round(part * count) for part in INSTANTS}
        answers.append([moving_figures(film) for k, film in enumerate(films, 1) if k in wanted])
    return bounded(answers)


def moving_figures(film):
    """Figures of a film in time, its force on the shell by components."""
    found = figures(film)
    return found | {"force_x": found["load"] * math.cos(found["load_angle"]), "force_y": found["load"] * math.sin(found["load_angle"])}


def bounded(answers):
    """From answers with a quarter, half and all of the cells and steps: the last, with how far it may be off."""
    return [{key: (c[key], HIGHER * second_film.spread(a[key], b[key], c[key])) for key in c} for a, b, c in zip(*answers)]


def compare(orbit, one, other):
    """[(figure, text)] of what differs by more than both bounds, and {figure: difference over what is allowed}."""
    b = orbit.case.bearing
    omega = abs(orbit.case.journal_speed)
    load = max(max(math.hypot(a["force_x"][0], a["force_y"][0]) for a in one), 5e-3 * max(a["p_max"][0] for a in one) * b.R * b.L)
    torque = max(max(abs(a["torque_shell"][0]), abs(a["torque_journal"][0])) for a in one)
    scales = {"force_x": load, "force_y": load, "torque_journal": max(torque, load * b.c), "torque_shell": max(torque, load * b.c),
              "power_film": max(a["power_film"][0] for a in one), "h_min": b.c}
    if not any(f.pressure is None for f in b.features):
        scales["p_max"] = max(max(a["p_max"][0] for a in one) - b.p_cav, 1e3)
    if b.cavitation == "mass_conserving":
        scales["fill_volume"] = 2 * math.pi * b.R * b.L * b.c
        if not comparison.bearings.reservoirs_touch(b):
            scales["flow_left"] = scales["flow_right"] = omega * b.R * b.c * b.L
    off, ratios = [], {}
    for when, a, c in zip(INSTANTS, one, other):
        for key, scale in scales.items():
            value = a[key][0] - (b.p_cav if key == "p_max" else 0.0)
            allowed = a[key][1] + c[key][1] + (comparison.UNSEEN + comparison.CURVATURE * b.c / b.R) * scale
            ratio = abs(value - c[key][0]) / allowed
            ratios[key] = max(ratios.get(key, 0.0), ratio)
            if not ratio <= 1:
                off.append((key, f"{value:.6g} +- {a[key][1]:.2g} and {c[key][0]:.6g} +- {c[key][1]:.2g} after {when} of the orbit"))
    return off, ratios


def examine(program, seed, name, folder, is_small=False):
    """One case by its name."""
    orbit = drawn(random.Random(f"{seed}/{name}"), is_small)
    rows, steps = (comparison.ROWS_SMALL, STEPS_SMALL) if is_small else (comparison.ROWS, STEPS)
    text = orbit.text(steps)
    try:
        other = by_the_second(orbit, folder, rows, steps)
        one = by_hersey(program, orbit, folder, steps)
    except NoAnswer as error:
        return Comparison("one has no answer", str(error), text)
    off, ratios = compare(orbit, one, other)
    return Comparison("answer", "", text, off, ratios)
