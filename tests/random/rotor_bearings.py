#!/usr/bin/python3
"""Random bores of arcs, hybrid bearings, tilting pads and thrust bearings, fixed and tilting: answers that must not depend on how a bearing is written down.

    rotor_bearings.py HERSEY [--seed S] [--count N] [--only NAME] [--output DIR]

Each bearing is solved as it is, turned about its axis, mirrored with its sense of rotation, and again from the other side: a position that a
load found must carry that load. A case that fails is left in the folder of `--output` with the command that repeats it.
"""

import argparse
import json
import math
import os
import random
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import program  # noqa: E402

SAME = 2e-5  # relative difference that two writings of one bearing may have: searches end at 1e-6 and better
SCALARS = ("load", "h_min", "p_max", "power_film", "oil_volume", "torque_journal", "torque_runner", "side_flow", "eccentricity_ratio",
           "film_thickness_axis", "stiffness", "damping", "cavitated_share", "reynolds_max")
MATRICES = ("K", "C", "stiffness", "damping")


def degrees(value):
    return f"{value:.10g} deg"


def oil(rng):
    return {"viscosity": f"{rng.choice([4, 10, 20, 60])} mPa.s", "density": "860 kg/m^3"}


def cavitation(rng):
    return rng.choice(["mass_conserving", "mass_conserving", "reynolds", "guembel"])


def film_keys(rng, speed):
    keys = {"cavitation": cavitation(rng), "lubricant": "oil"}
    if rng.random() < 0.25:
        keys["turbulence"] = rng.choice(["ng_pan", "constantinescu", "hirs"])
    return keys


class Case:
    """A bearing that can be written as it is, turned by an angle [deg], or mirrored."""

    def __init__(self, rng):
        self.oil = oil(rng)
        self.speed = rng.choice([1000, 3000, 8000]) * rng.choice([1, 1, -1])
        self.film = film_keys(rng, self.speed)

    def text(self, turn=0.0, mirror=False, point=None):
        bearing = {**self.film, **self.keys(turn, mirror), "operating_point": {**self.point(turn, mirror), **(point or {})}}
        return json.dumps({"hersey": 1, "lubricants": {"oil": self.oil}, "bearings": {"b": bearing}})


class Journal(Case):
    """What bores of arcs and tilting pads have in common."""

    def __init__(self, rng):
        super().__init__(rng)
        self.diameter, self.slenderness = rng.choice([30, 100, 250]), rng.choice([0.3, 0.5, 1.0])
        self.clearance = self.diameter * rng.choice([0.8, 1.2, 2.0]) / 2000  # [mm]
        self.direction = rng.uniform(-180, 180)
        mu, omega = float(self.oil["viscosity"].split()[0]) * 1e-3, abs(self.speed) * math.pi / 30
        radius, c = self.diameter / 2000, self.clearance / 1000
        unit = mu * omega * (radius / c) ** 2 * 2 * radius * 2 * radius * self.slenderness
        self.load = unit * 10 ** rng.uniform(-1.3, -0.2)

    def size(self):
        return {"diameter": f"{self.diameter} mm", "width": f"{self.diameter * self.slenderness} mm",
                "radial_clearance": f"{self.clearance:.10g} mm", "grid": {"circumferential": 72, "axial": 9}}

    def point(self, turn, mirror):
        angle = self.direction + turn
        return {"journal_speed": f"{-self.speed if mirror else self.speed} rpm", "load": f"{self.load:.12g} N",
                "load_angle": degrees(-angle if mirror else angle)}

    @staticmethod
    def position(figures):
        return {"load": "none", "eccentricity_ratio": f"{figures['eccentricity_ratio']:.15g}",
                "eccentricity_angle": f"{figures['eccentricity_angle']:.15g} rad"}


