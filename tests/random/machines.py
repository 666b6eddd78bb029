"""Random machines with oil films: rotors on a planar joint and slider-cranks, their symmetries and their model files. SI units."""

import copy
import math
from dataclasses import dataclass, field

import bearings
import heat
from bearings import PI, log_uniform, rounded
from model_text import deg, mm, number, rpm, um, yaml


@dataclass
class Size:
    """What grids and numbers of steps are drawn from."""

    grids: list
    steps: list


FULL = Size([(24, 5), (30, 7), (36, 7), (40, 7)], [10, 15, 25])
SMALL = Size([(20, 5), (24, 5), (24, 7), (32, 7)], [5, 8, 12])


def newton(value):
    return f"{number(value)} N"


@dataclass
class Load:
    """A force on a rotor: constant + swing cos(rate t + phase) along x and sin along y, at height z of the rotor [N]."""

    constant: tuple
    swing: tuple
    rate: float
    phase: float

    def at(self, t):
        angle = self.rate * t + self.phase
        return (self.constant[0] + self.swing[0] * math.cos(angle), self.constant[1] + self.swing[1] * math.sin(angle))

    def text(self, body):
        def component(constant, swing, function):
            if not swing:
                return newton(constant)
            return {"expression": f"({number(constant)}) + ({number(swing)})*{function}(({number(self.rate)})*t + ({number(self.phase)}))",
                    "unit": "N"}

        return {"type": "force", "body": body, "components": [component(self.constant[0], self.swing[0], "cos"),
                                                               component(self.constant[1], self.swing[1], "sin"), "0 N"]}


@dataclass
class Numerics:
    steps: int
    step: float  # [s]
    kind: str = "time"  # time, angle or error
    spectral_radius: float = 0.8
    error: float = 1e-4


def simulation_text(numerics, speed, crank=None):
    entry = {}
    if crank:
        entry["crank"] = crank
    entry["duration"] = f"{number(1e3 * numerics.steps * numerics.step)} ms"
    if numerics.kind == "error":
        entry["step"] = {"tolerance": numerics.error, "largest": f"{number(1e3 * 2 * numerics.step)} ms"}
    elif numerics.kind == "angle":
        entry["step"] = deg(abs(speed) * numerics.step)
    else:
        entry["step"] = f"{number(1e3 * numerics.step)} ms"
    entry["spectral_radius"] = numerics.spectral_radius
    return entry


def rotated(vector, angle):
    c, s = math.cos(angle), math.sin(angle)
    return (c * vector[0] - s * vector[1], s * vector[0] + c * vector[1])


