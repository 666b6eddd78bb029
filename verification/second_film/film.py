"""The film of a bearing by finite elements, with cavitation as a complementarity problem of pressure and void.

Literature: Reynolds (1886); Jakobsson and Floberg (1957), Olsson (1965) for the oil that is conserved; the linear complementarity
form with the void s = 1 - theta as partner of the pressure is that of Giacopini, Fowell, Dini and Strozzi (2010); the equations of a
state guessed are solved and the guess changed where a sign is wrong: block principal pivoting (Judice and Pires 1994), the primal-dual
active set of Hintermueller, Ito and Kunisch (2003). An answer is checked for its complementarity, so how it was found does not matter.

Pressure: bilinear elements, Galerkin. Void: carried by the flow along the rows of the mesh from one element to the next; it belongs to
the middle of the element behind its node, where a broken film's flow is exact. Pressures count from that of cavitation. SI units.
"""

import math

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from mesh import TURN, Mesh, Quadrature

FREE, PRESCRIBED, AIR = 0, 1, 2  # kinds of nodes: of the film; full, of prescribed pressure; on an edge in air of some oil


class NoAnswer(Exception):
    """Says why."""


class Motion:
    """Where the journal is and how it moves: centre (x, y), its velocity, slope of the axis; speeds of both surfaces."""

    def __init__(self, centre, tilt=(0.0, 0.0), velocity=(0.0, 0.0), journal=0.0, shell=0.0):
        self.centre, self.tilt, self.velocity, self.journal, self.shell = centre, tilt, velocity, journal, shell


