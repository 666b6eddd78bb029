"""What random machines with circuits, wear and skirts have in common: ways of writing one, films, wear, and circuits. SI units and text."""

import copy

class Writing:
    """A model that must do as `base` does, which is the case itself unless given: `renamed` maps names of series, those in
    `turned_round` have the other sign, those with a beginning of `without` are not there."""

    def __init__(self, model, renamed=None, turned_round=(), base=None, without=()):
        self.model, self.renamed, self.turned_round, self.base, self.without = model, renamed or {}, turned_round, base, without

    def name(self, name):
        """(name in the other run or None, sign)"""
        if any(name.startswith(begin) or name.rpartition("/")[2].startswith(begin) for begin in self.without):
            return None, 1
        sign = -1 if name in self.turned_round or name.rpartition("/")[2] in self.turned_round else 1
        if name in self.renamed:
            return self.renamed[name], sign
        folder, _, figure = name.rpartition("/")
        return f"{folder}/{self.renamed.get(figure, figure)}", sign


def backwards(model, *paths):
    """The model with the entries of these mappings in the other order."""
    other = copy.deepcopy(model)
    for path in paths:
        *above, last = path
        at = other
        for key in above:
            at = at[key]
        if last in at:
            at[last] = at[last][::-1] if isinstance(at[last], list) else dict(list(at[last].items())[::-1])
    return other


def asperities(rng):
    return {"model": "greenwood_tripp_fit", "roughness": f"{rng.uniform(0.3, 1.5):.3g} um", "elastic_factor": 3e-3,
            "composite_modulus": f"{rng.choice([60, 110])} GPa", "friction": rng.choice([0.05, 0.1, 0])}


def wear(rng, fixed, moving):
    """Wear that takes a visible part of the roughness in a short run."""
    entry = {"acceleration": rng.choice([1, 50, 2000])}
    both = rng.choice([(True, False), (True, True)]) if moving else (True, False)
    for surface, is_worn in zip((fixed, moving), both):
        if is_worn:
            entry[surface] = {"coefficient": f"{10 ** rng.uniform(-16, -14):.4g} 1/Pa"}
    if moving in entry and rng.random() < 0.5:
        entry[moving]["around"] = "local"
    return entry


def counted_otherwise(model, bearing, times):
    """Wear `times` as fast and counted so many times less: the same wear."""
    other = copy.deepcopy(model)
    entry = other["bearings"][bearing]["wear"]
    entry["acceleration"] = entry["acceleration"] / times
    for surface in entry.values():
        if isinstance(surface, dict):
            surface["coefficient"] = f"{float(surface['coefficient'].split()[0]) * times!r} 1/Pa"
    return other


def unworn(model):
    """Wear by a coefficient of 0, against no wear at all."""
    base, other = copy.deepcopy(model), copy.deepcopy(model)
    for bearing in base["bearings"].values():
        for surface in bearing.get("wear", {}).values():
            if isinstance(surface, dict):
                surface["coefficient"] = "0 1/Pa"
    for bearing in other["bearings"].values():
        bearing.pop("wear", None)
    return Writing(other, base=base, without=("wear_", "worn_"))


def oil(mu, is_warm):
    """An oil of this viscosity, at 60 degC where it is to thin as it warms."""
    law = {"law": "exponential", "viscosity": f"{1e3 * mu} mPa.s", "reference": "60 degC", "coefficient": "0.03 1/K"}
    return {"viscosity": law if is_warm else f"{1e3 * mu} mPa.s", "density": "850 kg/m^3"}


def warm(rng, films, circuit, moving):
    """Gives films temperatures, and the circuit, too, or not."""
    supply = f"{rng.uniform(40, 70):.4g} degC"
    for keys in films:
        shell = rng.choice([{"wall": "insulated"}, {"wall": "given", "temperature": "50 degC"}])
        if keys.get("initial_fill", 1) < 1:
            shell = {"wall": "given", "temperature": "50 degC"}  # contact in a dry film heats no oil
        keys["thermal"] = {"model": "film", "supply_temperature": supply, "shell": shell,
                           moving: rng.choice([{"wall": "insulated"}, {"wall": "free", "heat_capacity": "200 J/K"}])}
        if keys["cavitation"] == "reynolds":
            keys["thermal"]["carry_over"] = 0  # a film that loses oil has no grooves that stir it
    if rng.random() < 0.5:
        circuit["temperature"] = supply
        return
    for node in circuit["nodes"].values():
        if "pressure" in node:
            node["temperature"] = supply


