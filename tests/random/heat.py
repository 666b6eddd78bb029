"""Random temperatures of films: models, walls and oils that thin as they warm, and what must hold of their heat. Temperatures in degC."""

import copy
import math
import random
from dataclasses import dataclass, field

import numpy as np

from model_text import mm, number

# Films with temperatures are found to 1e-8 of the largest rise; the balance is made of differences of flows solved to 1e-8 of the
# largest through a node's volume.
BALANCED = 1e-7

# Linear extrapolation along the flow overshoots beside a front; as a share of the largest rise.
OVERSHOOT = 0.05


def degrees(value):
    return f"{number(value)} degC"


@dataclass
class Heat:
    """A bearing's `thermal` and its oil's law of temperature."""

    model: str  # isothermal, global, film
    T: float  # of the oil supplied, or everywhere
    law: tuple | None  # None: a viscosity that does not change; ("exponential", beta), ("vogel", c) or ("table",)
    layers: int = 5
    T_edges: float | None = None
    shell: tuple = ("insulated",)
    journal: tuple = ("free",)
    carry_over: float = 1.0
    cooling: tuple | None = None  # (area, transfer, ambient), of a global one
    T_air: float | None = None  # of what the bodies of a network are cooled by
    paths: dict = field(default_factory=dict)  # conductance from block (the shell), shaft (the journal) or sump (the oil) to the air [W/K]

    def viscosity(self, mu):
        """Of an oil that has the viscosity `mu` at T."""
        pascal_seconds = lambda value: f"{number(1e3 * value)} mPa.s"
        if self.law is None:
            return pascal_seconds(mu)
        if self.law[0] == "exponential":
            return {"law": "exponential", "viscosity": pascal_seconds(mu), "reference": degrees(self.T),
                    "coefficient": f"{number(self.law[1])} 1/K"}
        b, c = 900.0, self.law[1]
        if self.law[0] == "vogel":
            return {"law": "vogel", "a": pascal_seconds(mu / math.exp(b / (self.T + 273.15 - c))), "b": f"{number(b)} K",
                    "c": f"{number(c)} K"}
        places = [self.T - 20, self.T, self.T + 40, self.T + 100]
        at = [mu * math.exp(b / (T + 273.15 - c) - b / (self.T + 273.15 - c)) for T in places]
        return {"law": "table", "temperatures": [degrees(T) for T in places], "viscosities": [pascal_seconds(value) for value in at]}

    def wall(self, kind):
        if kind[0] == "given":
            return {"wall": "given", "temperature": degrees(kind[1])}
        if kind[0] == "ring":
            return {"wall": "ring", "outer_diameter": mm(kind[1]), "heat_transfer": f"{number(kind[2])} W/m^2/K",
                    "ambient": degrees(kind[3])}
        if kind[0] == "node":
            return {"wall": "node", "node": kind[1]}
        return kind[0]

    def network(self):
        """The model's section `thermal`, or nothing."""
        if self.model != "film" or not self.paths:
            return {}
        nodes = {name: {"heat_capacity": "1 kJ/K"} for name in self.paths} | {"air": {"fixed": degrees(self.T_air)}}
        paths = {f"of_{name}": {"between": [name, "air"], "conductance": f"{number(G)} W/K"} for name, G in self.paths.items()}
        return {"thermal": {"nodes": nodes, "paths": paths}}

    def text(self):
        if self.model == "isothermal":
            return {"model": "isothermal", "temperature": degrees(self.T)}
        if self.model == "global":
            if self.cooling:
                area, transfer, ambient = self.cooling
                return {"model": "global", "cooling": {"area": f"{number(area)} m^2", "heat_transfer": f"{number(transfer)} W/m^2/K",
                                                       "ambient": degrees(ambient)}}
            return {"model": "global", "supply_temperature": degrees(self.T)}
        entry = {"model": "film", "supply_temperature": {"node": "sump"} if "sump" in self.paths else degrees(self.T), "layers": self.layers, "shell": self.wall(self.shell),
                 "journal": self.wall(self.journal)}
        if self.T_edges is not None:
            entry["edge_temperature"] = degrees(self.T_edges)
        if "sump" in self.paths:
            entry["drains_to"] = "sump"
        if self.carry_over != 1:
            entry["carry_over"] = self.carry_over
        return entry

    def given(self):
        """All temperatures given."""
        walls = [wall[-1] for wall in (self.shell, self.journal) if wall[0] in ("given", "ring")]
        oil = [] if "sump" in self.paths else [self.T]
        return [*oil, *(T for T in (self.T_edges, self.T_air) if T is not None), *walls]


def of_constant_oil(b, model):
    """The bearing with an oil that does not thin and this model of temperature."""
    other = copy.deepcopy(b)
    other.heat.law = None
    other.heat.model = model
    # An oil that does not thin makes ever the same heat, which bodies may not be able to pass on.
    for wall in ("shell", "journal"):
        if getattr(other.heat, wall)[0] == "node":
            setattr(other.heat, wall, ("given", other.heat.T_air))
    other.heat.paths = {}
    return other


