# %% [markdown]
# # A force and a controller of one's own
# A Python function stands where a model file may have an expression. Here a magnet holds a shaft in its bearing against its weight,
# by position and speed.

# %%
import hersey

model = hersey.Model.from_dict({
    "title": "A shaft supported by a magnet",
    "gravity": "0 -9.81 0 m/s^2",
    "lubricants": {"oil": {"viscosity": "15 mPa.s"}},
    "bodies": {"shaft": {"mass": "2 kg", "inertia": {"xx": "1e-3 kg.m^2", "yy": "1e-3 kg.m^2", "zz": "1e-3 kg.m^2"}}},
    "joints": {"free": {"type": "planar", "between": ["ground", "shaft"], "axis": "z"}},
    "drives": {"turning": {"joint": "free", "coordinate": "rotation", "speed": "3000 rpm"}},
    "forces": {"magnet": {"type": "force", "body": "shaft", "axes": "ground", "components": ["0 N", "0 N", "0 N"]}},
    "bearings": {"main": {"shell": "ground", "journal": "shaft", "diameter": "45 mm", "width": "15.6 mm",
                          "radial_clearance": "34 um", "lubricant": "oil", "grid": {"circumferential": 40, "axial": 7}}},
    "simulation": {"duration": "40 ms", "step": "0.2 ms"},
})


def magnet(y, speed):
    """Lifts [N]: stiff towards y = 0, damped."""
    return 2 * 9.81 - 2e6 * y - 2000 * speed


model["forces.magnet.components.1"] = hersey.Function(magnet, of=["free.y", "free.y_rate"], unit="N",
                                                      derivative=lambda y, speed: (-2e6, -2000))
results = model.run("out/magnet", overwrite=True)
print(results.summary["functions"])

# %% [markdown]
# A function that goes wrong ends the run and says so; what was computed until then is there.

# %%
model["forces.magnet.components.1"] = hersey.Function(lambda t: 10 / (0.02 - t) if t < 0.02 else float("nan"), of="t", unit="N")
try:
    model.run("out/magnet", overwrite=True)
    raise AssertionError("a force that is no number")
except hersey.UserFunctionError as error:
    print(error)
    assert error.results is not None and error.t < 0.021
