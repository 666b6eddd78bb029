"""Reads a bearing with its operating point from a model file: the keys that the second solver knows, and no others."""

import math
import re

import yaml

from bearing import Bearing, Feature, Profile
from film import Motion

UNITS = {"m": 1, "mm": 1e-3, "um": 1e-6, "rad": 1, "deg": math.pi / 180, "rpm": math.pi / 30, "rad/s": 1, "Pa": 1, "kPa": 1e3,
         "MPa": 1e6, "GPa": 1e9, "bar": 1e5, "Pa.s": 1, "mPa.s": 1e-3, "N": 1, "kN": 1e3, "m/s": 1, "mm/s": 1e-3, "1/Pa": 1,
         "1/GPa": 1e-9, "1/MPa": 1e-6}


class Unknown(Exception):
    """A key or value that this program does not know."""


def quantity(text):
    if isinstance(text, (int, float)):
        return float(text)
    match = re.fullmatch(r"\s*([-+0-9.eE]+)\s*(\S*)\s*", str(text))
    if not match or match[2] not in UNITS and match[2]:
        raise Unknown(f"'{text}'")
    return float(match[1]) * UNITS.get(match[2], 1)


class Keys:
    """A mapping whose keys are taken one by one; none may be left."""

    def __init__(self, mapping, where):
        self.left, self.where = dict(mapping), where

    def take(self, key, default=None):
        return self.left.pop(key, default)

    def number(self, key, default=0.0):
        value = self.take(key)
        return default if value is None else quantity(value)

    def choice(self, key, default, allowed):
        value = self.take(key, default)
        if value not in allowed:
            raise Unknown(f"{self.where}.{key}: {value}")
        return value

    def end(self):
        if self.left:
            raise Unknown(f"{self.where}: {', '.join(self.left)}")


def read(path):
    """Bearing, motion and load (size, angle) or None of a model file with one bearing."""
    with open(path, encoding="utf-8") as file:
        top = Keys(yaml.load(file, Loader=yaml.BaseLoader), "model")  # all of it text: `on` is a key here
    top.take("hersey"), top.take("title"), top.take("description")
    oils, bearings = top.take("lubricants", {}), top.take("bearings", {})
    top.end()
    if len(bearings) != 1:
        raise Unknown("more than one bearing")
    keys = Keys(next(iter(bearings.values())), "bearing")
    oil = Keys(oils[keys.take("lubricant")], "lubricant")
    clearance = keys.take("radial_clearance")
    clearance = quantity(clearance) if clearance is not None else 0.5 * quantity(keys.take("diametral_clearance"))
    b = Bearing(0.5 * keys.number("diameter"), keys.number("width"), clearance, oil.number("viscosity"))
    _oil(b, oil)
    point = Keys(keys.take("operating_point"), "operating_point")
    p_cav = _cavitation(b, keys)
    _edges(b, keys, p_cav)
    _supply(b, keys, p_cav)
    turn = point.number("journal_angle")
    for name, feature in (keys.take("features") or {}).items():
        b.features.append(_feature(b, Keys(feature, name), p_cav, turn))
    for profile in keys.take("shape") or []:
        b.profiles.append(_profile(Keys(profile, "shape"), turn))
    b.cavitated_shear = keys.choice("cavitated_shear", "film_share", ("film_share", "full"))
    b.shear_force = keys.choice("shear_force", "full", ("full", "torque_only"))
    for key in ("grid", "solver", "pressures"):  # what must not change an answer; p_cav is on the scale of all others
        keys.take(key)
    keys.end()
    motion, load = _point(b, point)
    _refuse_what_turns(b, motion)
    return b, motion, load


def _oil(b, oil):
    law = oil.take("pressure_viscosity", 0)
    if isinstance(law, dict):
        law = Keys(law, "pressure_viscosity")
        if law.choice("law", None, ("barus", "roelands")) == "barus":
            b.barus = law.number("alpha")
        else:
            b.roelands = law.number("z")
        law.end()
    else:
        b.barus = quantity(law)
    law = oil.take("compressibility", "incompressible")
    law = Keys({"law": law} if isinstance(law, str) else law, "compressibility")
    name = law.choice("law", None, ("incompressible", "dowson_higginson", "constant_bulk_modulus"))
    if name == "dowson_higginson":
        b.dowson_higginson = (law.number("rise", 0.6e-9), law.number("saturation", 1.7e-9))
    elif name == "constant_bulk_modulus":
        b.bulk_modulus = law.number("bulk_modulus")
    law.end()
    oil.end()


