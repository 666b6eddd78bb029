"""Random bearings by themselves: the case, its model file, and what must hold of its answer."""

import copy
import math
from dataclasses import dataclass

import numpy as np

import bearings
import film_integrals as film
import film_laws
import heat
from bearings import PI, log_uniform, rounded
from findings import Findings
from model_text import deg, number, rpm, yaml

GRIDS = [(36, 9), (48, 9), (48, 13), (60, 9)]
SMALL_GRIDS = [(24, 7), (32, 7), (32, 9), (40, 7)]

# Fields are printed with eight digits.
DIGITS = 1e-7


@dataclass
class Steady:
    """A bearing at a steady operating point: a load (size, angle) or a position (ratio, angle)."""

    bearing: bearings.Bearing
    journal_speed: float
    shell_speed: float = 0.0
    load: tuple | None = None
    position: tuple | None = None
    tilt: tuple = (0.0, 0.0)
    journal_angle: float = 0.0
    radial_velocity: float = 0.0  # of the journal's centre in the direction of its position, outwards [m/s]

    def text(self, note=""):
        point = {"journal_speed": rpm(self.journal_speed)}
        if self.shell_speed:
            point["shell_speed"] = rpm(self.shell_speed)
        if self.load:
            point |= {"load": f"{number(self.load[0])} N", "load_angle": deg(self.load[1])}
        else:
            point |= {"eccentricity_ratio": self.position[0], "eccentricity_angle": deg(self.position[1])}
        if self.radial_velocity:
            point["radial_velocity"] = f"{number(1e3 * self.radial_velocity)} mm/s"
        if self.journal_angle:
            point["journal_angle"] = deg(self.journal_angle)
        if any(self.tilt):
            point |= {"tilt_x": deg(self.tilt[0]), "tilt_y": deg(self.tilt[1])}
        bearing = self.bearing.text() | {"operating_point": point}
        network = self.bearing.heat.network() if self.bearing.heat else {}
        return note + yaml({"hersey": 1, "lubricants": {"oil": self.bearing.lubricant()}} | network | {"bearings": {"main": bearing}})

    # -- symmetries

    def _with(self, bearing, **changes):
        other = copy.deepcopy(self)
        other.bearing = bearing
        for key, value in changes.items():
            setattr(other, key, value)
        return other

    def mirrored_z(self):
        return self._with(self.bearing.mirrored_z(), tilt=(-self.tilt[0], -self.tilt[1]))

    def mirrored_phi(self):
        flip = lambda pair: (pair[0], -pair[1]) if pair else None
        return self._with(self.bearing.mirrored_phi(), journal_speed=-self.journal_speed, shell_speed=-self.shell_speed,
                          load=flip(self.load), position=flip(self.position), tilt=(self.tilt[0], -self.tilt[1]),
                          journal_angle=-self.journal_angle)

    def turned(self, angle):
        turn = lambda pair: (pair[0], pair[1] + angle) if pair else None
        c, s = math.cos(angle), math.sin(angle)
        tilt = (c * self.tilt[0] - s * self.tilt[1], s * self.tilt[0] + c * self.tilt[1])
        return self._with(self.bearing.turned(angle), load=turn(self.load), position=turn(self.position), tilt=tilt)

    def slope(self):
        """Of the journal's axis, whose tilt is given as an angle [-]."""
        return tuple(math.tan(angle) for angle in self.tilt)

    def reordered(self):
        return self._with(self.bearing.reordered())

    def with_solver(self, solver):
        return self._with(self.bearing.with_solver(solver))

    def of_constant_oil(self, model):
        return self._with(heat.of_constant_oil(self.bearing, model))

    def at(self, position):
        """The same with a position in place of the load."""
        return self._with(self.bearing, load=None, position=position)

    def on_nodes(self):
        return self._with(self.bearing.on_nodes())

    def on_grid(self, factor):
        return self._with(self.bearing.on_grid(factor))


