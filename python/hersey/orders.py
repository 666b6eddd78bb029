"""Orders of a series over a run whose speed changes: amplitude and phase of what goes with a shaft's revolutions."""

from __future__ import annotations

from typing import Any, Optional, Sequence

import numpy as np

from . import _core
from .errors import InputError


def order_tracking(series: Any, angle: Any, time: Any = None, orders: Sequence[float] = (0.5, 1, 2), revolutions: int = 8,
                   windows: int = 200):
    """Amplitude and phase of orders of a shaft, as an `xarray.Dataset` over `time` [s], the middles of windows, and `order`.

    `series` and the shaft's `angle` [rad] are `xarray.DataArray` over time, as `results.bearing()["eccentricity"][:, 0]`
    and `results["joints/turning"]["coordinates"][:, 2]` of a planar joint, or arrays with `time` [s] beside them. Windows are
    of whole `revolutions`, at most `windows` of them evenly over the time; in each, mean, linear drift and orders are
    fitted by least squares, as in the report (docs/theory/rotors.md).

    Of each window: `speed` [rad/s], `angle` [rad], `mean` and `peak_to_peak` of the series; of each order `amplitude` and
    `lag`, the angle [rad] by which it lags behind the shaft's, -pi to pi. Windows with too few rows are left out.

    Raises `InputError` where times are missing, lengths differ, or a number is out of its range.
    """
    import xarray

    values, angles = np.asarray(series, dtype=float), np.asarray(angle, dtype=float)
    times = np.asarray(_time_of(series, time), dtype=float)
    if values.ndim != 1 or angles.shape != values.shape or times.shape != values.shape:
        raise InputError(f"series of shape {values.shape}, angle of shape {angles.shape}, time of shape {times.shape}: expected "
                         "one number of each at every instant")
    if not len(orders) or min(orders) <= 0 or len(set(orders)) < len(orders):
        raise InputError(f"orders {tuple(orders)}: expected numbers > 0, all different, such as (0.5, 1, 2)")
    if revolutions < 1 or windows < 1:
        raise InputError(f"{windows} windows of {revolutions} revolutions: expected one or more of both")
    found = _core.track_orders(times, angles, values, list(map(float, orders)), int(revolutions), int(windows))
    unit = str(getattr(series, "attrs", {}).get("units", ""))
    amplitude = np.asarray(found["amplitude"]).reshape(-1, len(orders))

    def over_time(key: str, units: str, name: str) -> Any:
        return ("time", found[key], {"units": units, "long_name": name})

    return xarray.Dataset(
        {"amplitude": (("time", "order"), np.abs(amplitude), {"units": unit, "long_name": "amplitude of an order"}),
         "lag": (("time", "order"), -np.angle(amplitude), {"units": "rad", "long_name": "by which an order lags behind the shaft"}),
         "mean": over_time("mean", unit, "mean of the series"),
         "peak_to_peak": over_time("peak_to_peak", unit, "largest less smallest of the series")},
        {"time": over_time("time", "s", "middle of the window"), "order": ("order", np.asarray(orders, dtype=float)),
         "speed": over_time("speed", "rad/s", "mean speed of the revolution around it"),
         "angle": over_time("angle", "rad", "angle of the shaft, rising")})


def _time_of(series: Any, time: Optional[Any]) -> Any:
    if time is not None:
        return time
    if "time" in getattr(series, "coords", {}):
        return series["time"].values
    raise InputError("a series without times: expected an xarray.DataArray over time, or time=...")
