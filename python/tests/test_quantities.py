"""Whatever Python has for a quantity goes in where a text with a unit goes."""

import json
import subprocess

import numpy as np
import pytest
from conftest import EXAMPLES

import hersey
from hersey import fem

SMALL = dict(lubricant={"viscosity": "15 mPa.s"}, grid={"circumferential": 40, "axial": 7},
             supply={"line": "widest_gap", "pressure": "0 bar"}, grid_error=False)
TEXTS = dict(diameter="45 mm", width="15.6 mm", radial_clearance="34 um", speed="3570 rpm", load="2500 N")


def as_pint():
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    return dict(diameter=45 * unit.mm, width=unit.Quantity(15.6, "mm"), radial_clearance=34 * unit.micrometer,
                speed=3570 * unit.rpm, load=2.5 * unit.kN)


FORMS = {
    "numbers": lambda: dict(diameter=0.045, width=0.0156, radial_clearance=34e-6, speed=3570 * 2 * np.pi / 60, load=2500),
    "numpy": lambda: dict(diameter=np.float64(0.045), width=np.array(0.0156), radial_clearance=np.float64(34e-6),
                          speed=np.float64(3570 * 2 * np.pi / 60), load=np.int64(2500)),
    "pairs": lambda: dict(diameter=(45, "mm"), width=(15.6, "mm"), radial_clearance=(np.float64(34), "um"), speed=(3570, "rpm"),
                          load=(2.5, "kN")),
    "pint": as_pint,
}


@pytest.mark.parametrize("form", FORMS)
def test_every_form_is_the_same_bearing(form):
    film = hersey.bearing(**SMALL, **FORMS[form]())
    # Values differ in their last bits, which the solver's tolerance of 1e-8 of the load may carry on.
    assert film["h_min"] == pytest.approx(hersey.bearing(**SMALL, **TEXTS)["h_min"], rel=1e-6)


@pytest.mark.parametrize("form", FORMS)
def test_every_form_is_assigned_and_swept(form, alone):
    given = FORMS[form]()
    alone["bearings.main.radial_clearance"] = given["radial_clearance"]
    alone["load"] = given["load"]  # a parameter
    found = alone.sweep(speed=[given["speed"]], grid_error=False)
    assert found["h_min"].shape == (1,)
    assert float(found["h_min"][0]) == pytest.approx(
        float(alone.bearing(clearance="34 um", load="2500 N", speed="3570 rpm", grid_error=False)["h_min"]), rel=1e-6)


def test_numbers_become_quantities_that_the_program_understands(alone, program, bearing_file):
    alone.set({"bearings.main.radial_clearance": 40e-6, "load": 1000.0})
    assert alone.changes == ["bearings.main.radial_clearance=4e-05 m", "load=1000.0 N"]
    options = [part for change in alone.changes for part in ("--set", change)]
    run = subprocess.run([program, "bearing", bearing_file, "--json", *options], capture_output=True, text=True, check=True)
    assert json.loads(run.stdout)["solutions"][0]["figures"]["h_min"]["value"] == alone.bearing()["h_min"]
    loaded = hersey.Model.load(bearing_file, load=1000.0)
    assert loaded.changes == ["load=1000.0 N"]


def test_arrays_are_swept_in_si(alone):
    by_numbers = alone.sweep(load=np.linspace(500, 1500, 3), clearance=(np.array([30, 40]), "um"), grid_error=False)
    by_texts = alone.sweep(load=["500 N", "1000 N", "1500 N"], clearance=["30 um", "40 um"], grid_error=False)
    assert np.array_equal(by_numbers["h_min"], by_texts["h_min"]) and np.isfinite(by_numbers["h_min"]).all()
    assert by_numbers["load"].attrs["units"] == "N" and by_numbers["clearance"].values.tolist() == [30, 40]