def random_steady(rng, is_small=False):
    """`is_small`: drawn alike, on coarser grids."""
    b = bearings.random_bearing(rng, SMALL_GRIDS if is_small else GRIDS, is_plain=rng.random() < 0.3)
    speed = rounded(log_uniform(rng, 10, 600)) * rng.choice([1, 1, -1])
    case = Steady(b, speed)
    if rng.random() < 0.25:
        case.shell_speed = rounded(speed * rng.uniform(-0.5, 1.0))
        if any(f.on == "shell" and f.pressure is None and f.depth > 0 and f.arc < 2 * PI for f in b.features):
            case.shell_speed = 0.0  # refused: its pockets would travel
    omega = abs(case.journal_speed + case.shell_speed)
    room = b.room() / b.c
    # p of a bearing of Sommerfeld number 1, which laws of viscosity must be able to stand
    unit = b.mu * omega * (b.R / b.c) ** 2
    angle = rounded(rng.uniform(-PI, PI))
    slender = min(1.0, (b.L / (2 * b.R)) ** 2)
    if rng.random() < 0.6:
        ratio = rounded(room * rng.choice([rng.random(), rng.random(), rng.uniform(0.6, 0.95)]))
        if rng.random() < 0.05 and not (b.supply and b.supply[0] == "widest_gap"):
            ratio = 0.0  # nowhere widest
        case.position = (ratio, angle)
        left = (room - ratio) * b.c
        size = 10 * unit * slender / max(1 - ratio / room, 0.02)
        if ratio > 0 and rng.random() < 0.2:
            case.radial_velocity = rounded(rng.uniform(-0.5, 0.5) * omega * b.c)
            size *= 2
            if rng.random() < 0.3:
                case.journal_speed = case.shell_speed = 0.0
    else:
        sommerfeld = log_uniform(rng, 0.05, 8) * slender
        case.load = (rounded(max(sommerfeld * unit * 2 * b.R * b.L, 0.1)), angle)
        left = 0.2 * room * b.c
        size = 5 * case.load[0] / (2 * b.R * b.L)
    if rng.random() < 0.3:
        slope = rng.uniform(0, 0.6) * left / (0.5 * b.L)
        towards = rng.uniform(-PI, PI)
        case.tilt = (rounded(slope * math.cos(towards)), rounded(slope * math.sin(towards)))
    if any(part.on == "journal" for part in (*b.features, *b.profiles)):
        case.journal_angle = rounded(rng.uniform(-PI, PI))
    soften(b, size)
    b.heat = heat.random_heat(rng, b, ["isothermal", "global", "film", "film", "film", "film"])
    if b.heat:
        heat.connect(b.heat, b, case.journal_speed - case.shell_speed)
    return case


def soften(b, pressure):
    """Keeps laws within what a film can carry: viscosity up to exp(2), columns that yield less than two clearances."""
    if b.viscosity_law and b.viscosity_law[0] == "barus":
        b.viscosity_law = ("barus", rounded(min(b.viscosity_law[1], 2 / max(pressure, 1e5))))
    if b.column:
        modulus, length = b.column
        b.column = (rounded(max(modulus, pressure * length / (2 * b.c))), length)


# -- the answer


class Answer:
    """Figures in SI and fields of a solved bearing."""

    def __init__(self, document, fields_file):
        figures = document["figures"]
        self.values = {key: f["value"] for key, f in figures.items() if f["value"] is not None}
        # what the program says in words is not missing
        self.missing = [key for key, f in figures.items() if f["value"] is None and not f.get("words")]
        table = np.genfromtxt(fields_file, delimiter=",", skip_header=1)
        self.phi = np.radians(np.unique(table[:, 0]))
        self.z = 1e-3 * np.unique(table[:, 1])
        shape = (len(self.phi), len(self.z))
        self.p, self.p_asperity = (1e6 * table[:, k].reshape(shape) for k in (2, 3))
        self.h, self.theta = 1e-6 * table[:, 4].reshape(shape), table[:, 5].reshape(shape)
        columns = zip(("middle", "shell", "journal", "hottest"), table[:, 6:10].T) if table.shape[1] >= 10 else ()
        self.temperatures = {name: column.reshape(shape) for name, column in columns}

    def __getitem__(self, key):
        return self.values[key]

    def position(self, c):
        e, at = self["eccentricity_ratio"] * c, self["eccentricity_angle"]
        return np.array([e * math.cos(at), e * math.sin(at)])


# What may be infinite or undefined for a good reason: stability of a rotor, ratios by a load of nothing.
MAY_BE_MISSING = ("critical_mass", "whirl_ratio", "stability_number", "threshold_speed", "film_ratio", "attitude",
                  "sommerfeld_S", "sommerfeld_So", "hersey", "friction_journal", "friction_shell", "T_side", "T_film", "T_out")


