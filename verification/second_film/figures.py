"""Figures of a solved film: forces, torques, power, flows. Wall shear from the profile of velocity across the film,

    tau = mu (u_J - u_S)/h -+ (h/2) dp/dx on the shell and on the journal (Couette and Poiseuille),

the first only in the oil's share of the gap. Angles from x towards y; the load acts on the journal and is what the film does to the shell.
"""

import math

import numpy as np

from film import AIR, Film, Motion, NoAnswer
from mesh import Quadrature

STRIPS = 6  # per element around: pressure and sheared share may end within one


def figures(film):
    b, motion = film.bearing, film.motion
    q, nodes = Quadrature.strips(film.mesh, STRIPS), film.nodes
    signed = q.at(film.p, nodes)
    p = np.maximum(signed, 0)
    px, pz = q.slopes(film.p, nodes)
    px, pz = np.where(signed > 0, px, 0), np.where(signed > 0, pz, 0)
    h = b.gap(q.phi, q.z, motion) + b.pocket_depth(q.phi, q.z)
    fill, sheared = _fill(film, q, signed), h + b.shear_depth(q.phi, q.z)
    share = np.ones_like(fill) if b.cavitated_shear == "full" else fill
    mu = b.viscosity(p)[0]
    slip = b.R * (motion.journal - motion.shell)
    couette = mu * slip / sheared * share
    slopes = {side: sum((f.opening(q.phi, q.z, b.L)[1] for f in b.profiles if f.on_journal == side), 0 * p) for side in (False, True)}
    # tangential tractions towards growing angles; pressure on the walls of pockets, - p dd/dx, by parts as d dp/dx
    walls = {side: b.pocket_depth(q.phi, q.z, side) for side in (False, True)}
    on_shell = couette - 0.5 * h * px - p * slopes[False] / b.R + walls[False] * px
    on_journal = -couette - 0.5 * h * px - p * slopes[True] / b.R + walls[True] * px
    c, s = np.cos(q.phi), np.sin(q.phi)
    tangential = on_shell if b.shear_force == "full" else 0 * on_shell
    force = np.array([(q.area * (p * c - tangential * s)).sum(), (q.area * (p * s + tangential * c)).sum()])
    at = math.atan2(motion.centre[1], motion.centre[0])
    load, angle = float(np.hypot(*force)), math.atan2(force[1], force[0])
    sense = math.copysign(1.0, motion.journal + motion.shell)
    flow = film.outflow
    ends = [_leaving(film, end) for end in (0, -1)]
    return {
        "load": load, "load_angle": angle, "eccentricity_ratio": math.hypot(*motion.centre) / b.c, "eccentricity_angle": at,
        "attitude": sense * math.remainder(at - angle, 2 * math.pi),
        "torque_shell": b.R * float((q.area * on_shell).sum()), "torque_journal": b.R * float((q.area * on_journal).sum()),
        "power_film": float((q.area * (couette * slip + h**3 / (12 * mu) * (px**2 + pz**2))).sum()),
        "flow_left": ends[0], "flow_right": ends[1], "side_flow": sum(ends),
        "flow_supply": -float(flow[film.owner >= 0].sum()),
        "p_max": float(_peak(film)), "h_min": b.smallest_gap(motion), "fill_volume": float((q.area * h * fill).sum()),
    }


def _fill(film, q, signed):
    """The oil's share of the gap at the points."""
    b = film.bearing
    if b.cavitation == "mass_conserving":
        # voids belong to what lies behind their node: a row of an element has that of its node upstream
        left = film.U > 0
        low, high = (1 - film.void[film.nodes[:, k]] for k in ((0, 2) if left else (1, 3)))
        eta = q.N[:, 2] + q.N[:, 3]
        return low[:, None] * (1 - eta) + high[:, None] * eta
    return np.where((signed > 0) | b_fed(film, q), 1.0, 0.0)


