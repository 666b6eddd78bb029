"""Random bearings: what one is, its symmetries, its text in a model file and its gap by formula. SI units throughout."""

import copy
import math
from dataclasses import dataclass, field

import numpy as np

from heat import Heat
from model_text import bar, deg, mm, number, um

PI = math.pi


@dataclass
class Feature:
    """A hole, groove or pocket; phi and z of its middle, whole extents arc [rad] and length [m], pressure None: not fed."""

    name: str
    kind: str
    on: str
    phi: float
    z: float
    arc: float
    length: float
    pressure: float | None
    depth: float

    def distances(self, phi, z, turn=0.0):
        """How far points lie from its middle in units of its half extents, around and along."""
        around = np.remainder(phi - self.phi - (turn if self.on == "journal" else 0.0) + PI, 2 * PI) - PI
        return around / (0.5 * self.arc), (z - self.z) / (0.5 * self.length)

    def covers(self, phi, z, turn=0.0, margin_phi=0.0, margin_z=0.0):
        """Whether rectangles around points, this far to both sides, have a part of it; without margins: the points."""
        x, y = self.distances(phi, z, turn)
        x = np.maximum(np.abs(x) - margin_phi / (0.5 * self.arc), 0)
        y = np.maximum(np.abs(y) - margin_z / (0.5 * self.length), 0)
        if self.kind in ("hole", "oval_hole"):
            return x**2 + y**2 < 1
        return (x < 1) & (y < 1)

    def text(self, R, L):
        entry = {"shape": self.kind, "on": self.on, "angle": deg(self.phi), "z": mm(self.z)}
        if self.kind == "hole":
            entry["diameter"] = mm(self.length)
        elif self.kind == "oval_hole":
            entry |= {"around": mm(self.arc * R), "along": mm(self.length)}
        else:
            if self.arc < 2 * PI:
                entry["arc"] = deg(self.arc)
            if self.length < L or self.kind in ("circumferential_groove", "pocket"):
                entry["length"] = mm(self.length)
        if self.pressure is not None:
            entry["pressure"] = bar(self.pressure)
        return entry | {"depth": um(self.depth)}


@dataclass
class Profile:
    """A deviation from the cylinder: barrel, taper, ovality or lobes; size [m]."""

    kind: str
    on: str
    size: float
    angle: float = 0.0
    count: int = 2

    def opening(self, phi, z, L, turn=0.0):
        """By how much it widens the gap [m]."""
        phi = phi - self.angle - (turn if self.on == "journal" else 0.0)
        if self.kind == "barrel":
            return self.size * (2 * z / L) ** 2 + 0 * phi
        if self.kind == "taper":
            return self.size * z / L + 0 * phi
        if self.kind == "ovality":
            return self.size * np.cos(2 * phi) + 0 * z
        part = 2 * PI / self.count
        return self.size * (1 - np.cos(np.remainder(phi + part / 2, part) - part / 2)) + 0 * z

    def text(self):
        entry = {"profile": self.kind, "on": self.on}
        size = {"barrel": "drop", "taper": "rise", "ovality": "amplitude", "lobes": "offset"}[self.kind]
        entry[size] = um(self.size)
        if self.kind in ("ovality", "lobes"):
            entry["angle"] = deg(self.angle)
        if self.kind == "lobes":
            entry["count"] = self.count
        return entry


