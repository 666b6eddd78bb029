"""Which commands give the key figures of the examples, and which numbers of their results are key figures.

`bench/key_figures.py` asks `commands(example)` what to run, `of_bearing` what counts in the answer of `hersey bearing`, and `of_run`
what counts in the results file of a run. Both go by rules, so that a new quantity or a new kind of bearing is compared from its
first day; each rule says why it leaves out what it leaves out.
"""
import re

# Runs are as short as still shows what the example is about: a peak of the gas force, a rotor on its way, a contact and its end.
# The motion of a double pendulum, and of machines with contacts, soon multiplies round-off; those runs end before that.
COMMANDS = {
    "ball_drop/model": [("run", "simulation.duration=0.5s")],
    "bearing_alone/model": [("bearing",)],
    # The study's plan draws its parameters; each at its nominal value is a single bearing.
    "bearing_tolerances/model": [("bearing", "clearance=34um", "width=15.6mm", "viscosity=15mPa.s", "load=2500N")],
    "bearing_tolerances/optimum": [("bearing", "clearance=34um", "width=15.6mm")],
    "cam_follower/model": [("run", "simulation.duration=0.1s")],
    "co_simulation/bearing": [("run",)],
    "co_simulation/whole": [("run",)],
    "conrod_pressure/model": [("run",)],
    "conrod_pressure/static": [("run",)],
    "cpp_library/rotor": [("run",)],
    "crank_train/model": [("run",)],
    "double_pendulum/model": [("run", "simulation.duration=2s")],
    "engine/flexible": [("run", "simulation={crank: main, duration: 10 deg, step: 0.5 deg, spectral_radius: 0.8}")],
    "engine/hot": [("run", "simulation={crank: main, duration: 30 deg, step: 0.5 deg, spectral_radius: 0.8}")],
    "engine/hot_isothermal": [("run", "simulation={crank: main, duration: 30 deg, step: 0.5 deg, spectral_radius: 0.8}")],
    "engine/inline_four": [("run", "simulation={crank: main, duration: 20 deg, step: 0.5 deg, spectral_radius: 0.8}")],
    "engine/model": [("run", "simulation={crank: main, duration: 60 deg, step: 0.5 deg, spectral_radius: 0.8}")],
    "engine_oil/model": [("run", "simulation={crank: main, duration: 20 deg, step: 0.5 deg, spectral_radius: 0.8}")],
    "flexible_big_end/model": [("run", "load=1000N", "simulation.duration=0.25rev")],
    "flexible_rotor/campbell": [("run", "speed=4000rpm")],
    "flexible_rotor/films": [("run", "simulation.duration=20ms")],
    "flexible_rotor/model": [("run", "simulation.duration=0.3s")],
    "flexible_rotor/modes": [("run",)],
    "flexible_slider_crank/model": [("run",)],
    "floating_ring/entry": [("bearing",), ("run",)],
    "floating_ring/model": [("run",)],
    "four_bar/model": [("run",)],
    "geared_rotors/model": [("run", "simulation.duration=10ms")],
    "gyroscope/model": [("run", "simulation.duration=1s")],
    "hot_bearing/global": [("bearing",)],
    "hot_bearing/isothermal": [("bearing",)],
    "hot_bearing/model": [("bearing",)],
    "hot_pedestal/model": [("bearing",), ("run",)],
    "hot_pedestal/with_shaft": [("bearing",), ("run",)],
    # At rest the journal's attitude is round-off.
    "hydrostatic/jacking": [("bearing", "bearings.main.operating_point.journal_speed=10rpm")],
    "hydrostatic/model": [("bearing",)],
    "hydrostatic/spindle": [("run", "simulation.tolerance=1e-10")],
    "lemon_bore/model": [("bearing",)],
    "lobed_bores/model": [("bearing",)],
    "lobed_bores/partial_arc": [("bearing",)],
    # Reactions along free coordinates are what the iteration leaves: less than what counts as zero.
    "oil_circuit/model": [("run", "simulation.duration=4ms", "simulation.tolerance=1e-10")],
    "oil_circuit/passing_hole": [("run", "simulation.duration=10ms", "simulation.tolerance=1e-10")],
    "oil_circuit/twin_grooves": [("run",)],
    "oil_circuit/warm": [("run",)],
    "oil_whirl/flexible": [("run", "simulation.duration=20ms")],
    "oil_whirl/model": [("run", "simulation.duration=0.1s")],
    "oil_whirl/steady": [("run", "speed=9000rpm")],
    "oil_whirl/tables": [("run", "speed=9000rpm")],
    "oil_whirl/whirl": [("run", "simulation.cycle.multipliers=0")],
    "oil_whirl/unbalance": [("run", "speed=9000rpm", "simulation.cycle.multipliers=0")],
    "paper_big_end/model": [("run", "load=1000N", "clearance=0.034mm", "simulation.duration=2rev")],
    "piston/elastic_pin": [("run", "simulation.duration=10deg")],
    "piston/floating_pin": [("run", "simulation.duration=10deg")],
    "piston/model": [("run", "simulation.duration=90deg")],
    "piston/rings": [("run", "simulation.duration=90deg", "simulation.cycle.period=90deg")],
    "piston/skirt": [("bearing",)],
    "piston/starved": [("bearing",)],
    "piston/valve_guide": [("run",)],
    "plane_slider/carriage": [("run",)],
    "plane_slider/model": [("bearing",)],
    "rotor_run_up/model": [("run", "last_speed=1600", "duration=40ms", "blade_lost=20ms")],
    "slider_crank/flexible_rod": [("run", "simulation.duration=40deg")],
    "slider_crank/model": [("run",)],
    "slider_crank/pin_hole": [("run", "simulation.duration=90deg")],
    "tilting_pads/bearing": [("bearing",), ("run",)],
    "tilting_pads/hot": [("bearing",)],
    "thrust_pads/fixed": [("bearing",)],
    "thrust_pads/hot": [("bearing",)],
    "thrust_pads/model": [("run",)],
    "thrust_pads/shaft": [("run",)],
    "thrust_pads/tilting": [("bearing",), ("run",)],
    "tilting_pads/model": [("run",)],
    "start_stop/dry": [("run", "simulation.duration=0.2s")],
    "start_stop/model": [("run", "simulation.duration=0.3s", "simulation.tolerance=1e-10")],
    "wear/model": [("run", "simulation.duration=20ms")],
    "wear/scatter": [("run", "doublings=0", "run_in_roughness=0.3um", "simulation.duration=20ms")],
    "spinning_rod/model": [("run", "simulation.duration=10s")],
    "squeeze_film_damper/model": [("bearing",)],
    "squeeze_film_damper/rotor": [("run", "simulation.duration=20ms")],
    "squeezer/model": [("run", "simulation.duration=15ms")],
    "turbocharger/model": [("run", "first_speed=30000", "simulation.duration=20ms")],
}
# Examples that are not run, each with its reason.
LEFT_OUT = {}

