"""Functions of the user's own: the same numbers as expressions, their cost reported, their faults reported with name and time."""

import math

import numpy as np
import pytest

import hersey

PATH = "forces.push.components.1"


def moft(model, folder):
    return float(model.run(folder).bearing()["h_min"].min())


@pytest.mark.parametrize("derivative", ["difference", "complex", lambda t: -100 * math.cos(10 * t) * 10])
def test_force_by_python_is_the_force_by_expression(machine, tmp_path, derivative):
    model = hersey.Model.from_dict(machine)
    model[PATH] = {"expression": "-500 - 100*sin(10*t)", "unit": "N"}
    expected = moft(model, tmp_path / "expression")
    model[PATH] = hersey.Function(lambda t: -500 - 100 * np.sin(10 * t), of="t", unit="N", derivative=derivative)
    assert moft(model, tmp_path / "python") == pytest.approx(expected, rel=1e-12)  # round-off of two sines


def test_unit_is_the_function_s(machine, tmp_path):
    machine["forces"]["push"]["components"] = ["0 N", "-500 N", "0 N"]
    expected = moft(hersey.Model.from_dict(machine), tmp_path / "constant")
    model = hersey.Model.from_dict(machine)
    model[PATH] = hersey.Function(lambda t: -0.5, unit="kN")
    assert moft(model, tmp_path / "python") == pytest.approx(expected, rel=1e-12)
    with pytest.raises(hersey.InputError, match="pressure"):
        model[PATH] = hersey.Function(lambda t: -0.5, unit="kPa")


def test_drive_by_python_turns_as_its_derivative_says(machine, tmp_path):
    machine["drives"]["turning"] = {"joint": "free", "coordinate": "rotation",
                                    "position": {"expression": "100*t + 50*t^2", "unit": "rad"}}
    model = hersey.Model.from_dict(machine)
    expected = moft(model, tmp_path / "expression")
    model["drives.turning.position"] = hersey.Function(lambda t: 100 * t + 50 * t ** 2, unit="rad", derivative="complex")
    # The second derivative is a difference: eps^(2/3) of 100 rad/s over steps of 6e-8 s, in an inertia without weight.
    assert moft(model, tmp_path / "python") == pytest.approx(expected, rel=1e-6)


def test_controller_is_a_function_of_coordinates_and_rates(machine, tmp_path):
    model = hersey.Model.from_dict(machine)
    observed = []

    def hold(y, rate):
        observed.append((y, rate))
        return -500 - 1e6 * y - 200 * rate

    model[PATH] = hersey.Function(hold, of=["free.y", "free.y_rate"], unit="N")
    results = model.run(tmp_path)
    assert results.status == "completed" and np.ptp([y for y, _ in observed]) > 1e-6


def test_cost_is_reported(machine, tmp_path):
    calls = []
    model = hersey.Model.from_dict(machine)
    model[PATH] = hersey.Function(lambda t: calls.append(t) or -500.0, unit="N")
    cost = model.run(tmp_path).summary["functions"][PATH]
    assert cost["calls"] == len(calls) > 50 and 0 < cost["seconds"] < 10


@pytest.mark.parametrize("bad, words", [
    (lambda t: 1 / 0, "raised ZeroDivisionError: division by zero"),
    (lambda t: math.nan, "gave nan: expected a finite number"),
    (lambda t: np.zeros(3), "expected one finite number"),
    (lambda t: "much", "gave 'much': expected one finite number"),
])
def test_fault_in_a_function_tells_name_and_time_and_keeps_results(machine, tmp_path, bad, words):
    model = hersey.Model.from_dict(machine)
    model[PATH] = hersey.Function(lambda t: bad(t) if t > 5.1e-3 else -500.0, unit="N")
    with pytest.raises(hersey.UserFunctionError) as caught:
        model.run(tmp_path)
    error = caught.value
    assert error.name == PATH and error.t == pytest.approx(5e-3) and words in str(error)
    assert "t = 0.005 s" in str(error)
    assert float(error.results.bearing()["time"][-1]) == pytest.approx(5e-3)
    if "raised" in words:
        assert isinstance(error.__cause__, ZeroDivisionError)


def test_fault_at_the_start_is_reported_too(machine, tmp_path):
    model = hersey.Model.from_dict(machine)
    model[PATH] = hersey.Function(lambda t: math.nan, unit="N")
    with pytest.raises(hersey.UserFunctionError, match="expected a finite number, at t = 0 s"):
        model.run(tmp_path)


def test_wrong_derivatives_are_reported(machine, tmp_path):
    model = hersey.Model.from_dict(machine)
    model[PATH] = hersey.Function(lambda y: -500.0 - 1e5 * y, of="free.y", unit="N", derivative=lambda y: (1e5, 0))
    with pytest.raises(hersey.UserFunctionError, match="expected 1 numbers"):
        model.run(tmp_path / "a")
    model[PATH] = hersey.Function(lambda y: -500.0 - 1e5 * abs(y), of="free.y", unit="N", derivative="complex")
    with pytest.raises(hersey.UserFunctionError, match="of a complex argument"):
        model.run(tmp_path / "b")


def test_function_without_a_place_is_refused(machine):
    model = hersey.Model.from_dict(machine)
    with pytest.raises(hersey.InputError):
        model["bodies.shaft.mass"] = hersey.Function(lambda t: 1.0, unit="kg")
    with pytest.raises(hersey.InputError, match="did you mean"):
        model[PATH] = hersey.Function(lambda x: 1.0, of="fre.x", unit="N")
    assert model[PATH] == "-500 N" and model.changes == []


def test_viscosity_law_of_python_is_the_oil_s(alone):
    alone["lubricants.oil"] = {"temperature": "60 degC", "viscosity": hersey.viscosity_law(
        lambda T, p: 15e-3 * 0.97 ** (T - 60) * math.exp(1.5e-8 * p), range(40, 110, 10), np.arange(0, 301e6, 50e6))}
    by_table = alone.bearing(grid_error=False)
    alone["lubricants.oil"] = {"viscosity": "15 mPa.s", "pressure_viscosity": "1.5e-8 1/Pa"}
    # ln mu is linear in p in both: the same law but for round-off of 15 digits.
    assert by_table["h_min"] == pytest.approx(float(alone.bearing(grid_error=False)["h_min"]), rel=1e-9)
    with pytest.raises(hersey.UserFunctionError, match="viscosity: the function gave nan"):
        hersey.viscosity_law(lambda T: math.nan, [20, 40])


def test_surface_profile_of_python_is_the_bore(alone, tmp_path):
    alone["bearings.main.shape"] = [hersey.surface_profile(
        lambda angle, z: 5e-6 * math.cos(2 * angle), 15.6e-3, tmp_path / "bore.csv")]
    by_table = alone.bearing(grid_error=False)
    alone["bearings.main.shape"] = [{"profile": "ovality", "amplitude": "5 um", "angle": "0 deg"}]
    # Monotone cubics are of second order at extrema: (2 h)^2 / 8 of cos 2 phi at most, where h = 2 pi / 180.
    assert by_table["h_min"] == pytest.approx(float(alone.bearing(grid_error=False)["h_min"]),
                                              rel=(2 * 2 * math.pi / 180) ** 2 / 8)
