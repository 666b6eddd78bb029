"""A machine placed otherwise in space: turned as a whole, seen in a mirror, its joints counted from the other body.

Keys of the model file are true vectors, which a mirror turns over along its normal, or axial ones (rotations, torques), which it turns
over along the two other axes.
"""

import copy
import math

import numpy as np

import tree as trees

TRUE = ("origin", "centre_of_mass", "centre", "point", "normal", "from", "to", "position", "velocity", "gravity", "up")
AXIAL = ("orientation", "angular_velocity")

IN_GROUND_AXES = ("position", "velocity", "angular_velocity", "acceleration", "angular_acceleration", "force")

AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


def vector(text):
    """Three numbers and the rest of a text such as `0 48 0 mm` or `z`."""
    if text in AXES:
        return np.array(AXES[text], float), ""
    words = str(text).split()
    return np.array([float(w) for w in words[:3]]), " ".join(words[3:])


def written(numbers, unit=""):
    return " ".join(repr(float(n)) for n in numbers) + (f" {unit}" if unit else "")


def scalar(text):
    number, _, unit = str(text).partition(" ")
    return float(number), unit


def negated(text):
    number, unit = scalar(text)
    return f"{-number!r} {unit}".strip()


def rotation_matrix(axis, angle):
    axis = np.asarray(axis, float) / np.linalg.norm(axis)
    K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + math.sin(angle) * K + (1 - math.cos(angle)) * K @ K


def rotation_vector(R):
    """Of less than half a turn."""
    angle = math.acos(max(-1.0, min(1.0, (np.trace(R) - 1) / 2)))
    if angle == 0:
        return np.zeros(3)
    return angle / (2 * math.sin(angle)) * np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])


# -- turned as a whole


TURN = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])  # x to y, y to z, z to x: no vector needs arithmetic


def turned(tree):
    """The same machine with ground's axes named otherwise."""
    other = copy.deepcopy(tree)
    ground = other["bodies"].setdefault("ground", {})
    frames = ground.setdefault("frames", {})
    for frame in frames.values():
        turn_vector(frame, "origin")
        turn_frame(frame)
    frames["turned"] = {"rotation": {"axis": "1 1 1", "angle": "120 deg"}}
    for shape in ground.get("shapes", {}).values():
        for key in ("point", "normal", "centre"):
            turn_vector(shape, key)
    if "gravity" in other:
        turn_vector(other, "gravity")
    for force in other.get("forces", {}).values():
        if force.get("axes", "ground") == "ground":
            turn_vector(force, "direction")
            if isinstance(force.get("components"), list):
                force["components"] = [force["components"][k] for k in (2, 0, 1)]
    replace_ground(other)
    return other


def turn_vector(place, key):
    if key in place:
        numbers, unit = vector(place[key])
        place[key] = written(TURN @ numbers, unit)


def turn_frame(frame):
    given = frame.get("rotation")
    R = rotation_matrix(vector(given["axis"])[0], math.radians(scalar(given["angle"])[0])) if given else np.eye(3)
    w = rotation_vector(TURN @ R)
    frame["rotation"] = {"axis": written(w), "angle": f"{float(np.linalg.norm(w))!r} rad"}


def replace_ground(tree):
    """Where ground's own frame was meant, the turned one stands."""
    for section, keys in (("joints", ("between",)), ("forces", ("between", "body")), ("bearings", ("shell", "journal"))):
        for entry in tree.get(section, {}).values():
            for key in keys:
                if isinstance(entry.get(key), list):
                    entry[key] = ["ground.turned" if end == "ground" else end for end in entry[key]]
                elif entry.get(key) == "ground":
                    entry[key] = "ground.turned"


def turned_results(found):
    """What the results of the machine as it was become in the turned axes; without what turning names otherwise."""
    other = {}
    for name, (values, unit) in found.items():
        if name.startswith("ground/") or name.endswith(("/orientation", "/node_position", "inboard_origin", "outboard_origin", "/axis", "/x_axis")):
            continue
        is_vector = name.startswith(("bodies/", "contacts/")) and name.split("/")[-1] in IN_GROUND_AXES
        other[name] = (values @ TURN.T if is_vector else values, unit)
    return other


def without_axes(found):
    return {name: value for name, value in found.items() if name in turned_results({name: value})}


# -- in a mirror across z


MIRROR = np.diag([1.0, 1.0, -1.0])


def mirrored(tree):
    """The mirror image across the plane z = 0 of ground, every body's own axes mirrored likewise."""
    other = copy.deepcopy(tree)
    for path, _ in list(trees.leaves(tree)):
        place, key = trees.at(other, path[:-1]), path[-1]
        if key in TRUE and isinstance(place[key], str):
            set_vector(place, key, MIRROR)
        elif key in AXIAL:
            set_vector(place, key, -MIRROR)
        elif key == "axis" and path[-2] == "rotation":
            set_vector(place, key, -MIRROR)
        elif key in ("yz", "zx"):
            place[key] = negated(place[key])
        elif path[0] == "bearings" and key == "z":
            place[key] = negated(place[key])
    for beam in (body["beam"] for body in other["bodies"].values() if "beam" in body):
        beam["points"] = [written(MIRROR @ vector(p)[0], vector(p)[1]) for p in beam["points"]]
    for joint in other.get("joints", {}).values():
        mirror_joint(joint)
    mirror_couplings(other)
    for force in other.get("forces", {}).values():
        mirror_force(force)
    for bearing in other.get("bearings", {}).values():
        for key in ("edge_pressure", "ambient_fill"):
            if isinstance(bearing.get(key), dict):
                bearing[key] = {"left": bearing[key]["right"], "right": bearing[key]["left"]}
    return other