# Two figures are equal within a millionth. Sums in another order have moved figures by up to 1e-11 between two programs of equal
# formulation; iterations that start elsewhere and end at residuals of 1e-8 of their scale could by 1e-7. What a formulation
# changes within its stated error (1e-4 and more) is noticed.
RELATIVE = 1e-6
# Below these a figure is zero: what symmetry makes vanish is left with round-off, 1e-10 or less of the terms that cancel.
# A figure of an example that means something is ten times as large, and most are a million times.
ZERO = {"m": 1e-12, "rad": 1e-9, "1": 1e-9, "": 1e-9, "N": 1e-5, "N.m": 1e-8, "Pa": 1.0, "W": 1e-6, "J": 1e-10, "m^3/s": 1e-14, "m^3": 1e-16,
        "degC": 1e-6, "Hz": 1e-6, "N/m": 10.0, "N.s/m": 0.1, "N.m.s": 1e-9, "kg": 1e-6, "rad/s": 1e-6, "m/s": 1e-9}

NOT_OF_A_BEARING = re.compile("|".join([
    r".*_error(_share)?",                                # balances: round-off, or the error of the grid
    r"(h_min|p_max|T_max|T_shell_max)_(angle|y|z)",   # places: they leap between nodes of nearly equal values
    r"(rupture|reformation)_(angle|y)",
    r"load_angle|speed|journal_speed|shell_speed",    # given by the model
    r"[KC]_[xy][xy]|sommerfeld_.*|hersey|load_number|film_ratio|stability_number|threshold_speed",  # the same in other scales
    r"flow_(left|right)|power_put_in|friction_(shell|runner)|torque_shell|force_pad|h_min_centre",  # a part, or the sum, of others
    r".*_other_shear",                                # of a model that the example has not chosen
]))


def commands(example):
    """Commands of an example, each a tuple: `run` or `bearing`, then what `--set` sets."""
    return COMMANDS.get(example, [])


def complaints(examples):
    """What is wrong with the lists above, given the examples there are: none may be forgotten, and none that is gone may stay."""
    listed = COMMANDS.keys() | LEFT_OUT.keys()
    return [f"{name}: an example without key figures; give it a command in COMMANDS, or a reason in LEFT_OUT, of bench/key_figure_rules.py"
            for name in sorted(set(examples) - listed)] + \
        [f"{name}: no such example; take it out of bench/key_figure_rules.py" for name in sorted(listed - set(examples))]


def is_zero(value, unit):
    return not isinstance(value, str) and abs(value) < ZERO.get(unit, 0.0)


def of_bearing(answer):
    """[(quantity, value, unit)] of what `hersey bearing --json` says; the value is a text where the answer is one ("no threshold")."""
    figures = []
    for number, solution in enumerate(answer["solutions"]):
        prefix = f"{number + 1}: " if len(answer["solutions"]) > 1 else ""
        for name, figure in solution["figures"].items():
            value = figure.get("words", "none") if figure["value"] is None else figure["value"]
            if not NOT_OF_A_BEARING.fullmatch(name):
                figures.append((prefix + name, value, figure["unit"]))
    return figures


