"""Changes of a model that must leave its answer as it is, or change it in a known way."""

import re

import tree as trees
from tree import QUANTITY, dimension

# (model, path, value): written out, it means what leaving it out means.
NEUTRAL = [
    ("PLAIN", "bearings.main.ambient_fill", "1"),  # an edge above the cavitation pressure is flooded
    ("PLAIN", "bearings.main.cavitation", "mass_conserving"),
    ("PLAIN", "bearings.main.cavitation", {"model": "mass_conserving", "pressure": "0 Pa"}),
    ("PLAIN", "bearings.main.pressures", "gauge"),
    ("PLAIN", "bearings.main.thermal", "isothermal"),
    ("PLAIN", "bearings.main.thermal", {"model": "isothermal", "temperature": "70 degC"}),
    ("PLAIN", "bearings.main.thermal", {"model": "isothermal", "temperature": "70 degC",
                                        "expansion": {"shell": "0 1/K", "journal": "0 1/K"}}),
    ("PLAIN", "bearings.main.thermal", {"model": "isothermal", "temperature": "20 degC",
                                        "expansion": {"shell": "23e-6 1/K", "journal": "12e-6 1/K", "reference": "20 degC"}}),
    ("PLAIN", "bearings.main.shape", [{"profile": "barrel", "drop": "0 um"}]),
    ("PLAIN", "bearings.main.shape", [{"profile": "taper", "rise": "0 um", "on": "journal"}]),
    ("PLAIN", "bearings.main.shape", [{"profile": "ovality", "amplitude": "0 um", "angle": "17 deg"}]),
    ("PLAIN", "bearings.main.shape", [{"profile": "lobes", "count": "3", "offset": "0 um"}]),
    ("PLAIN", "bearings.main.features", {}),
    ("PLAIN", "bearings.main.asperities", "none"),
    ("PLAIN", "bearings.main.asperities", {"model": "greenwood_tripp", "roughness": "1 um", "composite_modulus": "115 GPa",
                                           "elastic_factor": "0"}),
    ("PLAIN", "bearings.main.asperities", {"model": "greenwood_tripp_fit", "roughness": "0.01 um", "composite_modulus": "115 GPa"}),
    ("PLAIN", "bearings.main.roughness", {"shell": {"sigma": "1 um"}, "flow_factors": "none"}),
    ("PLAIN", "bearings.main.compliance", "rigid"),
    ("PLAIN", "bearings.main.shell_surface", "rigid"),
    ("PLAIN", "bearings.main.journal_surface", "rigid"),
    ("PLAIN", "bearings.main.cavitated_shear", "film_share"),
    ("PLAIN", "bearings.main.turbulence", "none"),
    ("PLAIN", "bearings.main.turbulence", "ng_pan"),  # a film below its onset is laminar to the bit
    ("PLAIN", "bearings.main.turbulence", {"model": "hirs", "transition": "taylor", "onset": "41.2", "full": "90", "prandtl": "1"}),
    ("PLAIN", "bearings.main.shear_force", "full"),
    ("PLAIN", "bearings.main.solver", "newton"),
    ("PLAIN", "bearings.main.coupling", {"scheme": "partitioned", "relaxation": "0.5"}),  # a bearing by itself has no bodies
    ("PLAIN", "bearings.main.permissible_pressure", "60 MPa"),
    ("PLAIN", "bearings.main.grid.refine", [{"towards": "edges", "factor": "1"}]),
    ("PLAIN", "bearings.main.grid.refine", [{"towards": "angle", "angle": "40 deg", "factor": "1"}]),
    ("PLAIN", "bearings.main.materials", {"shell": {"youngs_modulus": "60 GPa", "poisson_ratio": "0.3"},
                                          "journal": {"youngs_modulus": "210 GPa", "poisson_ratio": "0.3"}}),
    ("PLAIN", "bearings.main.operating_point.shell_speed", "0 rpm"),
    ("PLAIN", "bearings.main.operating_point.tilt_x", "0 deg"),
    ("PLAIN", "bearings.main.operating_point.tilt_y", "0 deg"),
    ("PLAIN", "bearings.main.operating_point.journal_angle", "33 deg"),  # nothing on the journal to turn
    ("PLAIN", "lubricants.oil.pressure_viscosity", "0"),
    ("PLAIN", "lubricants.oil.pressure_viscosity", {"law": "barus", "alpha": "0 1/Pa"}),
    ("PLAIN", "lubricants.oil.pressure_viscosity", {"law": "roelands", "z": "0"}),
    ("PLAIN", "lubricants.oil.shear_thinning", "none"),
    ("PLAIN", "lubricants.oil.shear_thinning", {"law": "cross", "exponent": "0.8", "limit_ratio": "1", "critical_shear_rate": "1e5 1/s"}),
    ("PLAIN", "lubricants.oil.shear_thinning", {"law": "carreau", "exponent": "1", "critical_shear_rate": "1e5 1/s"}),
    ("PLAIN", "lubricants.oil.compressibility", "incompressible"),
    ("PLAIN", "lubricants.oil.compressibility", {"law": "dowson_higginson", "rise": "0 1/Pa"}),
    ("PLAIN", "lubricants.oil.temperature", "55 degC"),
    ("PLAIN", "lubricants.oil.density", "850 kg/m^3"),
    ("PLAIN", "lubricants.oil.thermal_expansion", "0 1/K"),
    ("PLAIN", "lubricants.oil.specific_heat", "1900 J/kg/K"),
    ("PLAIN", "lubricants.oil.conductivity", "0.2 W/m/K"),
    ("HOT", "bearings.main.thermal.journal", {"wall": "free"}),
    ("HOT", "bearings.main.features.groove.z", "0 mm"),
    ("HOT", "bearings.main.features.groove.on", "shell"),
    ("HOT", "bearings.main.features.groove.depth", "0 mm"),
]