def check(case, a):
    """All that must hold of one answer."""
    found = Findings()
    b = case.bearing
    may_be_missing = (*MAY_BE_MISSING, "K_", "C_", *(() if b.middle_is_open(case.journal_angle) else ("h_min_centre",)))
    bad = [key for key in a.missing if not key.startswith(may_be_missing)]
    bad += [key for key, value in a.values.items() if not math.isfinite(value)
            and not key.startswith(may_be_missing)]
    found.require("finite", not bad, f"no number: {', '.join(bad)}")
    for name in ("p", "p_asperity", "h", "theta"):
        found.require("finite", np.isfinite(getattr(a, name)).all(), f"field {name} is not finite")
    if found:
        return found
    check_gap(case, a, found)
    check_fill(b, a, found)
    check_cavity(case, a, found)
    check_oil(case, a, found)
    check_load(case, a, found)
    check_asperities(case, a, found)
    check_power(case, a, found)
    heat.check_steady(case, a, found)
    return found


def column_yield(b, a):
    if not b.column:
        return 0.0 * a.p
    atmosphere = 1.01325e5 if b.pressures == "absolute" else 0.0
    return b.column[1] / b.column[0] * (a.p - atmosphere + a.p_asperity)


def features_near(b, a, turn, cells, only_deep=True):
    """Nodes that lie in a feature (with depth) or at most this many cells beside it."""
    phi, z = a.phi[:, None], a.z[None, :]
    step_phi = np.diff(np.append(a.phi, a.phi[0] + 2 * PI)).max()
    step_z = np.diff(a.z).max()
    near = np.zeros(a.h.shape, bool)
    for f in b.features:
        if f.depth > 0 or not only_deep:
            near |= f.covers(phi, z, turn, cells * step_phi * (1 + 1e-9), cells * step_z * (1 + 1e-9))
    return near


def land_gap(case, a):
    """Gap without features, with what a column yields."""
    b = case.bearing
    return b.land(a.position(b.c), case.slope(), a.phi[:, None], a.z[None, :], case.journal_angle) + column_yield(b, a)


def check_gap(case, a, found):
    b, turn = case.bearing, case.journal_angle
    land = land_gap(case, a)
    round_off = DIGITS * (np.abs(a.h).max() + np.abs(column_yield(b, a)).max()) + 1e-9 * b.c
    away = ~features_near(b, a, turn, 0.5)
    off = np.abs(a.h - land)[away]
    found.bound("gap by formula", off.max(initial=0.0), round_off, "m beside the formula on land")
    below, above = (land - a.h).max(), (a.h - land - b.deepest()).max()
    found.bound("gap by formula", max(below, above), round_off, "m outside land and land + depth")
    # between two nodes a smooth film may be thinner than at both
    outside = ~features_near(b, a, turn, 0.0, only_deep=False)
    check_thinnest(a["h_min"], a.h[outside], land, a, b, found, round_off)


def check_thinnest(h_min, outside, land, a, b, found, round_off):
    found.require("h_min > 0", h_min > 0, f"h_min = {1e6 * h_min:.4g} um")
    if outside.size == 0:
        return
    found.bound("h_min <= h", h_min - outside.min(), round_off,
                f"m: h_min = {1e6 * h_min:.5g} um, smallest of all nodes outside features {1e6 * outside.min():.5g} um")
    # and not thinner than the thinnest place there is: the land's own smallest value, less what it dips between nodes
    lowest = land.min() - 2 * film.dip(land)
    found.bound("h_min is somewhere", lowest - h_min, round_off,
                f"m: h_min = {1e6 * h_min:.5g} um, the land is nowhere thinner than {1e6 * lowest:.5g} um")


