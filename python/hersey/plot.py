"""Pictures of results on matplotlib: orbit, film map, film thickness over the crank, Campbell diagram, waterfall.

Every function draws on `ax`, or on new axes, and returns them; lengths are shown in micrometres.
"""

from __future__ import annotations

from typing import Any, Mapping, Optional, Sequence

import numpy as np

from .errors import InputError


def _axes(ax: Any, **options: Any) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots(subplot_kw=options or None)[1]


def orbit(results: Any, bearing: Optional[str] = None, ax: Any = None, **style: Any) -> Any:
    """The journal's path in its bearing [um], with the circle that the clearance leaves it.

    Raises `InputError` for a bearing whose moving surface has no axis, such as a plane slider.
    """
    film = results.bearing(bearing)
    if "eccentricity" not in film:
        raise InputError(f"bearing {bearing or results.bearings[0]!r} has no orbit, as its moving surface has no axis: expected "
                         "a journal bearing; moft shows the film thickness of any kind")
    ax = _axes(ax)
    path = 1e6 * film["eccentricity"].values
    ax.plot(path[:, 0], path[:, 1], **style)
    ratio = film["eccentricity_ratio"].values
    size = np.hypot(*path.T)
    if np.any(ratio > 0):  # eccentricity over its ratio is the clearance
        last = np.flatnonzero(ratio > 0)[-1]
        turn = np.linspace(0, 2 * np.pi, 361)
        clearance = size[last] / ratio[last]
        ax.plot(clearance * np.cos(turn), clearance * np.sin(turn), color="0.6", linewidth=1)
    ax.set_aspect("equal")
    ax.set_xlabel("x [um]")
    ax.set_ylabel("y [um]")
    return ax


def film_map(source: Any, bearing: Optional[str] = None, time: Optional[float] = None, field: str = "pressure",
             ax: Any = None, **style: Any) -> Any:
    """A field of a film over bearing angle [deg] and z [mm]; of a plane slider over y along the sliding direction [mm], of a
    thrust bearing over angle and radius.

    `source` is the results of a run, at the stored instant nearest to `time` [s] (the last one where it is left out),
    or a `BearingSolution`.
    """
    ax = _axes(ax)
    if hasattr(source, "film"):
        film = source.film(bearing)
        film = film.isel(time=-1) if time is None else film.sel(time=time, method="nearest")
    else:
        film = source.fields
    (along,) = (name for name in film[field].dims if name not in ("z", "r"))  # phi, or y of a film that is plane
    across = "r" if "r" in film[field].dims else "z"
    data, is_angle = film[field].transpose(across, along), film[along].attrs.get("units") == "rad"
    scale, unit = {"Pa": (1e-6, "MPa"), "m": (1e6, "um")}.get(data.attrs.get("units", ""), (1, data.attrs.get("units", "")))
    places = np.degrees(film[along].values) if is_angle else 1e3 * film[along].values
    mesh = ax.pcolormesh(places, 1e3 * film[across].values, scale * data.values, shading="nearest", **style)
    ax.figure.colorbar(mesh, ax=ax, label=f"{data.attrs.get('long_name', field)} [{unit}]")
    ax.set_xlabel("bearing angle [deg]" if is_angle else f"{along} [mm]")
    ax.set_ylabel(f"{across} [mm]")
    return ax


def moft(results: Any, bearing: Optional[str] = None, ax: Any = None, **style: Any) -> Any:
    """Minimum film thickness [um] over the crank angle [deg] where the machine has a crank, else over time [ms]."""
    ax = _axes(ax)
    film = results.bearing(bearing)
    if "crank_angle" in film.coords:
        ax.plot(np.degrees(film["crank_angle"].values), 1e6 * film["h_min"].values, **style)
        ax.set_xlabel("crank angle [deg]")
    else:
        ax.plot(1e3 * film["time"].values, 1e6 * film["h_min"].values, **style)
        ax.set_xlabel("time [ms]")
    ax.set_ylabel("minimum film thickness [um]")
    ax.set_ylim(bottom=0)
    return ax


def campbell(runs: Mapping[float, Any], orders: Sequence[float] = (1,), ax: Any = None, **style: Any) -> Any:
    """Frequencies of a machine's modes [Hz] over its speed [rpm]; modes that grow are crosses.

    `runs` are results of `simulation.analysis: modes`, by speed [rpm]. A line of every order of the speed is drawn.
    """
    ax = _axes(ax)
    speeds = sorted(runs)
    for is_stable, marker in ((True, "o"), (False, "x")):
        at, frequencies = [], []
        for speed in speeds:
            modes = runs[speed]["modes/fields"]
            chosen = modes["damped_frequency"].values[(modes["damping_ratio"].values >= 0) == is_stable]
            chosen = chosen[chosen > 0]
            at += [speed] * len(chosen)
            frequencies += list(chosen)
        ax.plot(at, frequencies, marker, label="damped" if is_stable else "growing", **style)
    for order in orders:
        ax.plot(speeds, [order * speed / 60 for speed in speeds], color="0.7", linewidth=1, zorder=0)
    ax.set_xlabel("speed [rpm]")
    ax.set_ylabel("frequency [Hz]")
    ax.legend()
    return ax


def spectrogram(series: Any, windows: int = 40) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Amplitudes of an `xarray.DataArray` over time: middles of the windows [s], frequencies [Hz], shape (windows, n).

    Windows overlap by half and are Hann's, scaled so that a sine of amplitude 1 has a peak of 1.
    """
    time, values = series["time"].values, np.asarray(series.values, dtype=float)
    even = np.linspace(time[0], time[-1], len(time))
    values = np.interp(even, time, values)
    length = max(8, 2 * len(values) // (windows + 1))
    if length > len(values):
        raise ValueError(f"{len(values)} instants: expected 8 or more")
    begins = np.arange(0, len(values) - length + 1, max(1, length // 2))
    window = np.hanning(length)
    rows = [np.abs(np.fft.rfft(window * (values[k:k + length] - values[k:k + length].mean()))) * 2 / window.sum()
            for k in begins]
    return even[begins + length // 2], np.fft.rfftfreq(length, even[1] - even[0]), np.array(rows)


def waterfall(series: Any, windows: int = 40, highest: Optional[float] = None, scale: float = 1.0, ax: Any = None,
              **style: Any) -> Any:
    """Spectra of a series over time, one above the other: of a run-up, `results.bearing()["eccentricity"][:, 0]`.

    `highest` is the largest frequency shown [Hz]; `scale` stretches the peaks, which are as high as a tenth of the
    time shown where it is 1.
    """
    ax = _axes(ax)
    times, frequencies, amplitudes = spectrogram(series, windows)
    shown = frequencies <= (highest or frequencies[-1])
    size = scale * 0.1 * (times[-1] - times[0] or 1) / max(amplitudes.max(), 1e-300)
    options = {"color": "C0", "linewidth": 0.8, **style}
    for time, row in zip(times, amplitudes):
        ax.plot(frequencies[shown], time + size * row[shown], **options)
    ax.set_xlabel("frequency [Hz]")
    ax.set_ylabel("time [s]")
    return ax


__all__ = ["campbell", "film_map", "moft", "orbit", "spectrogram", "waterfall"]
