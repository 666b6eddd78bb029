# %% [markdown]
# # A run and its pictures
# A shaft falls into its film. The results are an HDF5 file; here they are xarray.

# %%
import matplotlib.pyplot as plt

import hersey
from hersey import plot

model = hersey.Model.from_dict({
    "title": "A shaft in a film",
    "lubricants": {"oil": {"viscosity": "15 mPa.s"}},
    "bodies": {"shaft": {"mass": "2 kg", "inertia": {"xx": "1e-3 kg.m^2", "yy": "1e-3 kg.m^2", "zz": "1e-3 kg.m^2"}}},
    "joints": {"free": {"type": "planar", "between": ["ground", "shaft"], "axis": "z"}},
    "drives": {"turning": {"joint": "free", "coordinate": "rotation", "speed": "3000 rpm"}},
    "forces": {"push": {"type": "force", "body": "shaft", "axes": "ground", "components": ["0 N", "-500 N", "0 N"]}},
    "bearings": {"main": {"shell": "ground", "journal": "shaft", "diameter": "45 mm", "width": "15.6 mm",
                          "radial_clearance": "34 um", "lubricant": "oil", "grid": {"circumferential": 40, "axial": 7}}},
    "simulation": {"duration": "40 ms", "step": "0.2 ms"},
    "output": {"fields_every": "4 ms"},
})
results = model.run("out/shaft", overwrite=True, progress=True)
print(results.table())

# %%
figure, axes = plt.subplots(1, 3, figsize=(13, 3.5))
plot.orbit(results, ax=axes[0])
plot.moft(results, ax=axes[1])
plot.film_map(results, ax=axes[2])
results.report("out/shaft/report.html")

# %% [markdown]
# The journal settles: it moves less in the last quarter than in the first.

# %%
film = results.bearing()
ratio = film["eccentricity_ratio"]
first, last = ratio.sel(time=slice(None, 10e-3)), ratio.sel(time=slice(30e-3, None))
assert float(last.max() - last.min()) < 0.5 * float(first.max() - first.min())