class Film:
    """One bearing at one moment on one mesh. `columns`, `rows`: cells around and along."""

    def __init__(self, bearing, motion, columns, rows):
        self.bearing, self.motion = bearing, motion
        self.line = bearing.line_angle(motion)
        around, along, ellipses = bearing.lines_of_mesh(self.line)
        self.mesh = Mesh(bearing.R, bearing.L, columns, rows, around, along, ellipses)
        self.nodes = self.mesh.nodes()
        self.points = Quadrature.gauss(self.mesh)
        self.U = 0.5 * bearing.R * (motion.journal + motion.shell)
        self._hold()
        q = self.points
        self.h = bearing.gap(q.phi, q.z, motion) + bearing.pocket_depth(q.phi, q.z)
        self.rate = bearing.gap_rate(q.phi, q.z, motion)
        if bearing.gap(*np.meshgrid(np.linspace(0, TURN, 721), np.linspace(-0.5, 0.5, 41) * bearing.L), motion).min() <= 0:
            raise NoAnswer("the surfaces touch")
        # what an element's row carries of the sliding gap, and what opening it takes at its nodes
        self.row_flow = self.U * np.einsum("ep,ep,epk->ek", q.area, self.h, q.Nx)
        self.opening = self._gather(np.einsum("ep,ep,pk->ek", q.area, self.rate, q.N))
        self.room = self._gather(np.einsum("ep,ep,pk->ek", q.area, self.h, q.N))  # for oil [m^3]
        self.before = None  # oil a step ago at each node [m^3] and the step [s]; None: all is steady but for the gap's rate

    def _gather(self, of_elements):
        """Sums contributions (elements, 4) at the nodes."""
        return np.bincount(self.nodes.ravel(), of_elements.ravel(), minlength=self.mesh.nx * self.mesh.nz)

    def _hold(self):
        """Kinds of all nodes, pressures of those prescribed, and what prescribes them."""
        m, b = self.mesh, self.bearing
        kind, prescribed = np.full((m.nx, m.nz), FREE), np.zeros((m.nx, m.nz))
        owner = np.full((m.nx, m.nz), -1)
        fill = np.zeros((m.nx, m.nz))
        for k, (mask, pressure) in enumerate(b.prescribed_places(m, self.line)):
            kind[mask], prescribed[mask], owner[mask] = PRESCRIBED, pressure, k
        for j, edge in ((0, b.edges[0]), (-1, b.edges[1])):
            if edge is None:
                continue
            pressure, share = edge
            in_air = b.cavitation == "mass_conserving" and pressure <= 0
            fed = in_air & (kind[:, j] == PRESCRIBED)  # a line or groove that ends on an edge in air keeps it full
            kind[:, j] = np.where(fed, PRESCRIBED, AIR if in_air else PRESCRIBED)
            prescribed[:, j] = 0.0 if in_air else max(pressure, 0.0) if b.cavitation != "guembel" else pressure
            owner[:, j] = np.where(fed & (owner[:, j] >= 0), owner[:, j], -2 if j == 0 else -3)
            fill[:, j] = share
        self.kind, self.prescribed, self.owner, self.most_void = kind.ravel(), prescribed.ravel(), owner.ravel(), 1 - fill.ravel()

    # -- equations

    def _laws(self, p):
        """At the points: conductance rho h^3/(12 mu) with its slope, rho with its slope."""
        q, b = self.points, self.bearing
        at = np.maximum(q.at(p, self.nodes), 0)
        mu, dmu = b.viscosity(at)
        rho, drho = b.density(at)
        k = rho * self.h**3 / (12 * mu)
        return k, k * (drho / rho - dmu / mu), rho, drho

    def residual(self, p, void, with_jacobian=True):
        """What more flows out of each node's part of the film than in, and its derivatives by pressures and voids."""
        q = self.points
        k, dk, rho, drho = self._laws(p)
        px, pz = q.slopes(p, self.nodes)
        slide = self.U * self.h
        r = np.einsum("ep,epk->ek", q.area * (k * px - rho * slide), q.Nx) + np.einsum("ep,epk->ek", q.area * k * pz, q.Nz)
        moved, rows, columns, values = self._void(void)
        storage, per_void = self._storage(void, rho)
        r = self._gather(r) + moved + storage
        if not with_jacobian:
            return r
        J = np.einsum("ep,epk,epl->ekl", q.area * k, q.Nx, q.Nx) + np.einsum("ep,epk,epl->ekl", q.area * k, q.Nz, q.Nz)
        if self.bearing.is_nonlinear():
            J += np.einsum("ep,epk,pl->ekl", q.area * (dk * px - drho * slide), q.Nx, q.N)
            J += np.einsum("ep,epk,pl->ekl", q.area * dk * pz, q.Nz, q.N)
            if self.before is None:
                J += np.einsum("ep,pk,pl->ekl", q.area * drho * self.rate, q.N, q.N)
        of_p = (np.repeat(self.nodes, 4, axis=1).ravel(), np.tile(self.nodes, (1, 4)).ravel(), J.ravel())
        n = np.arange(len(p))
        of_s = (np.concatenate([rows, n]), np.concatenate([columns, n]), np.concatenate([values, per_void]))
        return r, of_p, of_s

    def oil(self):
        """At each node [m^3], of a film that is solved."""
        return (1 - self.void) * self.room

    def _storage(self, void, rho):
        """What the gap takes up as it opens, and its derivative by the void: at its rate, or over a step (backward Euler)."""
        if self.before is None:
            q = self.points
            return self._gather(np.einsum("ep,pk->ek", q.area * rho * self.rate, q.N)) - void * self.opening, -self.opening
        oil, dt = self.before
        return ((1 - void) * self.room - oil) / dt, -self.room / dt

    def _void(self, void):
        """The void that surfaces carry: each row of an element takes that of its node upstream."""
        rows, columns, values = [], [], []
        for left, right in ((0, 1), (2, 3)):
            missing = self.row_flow[:, left]  # minus what passes from left to right where the gap is full
            up = self.nodes[:, left if self.U > 0 else right]
            rows += [self.nodes[:, left], self.nodes[:, right]]
            columns += [up, up]
            values += [missing, -missing]
        rows, columns, values = map(np.concatenate, (rows, columns, values))
        return np.bincount(rows, values * void[columns], minlength=len(void)), rows, columns, values

    # -- solution

    def solve(self, start=None):
        """Pressures and voids of all nodes."""
        n = len(self.kind)
        p, void = np.where(self.kind == PRESCRIBED, self.prescribed, 0.0), np.zeros(n)
        # state: 0 full (pressure unknown), 1 void unknown, 2 as void as its surroundings (inflow unknown)
        state = np.zeros(n, int)
        if start is not None and len(start[0]) == n:
            p, void, state = np.where(self.kind == PRESCRIBED, self.prescribed, start[0]), start[1].copy(), start[2].copy()
        slack = np.zeros(n)
        for count in range(200):
            change = self._step(p, void, slack, state)
            wrong = self._wrong_states(p, void, slack, state)
            if count > 40 and wrong[0].any():  # goes round in circles: change a random half of what is wrong
                half = np.random.default_rng(count).random(n) < 0.5
                wrong = (wrong[0] & half, wrong[1])
            state = np.where(wrong[0], wrong[1], state)
            if not wrong[0].any() and change < 1e-9:
                break
        else:
            raise NoAnswer("the film does not settle")
        self.iterations = count + 1
        self.p, self.void, self.state = p, void, state
        if self.bearing.cavitation == "mass_conserving" and void.max() > 1 + 1e-6:
            raise NoAnswer("a fill below nothing: more oil leaves than comes")
        self.outflow = -self.residual(p, void, with_jacobian=False)
        return p, void, state

    def _step(self, p, void, slack, state):
        """One Newton step for the state guessed; changes p, void and slack in place; the relative change of the pressure."""
        n = len(p)
        conserves = self.bearing.cavitation == "mass_conserving"
        cavitated = (state > 0) & (self.kind == FREE)
        p[cavitated] = 0
        void[(state == 0) | (self.kind == PRESCRIBED)] = 0
        void[state == 2] = self.most_void[state == 2]
        slack[state == 0] = 0
        r, (pi, pj, pv), (si, sj, sv) = self.residual(p, void)
        unknown_p = (self.kind == FREE) & (state == 0)
        unknown_s = (self.kind != PRESCRIBED) & (state == 1) if conserves else np.zeros(n, bool)
        own = ~unknown_p & ~unknown_s  # the flow to or from a reservoir, or the oil that Reynolds' condition lacks
        keep_p, keep_s = unknown_p[pj], unknown_s[sj]
        diagonal = np.flatnonzero(own)
        # voids and flows in units that weigh like a pressure, so that factors are well conditioned
        unit, per_void = np.abs(pv).max(), np.abs(pv).max() / max(np.abs(sv).max(), 1e-300)
        A = coo_matrix((np.concatenate([pv[keep_p], sv[keep_s] * per_void, np.full(len(diagonal), unit)]),
                        (np.concatenate([pi[keep_p], si[keep_s], diagonal]), np.concatenate([pj[keep_p], sj[keep_s], diagonal]))),
                       shape=(n, n)).tocsc()
        try:
            dy = splu(A).solve(-r - np.where(own, slack, 0.0))
        except RuntimeError as error:
            raise NoAnswer("the film's equations are singular") from error
        dy *= self._share_of_step(p[unknown_p], dy[unknown_p])
        p[unknown_p] += dy[unknown_p]
        void[unknown_s] += dy[unknown_s] * per_void
        slack[own] += dy[own] * unit
        return np.abs(dy[unknown_p]).max(initial=0.0) / max(np.abs(p).max(), 1e-300)

    def _share_of_step(self, p, dp):
        """All of it, or so much that the viscosity changes by no more than its e-fold anywhere: it is steep."""
        share = 1.0
        while len(p) and share > 1e-6:
            with np.errstate(over="ignore"):
                rise = self.bearing.viscosity(np.maximum(p + share * dp, 0))[0] / self.bearing.viscosity(np.maximum(p, 0))[0]
            if rise.max() < math.e and rise.min() > 1 / math.e:
                break
            share *= 0.5
        return share

    def _wrong_states(self, p, void, slack, state):
        """Where the guess was wrong, and the next guess."""
        n = len(p)
        if self.bearing.cavitation == "guembel":
            return np.zeros(n, bool), state
        free, air = self.kind == FREE, self.kind == AIR
        conserves = self.bearing.cavitation == "mass_conserving"
        tiny_p = 1e-9 * max(np.abs(p).max(), 1e-300)
        tiny_flow = 1e-11 * max(np.abs(self.row_flow).max(), np.abs(self.opening).max(), np.abs(slack).max())
        to_void = free & (state == 0) & (p < -tiny_p)
        to_full = free & (state == 1) & ((void < -1e-11) if conserves else (slack > tiny_flow))
        # an edge in air: oil leaves it (slack, an outflow), or its void follows, or it draws oil in
        to_void |= air & (state == 0) & (slack < -tiny_flow)
        to_full |= air & (state == 1) & (void < -1e-11)
        to_drawn = air & (state == 1) & (void > self.most_void + 1e-11)
        from_drawn = air & (state == 2) & (slack > tiny_flow)
        wrong = to_void | to_full | to_drawn | from_drawn
        return wrong, np.where(to_full, 0, np.where(to_drawn, 2, 1))


def march(bearing, motion_at, times, columns, rows, filled=None):
    """Films at each of `times` but the first: pressure and void of oil that is conserved, in time.

    At the first the film is steady, or that of a gap which was full a time `filled` before [s].
    """
    if bearing.bulk_modulus or bearing.dowson_higginson or bearing.line == "widest_gap":
        raise NoAnswer("in time: an incompressible oil, and feeds that stay where they are")
    if any(f.on_journal for f in bearing.features) or any(f.on_journal and f.kind == "lobes" for f in bearing.profiles):
        raise NoAnswer("a feature or kinks that travel over the mesh")

    def film_at(t):
        motion = motion_at(t)
        return Film(bearing.turned(motion.journal * (t - times[0])), motion, columns, rows)

    film = film_at(times[0])
    if filled:
        film.before = (film.room, filled)
    state = film.solve()
    for start, end in zip(times, times[1:]):
        after = film_at(end)
        after.before = (film.oil(), end - start)
        state = after.solve(state)
        film = after
        yield film