class Arcs(Journal):
    def __init__(self, rng):
        super().__init__(rng)
        count = rng.randint(1, 5)
        widest = 360 / count
        self.film["shear_force"] = rng.choice(["full", "torque_only"])
        self.arcs = []
        below = self.direction  # one arc carries the load
        for k in range(count):
            arc = rng.uniform(0.5, 0.9) * min(widest, 200)
            self.arcs.append({"middle": below + k * widest + rng.uniform(-0.05, 0.05) * widest, "arc": arc,
                              "preload": rng.uniform(-0.2, 0.6), "offset": rng.uniform(0.3, 0.8)})

    def keys(self, turn, mirror):
        arcs = {}
        for k, arc in enumerate(self.arcs):
            middle = arc["middle"] + turn
            arcs[f"a{k}"] = {"middle": degrees(-middle if mirror else middle), "arc": degrees(arc["arc"]), "preload": arc["preload"],
                             "offset": 1 - arc["offset"] if mirror else arc["offset"]}
        return {**self.size(), "arcs": arcs}


class Hybrid(Journal):
    """Recesses behind restrictors in a whole bore: turned by steps of its grid, which does not turn."""

    step = 5.0

    def __init__(self, rng):
        super().__init__(rng)
        if self.film["cavitation"] == "mass_conserving":
            self.film["ambient_fill"] = 1
        supply = rng.choice([10, 40, 120])  # [bar]
        area = self.diameter**2 * self.slenderness * 1e-6
        self.load = supply * 1e5 * area * rng.uniform(0.02, 0.25)
        size = (self.diameter / 100, self.slenderness)
        count, first = rng.randint(2, 5), rng.uniform(0, 360)
        law = rng.choice([{"type": "capillary", "length": "40 mm", "diameter": f"{rng.uniform(0.4, 1.2) * size[0]:.6g} mm"},
                          {"type": "orifice", "diameter": f"{rng.uniform(0.2, 0.8) * size[0]:.6g} mm"},
                          {"type": "constant_flow", "flow": f"{rng.uniform(0.02, 1) * size[0] ** 2:.6g} l/min"}])
        self.recesses = {f"r{k}": {"angle": first + 360 / count * k, "arc": rng.uniform(0.3, 0.7) * 360 / count,
                                   "length": rng.uniform(0.4, 0.7) * self.diameter * self.slenderness,
                                   "pressure": supply, "restrictor": law} for k in range(count)}

    def keys(self, turn, mirror):
        features = {}
        for name, recess in self.recesses.items():
            angle = recess["angle"] + turn
            features[name] = {"shape": "pocket", "angle": degrees(-angle if mirror else angle), "arc": degrees(recess["arc"]),
                              "length": f"{recess['length']:.12g} mm", "pressure": f"{recess['pressure']} bar",
                              "restrictor": recess["restrictor"]}
        return {**self.size(), "features": features}


class Pads(Journal):
    def __init__(self, rng):
        super().__init__(rng)
        self.film["shear_force"] = rng.choice(["full", "none"])
        self.count = rng.randint(3, 6)
        self.arc = rng.uniform(0.55, 0.88) * 360 / self.count
        self.preload, self.offset = rng.uniform(0.2, 0.6), rng.uniform(0.48, 0.62)
        if self.speed < 0:
            self.offset = 1 - self.offset
        self.lies = rng.choice(["between_pads", "on_pad"])
        self.pivot = rng.choice([{"type": "rigid"}, {"type": "spring", "stiffness": f"{self.load / self.clearance * 2e4:.6g} N/m"},
                                 {"type": "rigid", "pitch": "yes"}])
        self.ratio = rng.choice([0, 0.5, 1])

    def keys(self, turn, mirror):
        angle = self.direction + turn
        offset = 1 - self.offset if mirror else self.offset
        return {**self.size(), "kind": "tilting_pad", "pivot": self.pivot,
                "pads": {"count": self.count, "arc": degrees(self.arc), "preload": self.preload, "offset": offset, "load": self.lies,
                         "load_angle": degrees(-angle if mirror else angle)}}

    def point(self, turn, mirror):
        return {**super().point(turn, mirror), "whirl_ratio": self.ratio}


