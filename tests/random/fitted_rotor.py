"""A random rotor in bearings that an oil circuit feeds and that may wear."""

import copy
import math

import fitted_parts as parts
from fitted_parts import Writing


class Rotor:
    def __init__(self, rng):
        self.rng = rng
        self.speed = rng.choice([1, -1]) * rng.choice([1000, 3000, 6000])  # [rpm]
        self.count = rng.choice([1, 2])
        self.has_wear = rng.random() < 0.6
        self.diameter, self.clearance = rng.choice([20, 50, 80]), rng.choice([1.0, 1.5, 2.5])
        radius, c, mu = self.diameter / 2000, self.clearance * self.diameter / 2e6, rng.choice([5e-3, 20e-3])
        self.c, self.mu, self.width = c, mu, self.diameter * rng.choice([0.3, 0.6])
        omega = abs(self.speed) * math.pi / 30
        unit = mu * omega * (radius / c) ** 2 * 2 * radius * self.width / 1000 * min(1, (self.width / self.diameter) ** 2)
        self.load = unit * self.count * 10 ** rng.uniform(-0.5, 0.9)
        self.direction = rng.uniform(-180, 180)
        self.whirl = rng.choice([0, 0.3])
        self.mass = self.load / (c * omega**2) * 10 ** rng.uniform(-1.5, -0.3)
        self.films = [self.film(k) for k in range(self.count)]
        self.circuit = parts.circuit(rng, [f"groove_{k}" for k in range(self.count)], {"joint": "plane"} if self.speed > 0 else
                                     {"speed": f"{abs(self.speed)} rpm"})
        self.steps = rng.choice([12, 20])
        self.askew = [(rng.uniform(-180, 180), rng.choice([0, 0, 0.3]) * c / (self.width / 2000)) for _ in self.films]  # axis [deg], angle [rad]
        self.is_warm = rng.random() < 0.4
        if self.is_warm:
            parts.warm(rng, self.films, self.circuit, "journal")

    def film(self, k):
        rng = self.rng
        keys = parts.film(rng, {"circumferential": rng.choice([24, 36])}, {"axial": 7})
        self.groove = self.direction + 180 + rng.uniform(-40, 40)
        shape = rng.choice([{"shape": "circumferential_groove", "arc": f"{rng.uniform(100, 200):.4g} deg", "length": f"{0.4 * self.width:.6g} mm"},
                            {"shape": "pocket", "arc": "50 deg", "length": f"{0.5 * self.width:.6g} mm", "depth": "0.2 mm"}])
        keys |= {"diameter": f"{self.diameter} mm", "width": f"{self.width:.8g} mm", "radial_clearance": f"{1e6 * self.c:.8g} um",
                 "features": {"groove": {**shape, "angle": self.groove, "circuit": f"groove_{k}"}}}
        if self.has_wear:
            keys["asperities"] = parts.asperities(rng)
            keys["wear"] = parts.wear(rng, "shell", "journal")
        elif rng.random() < 0.3:
            keys["asperities"] = parts.asperities(rng)
        return keys

    def model(self, turn=0.0, mirror=1):
        speed, direction = mirror * self.speed, mirror * (self.direction + turn)
        x, y = math.cos(math.radians(direction)), math.sin(math.radians(direction))
        rate = speed * math.pi / 30
        heights = [0.0] if self.count == 1 else [-50.0, 50.0]
        frames = {f"at{k}": {"origin": f"0 0 {z} mm"} for k, z in enumerate(heights)}
        seats = copy.deepcopy(frames)
        for k, (axis, angle) in enumerate(self.askew):
            if angle:
                at = math.radians(axis + turn)  # a rotation's axis keeps its component across a mirror only
                seats[f"at{k}"]["rotation"] = {"axis": f"{mirror * math.cos(at)!r} {math.sin(at)!r} 0", "angle": f"{angle!r} rad"}
        start = [0.3 * self.c * 1e6 * value for value in (x, y)]

        def component(value, other, function):
            swing = self.whirl * self.load
            if not swing:
                return f"{self.load * value!r} N"
            # A load that turns with the rotor from the direction of the constant one.
            return {"expression": f"({self.load * value!r}) + ({swing!r})*{function}(({rate!r})*t + ({math.radians(direction)!r}))", "unit": "N"}

        bearings = {}
        for k, film in enumerate(self.films):
            film = copy.deepcopy(film)
            groove = film["features"]["groove"]
            groove["angle"] = f"{mirror * (groove['angle'] + turn)!r} deg"
            bearings[f"b{k}"] = {"shell": f"ground.at{k}", "journal": f"rotor.at{k}", **film}
        inertia = f"{0.5 * self.mass * (self.diameter / 2000) ** 2!r} kg.m^2"
        return {"hersey": 1, "gravity": "0 0 0 m/s^2",
                "lubricants": {"oil": parts.oil(self.mu, self.is_warm)},
                "bodies": {"ground": {"frames": seats},
                           "rotor": {"mass": f"{self.mass!r} kg", "inertia": {"xx": inertia, "yy": inertia, "zz": inertia}, "frames": frames}},
                "joints": {"plane": {"type": "planar", "between": ["ground", "rotor"], "axis": "z",
                                     "initial": {"x": f"{start[0]!r} um", "y": f"{start[1]!r} um", "rotation_rate": f"{speed} rpm"}}},
                "drives": {"motor": {"joint": "plane", "coordinate": "rotation", "speed": f"{speed} rpm"}},
                "forces": {"load": {"type": "force", "body": "rotor",
                                    "components": [component(x, y, "cos"), component(y, x, "sin"), "0 N"]}},
                "circuit": self.circuit, "bearings": bearings,
                "simulation": {"duration": f"{self.steps * 2 / abs(self.speed) / 6 * 1e3!r} ms", "step": f"{2 / abs(self.speed) / 6 * 1e3!r} ms",
                               "spectral_radius": 0.8}}

    def writings(self):
        model = self.model()
        yield "reordered", Writing(parts.backwards(model, ("bodies",), ("bearings",), ("circuit", "nodes"), ("circuit", "elements")))
        # By whole numbers of grid lines, of 24 and of 36 around, which stay where they are.
        yield "turned", Writing(self.model(turn=30 * self.rng.randint(1, 11)))
        if "joint" not in self.circuit["elements"].get("pump", {}):  # a pump that turned backwards would be another machine
            yield "mirrored", Writing(self.model(mirror=-1))
        yield "turned_ways", parts.turned_ways(model)
        for name in parts.ways(self.circuit) if not self.is_warm else ():  # losses in the first half warm the second
            if halves := parts.parted(model, name):
                yield f"parted_{name}", halves
                break
        if self.has_wear:
            yield "counted_otherwise", Writing(parts.counted_otherwise(model, "b0", 4))
            yield "unworn", parts.unworn(model)
        if not self.is_warm:  # oil from a circuit is as warm as its node
            yield "given_pressure", self.with_given_pressure(model)

    def with_given_pressure(self, model):
        """Grooves at nodes of a given pressure are grooves of that pressure."""
        base, other = copy.deepcopy(model), copy.deepcopy(model)
        del other["circuit"]
        pressure = f"{self.rng.uniform(0.5, 4):.4g} bar"
        for k in range(self.count):
            base["circuit"]["nodes"][f"groove_{k}"] = {"pressure": pressure}
            groove = other["bearings"][f"b{k}"]["features"]["groove"]
            del groove["circuit"]
            groove["pressure"] = pressure
        return Writing(other, base=base, without=("circuit/",))