def connect(heat, b, speed):
    """Makes some walls, and what the oil comes from and drains to, bodies that air cools. Drawn from the bearing's own numbers: what
    else is drawn stays what it was."""
    rng = random.Random(repr((b.R, b.L, b.c, heat.T, speed)))
    if heat.model != "film" or rng.random() < 0.6:
        return
    heat.T_air = round(heat.T - rng.uniform(0, 30), 1)
    area = 2 * math.pi * b.R * b.L
    through = 850 * 2000 * 0.5 * abs(speed) * b.R * b.c * b.L  # what the journal carries along [W/K]
    if rng.random() < 0.6:
        heat.shell, heat.paths["block"] = ("node", "block"), round(area * 10 ** rng.uniform(1.5, 3.5), 4)
    if rng.random() < 0.3:
        heat.journal, heat.paths["shaft"] = ("node", "shaft"), round(area * 10 ** rng.uniform(1.5, 3.5), 4)
    if rng.random() < 0.5 and through > 0:
        heat.paths["sump"] = round(through * 10 ** rng.uniform(-0.5, 1), 4)
    if not heat.paths:
        heat.T_air = None


def random_heat(rng, b, models):
    """Temperatures of a bearing, or None."""
    if rng.random() < 0.5:
        return None
    T = round(rng.uniform(20, 90), 1)
    law = rng.choice([("exponential", round(rng.uniform(0.005, 0.045), 4)), ("vogel", round(rng.uniform(120, 190), 1)), ("table", 160.0)])
    heat = Heat(rng.choice(models), T, law)
    near = lambda: round(T + rng.uniform(-15, 30), 1)
    heat.layers = rng.choice([1, 2, 3, 5, 5, 5, 8])
    if rng.random() < 0.3:
        heat.T_edges = near()
    ring = ("ring", round(2 * b.R * rng.uniform(1.1, 2.5), 5), round(rng.uniform(0, 200), 1), round(T - rng.uniform(0, 30), 1))
    heat.shell = rng.choice([("insulated",), ("given", near()), ring, ring])
    heat.journal = rng.choice([("insulated",), ("given", near()), ("free",), ("free",)])
    heat.carry_over = rng.choice([1.0, 1.0, round(rng.random(), 2), 0.0])
    if rng.random() < 0.3:
        heat.cooling = (round(rng.uniform(10, 100) * b.R * b.L, 5), round(rng.uniform(10, 40), 1), round(T - rng.uniform(0, 40), 1))
    if b.cavitation == "reynolds":
        heat.carry_over = 0.0  # refused: its grooves have no finite temperature
    takes = heat.shell[0] != "insulated" or heat.journal[0] == "given"
    if all(b.walls) and not takes:
        heat.shell = ("given", near())  # refused: heat has nowhere to go
    if heat.cooling and heat.model == "global":
        heat.T = heat.cooling[2]
    return heat


# -- a bearing by itself


def check_steady(case, a, found):
    """The balance of heat, term by term, and its temperatures."""
    heat = case.bearing.heat
    if not heat or heat.model != "film":
        return
    made = a["heat_dissipated"]
    scale = max(made, abs(a["heat_to_oil"]), abs(a["heat_to_shell"]), abs(a["heat_to_journal"]), 1e-12)
    if not moves(case) and not case.radial_velocity:
        off = made - a["heat_to_oil"] - a["heat_to_shell"] - a["heat_to_journal"]
        found.bound("heat: made = carried away", abs(off), BALANCED * scale, f"W of {made:.6g}")
    found.bound("heat: reported error of the balance", abs(a["heat_balance_error"]), BALANCED, "")
    film = a["power_film"] + a["power_asperity"]
    found.bound("heat: made = film's power", abs(made - film), 1e-6 * max(film, 1e-12), f"W: made {made:.8g}, power {film:.8g}")
    check_temperatures(heat, a, found)
    check_network(case, a, scale, found)
    check_oil(case, a, scale, found)


def moves(case):
    b = case.bearing
    return (case.journal_speed and b.varies_on("journal")) or (case.shell_speed and b.varies_on("shell"))


def check_temperatures(heat, a, found):
    low, rise = min(heat.given()), max(a["T_max"] - min(heat.given()), 1.0)
    for name, field in a.temperatures.items():
        found.require("heat: finite", bool(np.isfinite(field).all()), f"{name} is not finite")
        found.bound("heat: no colder than anything given", low - field.min(), OVERSHOOT * rise, f"K: {name} down to {field.min():.6g} degC")
    found.bound("heat: T_max", abs(a["T_max"] - a.temperatures["hottest"].max()), 1e-6 * abs(a["T_max"]) + 1e-6, "K off the field's")
    if heat.shell[0] == "given":
        found.bound("heat: walls given", np.abs(a.temperatures["shell"] - heat.shell[1]).max(), 1e-5, "K at the shell")
    if heat.journal[0] == "given":
        found.bound("heat: walls given", np.abs(a.temperatures["journal"] - heat.journal[1]).max(), 1e-5, "K at the journal")
    if heat.journal[0] not in ("given", "node"):
        found.bound("heat: journal takes nothing", abs(a["heat_to_journal"]), BALANCED * max(a["heat_dissipated"], 1e-12), "W")