class Thrust(Case):
    def __init__(self, rng):
        super().__init__(rng)
        self.inner, self.outer = 50.0, 50 * rng.choice([1.4, 2.0, 3.0])
        self.count = rng.randint(1, 8)
        self.arc = rng.uniform(0.5, 0.9) * 360 / self.count
        self.sense = "positive" if self.speed > 0 else "negative"
        rise = rng.choice([10, 30, 60])
        self.shape = rng.choice([[{"profile": "ramp", "rise": f"{rise} um", "arc": degrees(self.arc * 0.8)}],
                                 [{"profile": "ramp", "rise": f"{rise} um"}],
                                 [{"profile": "ramp", "rise": f"{rise} um"}, {"profile": "barrel", "drop": "3 um"}]])
        self.first = rng.uniform(0, 360)
        self.tilt = (rng.uniform(-1e-4, 1e-4), rng.uniform(-1e-4, 1e-4))
        self.load = 1e3 * 10 ** rng.uniform(-0.5, 0.7)

    def keys(self, turn, mirror):
        sectors = {}
        for k in range(self.count):
            middle = self.first + turn + 360 / self.count * k
            sectors[f"p{k}"] = {"middle": degrees(-middle if mirror else middle), "arc": degrees(self.arc)}
        sense = {"positive": "negative", "negative": "positive"}[self.sense] if mirror else self.sense
        return {"kind": "thrust", "inner_diameter": f"{2 * self.inner} mm", "outer_diameter": f"{2 * self.outer} mm", "sectors": sectors,
                "sense": sense, "shape": self.shape, "grid": {"along": 21, "radial": 11}}

    def point(self, turn, mirror):
        angle = math.radians(turn)
        x = self.tilt[0] * math.cos(angle) - self.tilt[1] * math.sin(angle)
        y = self.tilt[0] * math.sin(angle) + self.tilt[1] * math.cos(angle)
        return {"speed": f"{-self.speed if mirror else self.speed} rpm", "load": f"{self.load:.12g} N",
                "tilt_x": f"{math.atan(x):.15g} rad", "tilt_y": f"{math.atan(-y if mirror else y):.15g} rad"}

    @staticmethod
    def position(figures):
        return None


class ThrustPads(Thrust):
    """A collar on pads on pivots."""

    def __init__(self, rng):
        super().__init__(rng)
        self.shape = [{"profile": "crown", "drop": f"{rng.choice([0, 3, 10])} um"}]
        # Pads that have a wedge: of small arcs, their pivots behind and outside their middles.
        self.count = rng.randint(5, 9)
        self.arc = rng.uniform(0.6, 0.9) * 360 / self.count
        self.offset, self.radius = rng.uniform(0.57, 0.65), self.inner + (self.outer - self.inner) * rng.uniform(0.5, 0.57)
        self.pivot = rng.choice([{"type": "rigid"}, {"type": "rigid", "form": "line"},
                                 {"type": "spring", "stiffness": f"{self.load * 1e5:.6g} N/m"}])
        self.ratio = rng.choice([0, 0.5, 1])
        self.film["shear_force"] = rng.choice(["full", "none"])
        self.density = rng.choice([0, 7850])

    def keys(self, turn, mirror):
        keys = super().keys(turn, mirror)
        first = self.first + turn
        pads = {"count": self.count, "arc": degrees(self.arc), "offset": self.offset, "pivot_radius": f"{self.radius:.12g} mm",
                "angle": degrees(-first if mirror else first), "thickness": "5 mm",
                "density": f"{self.density} kg/m^3"}
        return {**{key: value for key, value in keys.items() if key != "sectors"}, "kind": "tilting_pad_thrust", "pads": pads,
                "pivot": self.pivot}

    def point(self, turn, mirror):
        return {**super().point(turn, mirror), "whirl_ratio": self.ratio}

    @staticmethod
    def position(figures):
        return {"load": "none", "film_thickness": f"{figures['film_thickness_axis']:.15g} m"}