@dataclass
class Rotor:
    """A rigid rotor in one or two bearings, free in its plane, driven at a constant speed."""

    mass: float
    inertia: tuple  # (xx and yy, zz)
    speed: float
    heights: list  # of the bearings [m]
    bearings: list
    loads: list
    gravity: tuple
    start: tuple  # x, y [m]
    rates: tuple  # [m/s]
    rotation: float
    numerics: Numerics
    order: int = 1

    def named_bearings(self):
        return {f"b{k}": bearing for k, bearing in enumerate(self.bearings)}

    def text(self, note=""):
        frames = {f"at{k}": {"origin": f"0 0 {number(1e3 * z)} mm"} for k, z in enumerate(self.heights)}
        xx, zz = (f"{number(value)} kg.m^2" for value in self.inertia)
        bodies = {"ground": {"frames": frames},
                  "rotor": {"mass": f"{number(self.mass)} kg", "inertia": {"xx": xx, "yy": xx, "zz": zz}, "frames": frames}}
        initial = {"x": um(self.start[0]), "y": um(self.start[1]), "rotation": deg(self.rotation),
                   "x_rate": f"{number(self.rates[0])} m/s", "y_rate": f"{number(self.rates[1])} m/s",
                   "rotation_rate": rpm(self.speed)}
        films = {name: {"shell": f"ground.at{k}", "journal": f"rotor.at{k}"} | b.text() | {"lubricant": f"oil{k}"}
                 for k, (name, b) in enumerate(self.named_bearings().items())}
        model = {"hersey": 1,
                 "gravity": f"{number(self.gravity[0])} {number(self.gravity[1])} 0 m/s^2",
                 "bodies": self._ordered(bodies),
                 "joints": {"plane": {"type": "planar", "between": ["ground", "rotor"], "axis": "z", "initial": initial}},
                 "drives": {"motor": {"joint": "plane", "coordinate": "rotation", "speed": rpm(self.speed)}},
                 "forces": self._ordered({f"load{k}": load.text("rotor") for k, load in enumerate(self.loads)}),
                 "lubricants": {f"oil{k}": b.lubricant() for k, b in enumerate(self.bearings)},
                 "bearings": self._ordered(films),
                 "simulation": simulation_text(self.numerics, self.speed),
                 "output": {"fields_every": f"{number(1e3 * self.numerics.step)} ms"}}
        return note + yaml({key: value for key, value in model.items() if value})

    def _ordered(self, entries):
        return dict(list(entries.items())[::self.order])

    def on_grid(self, factor):
        m = copy.deepcopy(self)
        m.bearings = [b.on_grid(factor) for b in self.bearings]
        return m

    def mirrored_z(self):
        m = copy.deepcopy(self)
        m.bearings = [b.mirrored_z() for b in self.bearings]
        m.heights = [-z for z in self.heights]
        return m

    def mirrored_phi(self):
        m = copy.deepcopy(self)
        flip = lambda v: (v[0], -v[1])
        m.bearings = [b.mirrored_phi() for b in self.bearings]
        m.speed, m.rotation = -self.speed, -self.rotation
        m.gravity, m.start, m.rates = flip(self.gravity), flip(self.start), flip(self.rates)
        for load in m.loads:
            load.constant, load.swing = flip(load.constant), flip(load.swing)
        return m

    def turned(self, angle):
        """By a quarter turn or any other angle about z, both surfaces and all forces together; swings turn by quarters only."""
        m = copy.deepcopy(self)
        m.bearings = [b.turned(angle) for b in self.bearings]
        m.gravity, m.start, m.rates = (rotated(v, angle) for v in (self.gravity, self.start, self.rates))
        for load in m.loads:
            load.constant = rotated(load.constant, angle)
        return m

    def reordered(self):
        m = copy.deepcopy(self)
        m.bearings = [b.reordered() for b in self.bearings]
        m.order = -1
        return m


def random_numerics(rng, speed, steps):
    """Steps of 1 to 5 degrees of the turn."""
    step = rounded(math.radians(log_uniform(rng, 1, 5)) / abs(speed))
    n = Numerics(steps, step, rng.choice(["time", "time", "error"]), rng.choice([0.5, 0.8, 0.8, 0.95]))
    n.error = rounded(log_uniform(rng, 1e-4, 1e-3))
    return n


def random_coupling(rng):
    kind = rng.random()
    if kind < 0.85:
        return None
    return {"scheme": "partitioned", "acceleration": rng.choice(["quasi_newton"] * 4 + ["aitken"])}


def machine_bearing(rng, speed, size_drawn):
    b = bearings.random_bearing(rng, size_drawn.grids, is_plain=rng.random() < 0.3)
    b.solver = rng.choice(["newton", "newton", "multigrid"])
    b.coupling = random_coupling(rng)
    b.heat = heat.random_heat(rng, b, ["isothermal", "film", "film", "film"])
    return b


def random_rotor(rng, size_drawn):
    speed = rounded(log_uniform(rng, 30, 600)) * rng.choice([1, 1, -1])
    films = [machine_bearing(rng, speed, size_drawn) for _ in range(rng.choice([1, 1, 2]))]
    width = max(b.L for b in films)
    heights = [0.0] if len(films) == 1 else [-rounded(2 * width), rounded(rng.uniform(1, 3) * width)]
    unit = min(b.mu * abs(speed) * (b.R / b.c) ** 2 * 2 * b.R * b.L * min(1, (b.L / (2 * b.R)) ** 2) for b in films)
    size = log_uniform(rng, 0.1, 4) * unit * len(films)
    room = min(b.room() for b in films)
    # a rotor that a whirl frequency of a tenth to once the speed belongs to
    mass = rounded(log_uniform(rng, 0.01, 1) * size / (min(b.c for b in films) * speed**2))
    loads = []
    for _ in range(rng.choice([1, 1, 2])):
        at = rng.uniform(-PI, PI)
        swing = rng.choice([0.0, 0.0, rng.uniform(0.2, 1)]) * size
        loads.append(Load((rounded(size * math.cos(at)), rounded(size * math.sin(at))),
                          (rounded(swing), rounded(swing * rng.choice([1, -1, 0.3]))),
                          rounded(abs(speed) * rng.choice([0.5, 1, 2])), rounded(rng.uniform(-PI, PI))))
    at, far = rng.uniform(-PI, PI), rng.uniform(0, 0.7) * room
    zz = rounded(0.5 * mass * min(b.R for b in films) ** 2)
    gravity = (0.0, -9.81) if rng.random() < 0.3 else (0.0, 0.0)
    for b in films:
        soften(b, 10 * size / (2 * b.R * b.L))
    rate = 0.1 * room * abs(speed) if rng.random() < 0.3 else 0.0
    return Rotor(mass, (rounded(mass * (2 * width) ** 2), zz), speed, heights, films, loads, gravity,
                 (rounded(far * math.cos(at)), rounded(far * math.sin(at))),
                 (rounded(rate * rng.uniform(-1, 1)), rounded(rate * rng.uniform(-1, 1))),
                 rounded(rng.uniform(-PI, PI)), random_numerics(rng, speed, rng.choice(size_drawn.steps)))


