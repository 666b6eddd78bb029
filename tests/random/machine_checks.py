"""What must hold of a run: read from its results file, every integral made anew from the fields."""

import math

import h5py
import numpy as np

import bearings
import film_integrals as film
import film_laws
import heat
from findings import Findings
from machines import Rotor

# Steps are solved to 1e-8 of their largest force (`simulation.tolerance`).
SOLVED = 1e-6


class Film:
    """One bearing's rows and fields."""

    def __init__(self, group):
        self.rows = {key: item[:] for key, item in group.items() if isinstance(item, h5py.Dataset)}
        fields = group["fields"]
        self.phi, self.z, self.time = fields["phi"][:], fields["z"][:], fields["time"][:]
        self.p, self.h, self.theta = fields["pressure"][:], fields["thickness"][:], fields["fill"][:]
        self.p_asperity = fields["asperity_pressure"][:]


class Motion:
    """A body's motion: rows of position, velocity, angular velocity, acceleration and rotation matrices to ground."""

    def __init__(self, group):
        self.position, self.velocity, self.omega, self.acceleration = (
            group[key][:] for key in ("position", "velocity", "angular_velocity", "acceleration"))
        w, x, y, z = group["orientation"][:].T
        self.R = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                           [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                           [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]).transpose(2, 0, 1)


GROUND = "ground"


class Results:
    def __init__(self, path):
        with h5py.File(path) as file:
            self.status, self.message = file.attrs["status"], file.attrs["message"]
            self.time = file["time"][:]
            self.dt, self.rejected = file["solver/dt"][:], int(file["solver/rejected_steps"][-1])
            self.films = {name: Film(group) for name, group in file["bearings"].items()}
            self.bodies = {name: Motion(group) for name, group in file["bodies"].items() if "position" in group}
            self.joints = {name: {key: group[key][:] for key in group} for name, group in file["joints"].items()}
            self.drives = {name: {key: group[key][:] for key in group} for name, group in file["drives"].items()}
            self.without_number = without_number(file)


def without_number(file):
    """Names of datasets with values that are no numbers."""
    bad = []

    def visit(name, item):
        # NaN is what a cycle without one before it has by definition, a contact that does not touch, a film without cavity.
        may_be_missing = name.startswith(("cycles/", "contacts/")) or name.endswith(
            ("/rupture_angle", "/reformation_angle", "/T_side", "/T_film"))
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and not may_be_missing:
            if not np.isfinite(item[...]).all():
                bad.append(name)

    file.visititems(visit)
    return bad


def check(machine, results):
    found = Findings()
    closed = [f"bearings/{name}/h_min_centre" for name, b in machine.named_bearings().items() if not b.middle_is_open()]
    bad = [name for name in results.without_number if name not in closed]
    found.require("finite", not bad, f"no numbers in {', '.join(bad[:4])}")
    if found or len(results.time) < 2:
        return found
    check_start(machine, results, found)
    for name, bearing in machine.named_bearings().items():
        check_film(bearing, results.films[name], name, found)
        motion = relative_motion(machine, results, name)
        check_oil(bearing, results, results.films[name], motion, name, found)
        check_gaps(bearing, results, results.films[name], motion, name, found)
        check_power(bearing, results, results.films[name], motion, name, found)
        heat.check_run(bearing, results.films[name].rows, results.dt, name, found)
    check_momentum(machine, results, found)
    check_drive(machine, results, found)
    return found


# -- start


def check_start(machine, results, found):
    """The start is what was given, to round-off."""
    if isinstance(machine, Rotor):
        given = [*machine.start, machine.rotation]
        rates = [*machine.rates, machine.speed]
        compare_start("plane", given, rates, results, found)
        return
    height, beta, height_rate, beta_rate = machine.closed()
    compare_start("wrist", [beta], [beta_rate], results, found)
    compare_start("bore", [height - machine.radius - machine.rod], [height_rate], results, found)
    if machine.main:
        compare_start("main_joint", [*machine.main_offset(), machine.angle], [0, 0, machine.speed], results, found)
    else:
        compare_start("main_joint", [machine.angle], [machine.speed], results, found)