KINDS = {"arcs": Arcs, "hybrid": Hybrid, "pads": Pads, "thrust": Thrust, "thrust_pads": ThrustPads}


def solved(hersey, case, folder, **writing):
    path = os.path.join(folder, "case.yaml")
    program.write(path, case.text(**writing))
    ending = program.run(hersey, "bearing", path, "--json", "--no-grid-error")
    if ending.kind != "answer":
        return ending, {}
    figures = ending.document["solutions"][0]["figures"]
    return ending, {key: figure["value"] for key, figure in figures.items() if isinstance(figure["value"], float)}


def differences(one, other):
    """Figures that should be equal and are not."""
    found = []
    for key in SCALARS:
        if key not in one or key not in other:
            continue
        size = 1.0 if key.endswith("_share") else max(abs(one[key]), 1e-300)
        if abs(abs(one[key]) - abs(other[key])) > SAME * size:
            found.append(f"{key}: {one[key]:.9g}, {other[key]:.9g}")
    for matrix in MATRICES[:2]:
        entries = [f"{matrix}_{i}{j}" for i in "xy" for j in "xy"]
        if any(entry not in one or entry not in other for entry in entries):
            continue
        size = max(abs(one[entry]) for entry in entries)
        # Fronts of cavities that lie between other lines change coefficients more than forces.
        found += [f"{entry}: {one[entry]:.9g}, {other[entry]:.9g}" for entry in entries
                  if abs(abs(one[entry]) - abs(other[entry])) > 50 * SAME * size]
    return found


def examine(hersey, seed, name, output):
    """(ending, text, findings) of one case."""
    rng = random.Random(f"{seed}-{name}")
    case = KINDS[name.split("-")[0]](rng)
    folder = os.path.join(output, name)
    os.makedirs(folder, exist_ok=True)
    ending, figures = solved(hersey, case, folder)
    text = case.text()
    if ending.kind != "answer":
        return ending.kind, ending.text, [], text
    findings = []
    if not all(math.isfinite(value) for value in figures.values()):
        findings.append("figures that are no numbers")
    angle = rng.uniform(10, 350)
    if step := getattr(case, "step", None):
        angle = step * round(angle / step)
    for what, writing in (("turned", {"turn": angle}), ("mirrored", {"mirror": True})):
        again, others = solved(hersey, case, folder, **writing)
        if again.kind != "answer":
            findings.append(f"{what}: {again.kind}: {again.text}")
        else:
            findings += [f"{what}: {text}" for text in differences(figures, others)]
    if point := case.position(figures):
        again, others = solved(hersey, case, folder, point=point)
        if again.kind != "answer":
            findings.append(f"from its position: {again.kind}: {again.text}")
        else:
            findings += [f"from its position: {text}" for text in differences(figures, others)]
    return "answer", ending.warnings, findings, text


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("hersey")
    parser.add_argument("--seed", default=None)
    parser.add_argument("--count", type=int, default=30, help="of each kind")
    parser.add_argument("--only")
    parser.add_argument("--output", default="build/random-rotor-bearings")
    arguments = parser.parse_args()
    seed = arguments.seed or str(random.randrange(10**6))
    names = [arguments.only] if arguments.only else [f"{kind}-{k}" for kind in KINDS for k in range(arguments.count)]
    failed, messages = 0, 0
    for name in names:
        ending, text, findings, model = examine(os.path.abspath(arguments.hersey), seed, name, os.path.abspath(arguments.output))
        messages += ending == "message"
        if ending not in ("answer", "message") or findings:
            failed += 1
            program.write(os.path.join(arguments.output, name, "case.yaml"), model)
            print(f"{name} (--seed {seed} --only {name}): {ending} {text}")
            for finding in findings:
                print(f"    {finding}")
        elif ending == "message":
            print(f"{name}: no answer: {text}")
    print(f"seed {seed}: {len(names)} bearings, {messages} without an answer, {failed} failing")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
