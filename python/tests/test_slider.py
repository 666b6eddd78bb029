"""Plane sliders from Python: by themselves, in sweeps, studies and machines, as journal bearings are."""

import copy
import json
import pickle
import subprocess

import h5py
import numpy as np
import pytest

import hersey
from hersey import _core

PAD = dict(kind="plane_slider", length="50 mm", width="40 mm", viscosity="20 mPa.s", speed="3 m/s",
           grid={"along": 21, "across": 9}, shape=[{"profile": "ramp", "rise": "20 um"}])

CARRIAGE = {
    "title": "A carriage on a way",
    "gravity": "-9.81 0 0 m/s^2",
    "lubricants": {"oil": {"viscosity": "20 mPa.s"}},
    "bodies": {name: {"mass": mass, "inertia": {key: "1 kg.m^2" for key in ("xx", "yy", "zz")}}
               for name, mass in (("way", "20 kg"), ("carriage", "100 kg"))},
    "joints": {"travel": {"type": "prismatic", "between": ["ground", "way"], "axis": "y"},
               "lift": {"type": "prismatic", "between": ["ground", "carriage"], "axis": "x",
                        "initial": {"translation": "30 um"}}},
    "drives": {"feed": {"joint": "travel", "coordinate": "translation", "speed": "3 m/s"}},
    "bearings": {"pad": {key: value for key, value in PAD.items() if key not in ("viscosity", "speed")}
                 | {"pad": "carriage", "runner": "way", "lubricant": "oil"}},
    "simulation": {"duration": "5 ms", "step": "0.5 ms"},
    "output": {"fields_every": "1 ms"},
}


@pytest.fixture
def pad():
    return hersey.bearing_model(load="1 kN", **PAD)


@pytest.fixture
def pad_file(pad, tmp_path):
    file = tmp_path / "pad.yaml"
    file.write_text(json.dumps(pad.to_dict()), encoding="utf-8")  # JSON is YAML
    return file


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    return hersey.Model.from_dict(CARRIAGE).run(tmp_path_factory.mktemp("carriage"))


def solutions_of(program, *arguments):
    run = subprocess.run([program, "bearing", *arguments, "--json"], capture_output=True, text=True, check=True)
    return json.loads(run.stdout)["solutions"]


def test_keyword_form_is_the_model_written_down_and_the_program_s(pad, program, pad_file):
    film = hersey.bearing(load="1 kN", **PAD)
    assert film == pad.bearing() and film.kind == "plane_slider" and pad.title == "Plane slider"
    figures = solutions_of(program, pad_file)[0]["figures"]
    assert set(figures) == set(film)
    for key, figure in figures.items():
        assert film[key].unit == (figure["unit"] or "1"), key
        assert film[key] == figure["value"] if figure["value"] is not None else np.isnan(film[key]), key


def test_load_takes_the_place_of_a_film_thickness_and_back(pad):
    by_load = pad.bearing(load="2 kN", grid_error=False)
    at = pad.bearing(film_thickness=by_load["h_min"], grid_error=False)
    assert at["load"] == pytest.approx(2000, rel=1e-6)  # the solver leaves 1e-8 of the load
    by_thickness = hersey.bearing_model(film_thickness="20 um", **PAD)
    again = by_thickness.bearing(load=by_thickness.bearing(grid_error=False)["load"], grid_error=False)
    assert again["h_min"] == pytest.approx(20e-6, rel=1e-6)
    with pytest.raises(hersey.InputError, match="exactly one of them; with model.set, give the other one as None"):
        pad.bearing(load="2 kN", film_thickness="20 um")


def test_stiffness_is_the_force_s_slope():
    model = hersey.bearing_model(film_thickness="20 um", **PAD)
    solution = model.bearing(grid_error=False)
    step = 1e-4  # of the thickness

    def force(**change):
        found = model.bearing(grid_error=False, **change)
        return np.array([found["load"], found["load"] * found["centre_y"]]), found.position[0]

    assert solution.position == pytest.approx([-20e-6], rel=1e-9) and solution.stiffness.shape == (3, 3)  # round-off
    (less, at), (more, further) = force(film_thickness=20e-6 * (1 + step)), force(film_thickness=20e-6 * (1 - step))
    by_position = (more - less) / (further - at)
    # Central difference: truncation of the order step^2 of the curvature, some ten slopes per thickness.
    assert by_position == pytest.approx(solution.stiffness[:2, 0], rel=100 * step)
    slope = step * 20e-6 / 25e-3  # moves the ends of the pad by as much
    (less, at), (more, further) = force(tilt_along=-slope), force(tilt_along=slope)
    by_slope = (more - less - (further - at) * by_position) / (2 * slope)  # the position follows a given thickness
    assert by_slope == pytest.approx(solution.stiffness[:2, 1], rel=100 * step)


