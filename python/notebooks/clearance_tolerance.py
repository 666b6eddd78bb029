# %% [markdown]
# # What a tolerance does to the film
# A hundred bearings from the drawing's tolerances, by SciPy's or NumPy's generator: the film's distribution.

# %%
import numpy as np

import hersey

model = hersey.Model.load("examples/bearing_alone/model.yaml")
model["bearings.main.grid"] = {"circumferential": 60, "axial": 13}

# %% [markdown]
# Clearance 34 um +- 6 um (three sigma), viscosity 15 mPa.s +- 10 %.

# %%
random = np.random.default_rng(1)
films = []
for clearance, viscosity in zip(random.normal(34, 2, 40), random.normal(15, 0.5, 40)):
    solution = model.bearing(clearance=f"{clearance} um", viscosity=f"{viscosity} mPa.s", grid_error=False)
    films.append(float(solution["h_min"]))
print(f"h_min: median {1e6 * np.median(films):.2f} um, one in ten below {1e6 * np.quantile(films, 0.1):.2f} um")

# %%
assert 0 < np.std(films) < 0.2 * np.mean(films)