@dataclass
class Bearing:
    R: float
    L: float
    c: float
    mu: float
    n_phi: int
    n_z: int
    cavitation: str = "mass_conserving"
    p_cav: float = 0.0
    p_edge: tuple = (0.0, 0.0)
    ambient: tuple = (0.0, 0.0)
    supply: tuple | None = None  # ("widest_gap" or angle, pressure)
    features: list = field(default_factory=list)
    profiles: list = field(default_factory=list)
    viscosity_law: tuple | None = None  # ("barus", alpha) or ("roelands", z)
    is_compressible: bool = False  # by Dowson and Higginson
    bulk_modulus: float | None = None  # constant, in its place
    walls: tuple = (False, False)  # closed edges, whose pressure is of no account
    roughness: dict | None = None
    asperities: dict | None = None
    column: tuple | None = None  # (modulus, length)
    cavitated_shear: str = "film_share"
    shear_force: str = "full"
    refine: list = field(default_factory=list)
    solver: str = "newton"
    pressures: str = "gauge"
    coupling: dict | None = None
    heat: Heat | None = None

    # -- what it is in a model file

    def lubricant(self):
        entry = {"viscosity": self.heat.viscosity(self.mu) if self.heat else f"{number(1e3 * self.mu)} mPa.s"}
        if self.viscosity_law:
            law, value = self.viscosity_law
            entry["pressure_viscosity"] = ({"law": "roelands", "z": value} if law == "roelands"
                                           else {"law": "barus", "alpha": f"{number(value)} 1/Pa"})
        if self.is_compressible:
            entry["compressibility"] = "dowson_higginson"
        if self.bulk_modulus:
            entry["compressibility"] = {"law": "constant_bulk_modulus", "bulk_modulus": f"{number(1e-9 * self.bulk_modulus)} GPa"}
        return entry

    def edges(self):
        left, right = ("closed" if wall else bar(p) for p, wall in zip(self.p_edge, self.walls))
        return {"left": left, "right": right}

    def text(self):
        entry = {"diameter": mm(2 * self.R), "width": mm(self.L), "radial_clearance": um(self.c), "lubricant": "oil",
                 "grid": {"circumferential": self.n_phi, "axial": self.n_z},
                 "cavitation": {"model": self.cavitation, "pressure": bar(self.p_cav)},
                 "edge_pressure": "closed" if all(self.walls) else self.edges()}
        if self.refine:
            entry["grid"]["refine"] = self.refine
        if any(self.ambient):
            entry["ambient_fill"] = {"left": self.ambient[0], "right": self.ambient[1]}
        if self.supply:
            line, pressure = self.supply
            entry["supply"] = {"line": line if line == "widest_gap" else deg(line), "pressure": bar(pressure)}
        if self.features:
            entry["features"] = {f.name: f.text(self.R, self.L) for f in self.features}
        if self.profiles:
            entry["shape"] = [p.text() for p in self.profiles]
        if self.roughness:
            entry["roughness"] = {side: {"sigma": um(sigma), "gamma": gamma}
                                  for side, (sigma, gamma) in self.roughness.items()}
        if self.asperities:
            entry["asperities"] = self.asperities_text()
        if self.column:
            entry["compliance"] = {"model": "column", "composite_modulus": f"{number(1e-9 * self.column[0])} GPa",
                                   "length": mm(self.column[1])}
        for key, default in (("cavitated_shear", "film_share"), ("shear_force", "full"), ("solver", "newton"), ("pressures", "gauge")):
            if getattr(self, key) != default:
                entry[key] = getattr(self, key)
        if self.coupling:
            entry["coupling"] = self.coupling
        if self.heat:
            entry["thermal"] = self.heat.text()
        return entry

    def asperities_text(self):
        a = self.asperities
        return {"model": a["model"], "roughness": um(a["sigma"]), "mean_summit_height": um(a["summits"]), "elastic_factor": a["factor"],
                "composite_modulus": f"{number(1e-9 * a['modulus'])} GPa", "friction": a["friction"]}

    # -- its gap by formula

    def land(self, e, tilt, phi, z, turn=0.0):
        """Gap of the rigid surfaces without features, eccentricity e [m] and slope of the axis [-]."""
        x, y = e[0] + tilt[0] * z, e[1] + tilt[1] * z
        gap = self.c - x * np.cos(phi) - y * np.sin(phi)
        for profile in self.profiles:
            gap = gap + profile.opening(phi, z, self.L, turn)
        return gap

    def oil_gap(self, h, land, phi, z, turn=0.0):
        """The gap whose oil counts as the film's: what fills the depth of a fed feature is the supply's, a pocket's under it is not."""
        gap = h
        for f in self.features:
            if f.pressure is not None and f.depth > 0:
                gap = gap - f.depth * f.covers(phi, z, turn)
        return np.maximum(gap, land)

    def is_fed(self, phi, z, turn):
        """Whether points lie in features that are fed."""
        fed = np.zeros(np.broadcast(phi, z).shape, bool)
        for f in self.features:
            if f.pressure is not None:
                fed |= f.covers(phi, z, turn)
        return fed

    def atmosphere(self):
        """Its pressure on the scale that the model counts from [Pa]."""
        return 1.01325e5 if self.pressures == "absolute" else 0.0

    def fed_pressures(self):
        """Of edges, line and features [Pa]."""
        line = [self.supply[1]] if self.supply else []
        return [*self.p_edge, *line, *(f.pressure for f in self.features if f.pressure is not None)]

    def middle_is_open(self, turn=0.0):
        """Whether there is land at half width."""
        phi = np.linspace(0, 2 * PI, 721)
        return not all(any(f.depth > 0 and f.covers(at, 0.0, turn) for f in self.features) for at in phi)

    def deepest(self):
        return sum(f.depth for f in self.features)

    def varies_on(self, surface):
        """Whether this surface's shape varies around the bearing, so that turning it moves the gap."""
        return (any(f.on == surface and f.depth > 0 and f.arc < 2 * PI for f in self.features)
                or any(p.on == surface and p.kind in ("ovality", "lobes") for p in self.profiles))

    def room(self):
        """How far the journal may go in any direction without touching [m]; at least a tenth of the clearance."""
        phi, z = np.linspace(0, 2 * PI, 181)[:, None], np.linspace(-0.5, 0.5, 21)[None, :] * self.L
        return float(self.land((0, 0), (0, 0), phi, z).min())

    # -- symmetries

    def mirrored_z(self):
        """The bearing seen from the other end, with y kept: z -> -z."""
        b = copy.deepcopy(self)
        b.p_edge, b.ambient, b.walls = self.p_edge[::-1], self.ambient[::-1], self.walls[::-1]
        for f in b.features:
            f.z = -f.z
        for p in b.profiles:
            if p.kind == "taper":
                p.size = -p.size
        return b

    def mirrored_phi(self):
        """phi -> -phi."""
        b = copy.deepcopy(self)
        for part in (*b.features,):
            part.phi = -part.phi
        for p in b.profiles:
            p.angle = -p.angle
        for place in b.refine:
            if place["towards"] == "angle":
                place["angle"] = deg(-math.radians(float(place["angle"].split()[0])))
        if self.supply and self.supply[0] != "widest_gap":
            b.supply = (-self.supply[0], self.supply[1])
        return b

    def turned(self, angle):
        """phi -> phi + angle, both surfaces together."""
        b = copy.deepcopy(self)
        for f in b.features:
            f.phi += angle
        for p in b.profiles:
            p.angle += angle
        for place in b.refine:
            if place["towards"] == "angle":
                place["angle"] = deg(math.radians(float(place["angle"].split()[0])) + angle)
        if self.supply and self.supply[0] != "widest_gap":
            b.supply = (self.supply[0] + angle, self.supply[1])
        return b

    def on_nodes(self):
        """The same with line and borders of features as near to nodes as round-off lets them be."""
        b = copy.deepcopy(self)
        cell_phi, cell_z = 2 * PI / b.n_phi, b.L / (b.n_z - 1)
        for f in b.features:
            f.phi = cell_phi * round(f.phi / cell_phi)
            if f.arc < 2 * PI:
                f.arc = 2 * cell_phi * max(1, round(f.arc / (2 * cell_phi)))
            if f.kind == "hole":
                f.length = f.arc * b.R
            elif f.length < b.L:
                f.length = 2 * cell_z * max(1, round(f.length / (2 * cell_z)))
                f.z = cell_z * round(f.z / cell_z)
        if self.supply and self.supply[0] != "widest_gap":
            b.supply = (cell_phi * round(self.supply[0] / cell_phi), self.supply[1])
        return b

    def reordered(self):
        b = copy.deepcopy(self)
        b.features.reverse()
        b.profiles.reverse()
        return b

    def on_grid(self, factor):
        b = copy.deepcopy(self)
        b.n_phi, b.n_z = factor * self.n_phi, factor * (self.n_z - 1) + 1
        return b

    def with_solver(self, solver):
        b = copy.deepcopy(self)
        b.solver = solver
        return b


