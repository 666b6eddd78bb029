"""Laws of the oil by their published formulas, at the nodes of a field."""

import math

import numpy as np


def viscosity(b, p):
    """mu(p), p counted from the cavitation pressure (film.23)."""
    over = np.maximum(p - b.p_cav, 0)
    if not b.viscosity_law:
        return b.mu + 0 * p
    law, value = b.viscosity_law
    if law == "barus":
        return b.mu * np.exp(value * over)
    return b.mu * np.exp((math.log(b.mu) + 9.67) * ((1 + over / 196.2e6) ** value - 1))


def density(b, p):
    """rho/rho0 (film.24)."""
    over = np.maximum(p - b.p_cav, 0)
    return 1 + 0.6e-9 * over / (1 + 1.7e-9 * over) if b.is_compressible else 1 + 0 * p


def shear_share(b, a):
    """Share of the gap under Couette shear."""
    if b.cavitated_shear == "full":
        return 1 + 0 * a.p
    if b.cavitation == "mass_conserving":
        return np.clip(a.theta, 0, 1)
    # no fill fraction: the share fades within a thousandth of a cell's pressure of the cavitation pressure
    return (a.p > b.p_cav).astype(float)