def compare_start(joint, given, rates, results, found):
    for what, wanted in (("coordinates", given), ("rates", rates)):
        got = np.atleast_1d(results.joints[joint][what][0])
        off = np.abs(got - wanted) / np.maximum(np.abs(wanted), 1e-6)
        found.bound("start", off.max(), 1e-8, f": {joint} {what} given {np.array(wanted)}, at the start {got}")


def check_drive(machine, results, found):
    """The motor turns at its speed from the start to the end."""
    joint = "plane" if isinstance(machine, Rotor) else "main_joint"
    rate = results.joints[joint]["rates"]
    rate = rate if rate.ndim == 1 else rate[:, -1]
    k = int(np.argmax(np.abs(rate - machine.speed)))
    # Rates across a constraint are of the second order in the step; cut steps leave some of that behind.
    found.bound("driven speed", abs(rate[k] - machine.speed), 1e-4 * abs(machine.speed),
                f"rad/s off {machine.speed:.6g} at t = {results.time[k]:.6g} s")


# -- film


def check_film(b, f, name, found):
    found.bound("0 <= theta <= 1", max(-f.theta.min(), f.theta.max() - 1), 1e-9,
                f": {name}: theta from {f.theta.min():.6g} to {f.theta.max():.6g}")
    scale = max(np.abs(f.p).max(), 1.0)
    found.bound("p >= p_cav", b.p_cav - f.p.min(), 1e-9 * scale, f"Pa: {name}: smallest pressure {f.p.min():.6g}")
    if b.cavitation == "mass_conserving":
        both = np.minimum((f.p - b.p_cav) / scale, 1 - f.theta).max()
        # Pressure belongs to the end of a step, fill to the step as a whole: a front may lie a node further on (film.15).
        found.bound("full or at p_cav", both, 1e-9, f": {name}: a node is neither")
    h_min = f.rows["h_min"]
    found.require("h_min > 0", h_min.min() > 0, f"{name}: h_min = {1e6 * h_min.min():.4g} um")
    for name_of_power in ("power_film", "power_asperity"):
        power = f.rows[name_of_power]
        found.require("power > 0", power.min() >= 0, f"{name}: {name_of_power} down to {power.min():.4g} W")


# -- kinematics of a bearing


class Relative:
    """The journal's frame in the shell's at each row: eccentricity, velocity of the journal against the shell, turn, speeds."""

    def __init__(self, e, e_rate, turn, speed):
        self.e, self.e_rate, self.turn, self.speed = e, e_rate, turn, speed


def point(body, offset):
    """Position and velocity in ground of a point fixed on a body."""
    arm = body.R @ np.array(offset)
    return body.position + arm, body.velocity + np.cross(body.omega, arm)


def relative_motion(machine, results, name):
    if isinstance(machine, Rotor):
        body = results.bodies["rotor"]
        turn = np.arctan2(body.R[:, 1, 0], body.R[:, 0, 0])
        return Relative(body.position[:, :2], body.velocity[:, :2], turn, body.omega[:, 2])
    crank = results.bodies["crank"]
    if name == "main":
        turn = np.arctan2(crank.R[:, 1, 0], crank.R[:, 0, 0])
        return Relative(crank.position[:, :2], crank.velocity[:, :2], turn, crank.omega[:, 2])
    rod = results.bodies["rod"]
    shell, shell_rate = point(rod, (0, -machine.rod, 0))
    pin, pin_rate = point(crank, (0, machine.radius, 0))
    back = rod.R.transpose(0, 2, 1)
    apart = pin - shell
    e = np.einsum("nij,nj->ni", back, apart)
    e_rate = np.einsum("nij,nj->ni", back, pin_rate - shell_rate - np.cross(rod.omega, apart))
    turned = back @ crank.R
    return Relative(e[:, :2], e_rate[:, :2], np.arctan2(turned[:, 1, 0], turned[:, 0, 0]), crank.omega[:, 2] - rod.omega[:, 2])