# -- generator


def log_uniform(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def rounded(value, digits=4):
    return float(f"{value:.{digits}g}")


def random_feature(rng, b, name):
    """One feature of at least 2.2 cells each way, within the width; more cells where refinement makes some larger."""
    cells = 4 if b.refine else 2.2
    kind = rng.choice(["hole", "oval_hole", "axial_groove", "circumferential_groove", "pocket"])
    cell_phi, cell_z = 2 * PI / b.n_phi, b.L / (b.n_z - 1)
    low_phi, low_z = cells * cell_phi, cells * cell_z
    arc = rng.uniform(low_phi, max(1.5 * low_phi, 0.8))
    length = rng.uniform(low_z, max(1.2 * low_z, 0.6 * b.L))
    if kind == "hole":
        size = max(low_phi * b.R, low_z)
        if size > 0.8 * b.L:
            kind = "oval_hole"
        else:
            length = rng.uniform(size, max(size, min(0.5 * b.L, b.R)))
            arc = length / b.R
    if kind == "circumferential_groove":
        arc = 2 * PI if rng.random() < 0.5 else rng.uniform(1.5, 5)
        length = rng.uniform(low_z, max(1.2 * low_z, 0.4 * b.L))
    if kind == "axial_groove" and rng.random() < 0.3:
        length = b.L
    z = 0.0
    if length < b.L and rng.random() < 0.6:
        z = rng.uniform(-1, 1) * 0.5 * (b.L - length) * (1 if rng.random() < 0.2 else 0.8)
    is_fed = rng.random() < 0.6
    depth = rng.choice([0.0, rng.uniform(0.2, 3) * b.c, log_uniform(rng, 5e-5, 1e-3)])
    if not is_fed and depth == 0:
        depth = rng.uniform(0.2, 3) * b.c
    pressure = max(b.p_cav, 0) + rounded(log_uniform(rng, 1e4, 5e5)) if is_fed else None
    on = rng.choice(["shell", "shell", "journal"])
    return Feature(name, kind, on, rounded(rng.uniform(-PI, PI)), rounded(z), rounded(arc) if arc < 2 * PI else 2 * PI,
                   rounded(length) if length < b.L else b.L, pressure, rounded(depth))


def touch(a, b):
    """Whether two features of one surface are nearer to each other than a tenth of a radian and a tenth of a mm."""
    along = abs(a.z - b.z) < 0.5 * (a.length + b.length) + 1e-4
    apart = abs(math.remainder(a.phi - b.phi, 2 * PI))
    return along and apart < 0.5 * (a.arc + b.arc) + 0.1


def add_features(rng, b, count):
    for k in range(count):
        feature = random_feature(rng, b, f"f{k}")
        # Overlaps are legal where neither is fed or both have one pressure; most machines have none.
        if not any(touch(feature, other) for other in b.features):
            b.features.append(feature)


def add_profiles(rng, b):
    for _ in range(rng.choice([0, 0, 0, 1, 1, 2])):
        kind = rng.choice(["barrel", "taper", "ovality", "lobes"])
        size = rounded(rng.uniform(0.05, 0.3) * b.c)
        if kind == "taper" and rng.random() < 0.5:
            size = -size
        angle = rounded(rng.uniform(-PI, PI)) if kind in ("ovality", "lobes") else 0.0
        b.profiles.append(Profile(kind, rng.choice(["shell", "shell", "journal"]), size, angle, rng.choice([2, 3, 4])))


def add_feed(rng, b):
    """Pressures at cavitation, edges and supply so that oil can come in, sometimes by the edges alone."""
    b.pressures = rng.choice(["gauge"] * 7 + ["absolute"])
    b.p_cav = rng.choice([0.0, 0.0, -5e4, 2e4]) if b.pressures == "gauge" else rng.choice([0.0, 1.01325e5])
    edge = b.p_cav if rng.random() < 0.4 else b.p_cav + rounded(rng.uniform(1e4, 3e5))
    b.p_edge = (edge, edge) if rng.random() < 0.7 else (edge, b.p_cav + rounded(rng.uniform(0, 2e5)))
    if rng.random() < 0.3 and b.cavitation == "mass_conserving" and min(b.p_edge) <= b.p_cav:
        # An edge above the cavitation pressure is flooded.
        b.ambient = tuple(rounded(rng.random(), 2) if p <= b.p_cav else 1.0 for p in b.p_edge)
    if rng.random() < 0.55:
        line = "widest_gap" if rng.random() < 0.5 else rounded(rng.uniform(-PI, PI))
        b.supply = (line, max(b.p_cav, 0) + rounded(rng.choice([0.0, rng.uniform(1e4, 5e5)])))


def add_surfaces(rng, b):
    sigma = rounded(rng.uniform(0.005, 0.03) * b.c)
    if rng.random() < 0.2:
        b.roughness = {"shell": (sigma, rng.choice([1.0, 3.0, 9.0, 0.2])), "journal": (0.6 * sigma, rng.choice([1.0, 4.0]))}
    if rng.random() < 0.25:
        b.asperities = {"model": rng.choice(["greenwood_tripp", "greenwood_tripp_fit"]), "sigma": sigma, "factor": 3e-3,
                        "summits": rounded(rng.choice([0.0, rng.uniform(0, 2)]) * sigma),
                        "modulus": rounded(rng.uniform(50e9, 150e9)), "friction": 0.1}
    if rng.random() < 0.2:
        b.column = (rounded(log_uniform(rng, 3e9, 1e11)), rounded(rng.uniform(1e-3, 0.5 * b.R)))


def random_bearing(rng, grids, is_plain=False):
    """A bearing with every feature at times; `is_plain`: isoviscous, rigid, smooth, round."""
    R = rounded(log_uniform(rng, 8e-3, 6e-2))
    b = Bearing(R, rounded(2 * R * rng.uniform(0.25, 1.1)), rounded(R * log_uniform(rng, 5e-4, 3e-3)),
                rounded(log_uniform(rng, 3e-3, 6e-2)), *rng.choice(grids))
    b.cavitation = rng.choice(["mass_conserving"] * 3 + ["reynolds", "guembel"])
    b.cavitated_shear = rng.choice(["film_share", "film_share", "full"])
    b.shear_force = rng.choice(["full", "full", "torque_only"])
    add_feed(rng, b)
    if not is_plain and rng.random() < 0.2:
        b.refine = [rng.choice([{"towards": "edges", "factor": 2.0}, {"towards": "features", "factor": 2.0},
                                {"towards": "angle", "angle": deg(rounded(rng.uniform(-PI, PI))), "factor": 3.0}])]
    add_features(rng, b, rng.choice([0, 1, 1, 2, 3]))
    if not is_plain:
        add_profiles(rng, b)
        add_surfaces(rng, b)
        law = rng.choice([None, None, "barus", "roelands"])
        if law:
            b.viscosity_law = (law, rounded(log_uniform(rng, 1e-9, 2e-8)) if law == "barus" else rounded(rng.uniform(0.3, 0.7)))
        b.is_compressible = rng.random() < 0.2
        if not b.is_compressible and rng.random() < 0.2:
            b.bulk_modulus = rounded(log_uniform(rng, 3e8, 3e9))
    if rng.random() < 0.9:
        share_one_pressure(b)
    feed_from_line(b)
    close_edges(rng, b)
    if is_starved(b):
        b.supply = ("widest_gap", max(b.p_cav, 0) + 1e5)
    return b


def close_edges(rng, b):
    """Walls at both edges of some, at one of others: oil is at p_cav there where nothing feeds it."""
    draw = rng.random()
    b.walls = (True, True) if draw < 0.1 else (True, False) if draw < 0.15 else (False, draw < 0.2)
    b.p_edge = tuple(b.p_cav if wall else p for p, wall in zip(b.p_edge, b.walls))
    b.ambient = tuple(0.0 if wall else fill for fill, wall in zip(b.ambient, b.walls))


def feed_from_line(b):
    """A feature of the shell on a fixed line has the line's pressure: the program refuses another one."""
    if not b.supply or b.supply[0] == "widest_gap":
        return
    for f in b.features:
        if f.pressure is not None and f.on == "shell" and abs(math.remainder(f.phi - b.supply[0], 2 * PI)) <= f.arc / 2:
            f.pressure = b.supply[1]


def share_one_pressure(b):
    """One oil gallery feeds line and features: places of different pressures that overlap have an unlimited flow."""
    fed = [f for f in b.features if f.pressure is not None]
    if not fed:
        return
    pressure = b.supply[1] if b.supply else fed[0].pressure
    for f in fed:
        f.pressure = pressure
        if f.length > 0.9 * b.L and pressure not in b.p_edge:
            f.length, f.z = rounded(0.8 * b.L), 0.0


def reservoirs_touch(b):
    """Whether places prescribed at different pressures meet, where the flow from one to the other has no limit on finer grids."""
    # Land of less than half a cell is none to the grid: the program warns of it.
    least = b.L / (b.n_z - 1)
    for edge, side in [(p, side) for p, side, wall in zip(b.p_edge, (-1, 1), b.walls) if not wall]:
        if b.supply and b.supply[1] != edge:
            return True
        if any(f.pressure not in (None, edge) and 2 * side * f.z + f.length > b.L - least for f in b.features):
            return True
    fed = [f for f in b.features if f.pressure is not None]
    if any(f.on != g.on for f in fed for g in fed):
        return True
    return bool(b.supply) and any(f.pressure != b.supply[1] for f in fed)


def corner_power(b, pumped):
    """What is dissipated within one cell where places of different pressures touch, which no sum over cells sees [W]."""
    return 0.5 * abs(pumped) if reservoirs_touch(b) else 0.0


def land_power(b, mu, land_gap, phi, z, turn=0.0):
    """What the oil of fed grooves dissipates on land narrower than a cell before an edge, beside what the nodes' cell of it shows [W].

    Over the land flows h^3 dp/(12 mu l) per length, h the gap of the land alone: most of an edge node's cell may be groove, and
    counts with its depth in the thickness reported there. Between the nodes of a cell dz the sum over cells sees l = dz.
    """
    extra, dphi = 0.0, 2 * PI / len(phi)
    for f in b.features:
        if f.pressure is None or f.kind in ("hole", "oval_hole"):
            continue
        around, _ = f.distances(phi, f.z, turn)
        for pressure, side, is_wall in zip(b.p_edge, (-1, 1), b.walls):
            dz = z[1] - z[0] if side < 0 else z[-1] - z[-2]
            land = 0.5 * b.L - side * f.z - 0.5 * f.length
            if is_wall or not 0 < land < dz:
                continue
            at = (slice(None), 0 if side < 0 else -1)
            of_groove = np.abs(around) < 1
            each = (land_gap[at] ** 3 / (12 * mu[at]) * (f.pressure - pressure) ** 2 * b.R * dphi * (1 / land - 1 / dz))[of_groove]
            extra += float(each.sum())
    return extra


def is_starved(b):
    """Nothing presses oil in: such a film has only the empty answer."""
    is_fed = b.supply or any(f.pressure is not None for f in b.features)
    return not is_fed and max(b.p_edge) <= b.p_cav