def test_a_slider_has_a_position_and_no_eccentricity(pad, alone):
    film = pad.bearing(grid_error=False)
    assert film.position.shape == (1,) and -film.position[0] == pytest.approx(film["film_thickness_middle"], rel=1e-12)
    with pytest.raises(AttributeError, match="a plane slider has no eccentricity: expected position"):
        film.eccentricity
    assert not hasattr(film, "eccentricity") and "eccentricity_ratio" not in film
    journal = alone.bearing(grid_error=False)
    assert journal.kind == "journal" and np.array_equal(journal.position, journal.eccentricity) and journal.position.shape == (2,)


def test_fields_lie_over_y_and_z(pad):
    solution = pad.bearing(grid_error=False)
    fields = solution.fields
    assert fields["pressure"].dims == ("y", "z") and fields["y"].attrs["units"] == fields["z"].attrs["units"] == "m"
    assert fields["y"].values[[0, -1]] == pytest.approx([-25e-3, 25e-3]) and float(fields["z"].max()) == pytest.approx(20e-3)
    ramp = float(solution["h_min"]) + 20e-6 * (0.5 - fields["y"] / 50e-3)
    assert float(abs(fields["thickness"] - ramp).max()) < 1e-15  # round-off of 40 um


def test_solutions_pickle_and_copy_with_all_they_have(pad):
    film = pad.bearing(sensitivity_to="load")
    for again in (pickle.loads(pickle.dumps(film)), copy.copy(film), copy.deepcopy(film)):
        assert again == film and again.kind == film.kind and again.sensitivities == film.sensitivities
        assert np.array_equal(again.stiffness, film.stiffness) and np.array_equal(again.position, film.position)
        assert again.fields.identical(film.fields) and again.to_pandas().equals(film.to_pandas())
        assert not hasattr(again, "eccentricity")
    assert pickle.loads(pickle.dumps(pad)) == pad == hersey.Model.from_dict(pad.to_dict())


def test_sweep_is_the_program_s(pad, program, pad_file):
    found = pad.sweep(load=["500 N", "1000 N"], viscosity=["10 mPa.s", "20 mPa.s"], grid_error=False)
    expected = solutions_of(program, pad_file, "--no-grid-error", "--sweep", "load=500 N,1000 N", "--sweep",
                            "viscosity=10 mPa.s,20 mPa.s")
    assert found["h_min"].dims == ("load", "viscosity")
    assert found["h_min"].values.ravel().tolist() == [each["figures"]["h_min"]["value"] for each in expected]
    over = pad.sweep(film_thickness=([10, 20], "um"), grid_error=False)  # takes the place of the load
    assert over["film_thickness"].attrs["units"] == "um" and float(over["load"][0]) > float(over["load"][1])


def test_sweeps_without_points_have_the_figures_of_the_kind(pad, alone):
    empty = pad.sweep(load=[], speed=["1 m/s"])
    assert empty["h_min"].shape == (0, 1) and "h_min_y" in empty and "eccentricity_ratio" not in empty
    assert "eccentricity_ratio" in alone.sweep(load=[]) and "h_min_y" not in alone.sweep(load=[])


def test_gradient_is_the_slope_of_solutions(pad, program, pad_file):
    film = pad.bearing(sensitivity=True, grid_error=False)
    reported = solutions_of(program, pad_file, "--no-grid-error", "--sensitivity")[0]["sensitivities"]
    assert {each["parameter"]: each["derivatives"] for each in reported} == {
        key: each.derivatives for key, each in film.sensitivities.items()}
    for name, path, value in (("load", "operating_point.load", 1000.0), ("length", "length", 0.05)):
        low, high = (pad.bearing(**{name: factor * value}, grid_error=False)["h_min"] for factor in (0.999, 1.001))
        # Central difference over 0.2 %: 1e-5 of the slope.
        assert film.gradient("h_min")[f"bearings.main.{path}"] == pytest.approx((high - low) / (0.002 * value), rel=1e-4)


def test_names_are_those_of_the_kind(pad, alone):
    for wrong, right in (("lod", "load"), ("film_thicknes", "film_thickness"), ("sped", "speed"), ("viscosty", "viscosity"),
                         ("tilt_alon", "tilt_along")):
        for call in (pad.bearing, lambda **keys: pad.sweep(**{key: [value] for key, value in keys.items()}),
                     lambda **keys: hersey.bearing(**PAD | {"load": "1 kN"} | keys)):
            with pytest.raises(hersey.InputError, match=f"unknown key '{wrong}'; did you mean '{right}'"):
                call(**{wrong: "1 mm"})
    for foreign in ("journal_speed", "eccentricity_ratio", "clearance"):
        with pytest.raises(hersey.InputError, match=f"unknown key '{foreign}'; expected"):
            pad.bearing(**{foreign: 1})
    with pytest.raises(hersey.InputError, match="unknown key 'film_thickness'; expected"):
        alone.bearing(film_thickness="20 um")
    with pytest.raises(hersey.InputError, match="'plane_slidr'; did you mean 'plane_slider'"):
        hersey.bearing(**PAD | {"kind": "plane_slidr", "load": "1 kN"})


