"""A random piston that its skirt guides, on a crank whose big end has an oil circuit and may wear."""

import copy
import math

import fitted_parts as parts
from fitted_parts import Writing

SIDES = {"h_min_thrust": "h_min_antithrust", "side_force_thrust": "side_force_antithrust", "h_min_antithrust": "h_min_thrust",
         "side_force_antithrust": "side_force_thrust"}


class Engine:
    def __init__(self, rng):
        self.rng = rng
        self.bore = rng.choice([30, 75, 120])  # [mm]
        self.crank, self.ratio = 0.53 * self.bore, rng.uniform(3, 4.5)
        self.rod = self.crank * self.ratio
        self.length, self.offset = self.bore * rng.uniform(0.4, 0.8), self.bore * rng.choice([0, 0.008, -0.008])
        self.speed = rng.choice([1, -1]) * rng.choice([600, 1500, 4000])  # [rpm]
        self.mass = 0.4 * (self.bore / 75) ** 3
        self.mu = rng.choice([4e-3, 20e-3])
        self.gas = rng.uniform(0.1, 1.5) * 1e6 * math.pi * (self.bore / 2000) ** 2  # [N]
        self.start = rng.uniform(-100, 100)  # crank angle [deg]
        self.shift = rng.uniform(-0.8, 0.8) * self.bore
        self.has_big_end = rng.random() < 0.5
        self.steps = rng.choice([20, 40])
        self.skirt = self.skirt_keys()
        self.has_wear = "wear" in self.skirt
        self.rings = self.ring_keys() if rng.random() < 0.4 else {}
        self.big_end, self.circuit = None, None
        if self.has_big_end:
            self.big_end = self.big_end_keys()
            self.circuit = parts.circuit(rng, ["pin"], {"speed": f"{abs(self.speed)} rpm"})

    def skirt_keys(self):
        rng, bore = self.rng, self.bore
        keys = parts.film(rng, {"around": rng.choice([7, 9])}, {"along": rng.choice([11, 15])})
        clearance = bore * rng.uniform(0.3, 1)  # [um]
        keys |= {"kind": "skirt", "diameter": f"{bore} mm", "length": f"{self.length:.8g} mm", "radial_clearance": f"{clearance:.6g} um",
                 "arc": f"{rng.uniform(50, 110):.5g} deg"}
        self.clearance = clearance
        shape = [{"profile": "barrel", "top": f"{rng.uniform(0.1, 0.6) * bore:.5g} um", "bottom": f"{rng.uniform(0.1, 0.4) * bore:.5g} um",
                  "apex": f"{rng.uniform(-0.1, 0.1) * bore:.5g} mm"},
                 {"profile": "ovality", "top": f"{rng.uniform(0, 0.8) * bore:.5g} um", "bottom": f"{rng.uniform(0, 0.8) * bore:.5g} um"}]
        keys["shape"] = shape
        brings_layers = keys["cavitation"] == "mass_conserving" and rng.random() < 0.4
        if brings_layers:
            layers = [f"{rng.uniform(0.1, 1) * clearance:.4g} um" for _ in range(2)]
            keys["oil"] = {"top": layers[0], "bottom": rng.choice([layers[1], "flooded"]), "sides": rng.choice(["dry", "flooded"])}
        elif rng.random() < 0.4:
            keys["ambient_fill"] = rng.choice([0.5, {"top": 0.3, "bottom": 1, "sides": 0.8}])
        if not brings_layers and rng.random() < 0.4:
            keys["edge_pressure"] = rng.choice(["0.2 bar", {"top": "0.3 bar", "bottom": "0 bar", "sides": "closed"}])
        if rng.random() < 0.7:
            keys["asperities"] = parts.asperities(rng)
            if rng.random() < 0.6:
                keys["wear"] = parts.wear(rng, "skirt", None)
        return keys

    def ring_keys(self):
        rng = self.rng
        return {f"ring_{k}": {"type": "piston_ring", "between": ["ground.liner", "piston.skirt"], "bore": f"{self.bore} mm",
                              "height": f"{0.02 * self.bore:.4g} mm", "tension": f"{rng.uniform(0.05, 0.4) * self.bore:.4g} N",
                              "gas": f"{rng.choice([0, 2, 20])} bar", "friction": rng.choice([0.05, 0.12]), "viscosity": f"{1e3 * self.mu} mPa.s"}
                for k in range(rng.choice([1, 2]))}

    def big_end_keys(self):
        rng = self.rng
        keys = parts.film(rng, {"circumferential": 24}, {"axial": 9})
        self.pin = 0.6 * self.bore
        self.hole = rng.uniform(-180, 180)
        keys |= {"diameter": f"{self.pin:.8g} mm", "width": f"{0.4 * self.pin:.8g} mm", "radial_clearance": f"{0.6 * self.pin:.6g} um"}
        keys["features"] = {"hole": {"shape": "circumferential_groove", "arc": "120 deg", "length": f"{0.16 * self.pin:.5g} mm", "circuit": "pin"}}
        keys["asperities"] = parts.asperities(rng)
        keys["wear"] = parts.wear(rng, "shell", "journal")
        return keys

    def model(self, turn=0.0, mirror=1, shift=0.0):
        """Turned about the crank's axis, seen in a mirror, or with the liner's frame elsewhere along it [mm]."""
        up = math.radians(turn)
        sine, cosine = math.sin(up), math.cos(up)
        speed, offset, angle = mirror * self.speed, mirror * self.offset, mirror * self.start
        # The pin's axis keeps to the line that is as far off the liner's as the pin off the piston's.
        lean = -math.asin((self.crank * math.sin(math.radians(angle)) + offset) / self.rod)
        rate = -speed * math.cos(math.radians(angle)) * self.crank / self.rod / math.cos(lean)
        height = self.rod + shift

        def turned(x, y, unit):
            return f"{cosine * x - sine * y!r} {sine * x + cosine * y!r} 0 {unit}"

        inertia = {axis: f"{self.mass * (self.bore / 1000) ** 2 / 6!r} kg.m^2" for axis in ("xx", "yy", "zz")}
        rod = {axis: f"{self.mass * (self.rod / 1000) ** 2 / 10!r} kg.m^2" for axis in ("xx", "yy", "zz")}
        # z of the liner along the turned y, x across it: a third of a turn about one axis in space, or with the turn another.
        bodies = {"ground": {"frames": {"main": {"rotation": {"axis": "z", "angle": f"{turn} deg"}},
                                        "liner": {"origin": turned(0, height, "mm"), "rotation": rotation(up)}}},
                  "crank": {"mass": f"{15 * self.mass} kg", "inertia": {axis: "0.02 kg.m^2" for axis in ("xx", "yy", "zz")},
                            "frames": {"pin": {"origin": f"0 {self.crank!r} 0 mm"}}},
                  "rod": {"mass": f"{1.2 * self.mass} kg", "centre_of_mass": f"0 {0.3 * self.rod!r} 0 mm", "inertia": rod,
                          "frames": {"small_end": {"origin": f"0 {self.rod!r} 0 mm"}}},
                  "piston": {"mass": f"{self.mass} kg", "centre_of_mass": f"0 {0.1 * self.bore!r} 0 mm", "inertia": inertia,
                             "frames": {"pin": {"origin": f"{offset!r} 0 0 mm"},
                                        "skirt": {"origin": f"0 {-0.05 * self.bore!r} 0 mm", "rotation": {"axis": "x", "angle": "-90 deg"}}}}}
        joints = {"main": {"type": "revolute", "between": ["ground.main", "crank"], "axis": "z",
                           "initial": {"rotation": f"{angle!r} deg", "rotation_rate": f"{speed} rpm"}},
                  "big_end": {"type": "planar" if self.big_end else "revolute", "between": ["crank.pin", "rod"], "axis": "z",
                              "initial": {"rotation": f"{math.degrees(lean) - angle!r} deg", "rotation_rate": f"{rate - speed!r} rpm"}},
                  "wrist": {"type": "revolute", "between": ["rod.small_end", "piston.pin"], "axis": "z",
                            "initial": {"rotation": f"{-math.degrees(lean)!r} deg", "rotation_rate": f"{-rate!r} rpm"}}}
        skirt = {"skirt": "piston.skirt", "liner": "ground.liner", **copy.deepcopy(self.skirt)}
        model = {"hersey": 1, "gravity": turned(0, -9.81, "m/s^2"),
                 "lubricants": {"oil": {"viscosity": f"{1e3 * self.mu} mPa.s", "density": "850 kg/m^3"}},
                 "bodies": bodies, "joints": joints,
                 "drives": {"motor": {"joint": "main", "coordinate": "rotation", "speed": f"{speed} rpm"}},
                 "forces": {"gas": {"type": "force", "body": "piston", "direction": turned(0, -1, "").strip(),
                                    "magnitude": f"{self.gas!r} N", "axes": "ground"}, **self.rings},
                 "bearings": {"skirt": skirt},
                 "simulation": {"duration": f"{self.steps / abs(self.speed) / 6 * 1e3!r} ms", "step": f"{1 / abs(self.speed) / 6 * 1e3!r} ms",
                                "spectral_radius": 0.8}}
        if self.big_end:
            big_end = copy.deepcopy(self.big_end)
            big_end["features"]["hole"]["angle"] = f"{self.hole if mirror > 0 else 180 - self.hole!r} deg"
            model["bearings"]["big_end"] = {"shell": "rod", "journal": "crank.pin", **big_end}
            model["circuit"] = self.circuit
        return model

    def writings(self):
        model = self.model()
        order = [("bodies",), ("joints",), ("forces",), ("bearings",), ("bearings", "skirt", "shape")]
        yield "reordered", Writing(parts.backwards(model, *order, *([("circuit", "nodes"), ("circuit", "elements")] if self.circuit else [])))
        yield "turned", Writing(self.model(turn=self.rng.uniform(-180, 180)))
        yield "liner_moved", Writing(self.model(shift=self.shift))
        yield "mirrored", Writing(self.model(mirror=-1), renamed=SIDES, turned_round=("side_force", "offset_top", "offset_bottom"))
        if self.circuit:
            yield "turned_ways", parts.turned_ways(model)
        if self.has_wear:
            yield "counted_otherwise", Writing(parts.counted_otherwise(model, "skirt", 4))
            yield "unworn", parts.unworn(model)


def rotation(turn):
    """Axis and angle of -90 deg about x, followed by `turn` [rad] about z."""
    half, quarter = 0.5 * turn, -0.25 * math.pi
    w, x, y, z = math.cos(half) * math.cos(quarter), math.cos(half) * math.sin(quarter), math.sin(half) * math.sin(quarter), math.sin(half) * math.cos(quarter)
    return {"axis": f"{x!r} {y!r} {z!r}", "angle": f"{2 * math.degrees(math.acos(w))!r} deg"}