# Errors of balances are round-off themselves; figures that an option brings along, whatever its value.
LEFT_OUT = ("mass_balance_error", "heat_balance_error", "film_ratio", "clearance_cold", "clearance_hot")

# Below these a figure of the models here is the round-off of what cancels: flows of some 1e-6 m^3/s, a place of some mm.
FLOORS = {"m^3/s": 1e-15, "m": 1e-12}


def close(one, other, rtol, left_out=LEFT_OUT):
    """Names of figures that differ by more than rtol of their size; `one` and `other`: {name: (value, unit)}."""
    off = []
    for key in sorted((set(one) | set(other)) - set(left_out)):
        if key not in one or key not in other:
            off.append(f"{key}: in one alone")
            continue
        (a, unit), b = one[key], other[key][0]
        if not isinstance(a, (int, float)) or not isinstance(b, (int, float)):
            if a != b:
                off.append(f"{key}: {a} and {b}")
        elif abs(a - b) > rtol * max(abs(a), abs(b)) + FLOORS.get(unit, 0.0):
            off.append(f"{key}: {a:.10g} and {b:.10g}")
    return off


def scaled(tree, length, mass, time):
    """The model of a similar bearing or machine: every quantity times the scales of its dimension."""
    other = tree
    for path, text in trees.leaves(tree):
        if path[-1] == "expression":
            other = scaled_expression(other, path, length, mass, time)
            continue
        if len(path) > 2 and path[-3] == "points" and path[-4] == "table":
            unit = trees.at(tree, (*path[:-3], ("x_unit", "y_unit")[path[-1]]))
            other = trees.changed(other, path, repr(float(text) * size(unit, length, mass, time)))
            continue
        match = QUANTITY.fullmatch(text)
        if not match or not match[2] or path[-1] in ("title", "hersey"):
            continue
        factor = size(match[2], length, mass, time)
        numbers = " ".join(repr(float(n) * factor) for n in match[1].split())
        other = trees.changed(other, path, f"{numbers} {match[2]}")
    return other


# What expressions are of, in SI units.
ARGUMENTS = {"t": "s", "length": "m", "stretch": "m", "angle": "rad"}


def scaled_expression(tree, path, length, mass, time):
    place = trees.at(tree, path[:-1])
    text = place["expression"]
    for argument, unit in ARGUMENTS.items():
        text = re.sub(rf"\b{argument}\b", f"({argument}/{size(unit, length, mass, time)!r})", text)
    return trees.changed(tree, path, f"{size(place['unit'], length, mass, time)!r}*({text})")


def size(unit, length, mass, time):
    powers = dimension(unit)
    return length ** powers[0] * mass ** powers[1] * time ** powers[2]


def in_other_units(tree):
    """The same model with its quantities in other units of the same kind."""
    names = {"mm": ("inch", 1 / 25.4), "um": ("nm", 1e3), "bar": ("psi", 1e5 / 6894.757293168361), "rpm": ("deg/s", 6.0), "N": ("kgf", 1 / 9.80665),
             "mPa.s": ("Pa.s", 1e-3), "deg": ("rad", 0.017453292519943295), "GPa": ("MPa", 1e3), "m/s": ("km/h", 3.6),
             "mm/s": ("m/s", 1e-3), "kN": ("N", 1e3), "kg": ("g", 1e3), "kg.m^2": ("g.mm^2", 1e9), "ms": ("s", 1e-3), "N/m": ("N/mm", 1e-3),
             "m/s^2": ("mm/s^2", 1e3), "N.m": ("N.mm", 1e3)}
    other = tree
    for path, text in trees.leaves(tree):
        match = re.fullmatch(rf"({trees.NUMBER}(?:\s+{trees.NUMBER})*)\s+(\S+)", text)
        if match and match[2] in names:
            unit, factor = names[match[2]]
            numbers = " ".join(repr(float(n) * factor) for n in match[1].split())
            other = trees.changed(other, path, f"{numbers} {unit}")
    return other