def set_vector(place, key, by):
    numbers, unit = vector(place[key])
    place[key] = written(by @ numbers, unit)


# Joints whose only motion is a rotation have an axial axis and keep their coordinate; the others a true one.
def mirror_joint(joint):
    kind, start = joint["type"], joint.get("initial", {})
    if kind == "revolute":
        joint["axis"] = written(-MIRROR @ vector(joint.get("axis", "z"))[0])
    elif kind in ("prismatic", "cylindrical", "screw"):
        joint["axis"] = written(MIRROR @ vector(joint.get("axis", "z"))[0])
        if kind == "screw":
            joint["lead"] = negated(joint["lead"])
        turn_over(start, ("rotation", "rotation_rate"))
    elif kind == "universal":  # across z, the cross turns about x and y
        turn_over(start, ("rotation_1", "rotation_2", "rotation_1_rate", "rotation_2_rate"))


def turn_over(place, keys):
    for key in keys:
        if key in place:
            place[key] = negated(place[key])


def counts_backwards(tree, joint):
    return tree["joints"][joint]["type"] in ("cylindrical", "screw")


def mirror_couplings(tree):
    for coupling in tree.get("couplings", {}).values():
        ends = [coupling[key].split(".")[0] for key in ("output", "input")]
        if coupling["type"] == "gear" and counts_backwards(tree, ends[0]) != counts_backwards(tree, ends[1]):
            coupling["ratio"] = negated(coupling["ratio"])


def mirror_force(force):
    by = -MIRROR if force["type"] == "torque" else MIRROR
    if "direction" in force:
        set_vector(force, "direction", by)
    if isinstance(force.get("components"), list):
        force["components"] = [turned_over(f) if by[k, k] < 0 else f for k, f in enumerate(force["components"])]


def turned_over(function):
    if isinstance(function, dict):
        return function | {"expression": f"-({function['expression']})"}
    return negated(function)


def mirrored_results(found):
    """Bodies' motion seen in the mirror, edges of films swapped; joints by their coordinates where these stay."""
    other = {}
    for name, (values, unit) in found.items():
        last = name.split("/")[-1]
        if name.startswith("bodies/") and last in ("position", "velocity", "acceleration", "angular_velocity", "angular_acceleration"):
            by = -MIRROR if last.startswith("angular") else MIRROR
            other[name] = (values @ by, unit)
        elif name.startswith("bearings/") and last in ("flow_left", "flow_right"):
            other[name.replace(last, {"flow_left": "flow_right", "flow_right": "flow_left"}[last])] = (values, unit)
        elif name.startswith(("bearings/", "energy/", "power/")) and is_scalar_of_film(name):
            other[name] = (values, unit)
    return other


def is_scalar_of_film(name):
    """Neither a component nor a place along z, nor a field over it."""
    return not ("/fields/" in name or name.endswith(("_z", "/force", "/moment", "/tilt", "force_pressure", "force_shear", "force_asperity",
                                                     "origin", "axis", "_around")))


# -- joints counted from the other body


def reversed_joints(tree, names):
    """Joints whose two frames are given the other way round: the tree has another root, or grows the other way."""
    other = copy.deepcopy(tree)
    for name in names:
        joint = other["joints"][name]
        joint["between"] = joint["between"][::-1]
        for key in ("initial", "guess"):
            if key in joint:
                joint[key] = reversed_start(joint["type"], joint[key])
    turn_functions(other, names)
    return other


def turn_functions(tree, names):
    for force in tree.get("forces", {}).values():
        if force.get("joint") in names:
            turn_over(force, ("free_angle", "free_position", "speed"))
    for drive in tree.get("drives", {}).values():
        if drive["joint"] in names:
            drive["speed"] = turned_over(drive["speed"])
    for coupling in tree.get("couplings", {}).values():
        ends = [coupling[key].split(".")[0] in names for key in ("output", "input")]
        if ends[0] != ends[1]:
            coupling["ratio"] = negated(coupling["ratio"])


def reversed_start(kind, start):
    """Coordinates of the inverse motion: of the first frame in the second one."""
    if kind in ("revolute", "prismatic", "cylindrical", "screw"):
        return {key: negated(value) for key, value in start.items()}
    other = {}
    w, angle_unit = vector(start.get("orientation", "0 0 0 rad"))
    factor = math.pi / 180 if angle_unit == "deg" else 1.0
    R = rotation_matrix(w, factor * np.linalg.norm(w)) if np.linalg.norm(w) > 0 else np.eye(3)
    omega, rate_unit = vector(start.get("angular_velocity", "0 0 0 rad/s"))
    other["orientation"] = written(-w, angle_unit)
    other["angular_velocity"] = written(-R @ omega, rate_unit)
    if kind == "free":
        p, length = vector(start.get("position", "0 0 0 m"))
        v, speed = vector(start.get("velocity", "0 0 0 m/s"))
        metres = {"m": 1.0, "mm": 1e-3, "um": 1e-6}[length] * p
        radians = omega * {"rpm": math.pi / 30, "rad/s": 1.0}[rate_unit]
        other["position"] = written(-R.T @ p, length)
        assert speed == "m/s"
        other["velocity"] = written(-R.T @ v + np.cross(radians, R.T @ metres), speed)
    return other


# -- in another order


def reordered(tree):
    """Every mapping whose names are the model's own, from its end to its beginning."""
    other = {}
    for section, entries in tree.items():
        other[section] = dict(reversed(entries.items())) if isinstance(entries, dict) and section not in ("simulation", "output") else entries
    for body in other["bodies"].values():
        for key in ("frames", "shapes"):
            if key in body:
                body[key] = dict(reversed(body[key].items()))
    return other
