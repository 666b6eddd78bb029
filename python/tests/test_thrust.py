"""Thrust bearings from Python: by themselves and in machines, as other bearings are."""
import os

import numpy as np
import pytest

import hersey

THRUST = dict(kind="thrust", inner_diameter="100 mm", outer_diameter="200 mm", pads={"count": 3, "arc": "50 deg"},
              shape=[{"profile": "ramp", "rise": "20 um"}], viscosity="20 mPa.s", speed="300 rad/s",
              grid={"along": 13, "radial": 9})


def test_a_thrust_bearing_has_position_coefficients_and_fields_over_angle_and_radius():
    film = hersey.bearing(**THRUST, load="5 kN")
    assert film.kind == "thrust" and film.position.shape == (1,) and film.stiffness.shape == (3, 3)
    assert film["film_thickness_axis"] == pytest.approx(film.position[0])
    assert film["load"] == pytest.approx(5000)
    assert film["stiffness"] == pytest.approx(film.stiffness[0, 0])
    pytest.importorskip("xarray")
    fields = film.fields
    assert fields["pressure"].dims == ("phi", "r")
    assert fields["r"].values[[0, -1]] == pytest.approx([0.05, 0.1])
    assert fields["pressure"].max() <= film["p_max"] * (1 + 1e-6)  # single values of the fields have no more digits
    sum_of_pads = sum(film[f"pad_load_{k}"] for k in "123")
    assert sum_of_pads == pytest.approx(film["load"])


def test_the_shaft_of_the_example_floats_where_its_pads_carry_it(tmp_path):
    examples = os.path.join(os.path.dirname(__file__), "../../examples")
    model = hersey.Model.load(os.path.join(examples, "thrust_pads/model.yaml"))
    results = model.run(tmp_path / "pads")
    force = np.array([results[f"bearings/pad_{k}"]["force"].values[-1] for k in range(1, 7)])
    assert force[:, 2].sum() == pytest.approx(-40e3, rel=1e-5)  # balance of the steady motion