def _cavitation(b, keys):
    model = keys.take("cavitation", "mass_conserving")
    model = Keys({"model": model} if isinstance(model, str) else model, "cavitation")
    b.cavitation = model.choice("model", "mass_conserving", ("mass_conserving", "reynolds", "guembel"))
    pressure = model.number("pressure")
    model.end()
    return pressure


def _both(value, default):
    if value is None:
        return default, default
    if isinstance(value, dict):
        value = Keys(value, "edges")
        sides = value.take("left"), value.take("right")
        value.end()
        return sides
    return value, value


def _edges(b, keys, p_cav):
    pressures, fills = _both(keys.take("edge_pressure"), 0), _both(keys.take("ambient_fill"), 0)
    b.edges = tuple(None if p == "closed" else (quantity(p) - p_cav, float(f)) for p, f in zip(pressures, fills))


def _supply(b, keys, p_cav):
    supply = keys.take("supply")
    if supply is None:
        return
    supply = Keys(supply, "supply")
    line = supply.take("line")
    b.line = line if line == "widest_gap" else quantity(line)
    b.line_pressure = max(supply.number("pressure") - p_cav, 0.0)
    supply.end()


def _feature(b, keys, p_cav, turn):
    kind = keys.choice("shape", None, ("hole", "oval_hole", "axial_groove", "circumferential_groove", "pocket"))
    on_journal = keys.choice("on", "shell", ("shell", "journal")) == "journal"
    phi, z, pressure, depth = keys.number("angle"), keys.number("z"), keys.take("pressure"), keys.number("depth")
    if kind == "hole":
        length = keys.number("diameter")
        arc = length / b.R
    elif kind == "oval_hole":
        arc, length = keys.number("around") / b.R, keys.number("along")
    else:
        arc, length = keys.number("arc", 2 * math.pi), keys.number("length", b.L)
    keys.end()
    prescribed = None if pressure is None else max(quantity(pressure) - p_cav, 0.0)
    return Feature("hole" in kind, phi + turn * on_journal, z, arc, length, prescribed, depth, on_journal)


def _profile(keys, turn):
    kind = keys.choice("profile", None, ("barrel", "taper", "ovality", "lobes"))
    on_journal = keys.choice("on", "shell", ("shell", "journal")) == "journal"
    size = keys.number({"barrel": "drop", "taper": "rise", "ovality": "amplitude", "lobes": "offset"}[kind])
    angle = keys.number("angle", 0.5 * math.pi if kind == "lobes" else 0.0)
    profile = Profile(kind, size, angle + turn * on_journal, int(keys.take("count", 2)), on_journal)
    keys.end()
    return profile


def _point(b, point):
    speeds = point.number("journal_speed"), point.number("shell_speed")
    tilt = tuple(math.tan(point.number(key)) for key in ("tilt_x", "tilt_y"))
    down = -0.5 * math.pi
    load_at, at = point.number("load_angle", down), point.number("eccentricity_angle", down)
    load, ratio, speed = point.take("load"), point.take("eccentricity_ratio"), point.number("radial_velocity")
    point.end()
    e = 0.0 if ratio is None else float(ratio) * b.c
    towards = (math.cos(at), math.sin(at))
    motion = Motion((e * towards[0], e * towards[1]), tilt, (speed * towards[0], speed * towards[1]), *speeds)
    return motion, None if load is None else (quantity(load), load_at)


def _refuse_what_turns(b, motion):
    """A pocket that travels keeps its oil: at one moment of the turn that is a convention, not an answer."""
    for f in b.features:
        if f.pressure is None and f.arc < 2 * math.pi and (motion.journal if f.on_journal else motion.shell):
            raise Unknown("a pocket that travels")
    for f in b.profiles:
        if f.kind in ("ovality", "lobes") and motion.shell:
            raise Unknown("a shell that is not round and turns")