def b_fed(film, q):
    covered = np.zeros(q.phi.shape, bool)
    for f in film.bearing.features:
        if f.pressure is not None:
            covered |= f.covers(q.phi, q.z)
    return covered


def _leaving(film, end):
    """Over an edge; where no oil is conserved, over the part of it beside a film with pressure."""
    if film.bearing.edges[end] is None:
        return 0.0
    out = film.outflow.reshape(film.mesh.nx, film.mesh.nz)
    beside = film.p.reshape(out.shape)[:, 1 if end == 0 else -2]
    own = film.owner.reshape(out.shape)[:, end] == (-2 if end == 0 else -3)
    if film.bearing.cavitation != "mass_conserving":
        own = own & ((beside > 0) | (film.prescribed.reshape(out.shape)[:, end] > 0))
    return float(out[own, end].sum())


def _peak(film):
    """Largest pressure, between nodes by parabolas through three."""
    p = film.p.reshape(film.mesh.nx, film.mesh.nz)
    i, j = np.unravel_index(p.argmax(), p.shape)
    top = p[i, j]
    if film.kind.reshape(p.shape)[i, j] != 0:
        return top
    rise = 0.0
    around = np.array([film.mesh.phi[i - 1, j], film.mesh.phi[i, j], film.mesh.phi[(i + 1) % len(p), j]])
    around = around[1] + np.remainder(around - around[1] + math.pi, 2 * math.pi) - math.pi
    rise += _above(around, [p[i - 1, j], top, p[(i + 1) % len(p), j]])
    if 0 < j < p.shape[1] - 1:
        rise += _above(film.mesh.z[j - 1:j + 2], p[i, j - 1:j + 2])
    return top + rise


def _above(x, y):
    a, slope, _ = np.polyfit(np.asarray(x) - x[1], y, 2)
    return -slope**2 / (4 * a) if a < 0 and abs(slope) < -a * (x[2] - x[0]) else 0.0


def at_position(bearing, motion, columns, rows):
    film = Film(bearing, motion, columns, rows)
    film.solve()
    return figures(film)


def under_load(bearing, motion, load, angle, columns, rows, start=None):
    """The journal's position under a load, by Newton's method with differences; figures and position there."""
    target = load * np.array([math.cos(angle), math.sin(angle)])

    def solved(e, warm=None):
        film = Film(bearing, Motion(tuple(e), motion.tilt, motion.velocity, motion.journal, motion.shell), columns, rows)
        answer = figures_of(film, warm)
        return film, answer, np.array([math.cos(answer["load_angle"]), math.sin(answer["load_angle"])]) * answer["load"]

    sense = math.copysign(1.0, motion.journal + motion.shell)
    e = np.array(start) if start is not None else 0.6 * bearing.c * np.array([math.cos(angle + sense), math.sin(angle + sense)])
    film, answer, force = solved(e)
    for _ in range(60):
        off = force - target
        if np.hypot(*off) < 1e-6 * load:
            return answer, film
        h = 1e-5 * bearing.c
        J = np.stack([(solved(e + d, film)[2] - force) / h for d in (np.array([h, 0]), np.array([0, h]))], axis=1)
        if abs(np.linalg.det(J)) < 1e-12 * np.linalg.norm(J) ** 2:
            break
        step = np.linalg.solve(J, -off)
        step *= min(1.0, 0.3 * bearing.smallest_gap(film.motion) / max(np.hypot(*step), 1e-300))
        for _ in range(12):
            try:
                trial = solved(e + step, film)
            except NoAnswer:
                step = 0.5 * step
                continue
            if np.hypot(*(trial[2] - target)) < np.hypot(*off) or np.hypot(*step) < 1e-3 * bearing.c:
                break
            step = 0.5 * step
        e = e + step
        film, answer, force = trial
    raise NoAnswer("no position found under the load")


def figures_of(film, warm=None):
    film.solve((warm.p, warm.void, warm.state) if warm is not None else None)
    return figures(film)