def rows_of_fields(results, f):
    """For each field the row of the same instant; fields without one are left out."""
    pairs = []
    for k, t in enumerate(f.time):
        row = int(np.argmin(np.abs(results.time - t)))
        if abs(results.time[row] - t) <= 1e-9 * max(abs(t), results.time[-1]):
            pairs.append((k, row))
    return pairs


def covered(b, f, turn, cells, only_deep=True):
    phi, z = f.phi[:, None], f.z[None, :]
    step_phi = np.diff(np.append(f.phi, f.phi[0] + 2 * np.pi)).max()
    near = np.zeros(f.h.shape[1:], bool)
    for feature in b.features:
        if feature.depth > 0 or not only_deep:
            near |= feature.covers(phi, z, turn, cells * step_phi * (1 + 1e-9), cells * np.diff(f.z).max() * (1 + 1e-9))
    return near


def check_gaps(b, results, f, motion, name, found):
    """The first instant at which a gap is wrong."""
    for k, row in rows_of_fields(results, f):
        before = len(found)
        check_gap(b, f, k, row, motion, name, found)
        if len(found) > before:
            return


def land_of(b, f, k, row, motion):
    """Gap without features, with what a column yields to the pressure above the atmosphere's."""
    yielded = (f.p[k] - b.atmosphere() + f.p_asperity[k]) * (b.column[1] / b.column[0] if b.column else 0.0)
    return b.land(motion.e[row], (0, 0), f.phi[:, None], f.z[None, :], motion.turn[row]) + yielded


def check_gap(b, f, k, row, motion, name, found):
    """The stored gap is that of the positions, and h_min that of the gap."""
    land, turn = land_of(b, f, k, row, motion), motion.turn[row]
    # (bearing.2) is of first order in e/R
    round_off = 1e-9 * (b.c + np.abs(f.h[k]).max()) + 2 * b.c**2 / b.R
    away = ~covered(b, f, turn, 0.5)
    found.bound("gap by formula", np.abs(f.h[k] - land)[away].max(initial=0.0), round_off,
                f"m beside the formula on land: {name}, t = {f.time[k]:.6g} s")
    found.bound("gap by formula", max((land - f.h[k]).max(), (f.h[k] - land - b.deepest()).max()), round_off,
                f"m outside land and land + depth: {name}, t = {f.time[k]:.6g} s")
    h_min, outside = f.rows["h_min"][row], f.h[k][~covered(b, f, turn, 0.0, only_deep=False)]
    if outside.size:
        found.bound("h_min <= h", h_min - outside.min(), round_off,
                    f"m: {name}, t = {f.time[k]:.6g} s: h_min = {1e6 * h_min:.5g} um, smallest outside features {1e6 * outside.min():.5g} um")
    lowest = land.min() - 2 * film.dip(land)
    found.bound("h_min is somewhere", lowest - h_min, round_off,
                f"m: {name}, t = {f.time[k]:.6g} s: h_min = {1e6 * h_min:.5g} um, the land is nowhere thinner than {1e6 * lowest:.5g} um")


# -- oil


def check_oil(b, results, f, motion, name, found):
    """Volume at the end = volume at the start + what came in: at every step and over the run."""
    if b.cavitation != "mass_conserving":
        return
    r = f.rows
    volume, net = r["oil_volume"], r["flow_supply"] - r["flow_left"] - r["flow_right"]
    through = np.abs(r["flow_supply"]) + np.abs(r["flow_left"]) + np.abs(r["flow_right"])
    steps = np.diff(results.time)
    lost = np.diff(volume) - net[1:] * steps
    gap = 2 * np.pi * b.R * b.L * b.c
    # what steps solved to 1e-8 leave, a hundred times over, by the share of the gap that a step moves
    allowed = SOLVED * (through[1:] * steps + gap)
    worst = int(np.argmax(np.abs(lost) / allowed))
    found.bound("oil", abs(lost[worst]), allowed[worst],
                f"m^3 unexplained in one step of {name}, t = {results.time[worst + 1]:.6g} s: {lost[worst] / gap:.3g} of the gap")
    found.bound("oil", abs(lost.sum()), SOLVED * ((through[1:] * steps).sum() + gap),
                f"m^3 unexplained in {name} over the run: {lost.sum() / gap:.3g} of the gap")
    if b.roughness:
        return
    check_volume(b, results, f, motion, name, found)