def element(rng, circuit, name, start, end):
    """A way from node to node: drilling, orifice or filter."""
    law = rng.choice(["drilling", "orifice", "resistance"])
    keys = {"drilling": {"length": f"{rng.uniform(20, 120):.4g} mm", "diameter": f"{rng.uniform(2, 6):.3g} mm",
                         "loss_coefficient": rng.choice([0, 1.5])},
            "orifice": {"diameter": f"{rng.uniform(0.8, 4):.3g} mm"},
            "resistance": {"resistance": f"{10 ** rng.uniform(8, 10):.4g} Pa.s/m^3"}}[law]
    circuit["elements"][name] = {"type": law, "from": start, "to": end, **keys}


def circuit(rng, feeds, joint):
    """Oil from a supply or a pump over a gallery to the nodes of `feeds`."""
    net = {"lubricant": "oil", "nodes": {}, "elements": {}}
    has_gallery = rng.random() < 0.5
    net["nodes"]["gallery"] = ({"volume": f"{rng.uniform(5, 100):.4g} cm^3", "free_air": rng.choice([0, 0.02])} if has_gallery else {})
    if rng.random() < 0.5:
        net["nodes"]["supply"] = {"pressure": f"{rng.uniform(0.5, 5):.4g} bar"}
        element(rng, net, "filter", "supply", "gallery")
    else:
        net["nodes"]["sump"] = {"pressure": "0 bar"}
        net["elements"]["pump"] = {"type": "pump", "from": "sump", "to": "gallery", "displacement": f"{rng.choice([1, 1, 0.02]) * rng.uniform(0.2, 2):.4g} cm^3",
                                   "leakage": f"{rng.uniform(0.1, 1):.4g} l/min/bar", **joint}
        net["elements"]["relief"] = {"type": "relief_valve", "from": "gallery", "to": "sump",
                                     "opening_pressure": f"{rng.uniform(1, 4):.4g} bar", "conductance": "2 l/min/bar"}
    for feed in feeds:
        net["nodes"][feed] = {}
        element(rng, net, f"to_{feed}", "gallery", feed)
    return net


def ways(net):
    """Names of elements that carry oil both ways."""
    return [name for name, entry in net["elements"].items() if entry["type"] in ("drilling", "orifice", "resistance")]


def turned_ways(model):
    """Every way from its other end: its flow counts the other way."""
    other = copy.deepcopy(model)
    names = ways(other["circuit"])
    for name in names:
        entry = other["circuit"]["elements"][name]
        entry["from"], entry["to"] = entry["to"], entry["from"]
    return Writing(other, turned_round=[f"circuit/flow_{name}" for name in names])


def parted(model, name):
    """A way in two halves one after the other, or None where that is another way (an orifice's, a drilling's mouths)."""
    other = copy.deepcopy(model)
    elements = other["circuit"]["elements"]
    entry = elements[name]
    if entry["type"] == "orifice" or entry.get("loss_coefficient", 0):
        return None
    key = "length" if entry["type"] == "drilling" else "resistance"
    value, unit = entry[key].split()
    half = {**entry, key: f"{float(value) / 2!r} {unit}"}
    other["circuit"]["nodes"]["half_way"] = {}
    elements[name] = {**half, "to": "half_way"}
    elements["second_half"] = {**half, "from": "half_way"}
    return Writing(other)


def film(rng, around, along):
    """Keys of a film that differ from machine to machine."""
    keys = {"lubricant": "oil", "cavitation": rng.choice(["mass_conserving", "mass_conserving", "reynolds"])}
    if rng.random() < 0.2:
        keys["compliance"] = {"model": "column", "composite_modulus": "100 GPa", "length": "2 mm"}
    if rng.random() < 0.3:
        keys["cavitated_shear"] = "full"
    if keys["cavitation"] == "mass_conserving" and rng.random() < 0.3:
        keys["initial_fill"] = rng.choice([0, 0.2, 0.7])
    return keys | {"grid": around | along}
