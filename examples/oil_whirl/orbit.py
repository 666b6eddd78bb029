#!/usr/bin/python3
"""Orbit of a journal over a run: orbit.py RESULTS.h5 [BEARING]. Size and whirl frequency in twelve intervals."""

import sys

import h5py
import numpy as np

INTERVALS = 12


def main():
    bearing = sys.argv[2] if len(sys.argv) > 2 else "left"
    with h5py.File(sys.argv[1]) as file:
        t, e = file["time"][:], file[f"bearings/{bearing}/eccentricity"][:]
        omega = file[f"bearings/{bearing}/speed"][:]
        clearance = file[f"bearings/{bearing}"].attrs["radial_clearance"]
    print("  time [s]  speed [rpm]  orbit, half its height [um]  of the clearance  whirl [Hz]  whirl ratio")
    edges = np.linspace(t[0], t[-1], INTERVALS + 1)
    for begin, end in zip(edges, edges[1:]):
        inside = (t >= begin) & (t <= end)
        z = e[inside] @ (1, 1j)
        speed = abs(omega[inside].mean())
        size = np.ptp(z.imag) / 2
        line = f"{end:10.3f} {speed * 30 / np.pi:12.0f} {1e6 * size:28.3f} {size / clearance:17.3f}"
        if size < 1e-6:  # the place drifts with the speed more than the journal circles about it
            print(line)
            continue
        angle = np.unwrap(np.angle(z - z.mean()))
        whirl = abs(np.polyfit(t[inside], angle, 1)[0])
        print(f"{line} {whirl / 2 / np.pi:11.1f} {whirl / speed:12.3f}")


if __name__ == "__main__":
    main()