def check_volume(b, results, f, motion, name, found):
    """The oil reported against an integral of the fields, where they differ most."""
    worst = (0.0, 0.0, "")
    for k, row in rows_of_fields(results, f):
        gap = b.oil_gap(f.h[k], land_of(b, f, k, row, motion), f.phi[:, None], f.z[None, :], motion.turn[row])
        own = film.volume(f.theta[k] * gap * film_laws.density(b, f.p[k]), b.R, f.phi, f.z)
        step = sum(feature.depth * border_area(feature, b, f) for feature in b.features)
        off, allowed = abs(own.value - f.rows["oil_volume"][row]), own.error + step + 1e-6 * own.value
        if off - allowed > worst[0] - worst[1]:
            worst = (off, allowed, f"m^3: {name}, t = {f.time[k]:.6g} s: own integral {own.value:.6g}, reported {f.rows['oil_volume'][row]:.6g}")
    found.bound("oil volume", *worst)


def border_area(feature, b, f):
    ends = 0.0 if feature.length >= b.L else 2 * b.R * feature.arc * np.diff(f.z).max()
    sides = 0.0 if feature.arc >= 2 * np.pi else 2 * feature.length * b.R * np.diff(f.phi).max()
    return 0.5 * (ends + sides)


# -- power


class Powers:
    """What a film takes and gives at one instant [W]."""

    def __init__(self, b, results, f, k, row, motion):
        r = f.rows
        p, h, theta = f.p[k], f.h[k], f.theta[k]
        at = (b.R, f.phi, f.z)
        slip = b.R * motion.speed[row]
        mu = film_laws.viscosity(b, p)
        fed = b.is_fed(f.phi[:, None], f.z[None, :], motion.turn[row])
        couette = film.couette_power(film_laws.shear_shares(b, p, theta, fed), mu, h, slip, *at)
        poiseuille = film.poiseuille_power(p, mu, h, *at)
        over_land = bearings.land_power(b, mu, land_of(b, f, k, row, motion), f.phi, f.z, motion.turn[row])
        self.own = couette.value + poiseuille.value + over_land
        # Pressure has kinks within cells at lines and fed features, which both grids miss: more than their difference.
        self.error = (1.5 * couette.error + 2 * poiseuille.error) + 1e-3 * self.own
        if k > 0:
            # The film shears as it is at the end of the step, its fill is that of the step as a whole (film.15).
            filled = np.abs(theta - f.theta[k - 1]) * min(1.0, results.dt[row] / (f.time[k] - f.time[k - 1]))
            self.error += film.couette_power((filled,) * 2, mu, h, slip, *at).value
        highest = float((mu / np.maximum(h, 1e-9)).mean()) * slip**2
        self.error += sum(highest * border_area(g, b, f) for g in b.features if g.depth > 0)
        self.reported, self.asperity = r["power_film"][row], r["power_asperity"][row]
        # The wrench on the shell times the journal's velocity against it, both at the bearing's origin, is what the bodies put in.
        force, moment, e = r["force"][row], r["moment"][row], motion.e[row]
        velocity = motion.e_rate[row] + motion.speed[row] * np.array([e[1], -e[0]])
        self.mechanical = float(force[:2] @ velocity + moment[2] * motion.speed[row])
        self.pumped = pumped(b, r, row)
        self.error += bearings.corner_power(b, self.pumped) + 0.3 * over_land  # ends between nodes around
        self.stored, self.stored_error = storage(b, results, f, k, row, motion)