def soften(b, pressure):
    """Viscosity up to exp(2), columns that yield less than two clearances."""
    if b.viscosity_law and b.viscosity_law[0] == "barus":
        b.viscosity_law = ("barus", rounded(min(b.viscosity_law[1], 2 / max(pressure, 1e5))))
    if b.column:
        modulus, length = b.column
        b.column = (rounded(max(modulus, pressure * length / (2 * b.c))), length)


@dataclass
class SliderCrank:
    """A crank turning at a constant speed, rod and piston; the big end is a film, at times the main bearing, too."""

    radius: float
    rod: float
    masses: tuple  # crank, rod, piston
    speed: float
    angle: float  # of the crank at the start, from top dead centre
    offset: tuple  # of the big end's journal at the start, along the ground's x and y [m]
    gas: tuple  # force on the piston: constant and amplitude of its swing with the crank's angle [N]
    big_end: bearings.Bearing
    main: bearings.Bearing | None
    gravity: tuple
    numerics: Numerics
    order: int = 1

    def named_bearings(self):
        return {"big_end": self.big_end} | ({"main": self.main} if self.main else {})

    def main_offset(self):
        """Where the crank starts in a main bearing that is a film [m]."""
        return (math.copysign(0.1, self.speed) * self.main.room(), -0.2 * self.main.room()) if self.main else (0.0, 0.0)

    def closed(self):
        """Piston height, rod angle and their rates with which the loop closes at the start, the journal off its shell by `offset`."""
        r, rod, theta, main = self.radius, self.rod, self.angle, self.main_offset()
        x, y = main[0] - r * math.sin(theta) - self.offset[0], main[1] + r * math.cos(theta) - self.offset[1]
        beta = math.asin(x / rod)  # the big end lies at (rod sin beta, height - rod cos beta)
        beta_rate = -r * math.cos(theta) * self.speed / (rod * math.cos(beta))
        height = y + rod * math.cos(beta)
        height_rate = -r * math.sin(theta) * self.speed - rod * math.sin(beta) * beta_rate
        return height, beta, height_rate, beta_rate

    def text(self, note=""):
        height, beta, height_rate, beta_rate = self.closed()
        crank, rod, piston = self.masses

        def body(mass, size, **more):
            value = f"{number(mass * size**2 / 6)} kg.m^2"
            return {"mass": f"{number(mass)} kg", "inertia": {"xx": value, "yy": value, "zz": value}, **more}

        bodies = {"crank": body(crank, 2 * self.radius, frames={"pin": {"origin": f"0 {number(1e3 * self.radius)} 0 mm"}}),
                  "piston": body(piston, self.radius),
                  "rod": body(rod, self.rod, centre_of_mass=f"0 {number(-0.6e3 * self.rod)} 0 mm",
                              frames={"big_end": {"origin": f"0 {number(-1e3 * self.rod)} 0 mm"}}),
                  "ground": {"frames": {"cylinder": {"origin": f"0 {number(1e3 * (self.radius + self.rod))} 0 mm"}}}}
        turning = {"rotation": deg(self.angle), "rotation_rate": rpm(self.speed)}
        if self.main:
            turning |= {"x": um(self.main_offset()[0]), "y": um(self.main_offset()[1])}
        main = {"type": "planar" if self.main else "revolute", "between": ["ground", "crank"], "axis": "z", "initial": turning}
        translation = height - (self.radius + self.rod)
        joints = {"main_joint": main,
                  "bore": {"type": "prismatic", "between": ["ground.cylinder", "piston"], "axis": "y",
                           "initial": {"translation": mm(translation), "translation_rate": f"{number(height_rate)} m/s"}},
                  "wrist": {"type": "revolute", "between": ["piston", "rod"], "axis": "z",
                            "initial": {"rotation": deg(beta), "rotation_rate": rpm(beta_rate)}}}
        constant, swing = self.gas
        rate = number(self.speed)
        gas = {"type": "force", "body": "piston", "direction": "0 -1 0", "axes": "ground",
               "magnitude": {"expression": f"{number(constant)} + ({number(swing)})*cos(({rate})*t + ({number(self.angle)}))", "unit": "N"}}
        places = {"big_end": ("rod.big_end", "crank.pin"), "main": ("ground", "crank")}
        films = {name: {"shell": places[name][0], "journal": places[name][1]} | b.text() | {"lubricant": f"oil_{name}"}
                 for name, b in self.named_bearings().items()}
        model = {"hersey": 1, "gravity": f"{number(self.gravity[0])} {number(self.gravity[1])} 0 m/s^2",
                 "bodies": self._ordered(bodies), "joints": self._ordered(joints),
                 "drives": {"motor": {"joint": "main_joint", "coordinate": "rotation", "speed": rpm(self.speed)}},
                 "forces": {"gas": gas},
                 "lubricants": {f"oil_{name}": b.lubricant() for name, b in self.named_bearings().items()},
                 "bearings": self._ordered(films),
                 "simulation": simulation_text(self.numerics, self.speed, None if self.main else "main_joint"),
                 "output": {"fields_every": f"{number(1e3 * self.numerics.step)} ms"}}
        return note + yaml(model)

    def _ordered(self, entries):
        return dict(list(entries.items())[::self.order])

    def on_grid(self, factor):
        m = copy.deepcopy(self)
        m.big_end = self.big_end.on_grid(factor)
        m.main = self.main.on_grid(factor) if self.main else None
        return m

    def mirrored_z(self):
        m = copy.deepcopy(self)
        m.big_end = self.big_end.mirrored_z()
        m.main = self.main.mirrored_z() if self.main else None
        return m

    def mirrored_phi(self):
        """x -> -x: bearing angles phi -> 180 deg - phi."""
        m = copy.deepcopy(self)
        m.big_end = self.big_end.mirrored_phi().turned(PI)
        m.main = self.main.mirrored_phi().turned(PI) if self.main else None
        m.speed, m.angle = -self.speed, -self.angle
        m.offset, m.gravity = (-self.offset[0], self.offset[1]), (-self.gravity[0], self.gravity[1])
        return m

    def reordered(self):
        m = copy.deepcopy(self)
        m.big_end = self.big_end.reordered()
        m.order = -1
        return m