def check_network(case, a, scale, found):
    """Each body passes on what it takes up: the heat of its wall, or of all the oil where the oil comes from it."""
    heat = case.bearing.heat
    taken = {"block": a["heat_to_shell"], "shaft": a["heat_to_journal"]}
    if heat.T_edges is None and case.bearing.cavitation == "mass_conserving" and not moves(case) and not case.radial_velocity:
        taken["sump"] = a["heat_to_oil"]
    for name, G in heat.paths.items():
        if name in taken:
            passed = G * (a[f"T_node_{name}"] - heat.T_air)
            found.bound("heat: bodies pass on what they take up", abs(passed - taken[name]), 1e-6 * scale + 1e-6 * G,
                        f"W: {name} takes {taken[name]:.8g}, passes on {passed:.8g}")


def check_oil(case, a, scale, found):
    """What the oil carries away, from its flows and temperatures, where all of it comes from supplies and leaves over edges."""
    b, heat = case.bearing, case.bearing.heat
    edges_only_leave = all(p <= b.p_cav or wall for p, wall in zip(b.p_edge, b.walls)) and not any(b.ambient)
    flows = [a[f"flow_feature_{f.name}"] for f in b.features if f.pressure is not None]
    if b.supply:
        flows.append(a["flow_supply"] - sum(flows))
    # several supplies, or one that takes oil away: their nodes have flows of both signs
    if not edges_only_leave or heat.carry_over != 1 or len(flows) != 1 or moves(case) or b.cavitation != "mass_conserving" or "T_side" not in a.values:
        return
    if case.radial_velocity:
        return
    side = a["side_flow"]
    oil = 850 * 2000 * (side * a["T_side"] - a["flow_supply"] * (a["T_node_sump"] if "sump" in heat.paths else heat.T))
    found.bound("heat: oil by its flows", abs(oil - a["heat_to_oil"]), 1e-5 * scale + 850 * 2000 * 1e-6 * abs(side) * abs(heat.T),
                f"W: flows {oil:.6g}, reported {a['heat_to_oil']:.6g}")


def scales(heat, a):
    """Of the figures that symmetric cases share."""
    rise = max(a["T_max"] - min(heat.given()), 1.0)
    powers = max(a["heat_dissipated"], abs(a["heat_to_shell"]), abs(a["heat_to_oil"]), 1e-12)
    return {key: rise for key in ("T_max", "T_shell_max", "T_shell_mean", "T_journal", "T_film", "T_side")} | {
        key: powers for key in ("heat_dissipated", "heat_to_oil", "heat_to_shell")}


# -- in a run


def stored_noise(b, rows, dt):
    """Round-off of the heat that a step stores [W]: of what the film's oil holds at its absolute temperature, over the step.

    Where a run ends in steps of nanoseconds, this is what their balances have left. An oil has some 2 MJ/(m^3 K), a sum over nodes
    some times the round-off of one.
    """
    stored = 2e6 * 2 * math.pi * b.R * b.L * b.c * (273.15 + rows["T_max"])
    return 20 * np.finfo(float).eps * stored / np.where(dt > 0, dt, np.inf)


def check_run(b, rows, dt, name, found):
    """Every step's balance of heat, and that it is the film's power that warms."""
    if not b.heat or b.heat.model != "film":
        return
    made = rows["heat_dissipated"]
    terms = [rows[key] for key in ("heat_to_oil", "heat_to_shell", "heat_to_journal", "heat_stored")]
    scale = np.maximum(np.abs(np.array([made, *terms])).max(0), 1e-12)
    off = np.abs(made - sum(terms)) / scale
    allowed = 1e-5 + stored_noise(b, rows, dt) / scale
    reported = np.abs(rows["heat_balance_error"])
    k, m = int(np.argmax(off / allowed)), int(np.argmax(reported / allowed))
    found.bound("heat: made = carried away + stored", float(off[k]), float(allowed[k]), f" of {scale[k]:.4g} W in row {k} of {name}")
    found.bound("heat: reported error of the balance", float(reported[m]), float(allowed[m]), f": {name}")
    film = rows["power_film"] + rows["power_asperity"]
    off = np.abs(made - film) / np.maximum(film, 1e-12)
    k = int(np.argmax(off))
    found.bound("heat: made = film's power", float(off[k]), 1e-6, f" in row {k} of {name}: made {made[k]:.8g}, power {film[k]:.8g} W")
    low = min(b.heat.given())
    rise = max(float(rows["T_max"].max()) - low, 1.0)
    for key in ("T_max", "T_film", "T_journal", "T_shell_mean"):
        coldest = float(np.nanmin(rows[key]))
        found.bound("heat: no colder than anything given", low - coldest, OVERSHOOT * rise, f"K: {name} {key} down to {coldest:.6g} degC")