def pumped(b, r, row):
    power = sum((g.pressure - b.p_cav) * r[f"flow_feature_{g.name}"][row] for g in b.features if g.pressure is not None)
    if b.supply:
        power += (b.supply[1] - b.p_cav) * (r["flow_supply"][row] - sum(r[f"flow_feature_{g.name}"][row] for g in b.features))
    return power - (b.p_edge[0] - b.p_cav) * r["flow_left"][row] - (b.p_edge[1] - b.p_cav) * r["flow_right"][row]


def storage(b, results, f, k, row, motion):
    """Power that goes into filling: the film above p_cav takes up oil faster than the gap opens, where empty places fill.

    integral of (p - p_cav) [d(theta h)/dt - dh/dt]; both rates as the step's own differences. The integrator's rate of the gap may
    differ from its difference quotient by what it changes within the step: that is the error.
    """
    if k == 0 or row == 0 or f.time[k] - f.time[k - 1] > 1.01 * results.dt[row]:
        return 0.0, math.inf
    dt = results.dt[row]
    over = f.p[k] - b.p_cav
    filled = (f.theta[k] * f.h[k] - f.theta[k - 1] * f.h[k - 1] - f.h[k] + f.h[k - 1]) / dt
    phi = f.phi[:, None]
    opening = -(motion.e_rate[row, 0] * np.cos(phi) + motion.e_rate[row, 1] * np.sin(phi)) + 0 * f.h[k]
    difference = -((motion.e[row] - motion.e[row - 1])[0] * np.cos(phi) + (motion.e[row] - motion.e[row - 1])[1] * np.sin(phi)) / dt
    at = (b.R, f.phi, f.z)
    gained = film.volume(over * filled, *at)
    highest = max([p - b.p_cav for p in b.fed_pressures()] + [0.0])
    spread = film.volume((np.abs(over) + highest) * np.abs(opening - difference), *at)
    whole = film.volume(np.abs(over * opening), *at)
    return gained.value, gained.error + spread.value + 0.01 * whole.value + whole.error


def check_power(b, results, f, motion, name, found):
    """Reported dissipation against own integrals, and what the bodies and pumps put in against it."""
    worst = None
    for k, row in rows_of_fields(results, f):
        if b.roughness:
            continue
        w = Powers(b, results, f, k, row, motion)
        thins = b.heat is not None and b.heat.model == "film"  # where, only the program knows
        off = 0.0 if thins else abs(w.own - w.reported)
        if off > w.error and (worst is None or off / w.error > worst[0]):
            worst = (off / w.error, "power: film by own integral", off, w.error,
                     f"W: {name}, t = {f.time[k]:.6g} s: own {w.own:.6g}, reported {w.reported:.6g}")
        if b.column or b.asperities or moving_depth(b):
            continue  # elastic energy goes in and out, walls of a travelling pocket work
        lost = abs(w.mechanical + w.pumped - w.reported - w.asperity - w.stored)
        allowed = w.error + w.stored_error + 2 * b.c / b.R * (abs(w.mechanical) + abs(w.pumped)) + 0.01 * abs(w.reported)
        if film_laws.compressibility(b):
            allowed += film_laws.compressibility(b) * f.p[k].max() * (abs(w.reported) + abs(w.pumped) + abs(w.mechanical))
        if lost > allowed and (worst is None or lost / allowed > worst[0]):
            worst = (lost / allowed, "power: bodies + pump = dissipated + stored", lost, allowed,
                     f"W: {name}, t = {f.time[k]:.6g} s: bodies {w.mechanical:.6g}, pump {w.pumped:.6g}, film {w.reported:.6g}, "
                     f"asperities {w.asperity:.6g}, filling {w.stored:.6g}")
    if worst:
        found.bound(*worst[1:])


def moving_depth(b):
    return b.varies_on("journal")