def check_fill(b, a, found):
    found.bound("0 <= theta <= 1", max(-a.theta.min(), a.theta.max() - 1), DIGITS,
                f": theta from {a.theta.min():.6g} to {a.theta.max():.9g}")
    scale = max(np.abs(a.p).max(), 1.0)
    # guembel's pressures are those on the walls, cut off at p_cav
    found.bound("p >= p_cav", b.p_cav - a.p.min(), DIGITS * scale, f"Pa: smallest pressure {a.p.min():.6g}")
    both = np.minimum((a.p - b.p_cav) / scale, 1 - a.theta).max()
    if b.cavitation == "mass_conserving":
        found.bound("full or at p_cav", both, 2 * DIGITS, ": a node is neither")
    bound = a["p_max"] - a.p.max()
    is_line = b.supply and abs(a["p_max"] - b.supply[1]) < 10 * DIGITS * scale  # the line's own, between nodes
    found.bound("p_max", max(-bound, 0.0 if is_line else bound - 2 * film.dip(a.p)), DIGITS * scale,
                f"Pa: p_max {a['p_max']:.6g}, largest of a node {a.p.max():.6g}")
    # nothing is above the pressure of a line or feature that holds the largest one
    prescribed = [f.pressure for f in b.features if f.pressure is not None] + ([b.supply[1]] if b.supply else [])
    if any(abs(a.p.max() - p) < 10 * DIGITS * scale for p in prescribed):
        found.bound("p_max", bound, 100 * DIGITS * scale,
                    f"Pa: p_max {a['p_max']:.6g} beside a feature that has {a.p.max():.6g}")


def check_cavity(case, a, found):
    """What lies between rupture and re-formation at mid-width is cavitated, and a cavity has both."""
    b, middle = case.bearing, np.abs(a.z).argmin()
    broken = a.theta[:, middle] < 1 - 1e-8 if b.cavitation == "mass_conserving" else a.p[:, middle] <= b.p_cav
    has_ends = "rupture_angle" in a.values
    if b.cavitation == "mass_conserving" and not broken.all():
        found.require("cavity", has_ends == bool(broken.any()), f"cavity at mid-width {broken.any()}, its ends reported {has_ends}")
    if has_ends:
        low, high = a["rupture_angle"], a["reformation_angle"]
        if case.journal_speed + case.shell_speed < 0:
            low, high = high, low
        inside = (a.phi - low) % (2 * PI) < (high - low) % (2 * PI)
        at_an_end = np.minimum(np.abs(np.sin((a.phi - low) / 2)), np.abs(np.sin((a.phi - high) / 2))) < DIGITS
        found.require("cavity", broken[inside & ~at_an_end].all(), f"film between rupture {low:.4f} and re-formation {high:.4f}")


def check_oil(case, a, found):
    b = case.bearing
    flows = [a[key] for key in a.values if key.startswith("flow_")]
    scale = max(map(abs, flows)) + 1e-9 * abs(case.journal_speed) * b.R * b.c * b.L
    fed = sum(a[f"flow_feature_{f.name}"] for f in b.features)
    if not b.supply:
        found.bound("flows add up", abs(a["flow_supply"] - fed), 1e-9 * scale, "m^3/s between supply and features")
    for f in b.features:
        if f.pressure is None:
            found.bound("flows add up", abs(a[f"flow_feature_{f.name}"]), 1e-12 * scale, f"m^3/s through {f.name}, not fed")
    moves = (case.journal_speed and b.varies_on("journal")) or (case.shell_speed and b.varies_on("shell"))
    for edge, is_wall in zip(("left", "right"), b.walls):
        if is_wall:
            found.bound("closed edges", abs(a[f"flow_{edge}"]), 1e-9 * scale, "m^3/s through a wall")
    if b.cavitation == "guembel":
        # what leaves is that of the pressure that acts; all that the film's own equations move balances
        found.bound("oil", a["mass_balance_error"], 1e-6, "of the flows through all nodes of edges")
    if b.cavitation == "mass_conserving" and not moves and not case.radial_velocity:
        # the solver's tolerance, 1e-8 of the largest flow through a node's volume, may add up over a row
        out = a["flow_left"] + a["flow_right"]
        found.bound("oil", abs(a["flow_supply"] - out), 1e-6 * scale + 1e-8 * b.n_phi * b.R * b.c * abs(case.journal_speed) * b.L,
                    f"m^3/s: in {a['flow_supply']:.6g}, out {out:.6g}")
    density = film_laws.density(b, a.p)
    if not b.roughness:
        gap = b.oil_gap(a.h, land_gap(case, a), a.phi[:, None], a.z[None, :], case.journal_angle)
        own = film.volume(a.theta * gap * density, b.R, a.phi, a.z)
        # a step in depth lies somewhere in a cell
        step = sum(f.depth * border_area(f, b, a) for f in b.features)
        found.bound("oil volume", abs(own.value - a["oil_volume"]), own.error + step + 1e-4 * own.value,  # means of control volumes there
                    f"m^3: own integral {own.value:.6g}, reported {a['oil_volume']:.6g}")


