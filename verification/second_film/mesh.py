"""A mesh of quadrilaterals over the unwrapped bearing, with lines along everything that has a prescribed pressure or has a depth.

Nodes (i, j) lie at angles phi[i, j], around the bearing and periodic, and at z[j] along it. Rows run straight around, so that
a surface carries oil along them. Borders of rectangles are lines of the mesh; of ellipses, nodes are moved onto them along their row.
"""

import math

import numpy as np

TURN = 2 * math.pi

# Nearer to each other than this share of a cell, two lines of the mesh are one.
MERGE = 1e-6


def divided(breaks, size):
    """Places from the first to the last of `breaks`, all of them included, in steps of about `size` at most."""
    places = [breaks[0]]
    for a, b in zip(breaks, breaks[1:]):
        count = max(1, math.ceil((b - a) / size - 1e-9))
        places += [a + (b - a) * k / count for k in range(1, count + 1)]
    return np.array(places)


def distinct(places, size):
    """Ascending, without those that are one."""
    kept = []
    for place in sorted(places):
        if not kept or place - kept[-1] > MERGE * size:
            kept.append(place)
    return kept


def vertices(half, size):
    """Places along an ellipse at equal parts of its eccentric angle, so that its flat ends have vertices, too."""
    count = max(3, round(1.5 * half / size))
    return [math.cos(math.pi * k / (2 * count)) * side for k in range(count) for side in (-1, 1)]


class Mesh:
    """`columns`, `rows`: numbers of cells around and along, about; `around`, `along`: lines it must have; `ellipses`: (phi, z, half
    width in phi, half length in z)."""

    def __init__(self, R, L, columns, rows, around=(), along=(), ellipses=()):
        self.R, self.L = R, L
        lines = [math.remainder(a, TURN) % TURN for a in around]
        for phi, _, half, _ in ellipses:
            lines += [(phi + side * half) % TURN for side in (-1, 1)]
        lines = distinct(lines, TURN / columns) or [0.0]
        if len(lines) > 1 and lines[-1] - lines[0] > TURN - MERGE * TURN / columns:
            lines.pop()
        start = lines[0]
        x = divided([*lines, start + TURN], TURN / columns)
        of_ellipses = [z + half * place for _, z, _, half in ellipses for place in vertices(half, L / rows)]
        inside = [z for z in (*along, *of_ellipses) if -0.5 * L * (1 - 1e-9) < z < 0.5 * L * (1 - 1e-9)]
        self.z = divided(distinct([-0.5 * L, 0.5 * L, *inside], L / rows), L / rows)
        self.nx, self.nz = len(x) - 1, len(self.z)
        self.phi = np.repeat(x[:-1, None], self.nz, axis=1)
        self.end = np.repeat(x[-1:, None], self.nz, axis=1)  # the first column once more, a turn on
        for ellipse in ellipses:
            self._fit(ellipse)

    def _fit(self, ellipse):
        """Moves, in each row through an ellipse, the nodes nearest to its border onto it."""
        phi, z, half, length = ellipse
        for j, s in enumerate((self.z - z) / length):
            if abs(s) > 1 + 1e-9:
                continue
            reach = half * math.sqrt(max(0.0, 1 - s * s))
            for side in (-1, 1):
                offset = np.remainder(self.phi[:, j] - phi - side * reach + math.pi, TURN) - math.pi
                i = int(np.argmin(np.abs(offset)))
                self.phi[i, j] -= offset[i]
        self.end = self.phi[:1] + TURN

    def corners(self):
        """Angles of the four corners of each element: (i, j), (i+1, j), (i, j+1), (i+1, j+1)."""
        after = np.vstack([self.phi[1:], self.end])
        return self.phi[:, :-1], after[:, :-1], self.phi[:, 1:], after[:, 1:]

    def nodes(self):
        """Numbers of the four nodes of each element, (elements, 4)."""
        number = np.arange(self.nx * self.nz).reshape(self.nx, self.nz)
        after = np.roll(number, -1, axis=0)
        return np.stack([number[:, :-1], after[:, :-1], number[:, 1:], after[:, 1:]], axis=-1).reshape(-1, 4)


class Quadrature:
    """Points (xi, eta) of the unit square with weights, carried to every element: places, weights [m^2], shape functions and their
    derivatives along x = R phi and z."""

    def __init__(self, mesh, xi, eta, weight):
        xi, eta = np.asarray(xi), np.asarray(eta)
        a, b, c, d = (corner.reshape(-1, 1) * mesh.R for corner in mesh.corners())
        z0 = np.broadcast_to(mesh.z[:-1], (mesh.nx, mesh.nz - 1)).reshape(-1, 1)
        z1 = np.broadcast_to(mesh.z[1:], (mesh.nx, mesh.nz - 1)).reshape(-1, 1)
        self.N = np.stack([(1 - xi) * (1 - eta), xi * (1 - eta), (1 - xi) * eta, xi * eta], axis=-1)  # (points, 4)
        along_xi = np.stack([eta - 1, 1 - eta, -eta, eta], axis=-1)
        along_eta = np.stack([xi - 1, -xi, 1 - xi, xi], axis=-1)
        x_xi, x_eta = (b - a) * (1 - eta) + (d - c) * eta, (c - a) * (1 - xi) + (d - b) * xi
        z_eta = z1 - z0
        self.phi = (np.stack([a, b, c, d], axis=-1) * self.N).sum(-1) / mesh.R
        self.z = z0 * (1 - eta) + z1 * eta
        self.area = x_xi * z_eta * np.asarray(weight)  # (elements, points)
        self.Nx = along_xi / x_xi[..., None]
        self.Nz = (along_eta - along_xi * (x_eta / x_xi)[..., None]) / z_eta[..., None]

    @classmethod
    def gauss(cls, mesh):
        low = 0.5 - 0.5 / math.sqrt(3)
        xi, eta = np.meshgrid([low, 1 - low], [low, 1 - low])
        return cls(mesh, xi.ravel(), eta.ravel(), 0.25)

    @classmethod
    def strips(cls, mesh, count):
        """`count` midpoints around by two points of Gauss along: for integrands that end within an element."""
        low = 0.5 - 0.5 / math.sqrt(3)
        xi, eta = np.meshgrid((np.arange(count) + 0.5) / count, [low, 1 - low])
        return cls(mesh, xi.ravel(), eta.ravel(), 0.5 / count)

    def at(self, nodal, nodes):
        """A nodal field at the points."""
        return nodal[nodes] @ self.N.T

    def slopes(self, nodal, nodes):
        of = nodal[nodes][:, None, :]
        return (of * self.Nx).sum(-1), (of * self.Nz).sum(-1)
