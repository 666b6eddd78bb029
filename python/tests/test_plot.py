"""Pictures show the numbers of the results."""

import numpy as np
import pytest

import hersey

pytest.importorskip("matplotlib")
from hersey import plot  # noqa: E402


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    from conftest import MACHINE

    return hersey.Model.from_dict(MACHINE).run(tmp_path_factory.mktemp("plots"))


def test_orbit_stays_in_its_circle(results):
    path, circle = plot.orbit(results).lines
    assert np.hypot(*path.get_xydata().T).max() < np.hypot(*circle.get_xydata().T).min()
    assert np.hypot(*circle.get_xydata()[0]) == pytest.approx(34, rel=1e-9)  # the clearance [um], round-off


def test_film_map_shows_the_field_of_a_run_and_of_a_bearing(results, alone):
    mesh = plot.film_map(results, time=4e-3).collections[0]
    expected = results.film()["pressure"].sel(time=4e-3, method="nearest").max() / 1e6
    assert mesh.get_array().max() == pytest.approx(float(expected))
    solution = alone.bearing(grid_error=False)
    mesh = plot.film_map(solution, field="thickness").collections[0]
    assert mesh.get_array().min() == pytest.approx(1e6 * float(solution.fields["thickness"].min()))


def test_moft_is_the_series(results):
    ax = plot.moft(results)
    assert ax.lines[0].get_ydata().min() == pytest.approx(1e6 * float(results.bearing()["h_min"].min()))
    assert ax.get_xlabel() == "time [ms]"


def test_waterfall_finds_a_sine():
    import xarray

    time = np.arange(0, 2, 1e-3)
    series = xarray.DataArray(3 * np.sin(2 * np.pi * 50 * time), {"time": time}, ["time"])
    times, frequencies, amplitudes = plot.spectrogram(series, windows=19)
    # A Hann window's peak is flat to pi^2/12 of the square of half a line's distance: 0.85 at worst.
    assert np.all(np.abs(frequencies[amplitudes.argmax(axis=1)] - 50) <= frequencies[1])
    assert 0.84 * 3 < amplitudes.max() < 1.001 * 3
    assert len(plot.waterfall(series, windows=19, highest=100).lines) == len(times)


def test_campbell_shows_every_frequency_above_zero(tmp_path, machine):
    machine["simulation"] = {"analysis": "modes", "modes_about": "start"}
    machine.pop("output")
    machine["forces"] = {"spring": {"type": "sliding_spring", "joint": "free", "coordinate": "translation",
                                    "stiffness": "2e4 N/m", "damping": "1 N.s/m"}}
    machine["joints"] = {"free": {"type": "prismatic", "between": ["ground", "shaft"], "axis": "x"}}
    for empty in ("bearings", "drives", "lubricants", "parameters"):
        machine.pop(empty)
    runs = {speed: hersey.Model.from_dict(machine).run(tmp_path / str(speed)) for speed in (1000, 2000)}
    ax = plot.campbell(runs, orders=(1, 2))
    damped = np.sqrt(2e4 / 2 - (1 / 4) ** 2) / (2 * np.pi)
    assert ax.lines[0].get_ydata() == pytest.approx([damped, damped], rel=1e-6)  # of the eigenvalue's differences
    assert ax.lines[-1].get_ydata() == pytest.approx([2 * 1000 / 60, 2 * 2000 / 60])
