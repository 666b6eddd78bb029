"""Diagrams over a speed: natural frequencies, and spectra of a series."""

import numpy as np

MOST_FREQUENCIES = 400


def campbell(results):
    """Modes over the first parameter, by rising frequency at each of its values."""
    inputs = results.inputs()
    order = np.argsort(inputs[:, 0], kind="stable")
    rows = []
    for i in order:
        modes = results.found[results.runs[i]]["modes"]
        count = 1 + max((int(key.split(".")[1]) for key in modes), default=0)
        rows.append({"x": float(inputs[i, 0]), "run": results.runs[i],
                     "frequency": [modes.get(f"modes.{k}.damped_frequency") for k in range(1, count)],
                     "damping_ratio": [modes.get(f"modes.{k}.damping_ratio") for k in range(1, count)]})
    return {"parameter": results.settings["parameters"][0]["name"],
            "unit": results.settings["parameters"][0]["unit"], "rows": rows}


def series_in(file, name):
    """A series of a results file and its times: 'bearings.main.eccentricity.x'. None where there is no such series."""
    parts = name.split(".")
    column = 0
    if parts[-1] in "xyz" and len(parts[-1]) == 1:
        column = "xyz".index(parts.pop())
    path = "/".join(parts)
    if path not in file or not hasattr(file[path], "shape"):
        return None
    values = file[path][:]
    return file["time"][: len(values)], values if values.ndim == 1 else values[:, column]


def series_of(file, name):
    """The same, of a series that a study names for its spectrum."""
    found = series_in(file, name)
    if found is None:
        from .study import StudyError

        raise StudyError(f"spectrum_of '{name}': results have no such series; expected one of docs/results-file.md, "
                         "such as bearings.main.eccentricity.x")
    return found


def spectrum(time, values):
    """Amplitudes over frequency [Hz] of the second half of a series, on even times, under Hann's window."""
    half = time >= 0.5 * (time[0] + time[-1])
    time, values = time[half], values[half]
    even = np.linspace(time[0], time[-1], len(time))
    values = np.interp(even, time, values)
    window = np.hanning(len(values))
    amplitude = 2 * np.abs(np.fft.rfft((values - values.mean()) * window)) / window.sum()
    return np.fft.rfftfreq(len(values), even[1] - even[0]), amplitude


def run_up(results, folder):
    """The spectra of a series over the first parameter: a waterfall."""
    import h5py

    inputs = results.inputs()
    rows = []
    for i in np.argsort(inputs[:, 0], kind="stable"):
        with h5py.File(folder.file("runs", results.runs[i] + ".h5"), "r") as file:
            frequency, amplitude = spectrum(*series_of(file, results.settings["spectrum_of"]))
        rows.append({"x": float(inputs[i, 0]), "run": results.runs[i],
                     "frequency": frequency[:MOST_FREQUENCIES].tolist(),
                     "amplitude": amplitude[:MOST_FREQUENCIES].tolist()})
    return {"parameter": results.settings["parameters"][0]["name"],
            "unit": results.settings["parameters"][0]["unit"], "series": results.settings["spectrum_of"], "rows": rows}
