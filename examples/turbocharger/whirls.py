#!/usr/bin/python3
"""Whirls of a turbocharger in a run-up: whirls.py RESULTS.h5 [--intervals N] [--picture FILE.png] [--expect FILM].

With `--run HERSEY` in the place of results: 40 ms at 120,000 rpm with rings at 31,000 rpm, made by that program.

For each interval of time: speeds of shaft and ring, the strongest vibration of the compressor wheel below the shaft's speed, and its frequency over
half the ring's speed (1: the oil of the outer film whirls) and over half the sum of both speeds (1: that of the inner film). The film that whirls is that
in which the vibration takes the larger share of the clearance. --expect fails where it is another one in the last interval, or where the frequency is
not within 20 % of that film's. --picture draws the spectra over time and needs matplotlib (python3-matplotlib).
"""

import argparse
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

SIDE = "turbine"
# What turns with the shaft is above it, what rests is below [of the shaft's speed; Hz].
FASTEST, SLOWEST = 0.9, 60
# In thin films the share of side flow lowers the whirl below the mean speed of the oil, by up to a sixth in this machine.
WITHIN = 0.2


class Run:
    def __init__(self, path):
        with h5py.File(path) as file:
            self.t = file["time"][:]
            self.wheel = file["bodies/compressor_wheel/position"][:, :2] @ (1, 1j)
            # In ground's axes: the ring, whose own axes rotate, has that of the inner film in them.
            self.outer = self.film(file, "outer")
            self.inner = self.film(file, "inner") * np.exp(1j * ring_angle(file))
            self.ring = file[f"bearings/{SIDE}_outer/speed"][:]
            self.shaft = self.ring + file[f"bearings/{SIDE}_inner/speed"][:]

    @staticmethod
    def film(file, name):
        """The moving surface's centre over the clearance."""
        bearing = file[f"bearings/{SIDE}_{name}"]
        return bearing["eccentricity"][:] @ (1, 1j) / bearing.attrs["radial_clearance"]


def ring_angle(file):
    """Angle of the ring [rad]."""
    w, _, _, z = file[f"bodies/{SIDE}_ring/orientation"][:].T
    return np.unwrap(2 * np.arctan2(z, w))


def spectrum(t, z):
    """Frequencies [Hz], negative ones against the rotation, and amplitudes of an orbit with a Hann window."""
    window = np.hanning(len(z))
    amplitude = np.abs(np.fft.fft((z - z.mean()) * window)) / window.sum()
    return np.fft.fftfreq(len(z), t[1] - t[0]), amplitude


def strongest(t, z, below):
    """Frequency [Hz] and amplitude of the strongest forward vibration below a frequency."""
    frequency, amplitude = spectrum(t, z)
    amplitude = np.where((frequency > SLOWEST) & (frequency < below), amplitude, 0)
    k = int(np.argmax(amplitude))
    return frequency[k], amplitude[k]


def at(t, z, wanted):
    """Amplitude of the forward vibration at a frequency [Hz]."""
    frequency, amplitude = spectrum(t, z)
    return amplitude[np.argmin(np.abs(frequency - wanted))]


def table(run, intervals):
    print("    time  speed of shaft  of ring   whirl  amplitude  share of clearance   over half of  over half of")
    print("     [s]      [rpm]        [rpm]    [Hz]      [um]      outer     inner     ring's speed  shaft + ring  film")
    edges = np.linspace(run.t[0], run.t[-1], intervals + 1)
    last = None
    for begin, end in zip(edges, edges[1:]):
        k = (run.t >= begin) & (run.t <= end)
        shaft, ring = run.shaft[k].mean() / (2 * np.pi), run.ring[k].mean() / (2 * np.pi)
        f, size = strongest(run.t[k], run.wheel[k], FASTEST * shaft)
        outer, inner = at(run.t[k], run.outer[k], f), at(run.t[k], run.inner[k], f)
        line = f"{end:8.3f} {60 * shaft:11.0f} {60 * ring:12.0f}"
        last = None
        if size > 0.5e-6 and shaft > ring:  # less than 0.5 um, as large as the unbalance: no whirl
            last = ("outer", f / (0.5 * ring)) if outer > inner else ("inner", f / (0.5 * (shaft + ring)))
            line += f" {f:8.0f} {1e6 * size:9.2f} {outer:10.3f} {inner:9.3f} {f / (0.5 * ring):12.2f} {f / (0.5 * (shaft + ring)):13.2f}    {last[0]}"
        print(line)
    return last


def picture(run, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot

    dt, highest = run.t[1] - run.t[0], 3000
    length = int(round(0.025 / dt))  # 25 ms: 40 Hz apart
    begins = np.arange(0, len(run.t) - length, length // 4)
    frequency, _ = spectrum(run.t[:length], run.wheel[:length])
    shown = (frequency >= 0) & (frequency <= highest)
    levels = np.array([spectrum(run.t[b:b + length], run.wheel[b:b + length])[1][shown] for b in begins]).T * 1e6
    time = run.t[begins + length // 2]
    figure, axes = pyplot.subplots(figsize=(9, 5.4), layout="constrained")
    mesh = axes.pcolormesh(time, frequency[shown], np.log10(np.maximum(levels, 1e-3)), shading="nearest", cmap="viridis", vmin=-2, vmax=1.7)
    shaft, ring = run.shaft / (2 * np.pi), run.ring / (2 * np.pi)
    for values, label, style in ((shaft, "shaft", ":"), (0.5 * (shaft + ring), "half of shaft + ring: inner film", "--"), (0.5 * ring, "half of ring: outer film", "-.")):
        axes.plot(run.t[::100], values[::100], "w" + style, lw=1, label=label)
    axes.set(xlabel="time [s]", ylabel="frequency of the compressor wheel's forward vibration [Hz]", ylim=(0, highest))
    axes.legend(loc="upper left", facecolor="black", labelcolor="white", framealpha=0.6)
    bar = figure.colorbar(mesh, ax=axes, label="amplitude [um]", ticks=[-2, -1, 0, 1])
    bar.set_ticklabels(["0.01", "0.1", "1", "10"])
    figure.savefig(path, dpi=110)


def short_run(program):
    """A short run at a constant speed."""
    model = os.path.join(os.path.dirname(os.path.abspath(__file__)), "model.yaml")
    settings = ["first_speed=120000", "last_speed=120000", "simulation.duration=40ms", "output.fields_every=1s"]
    settings += [f"bearings.{bearing}.ring.initial_speed=31000rpm" for bearing in ("compressor", "turbine")]
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "run", model, "--output", folder, "--force"] + [part for setting in settings for part in ("--set", setting)]
        made = subprocess.run(command, capture_output=True, text=True, check=False)
        if made.returncode != 0:
            sys.exit(made.stdout + made.stderr)
        return Run(os.path.join(folder, "results.h5"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="?")
    parser.add_argument("--run", metavar="HERSEY")
    parser.add_argument("--intervals", type=int, default=20)
    parser.add_argument("--picture")
    parser.add_argument("--expect", choices=("outer", "inner"))
    given = parser.parse_args()
    run = short_run(given.run) if given.run else Run(given.results)
    last = table(run, given.intervals)
    if given.picture:
        picture(run, given.picture)
    if given.expect and (last is None or last[0] != given.expect or abs(last[1] - 1) > WITHIN):
        sys.exit(f"expected the {given.expect} film to whirl in the last interval, at the mean speed of its oil within {100 * WITHIN:.0f} %; found {last}")


if __name__ == "__main__":
    main()
