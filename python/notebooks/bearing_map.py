# %% [markdown]
# # A bearing over load and clearance
# Every figure of every combination in one call, as xarray: choose, compare, draw.

# %%
import matplotlib.pyplot as plt

import hersey

model = hersey.bearing_model(diameter="45 mm", width="15.6 mm", radial_clearance="34 um", viscosity="15 mPa.s",
                             speed="3570 rpm", load="2500 N", supply={"line": "widest_gap", "pressure": "0 bar"},
                             grid={"circumferential": 60, "axial": 13})
sweep = model.sweep(load=["500 N", "1500 N", "2500 N"], clearance=["20 um", "34 um", "50 um"], grid_error=False)
print(sweep["h_min"].to_pandas() * 1e6)

# %% [markdown]
# The best clearance is not the smallest: at light loads friction decides, at heavy ones the film.

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5))
(1e6 * sweep["h_min"]).plot.line(x="load", ax=left)
left.set_ylabel("minimum film thickness [um]")
sweep["friction_journal"].plot.line(x="load", ax=right)

# %%
assert (sweep["error"] == "").all()
assert (sweep["h_min"].diff("load") < 0).all()  # more load, thinner film