def random_slider_crank(rng, size_drawn):
    speed = rounded(log_uniform(rng, 50, 500)) * rng.choice([1, 1, -1])
    radius = rounded(log_uniform(rng, 0.02, 0.08))
    rod = rounded(radius * rng.uniform(3, 5))
    big_end = machine_bearing(rng, speed, size_drawn)
    main = machine_bearing(rng, speed, size_drawn) if rng.random() < 0.3 else None
    unit = big_end.mu * abs(speed) * (big_end.R / big_end.c) ** 2 * 2 * big_end.R * big_end.L * min(1, (big_end.L / (2 * big_end.R)) ** 2)
    size = log_uniform(rng, 0.2, 3) * unit
    moving = rounded(size * rng.uniform(0.1, 0.6) / (radius * speed**2))
    masses = (rounded(10 * moving), rounded(0.5 * moving), rounded(0.5 * moving))
    at, far = rng.uniform(-PI, PI), rng.uniform(0, 0.6) * big_end.room()
    for b in (big_end, main):
        if b:
            soften(b, 10 * size / (2 * b.R * b.L))
    numerics = random_numerics(rng, speed, rng.choice(size_drawn.steps))
    if not main and numerics.kind == "time" and rng.random() < 0.5:
        numerics.kind = "angle"
    gravity = (0.0, -9.81) if rng.random() < 0.5 else (0.0, 0.0)
    return SliderCrank(radius, rod, masses, speed, rounded(rng.uniform(-PI, PI)),
                       (rounded(far * math.cos(at)), rounded(far * math.sin(at))),
                       (rounded(size * rng.uniform(-0.3, 1)), rounded(size * rng.uniform(0, 0.5))), big_end, main, gravity, numerics)


def random_machine(rng, is_small=False):
    """`is_small`: drawn alike, on coarser grids and for fewer steps."""
    size_drawn = SMALL if is_small else FULL
    return random_rotor(rng, size_drawn) if rng.random() < 0.6 else random_slider_crank(rng, size_drawn)
