"""Laws of the oil by their published formulas, at the nodes of a field."""

import math

import numpy as np


def viscosity(b, p):
    """mu(p), p counted from the cavitation pressure (film.7)."""
    over = np.maximum(p - b.p_cav, 0)
    if not b.viscosity_law:
        return b.mu + 0 * p
    law, value = b.viscosity_law
    if law == "barus":
        return b.mu * np.exp(value * over)
    return b.mu * np.exp((math.log(b.mu) + 9.67) * ((1 + over / 196.2e6) ** value - 1))


def density(b, p):
    """rho/rho0 (film.8)."""
    over = np.maximum(p - b.p_cav, 0)
    if b.bulk_modulus:
        return np.exp(over / b.bulk_modulus)
    return 1 + 0.6e-9 * over / (1 + 1.7e-9 * over) if b.is_compressible else 1 + 0 * p


def compressibility(b):
    """The largest rise of density per pressure [1/Pa]."""
    return 1 / b.bulk_modulus if b.bulk_modulus else 0.6e-9 if b.is_compressible else 0.0


def asperity_pressure(b, h):
    """Of the law fitted to (film.40), from the gap of the mean planes."""
    a = b.asperities
    below = np.maximum(4 - (h - a["summits"]) / a["sigma"], 0)
    return a["factor"] * a["modulus"] * 4.4086e-5 * below**6.804


def shear_shares(b, p, theta, fed):
    """Share of the gap under Couette shear: the least and the most that can be meant. `fed`: nodes that something feeds."""
    if b.cavitated_shear == "full":
        return (1 + 0 * p,) * 2
    if b.cavitation == "mass_conserving":
        return (np.clip(theta, 0, 1),) * 2
    # No fill fraction: sheared is what has pressure, and up to a cell around it.
    full = p > b.p_cav
    wide = full | fed | np.roll(full, 1, 0) | np.roll(full, -1, 0)
    wide[:, 1:] |= full[:, :-1]
    wide[:, :-1] |= full[:, 1:]
    return full.astype(float), wide.astype(float)
