"""Integrals over the fields of a film, made with other sums than the program's own.

Every integral comes with an estimate of its error: the same sum over every second node. Fields are arrays (n_phi, n_z).
"""

from dataclasses import dataclass

import numpy as np


@dataclass
class Estimate:
    value: float
    error: float


def _spacing(phi):
    return np.diff(np.append(phi, phi[0] + 2 * np.pi))


def _sum(cells, R, phi, z):
    return float((cells * R * _spacing(phi)[:, None] * np.diff(z)[None, :]).sum())


def _corners(field):
    """The four corners of every cell between nodes, around the bearing: (i, j), (i+1, j), (i, j+1), (i+1, j+1)."""
    after = np.roll(field, -1, axis=0)
    return field[:, :-1], after[:, :-1], field[:, 1:], after[:, 1:]


def mean(field):
    """Mean over each cell, of a field given at nodes."""
    return sum(_corners(field)) / 4


def slopes(field, R, phi, z):
    """Mean slopes over each cell around and along."""
    a, b, c, d = _corners(field)
    dx, dz = R * _spacing(phi)[:, None], np.diff(z)[None, :]
    return (b + d - a - c) / (2 * dx), (c + d - a - b) / (2 * dz)


def _every_second(fields, phi, z):
    return [f[::2, ::2] for f in fields], phi[::2], z[::2]


def integral(cells_of, fields, R, phi, z):
    """Integral over the surface of what `cells_of(fields, R, phi, z)` gives for every cell, with its error."""
    fine = _sum(cells_of(fields, R, phi, z), R, phi, z)
    if len(phi) % 2 or len(z) % 2 == 0:
        return Estimate(fine, 0.0)
    coarse_fields, coarse_phi, coarse_z = _every_second(fields, phi, z)
    coarse = _sum(cells_of(coarse_fields, R, coarse_phi, coarse_z), R, coarse_phi, coarse_z)
    return Estimate(fine, abs(fine - coarse))


def middle_angles(phi):
    return (phi + 0.5 * _spacing(phi))[:, None]


def volume(content, R, phi, z):
    """Integral of theta h (times the density over rho0).

    A front jumps within a cell on either grid, so that their difference may be half of what both are off.
    """
    own = integral(lambda f, *at: mean(f[0]), [content], R, phi, z)
    return Estimate(own.value, 2 * own.error)


def force(pressure, R, phi, z):
    """Force of a pressure on the shell, along x and y."""
    along_x = integral(lambda f, _, phi, z: mean(f[0] * np.cos(phi)[:, None]), [pressure], R, phi, z)
    along_y = integral(lambda f, _, phi, z: mean(f[0] * np.sin(phi)[:, None]), [pressure], R, phi, z)
    return along_x, along_y


def couette_power(shares, mu, h, slip, R, phi, z):
    """Dissipation by shear: share mu slip^2/h, for a share between two bounds."""
    least, most = (integral(lambda f, *at: mean(f[0] / f[1]) * slip**2, [share * mu, h], R, phi, z) for share in shares)
    return Estimate((least.value + most.value) / 2, most.error + (most.value - least.value) / 2)


def poiseuille_power(p, mu, h, R, phi, z):
    """Dissipation by the flow that pressure drives: h^3/(12 mu) |grad p|^2.

    Where a cell is deep on one side the pressure falls on the other: it counts with its smallest conductance, and once more as error.
    """

    def parts(f, R, phi, z):
        around, along = slopes(f[0], R, phi, z)
        conductance = f[2] ** 3 / (12 * f[1])
        lowest, highest = np.minimum.reduce(_corners(conductance)), np.maximum.reduce(_corners(conductance))
        is_step = highest > 8 * lowest
        return np.where(is_step, lowest, mean(conductance)) * (around**2 + along**2), is_step

    whole = integral(lambda f, *at: parts(f, *at)[0], [p, mu, h], R, phi, z)
    steps = integral(lambda f, *at: np.multiply(*parts(f, *at)), [p, mu, h], R, phi, z)
    return Estimate(whole.value, whole.error + steps.value)


def dip(field):
    """By how much a smooth field may lie below the lower one of two neighbours: an eighth of its second difference."""
    around = np.abs(np.roll(field, 1, 0) - 2 * field + np.roll(field, -1, 0)).max()
    along = np.abs(field[:, :-2] - 2 * field[:, 1:-1] + field[:, 2:]).max()
    return (around + along) / 8