def check_load(case, a, found):
    b = case.bearing
    own = film.force(a.p + a.p_asperity, b.R, a.phi, a.z)
    size = math.hypot(own[0].value, own[1].value)
    reported = a["load"] * np.array([math.cos(a["load_angle"]), math.sin(a["load_angle"])])
    off = math.hypot(own[0].value - reported[0], own[1].value - reported[1])
    # Shear adds c/R of the load and the friction force; where guembel cuts the pressure off, half a cell of it is not here.
    shear = (abs(a["torque_shell"]) + abs(a["torque_journal"])) / b.R + 2 * b.c / b.R * size
    parts = float(np.abs(a.p + a.p_asperity - b.p_cav).sum()) * b.R * 2 * PI / len(a.phi) * b.L / len(a.z)
    error = math.hypot(own[0].error, own[1].error)
    found.bound("load", off, 1.5 * error + shear + 1e-3 * parts,
                f"N: own integral ({own[0].value:.6g}, {own[1].value:.6g}), reported ({reported[0]:.6g}, {reported[1]:.6g})")
    if case.load:
        found.bound("given load", abs(a["load"] - case.load[0]), 1e-5 * case.load[0], "N")
        found.bound("given load", abs(math.remainder(a["load_angle"] - case.load[1], 2 * PI)), 1e-5, "rad")
    else:
        found.bound("given position", abs(a["eccentricity_ratio"] - case.position[0]), 1e-9, "")


def check_asperities(case, a, found):
    """Contact pressure of the fitted law from the gap reported, to the digits printed of both; land beside a pocket touches on its own."""
    b = case.bearing
    if not b.asperities or b.asperities["model"] != "greenwood_tripp_fit":
        return
    own = film_laws.asperity_pressure(b, a.h)
    slope = 6.804 / np.maximum(4 - (a.h - b.asperities["summits"]) / b.asperities["sigma"], 1e-3) * a.h / b.asperities["sigma"]
    off = np.abs(own - a.p_asperity) - DIGITS * (1 + slope) * np.maximum(own, a.p_asperity)
    away = ~features_near(b, a, case.journal_angle, 0.5)
    found.bound("asperities by formula", float(off[away].max(initial=0.0)), 1e-6 * max(float(own.max()), 1.0), "Pa")


def check_power(case, a, found):
    """What turns the surfaces and what pumps the oil is what the film dissipates by own integrals."""
    b = case.bearing
    slip = b.R * (case.journal_speed - case.shell_speed)
    mu = film_laws.viscosity(b, a.p)
    if b.roughness:
        return  # flow factors would have to be repeated
    thins = b.heat is not None and b.heat.model != "isothermal"  # where, only the program knows
    fed = b.is_fed(a.phi[:, None], a.z[None, :], case.journal_angle)
    couette = film.couette_power(film_laws.shear_shares(b, a.p, a.theta, fed), mu, a.h, slip, b.R, a.phi, a.z)
    poiseuille = film.poiseuille_power(a.p, mu, a.h, b.R, a.phi, a.z)
    over_land = bearings.land_power(b, mu, land_gap(case, a), a.phi, a.z, case.journal_angle)
    own, reported = couette.value + poiseuille.value + over_land, a["power_film"]
    # The edge of a cavitated region is resolved to a cell: the estimate sees that. A step of depth lies somewhere in a cell.
    pumped = pumping(b, a)
    error = 1.5 * (couette.error + poiseuille.error) + 1e-3 * own + border_power(b, a, mu, slip) + bearings.corner_power(b, pumped)
    error += 0.3 * over_land  # ends between nodes around
    found.bound("power: film by own integral", 0.0 if thins else abs(own - reported), error, f"W: own {own:.6g}, reported {reported:.6g}")
    turned = -(case.journal_speed * a["torque_journal"] + case.shell_speed * a["torque_shell"])
    # the film pushes the shell away from the journal, and this back
    turned += case.radial_velocity * a["load"] * math.cos(a["load_angle"] - a["eccentricity_angle"])
    if (case.journal_speed and b.varies_on("journal")) or (case.shell_speed and b.varies_on("shell")):
        return  # one moment of a turn: the gap's own motion does work, too
    asperity = a["power_asperity"]
    found.require("power: asperities", asperity >= 0, f"boundary friction of {asperity:.6g} W")
    # c/R: the film's curvature; the rise of density does work of its own
    grid = error + 2 * b.c / b.R * (abs(turned) + abs(pumped)) + 0.01 * abs(reported)
    if film_laws.compressibility(b):
        grid += film_laws.compressibility(b) * a["p_max"] * (abs(reported) + abs(pumped))
    found.bound("power: turned + pumped = dissipated", abs(turned + pumped - reported - asperity), grid,
                f"W: turned {turned:.6g}, pumped {pumped:.6g}, film {reported:.6g}, asperities {asperity:.6g}")