# -- momentum: action is reaction


def check_momentum(machine, results, found):
    """Newton's law for the rotor, with loads by formula and the films' forces as reported; the drive's torque is the friction's."""
    if not isinstance(machine, Rotor):
        return
    body = results.bodies["rotor"]
    t = results.time
    total = np.zeros((len(t), 2))
    sizes = np.zeros(len(t))
    for load in machine.loads:
        forces = np.array([load.at(s) for s in t])
        total += forces
        sizes += np.abs(forces).sum(1)
    total += machine.mass * np.array(machine.gravity)
    torque = results.drives["motor"]["force_or_torque"].copy()
    for name in machine.named_bearings():
        rows = results.films[name].rows
        total -= rows["force"][:, :2]
        sizes += np.abs(rows["force"][:, :2]).sum(1)
        torque += rows["torque_journal"]
    off = np.abs(total - machine.mass * body.acceleration[:, :2]).sum(1)
    left = {name: left_by_exchange(machine, name, results) for name in machine.named_bearings()}
    # A step is solved to 1e-8 of its largest force; of the exchange's length along x and y both may be there.
    allowed = SOLVED * sizes + math.sqrt(2) * sum(left.values())
    k = int(np.argmax(off / allowed))
    found.bound("momentum", off[k], allowed[k], f"N at t = {t[k]:.6g} s: forces less mass times acceleration")
    scale = sum(np.abs(results.films[n].rows["torque_journal"]) + sizes * machine.named_bearings()[n].c for n in machine.named_bearings())
    # A speed kept to 1e-8 is one that changes within a step: Newmark's rule makes an acceleration of that, up to 1/(beta dt) of it.
    change = np.abs(np.diff(body.omega[:, 2])).max() / np.where(results.dt > 0, results.dt, np.inf).min()
    # Films are those of the step before it is put onto its constraints, by less than the error that chose it: first order
    # in what is left there, some times what a step of given length leaves.
    solved = (10 if machine.numerics.kind == "error" else 1) * SOLVED
    allowed = solved * scale + machine.inertia[1] * (10 * change + angle_noise(machine, results))
    allowed = allowed + sum(left[n] * machine.named_bearings()[n].R for n in left)
    k = int(np.argmax(np.abs(torque) / allowed))
    found.bound("drive's torque", abs(torque[k]), allowed[k], f"N m at t = {t[k]:.6g} s: drive and films")


def left_by_exchange(machine, name, results):
    """By how much, row by row, the wrench that bodies have been given may differ from that of the film, reported in the results [N].

    A partitioned exchange ends where the difference of both, moments over the radius, is below a tolerance of the wrench's own length
    (bearing.16): that of films, which in steps chosen by their error is a tenth of that error, at most 1e-6 (integrator.19).
    """
    bearing, rows = machine.named_bearings()[name], results.films[name].rows
    if not bearing.coupling or bearing.coupling.get("scheme") != "partitioned":
        return 0.0 * results.time
    tolerance = min(0.1 * machine.numerics.error, 1e-6) if machine.numerics.kind == "error" else 1e-8
    wrench = np.hstack([rows["force"], rows["moment"] / bearing.R])
    return max(tolerance, 1e-8) * np.linalg.norm(wrench, axis=1)


def angle_noise(machine, results):
    """Angular accelerations that round-off of the driven angle makes [rad/s^2], row by row.

    An angle that is off by its round-off is an acceleration of that over beta dt^2; with every step the sign of it changes and
    a share of the spectral radius is left, so that 1/(1 - radius) of them add up. Ten: the drive's angle is a sum of some terms.
    """
    radius = machine.numerics.spectral_radius
    beta = 1 / (1 + radius) ** 2
    angle = max(np.abs(results.joints["plane"]["coordinates"][:, -1]).max(), 1.0)
    return 10 * np.finfo(float).eps * angle / ((1 - radius) * beta * np.where(results.dt > 0, results.dt, np.inf) ** 2)