def length(values):
    return (values**2).sum(axis=1)**0.5 if values.ndim > 1 else abs(values)


def mean(values, time):
    """Mean over time by the trapezoidal rule; steps may differ in length."""
    if len(time) < 2:
        return values[-1]
    return ((values[1:] + values[:-1]) / 2 * (time[1:] - time[:-1])).sum() / (time[-1] - time[0])


# The key figures of a run: a series of the results file and what is made of it. `length` is the largest length of a vector.
OF_A_RUN = [
    ("bearings/*/h_min", "min"), ("bearings/*/p_max", "max"), ("bearings/*/force", "length"),
    ("bearings/*/eccentricity_ratio", "end"), ("bearings/*/attitude", "end"), ("bearings/*/film_thickness_middle", "end"),
    ("bearings/*/film_thickness_axis", "end"), ("bearings/*/torque_runner", "mean"), ("bearings/*/flow_inner", "mean"),
    ("bearings/*/flow_outer", "mean"),
    ("bearings/*/power_film", "mean"), ("bearings/*/power_asperity", "mean"), ("bearings/*/torque_journal", "mean"),
    ("bearings/*/flow_left", "mean"), ("bearings/*/flow_right", "mean"), ("bearings/*/flow_leading", "mean"),
    ("bearings/*/flow_trailing", "mean"), ("bearings/*/flow_supply", "mean"),
    ("bearings/*/T_max", "max"), ("bearings/*/T_shell_max", "max"), ("bearings/*/T_journal", "end"),
    ("bearings/*/heat_to_oil", "mean"), ("bearings/*/heat_to_shell", "mean"), ("bearings/*/heat_to_journal", "mean"),
    ("bearings/*/clearance_of_bodies", "end"), ("bearings/*/T_body_max", "end"), ("bearings/*/T_journal_body_max", "end"),
    ("circuit/pressure_*", "mean"), ("circuit/flow_*", "mean"),
    ("joints/*/reaction_force", "length"), ("contacts/*/normal_force", "max"), ("drives/*/force_or_torque", "length"),
    ("surface_loads/*/force", "length"), ("bodies/*/strain_energy", "max"), ("bodies/*/held_frequencies", "first"),
    ("energy/kinetic", "end"), ("energy/springs", "end"), ("energy/since_start/put_in", "end"),
    ("energy/since_start/film_dissipation", "end"), ("energy/since_start/boundary_friction", "end"),
    ("energy/since_start/dampers", "end"), ("energy/since_start/contacts", "end"),
    ("modes/fields/frequency", "first"), ("modes/fields/damping_ratio", "first"),
]
# Positions tell of the motion where neither bearings nor modes do. Frames of elastic bodies (`rod.tip`) are bodies of the results file.
OF_A_MECHANISM = [("bodies/*/position", "end")]
MODES = 8  # the lowest ones: what a mesh, not an engineer, decides comes after


def reduced(values, time, how):
    """[(suffix, value)] of a series."""
    if how == "first":
        return [(f".{k + 1}", value) for k, value in enumerate(values[:MODES])]
    if how == "end" and values.ndim > 1:
        return [(f".{axis}.end", value) for axis, value in zip("xyz", values[-1])]
    value = {"min": lambda: values.min(), "max": lambda: values.max(), "length": lambda: length(values).max(),
             "end": lambda: values[-1], "mean": lambda: mean(values, time)}[how]()
    return [(".max" if how == "length" else f".{how}", value)]


def is_free(file, name):
    """Whether a series is the reaction of a joint that holds nothing: what is left of the iteration."""
    joint = name.rpartition("/")[0]
    return name.startswith("joints/") and f"{joint}/coordinates" in file and file[f"{joint}/coordinates"].shape[1:] == (6,)


def of_run(path, prefix=""):
    """[(quantity, value, unit)] of a results file; a quantity is the path of its series and `.min`, `.max`, `.mean` or `.end`."""
    import h5py  # only who reads results needs it
    figures = []
    with h5py.File(path) as file:
        time = file["time"][()]
        for pattern, how in OF_A_RUN + ([] if "bearings" in file or "modes" in file else OF_A_MECHANISM):
            head, star, tail = pattern.partition("/*/")
            names = [f"{head}/{name}/{tail}" for name in file.get(head, {})] if star else [pattern]
            if pattern.endswith("*"):  # a family of one group
                group, stem = pattern[:-1].rsplit("/", 1)
                names = [f"{group}/{name}" for name in file.get(group, {}) if name.startswith(stem)]
            for name in names:
                if name in file and not is_free(file, name):
                    unit = str(file[name].attrs["units"])
                    figures += [(f"{prefix}{name}{suffix}", float(value), unit) for suffix, value in reduced(file[name][()], time, how)]
    return figures