def border_area(f, b, a):
    """Half the cells that the border of a feature passes [m^2]."""
    ends = 0.0 if f.length >= b.L else 2 * b.R * f.arc * np.diff(a.z).max()
    sides = 0.0 if f.arc >= 2 * PI else 2 * f.length * b.R * np.diff(a.phi).max()
    return 0.5 * (ends + sides)


def border_power(b, a, mu, slip):
    """Shear of half the cells on the borders of features with depth, where land and feature differ [W]."""
    highest = float((mu / np.maximum(a.h, 1e-9)).mean()) * slip**2
    return sum(highest * border_area(f, b, a) for f in b.features if f.depth > 0)


def pumping(b, a):
    """What comes in at its pressure and leaves at the edges' [W]; pressures count from that of cavitation."""
    power = sum((f.pressure - b.p_cav) * a[f"flow_feature_{f.name}"] for f in b.features if f.pressure is not None)
    if b.supply:
        line = a["flow_supply"] - sum(a[f"flow_feature_{f.name}"] for f in b.features)
        power += (b.supply[1] - b.p_cav) * line
    return power - (b.p_edge[0] - b.p_cav) * a["flow_left"] - (b.p_edge[1] - b.p_cav) * a["flow_right"]


# -- two answers


def overlap(case):
    """Whether fed features of shell and journal lie over each other at this moment of the turn: what each feeds is then a convention."""
    phi, z = np.linspace(0, 2 * PI, 361)[:, None], np.linspace(-0.5, 0.5, 41)[None, :] * case.bearing.L
    fed = [f.covers(phi, z, case.journal_angle) for f in case.bearing.features if f.pressure is not None]
    return any((a & b).any() for k, a in enumerate(fed) for b in fed[:k])


def differences(case, one, other, tolerance, is_mirrored_z=False, is_mirrored_phi=False, turn=0.0):
    """Differences of `other`'s figures from those of `one` under a symmetry, each by its own scale."""
    found = []
    b = case.bearing
    omega = abs(case.journal_speed) + abs(case.shell_speed)
    scales = {"h_min": b.c, "h_min_centre": b.c, "load": max(one["load"], 1e-3 * max(one["p_max"], 1e3) * b.R * b.L),
              "p_max": max(one["p_max"], 1e3), "power_film": one["power_film"], "power_asperity": one["power_film"],
              "oil_volume": one["oil_volume"], "eccentricity_ratio": 1.0}
    # What speeds would make flow: a squeeze between closed edges has no flow at all.
    moved = 1e-3 * (omega * b.c + abs(case.radial_velocity)) * b.R * b.L
    flow = max([abs(one[key]) for key in one.values if key.startswith("flow_")] + [moved])
    for key in one.values:
        if key.startswith(("flow_", "side_flow")) and not (key.startswith("flow_feature_") and overlap(case)):
            scales[key] = flow
        if key.startswith("torque_"):
            scales[key] = max(abs(one["torque_journal"]), abs(one["torque_shell"]), one["load"] * b.c)
    if "T_max" in one.values:
        scales |= heat.scales(b.heat, one)
    swapped = {"flow_left": "flow_right", "flow_right": "flow_left"}
    for key, scale in scales.items():
        if scale <= 0 or key not in one.values or key not in other.values:
            continue
        name = swapped.get(key, key) if is_mirrored_z else key
        value = -other[name] if is_mirrored_phi and key.startswith("torque_") else other[name]
        if abs(one[key] - value) > tolerance * scale:
            found.append(f"{key} {one[key]:.8g} and {value:.8g}")
    for angle, size in (("eccentricity_angle", one["eccentricity_ratio"]), ("load_angle", one["load"] / scales["load"])):
        sign = -1 if is_mirrored_phi else 1
        off = math.remainder(sign * other[angle] - turn - one[angle], 2 * PI)
        if abs(off) * size > tolerance:
            found.append(f"{angle} {one[angle]:.8g} and {sign * other[angle] - turn:.8g} rad")
    return found
