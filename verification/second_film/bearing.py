"""What a bearing is: gap, oil and what feeds it, by published formulas. SI units; pressures count from that of cavitation."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from mesh import TURN

SLIM = 1e-9  # of a border that lies on a node


@dataclass
class Feature:
    """A hole (ellipse) or a rectangle: middle and whole extents; pressure None: a pocket; `turned`: of the journal."""

    is_round: bool
    phi: float
    z: float
    arc: float
    length: float
    pressure: float | None
    depth: float
    on_journal: bool

    def covers(self, phi, z):
        x = np.abs(np.remainder(phi - self.phi + math.pi, TURN) - math.pi) / (0.5 * self.arc)
        y = np.abs(z - self.z) / (0.5 * self.length)
        if self.is_round:
            return x**2 + y**2 <= 1 + SLIM
        return ((x <= 1 + SLIM) | (self.arc >= TURN)) & (y <= 1 + SLIM)


@dataclass
class Profile:
    kind: str
    size: float
    angle: float
    count: int
    on_journal: bool

    def opening(self, phi, z, L):
        """The gap that it adds, and its derivative by the angle."""
        a = phi - self.angle
        if self.kind == "barrel":
            return self.size * (2 * z / L) ** 2, 0 * a
        if self.kind == "taper":
            return self.size * z / L, 0 * a
        if self.kind == "ovality":
            return self.size * np.cos(2 * a), -2 * self.size * np.sin(2 * a)
        part = TURN / self.count
        off = np.remainder(a + 0.5 * part, part) - 0.5 * part
        return self.size * (1 - np.cos(off)), self.size * np.sin(off)

    def kinks(self):
        if self.kind != "lobes":
            return []
        return [self.angle + (k + 0.5) * TURN / self.count for k in range(self.count)]


@dataclass
class Bearing:
    R: float
    L: float
    c: float
    mu: float
    cavitation: str = "mass_conserving"
    edges: tuple = ((0.0, 0.0), (0.0, 0.0))  # each (pressure, share of oil around it), or None: a wall
    line: object = None  # "widest_gap" or an angle
    line_pressure: float = 0.0
    features: list = field(default_factory=list)
    profiles: list = field(default_factory=list)
    barus: float = 0.0
    roelands: float = 0.0
    bulk_modulus: float = 0.0
    dowson_higginson: tuple | None = None  # (rise, saturation)
    cavitated_shear: str = "film_share"
    shear_force: str = "full"

    def turned(self, angle):
        """With the journal's profiles turned on."""
        return replace(self, profiles=[replace(f, angle=f.angle + angle * f.on_journal) for f in self.profiles])

    # -- oil

    def is_nonlinear(self):
        return bool(self.barus or self.roelands or self.bulk_modulus or self.dowson_higginson)

    def viscosity(self, p):
        """Barus (1893), mu0 exp(alpha p); Roelands (1966), with 6.31e-5 Pa s and 196.2 MPa; slope."""
        if self.barus:
            mu = self.mu * np.exp(self.barus * p)
            return mu, self.barus * mu
        if self.roelands:
            A, x = math.log(self.mu / 6.31e-5), 1 + p / 196.2e6
            mu = self.mu * np.exp(A * (x**self.roelands - 1))
            return mu, mu * A * self.roelands * x ** (self.roelands - 1) / 196.2e6
        return self.mu + 0 * p, 0 * p

    def density(self, p):
        """Over that at the cavitation pressure, and slope."""
        if self.bulk_modulus:
            rho = np.exp(p / self.bulk_modulus)
            return rho, rho / self.bulk_modulus
        if self.dowson_higginson:
            rise, saturation = self.dowson_higginson
            return 1 + rise * p / (1 + saturation * p), rise / (1 + saturation * p) ** 2
        return 1 + 0 * p, 0 * p

    # -- gap

    def gap(self, phi, z, motion):
        x, y = (motion.centre[k] + motion.tilt[k] * z for k in (0, 1))
        return self.c - x * np.cos(phi) - y * np.sin(phi) + sum(f.opening(phi, z, self.L)[0] for f in self.profiles)

    def gap_rate(self, phi, z, motion):
        rate = -motion.velocity[0] * np.cos(phi) - motion.velocity[1] * np.sin(phi) + 0 * z
        for f in self.profiles:
            rate = rate - (motion.journal if f.on_journal else motion.shell) * f.opening(phi, z, self.L)[1]
        return rate

    def pocket_depth(self, phi, z, on_journal=None):
        """Of both surfaces, or of one."""
        return self._depth(phi, z, lambda f: f.pressure is None and on_journal in (None, f.on_journal))

    def shear_depth(self, phi, z):
        """Depth of what is fed: the film's shear sees it, the flow of the film does not."""
        return self._depth(phi, z, lambda f: f.pressure is not None)

    def _depth(self, phi, z, counts):
        return sum((f.depth * f.covers(phi, z) for f in self.features if counts(f)), 0 * phi)

    def smallest_gap(self, motion):
        """Outside features with depth: by searching finer and finer about the smallest."""
        phi, z, width, length = 0.0, 0.0, math.pi, 0.5 * self.L
        for count in (721, 81, 41, 41, 41):
            along = np.clip(z + length * np.linspace(-1, 1, 41), -0.5 * self.L, 0.5 * self.L)
            P, Z = np.meshgrid(phi + width * np.linspace(-1, 1, count), along)
            h = self.gap(P, Z, motion) + self.pocket_depth(P, Z) + self.shear_depth(P, Z)
            k = np.unravel_index(h.argmin(), h.shape)
            phi, z, width, length = P[k], Z[k], width * 4 / count, length / 10
        return float(h.min())

    # -- what has a prescribed pressure

    def line_angle(self, motion):
        """Of the supply line; None where there is none."""
        if self.line != "widest_gap":
            return self.line
        phi = np.linspace(0, TURN, 3601)
        k = int(self.gap(phi, 0.0, motion).argmax())
        fine = phi[k] + np.linspace(-1, 1, 2001) * (phi[1] - phi[0])
        return float(fine[self.gap(fine, 0.0, motion).argmax()])

    def lines_of_mesh(self, line):
        around, along = [] if line is None else [line], []
        for profile in self.profiles:
            around += profile.kinks()
        for f in self.features:
            if f.is_round:
                continue
            if f.arc < TURN:
                around += [f.phi - 0.5 * f.arc, f.phi + 0.5 * f.arc]
            along += [f.z - 0.5 * f.length, f.z + 0.5 * f.length]
        return around, along, [(f.phi, f.z, 0.5 * f.arc, 0.5 * f.length) for f in self.features if f.is_round]

    def prescribed_places(self, mesh, line):
        """(nodes, pressure) of the line and of each feature that is fed; later ones hold where both are."""
        z = np.broadcast_to(mesh.z, mesh.phi.shape)
        if line is None:
            yield np.zeros(mesh.phi.shape, bool), 0.0
        else:
            off = np.abs(np.remainder(mesh.phi - line + math.pi, TURN) - math.pi)
            nearest = np.zeros(mesh.phi.shape, bool)
            nearest[off.argmin(axis=0), np.arange(mesh.nz)] = True
            yield nearest, self.line_pressure
        for f in self.features:
            yield (f.covers(mesh.phi, z) if f.pressure is not None else np.zeros(mesh.phi.shape, bool)), f.pressure or 0.0