def test_lists_of_a_study_take_what_a_text_with_a_unit_stands_for(alone):
    texts = {**alone.to_dict(), "study": {"parameters": {"load": ["500 N", "700 N"], "bearings.main.width": ["20 mm"]}}}
    texts["bearings"]["main"]["operating_point"]["load"] = "${load}"
    by_texts = [run.bearing(grid_error=False)["h_min"] for run in hersey.Model.from_dict(texts).runs()]
    assert by_texts[0] != by_texts[1]
    for loads in ([500, 700.0], np.array([500, 700]), ([0.5, 0.7], "kN"), [(0.5, "kN"), 700]):
        given = {**texts, "study": {"parameters": {"load": loads, "bearings.main.width": [0.02]}}}
        model = hersey.Model.from_dict(given)
        assert not any(str(value).replace(".", "").isdigit() for value in model.study["load"])
        for study in ({"study": given["study"]}, {"study.parameters": given["study"]["parameters"]}, {"study.parameters.load": loads}):
            assert model.copy().set(study).study == model.study
        # Values differ in their last bits, which the solver's tolerance of 1e-8 of the load may carry on.
        assert [run.bearing(grid_error=False)["h_min"] for run in model.runs()] == pytest.approx(by_texts, rel=1e-6)


def test_a_dictionary_takes_numbers_in_every_place(machine):
    machine["gravity"] = np.array([0, -9.81, 0])
    machine["parameters"]["load"] = 500
    machine["bodies"]["shaft"] = {"mass": 2.0, "inertia": {key: 1e-3 for key in ("xx", "yy", "zz")}}
    machine["drives"]["turning"]["speed"] = 100 * np.pi
    machine["bearings"]["main"].update(diameter=(45, "mm"), width=0.0156, radial_clearance=34e-6)
    machine["simulation"] = {"duration": 1e-3, "step": (0.2, "ms")}
    model = hersey.Model.from_dict(machine)
    assert model["bodies.shaft.mass"] == "2.0 kg" and model["gravity"][1] == "-9.81 m/s^2" and model["load"] == "500 N"
    assert model["bearings.main.grid.axial"] == 7
    assert hersey.Model.from_dict(model.to_dict()) == model


def test_a_number_in_a_file_or_a_text_is_not_si(alone, machine):
    machine["bearings"]["main"]["width"] = "15.6"
    with pytest.raises(hersey.InputError, match="bearings.main.width: a number without unit; expected a length"):
        hersey.Model.from_dict(machine)
    with pytest.raises(hersey.InputError, match="a number without unit"):
        alone["bearings.main.width"] = "15.6"


def test_figures_go_in_with_their_unit(alone):
    film = alone.bearing(grid_error=False)
    again = alone.bearing(load=film["load"], grid_error=False)
    assert again["h_min"] == pytest.approx(float(film["h_min"]), rel=1e-6)
    with pytest.raises(hersey.InputError, match="a length"):
        alone.bearing(load=film["h_min"])


def test_inputs_of_a_simulation(machine):
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    sim = hersey.Simulation(hersey.Model.from_dict(machine))
    name = "forces.push.components.y"
    for given in (-2000, np.float32(-2000), "-2 kN", (-2, "kN"), -2 * unit.kN):
        sim[name] = given
        assert sim.input(name) == -2000
    with pytest.raises(hersey.InputError, match="finite number"):
        sim[name] = float("nan")
    assert sim.advance_to("0.4 ms") and sim.time == pytest.approx(4e-4, rel=1e-12)


def test_elastic_bodies():
    file = EXAMPLES / "meshes" / "conrod.msh"
    bodies = [fem.Body(file, "mm", youngs_modulus=E, poisson_ratio=0.3, density=rho)
              for E, rho in ((210e9, 7850), ("210 GPa", "7850 kg/m^3"), ((210, "GPa"), np.float64(7850)))]
    assert bodies[0].mass == bodies[1].mass == bodies[2].mass
    loads = ({"force": {"small_end": np.array([0, -500.0, 0])}, "gravity": [0, 0, -9.81]},
             {"force": {"small_end": "0 -500 0 N"}, "gravity": "0 0 -9.81 m/s^2"})
    first, second = (bodies[0].static(["big_end"], **load)["displacement"].values for load in loads)
    assert np.array_equal(first, second)
