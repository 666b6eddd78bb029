"""Orders of a run-up are those that are known."""

import numpy as np
import pytest

import hersey

TURN = 2 * np.pi


@pytest.fixture
def run_up():
    """Time, angle of a shaft that runs up from 5 to 45 Hz, and a series with two orders and a mean."""
    time = np.linspace(0, 4, 8001)
    angle = TURN * (5 * time + 5 * time**2)
    return time, angle, 4e-6 + 2e-6 * np.cos(angle - 1.1) + 0.5e-6 * np.cos(2 * angle + 0.3)


def test_known_orders_are_exact(run_up):
    time, angle, values = run_up
    found = hersey.order_tracking(values, angle, time)
    assert found["amplitude"].dims == ("time", "order") and found.sizes["time"] == 200
    exact = pytest.approx(np.full(200, 2e-6), rel=1e-9)  # round-off of sums of a thousand rows
    assert found["amplitude"].sel(order=1).values == exact
    assert found["lag"].sel(order=1).values == pytest.approx(np.full(200, 1.1), rel=1e-9)
    assert found["lag"].sel(order=2).values == pytest.approx(np.full(200, -0.3), rel=1e-8)
    assert found["amplitude"].sel(order=0.5).values.max() < 1e-15
    assert found["mean"].values == pytest.approx(np.full(200, 4e-6), rel=1e-9)
    # The revolution around an instant begins a little more before it than it ends after: (rise/speed^2)^2/8 of the speed.
    assert found["speed"].values == pytest.approx(TURN * (5 + 10 * found["time"].values), rel=5e-3)


def test_a_series_with_its_times_and_unit_needs_no_others(run_up):
    import xarray

    time, angle, values = run_up
    series = xarray.DataArray(values, {"time": time}, ["time"], attrs={"units": "m"})
    found = hersey.order_tracking(series, angle, orders=(1,), revolutions=4, windows=10)
    assert found.sizes == {"time": 10, "order": 1}
    assert found["peak_to_peak"].attrs["units"] == "m"
    assert found.equals(hersey.order_tracking(values, angle, time, orders=(1,), revolutions=4, windows=10))


def test_what_is_wrong_is_named(run_up):
    time, angle, values = run_up
    with pytest.raises(hersey.InputError, match="without times"):
        hersey.order_tracking(values, angle)
    with pytest.raises(hersey.InputError, match="shape"):
        hersey.order_tracking(values, angle[1:], time)
    with pytest.raises(hersey.InputError, match="orders"):
        hersey.order_tracking(values, angle, time, orders=(1, 1))
    with pytest.raises(hersey.InputError, match="windows"):
        hersey.order_tracking(values, angle, time, windows=0)
