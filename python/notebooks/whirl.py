# %% [markdown]
# # Stiffness, damping and whirl
# The linearised film says at which mass a rigid rotor begins to whirl; a run shows it.

# %%
import numpy as np

import hersey

dimensions = dict(diameter="50 mm", width="25 mm", radial_clearance="60 um", viscosity="10 mPa.s", cavitation="reynolds",
                  grid={"circumferential": 60, "axial": 13}, supply={"line": "90 deg", "pressure": "0.5 bar"})
film = hersey.bearing(speed="6000 rpm", load="200 N", load_angle="-90 deg", **dimensions)
print(film["critical_mass"], film["whirl_ratio"])

# %% [markdown]
# The same from the matrices: the largest mass at which no eigenvalue of M s^2 + C s + K has a positive real part.

# %%
K, C = film.stiffness[:2, :2], film.damping[:2, :2]


def growth(mass):
    """Largest real part of the eigenvalues [1/s]."""
    companion = np.block([[np.zeros((2, 2)), np.eye(2)], [-K / mass, -C / mass]])
    return np.linalg.eigvals(companion).real.max()


critical = float(film["critical_mass"])
print(f"growth at 0.9 and 1.1 of the critical mass: {growth(0.9 * critical):.3g}, {growth(1.1 * critical):.3g} 1/s")
assert growth(0.9 * critical) < 0 < growth(1.1 * critical)
assert 0.4 < film["whirl_ratio"] < 0.55  # the oil goes round at half the speed