def kinds_of_the_schema():
    """Keys of the operating point by kind, as the schema has them."""
    kinds = {}

    def visit(node):
        if isinstance(node, list):
            for item in node:
                visit(item)
        elif isinstance(node, dict):
            keys = node.get("properties", {})
            if "operating_point" in keys and "const" in keys.get("kind", {}):
                kinds[keys["kind"]["const"]] = set(keys["operating_point"]["properties"]) - {"use"}  # a part of the file
            for item in node.values():
                visit(item)

    visit(json.loads(_core.schema_json()))
    return kinds


def test_every_kind_tells_its_names():
    kinds = kinds_of_the_schema()
    assert {"journal", "plane_slider"} <= set(kinds)
    for kind, keys in kinds.items():
        names = _core.names_of_kind(kind, "main", "oil")
        assert names.kind == kind and names.title and set(names.point_keys) == keys
        assert {f"bearings.main.operating_point.{key}" for key in names.load_or_position if key} <= set(names.paths.values())
    assert _core.names_of_kind("", "main", "oil").kind == "journal" and _core.names_of_kind("none", "main", "oil") is None


def test_results_have_y_in_place_of_the_angle(results):
    film = results.film()
    assert film["pressure"].dims == ("time", "y", "z") and film["y"].attrs["units"] == "m"
    assert float(film["y"].max()) == pytest.approx(25e-3)
    series = results.bearing()
    assert series["film_thickness_middle"].dims == ("time",) and "eccentricity" not in series
    thickness = film["thickness"].isel(time=-1)
    assert float(thickness.sel(y=0, z=0, method="nearest")) == pytest.approx(float(series["film_thickness_middle"][-1]) + 10e-6)


def test_a_run_has_the_bits_of_the_program(results, program, tmp_path):
    file = tmp_path / "model.yaml"
    file.write_text(json.dumps({"hersey": 1, **CARRIAGE}), encoding="utf-8")
    subprocess.run([program, "run", file, "--output", tmp_path / "out"], capture_output=True, check=True)
    with h5py.File(tmp_path / "out" / "results.h5") as written:
        for data, group in ((results.bearing(), "bearings/pad"), (results.film(), "bearings/pad/fields")):
            for name in data.data_vars:
                assert np.array_equal(data[name].values, written[group][name][()], equal_nan=True), name


def test_a_machine_is_stepped_with_the_outputs_of_the_kind():
    sim = hersey.Simulation(hersey.Model.from_dict(CARRIAGE))
    assert sim.step() and 0 < sim["bearings.pad.film_thickness_middle"] < 30e-6
    assert sim["bearings.pad.sliding_speed"] == pytest.approx(3, rel=1e-12)


def test_a_study_is_the_sweep(pad, tmp_path):
    content = {**pad.to_dict(), "study": {"parameters": {"bearings.main.operating_point.load": ["500 N", "1 kN"]},
                                          "outputs": ["bearings.main.h_min"]}}
    file = tmp_path / "study.yaml"
    file.write_text(json.dumps(content), encoding="utf-8")
    found = hersey.study(file, tmp_path / "study")
    (column,) = (name for name in found.table if name.startswith("bearings.main.h_min"))
    expected = pad.sweep(load=[500, 1000], grid_error=False)["h_min"].values
    assert sorted(1e-6 * found.table[column]) == pytest.approx(sorted(expected), rel=1e-9)  # [um], digits of the table
    content["study"]["outputs"] = ["bearings.main.eccentricity_ratio"]
    file.write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(hersey.InputError, match="unknown figure 'bearings.main.eccentricity_ratio'"):
        hersey.study(file, tmp_path / "none")


def test_pictures(results, pad):
    pytest.importorskip("matplotlib")
    from hersey import plot

    ax = plot.film_map(results)
    assert ax.get_xlabel() == "y [mm]"
    expected = results.film()["pressure"].isel(time=-1).max() / 1e6
    assert ax.collections[0].get_array().max() == pytest.approx(float(expected))
    solution = pad.bearing(grid_error=False)
    mesh = plot.film_map(solution, field="thickness").collections[0]
    assert mesh.get_array().min() == pytest.approx(1e6 * float(solution["h_min"]))
    assert plot.moft(results).lines[0].get_ydata().min() == pytest.approx(1e6 * float(results.bearing()["h_min"].min()))
    with pytest.raises(hersey.InputError, match="bearing 'pad' has no orbit, as its moving surface has no axis: expected a journal"):
        plot.orbit(results)
