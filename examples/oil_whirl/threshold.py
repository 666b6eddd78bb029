#!/usr/bin/python3
"""Oil whirl of the two rotors: growth of the orbit in the run against the linearised prediction.

    threshold.py HERSEY [rigid | flexible] [--cavitation CONDITION] [--grid 32x7] [--settle SECONDS] [--within SHARE]

For each of a few speeds: stiffness and damping of a bearing under its share of the weight (`hersey bearing`) and from them
the rotor's eigenvalue; a run that comes to the speed, holds it, and is left alone there (`hersey run`), and growth and frequency
of the journal's motion in it. The threshold is where growth passes zero, by interpolation. With --within the command fails
where threshold or growth differ by more than that share.
"""

import argparse
import dataclasses
import json
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
GRAVITY = 9.81
HOLD = 0.12  # [s] over which the motion is looked at


@dataclasses.dataclass
class Rotor:
    model: str
    speeds: tuple  # [rpm]
    from_speed: float  # where the run begins and settles [rpm]
    settle: float  # [s]
    approach: float  # time to come to the speed [s]
    mass: float  # [kg]
    step: float  # [ms]
    pairs: int  # vibrations that are still measurable after the approach


RIGID = Rotor("model.yaml", (9500, 10000, 10500, 11000), 9000, 0.02, 0.01, 40, 0.1, 1)
SHAFT = {"length": 0.6, "diameter": 0.04, "E": 210e9, "nu": 0.3, "density": 7850, "disc": 33.84, "disc_inertia": 0.1796}
SHAFT_MASS = SHAFT["density"] * np.pi / 4 * SHAFT["diameter"] ** 2 * SHAFT["length"]
FLEXIBLE = Rotor("flexible.yaml", (5500, 6000, 6500, 7000), 5000, 0.25, 0.05, SHAFT["disc"] + SHAFT_MASS, 0.2, 2)


def hersey(program, *arguments):
    run = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{' '.join(arguments)}\n{run.stdout}{run.stderr}")
    return run.stdout


def film_coefficients(program, rotor, speed, settings):
    """Stiffness [N/m] and damping [N s/m] of one bearing, (2, 2) each."""
    printed = hersey(program, "bearing", os.path.join(HERE, rotor.model), "--bearing", "left", "--speed", f"{speed}rpm", "--load",
                  f"{rotor.mass * GRAVITY / 2}N", "--load-angle", "-90deg", "--no-grid-error", "--json", *settings)
    figures = json.loads(printed)["solutions"][0]["figures"]

    def matrix(name):
        return np.array([[figures[f"{name}_{a}{b}"]["value"] for b in "xy"] for a in "xy"])

    return matrix("stiffness"), matrix("damping")


def least_stable(M, B, K):
    """Eigenvalue of M x'' + B x' + K x = 0 that oscillates and has the largest real part [1/s]."""
    n = len(M)
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), -np.linalg.solve(M, B)]])
    values = np.linalg.eigvals(A)
    return max(values[values.imag > 1], key=lambda s: s.real)


def shaft_matrices(elements=10):
    """Mass and stiffness of shaft and disc in one plane, displacement and slope of each node: a Timoshenko beam with shear
    coefficient 6 (1 + nu)/(7 + 6 nu)."""
    h, d, E, nu = SHAFT["length"] / elements, SHAFT["diameter"], SHAFT["E"], SHAFT["nu"]
    area, inertia = np.pi / 4 * d**2, np.pi / 64 * d**4
    shear = 6 * (1 + nu) / (7 + 6 * nu) * area * E / (2 * (1 + nu))
    softening = 12 * E * inertia / (shear * h**2)
    k = E * inertia / (h**3 * (1 + softening)) * np.array(
        [[12, 6 * h, -12, 6 * h], [6 * h, (4 + softening) * h**2, -6 * h, (2 - softening) * h**2],
         [-12, -6 * h, 12, -6 * h], [6 * h, (2 - softening) * h**2, -6 * h, (4 + softening) * h**2]])
    m = SHAFT["density"] * area * h / 420 * np.array(
        [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2],
         [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]])
    n = 2 * (elements + 1)
    M, K = np.zeros((n, n)), np.zeros((n, n))
    for e in range(elements):
        at = slice(2 * e, 2 * e + 4)
        M[at, at] += m
        K[at, at] += k
    M[elements, elements] += SHAFT["disc"]
    M[elements + 1, elements + 1] += SHAFT["disc_inertia"]
    return M, K


def predicted(rotor, K_film, B_film):
    """Eigenvalue of the rotor on two linear bearings [1/s]."""
    if rotor.model == RIGID.model:
        return least_stable(rotor.mass / 2 * np.eye(2), B_film, K_film)
    m, k = shaft_matrices()
    n = len(m)
    M, K, B = np.kron(np.eye(2), m), np.kron(np.eye(2), k), np.zeros((2 * n, 2 * n))
    for end in (0, n - 2):
        at = np.ix_((end, n + end), (end, n + end))
        K[at] += K_film
        B[at] += B_film
    return least_stable(M, B, K)


def least_stable_of(t, e, whirl_guess, pairs):
    """Growth + i frequency [1/s] of the least stable part of a motion e(t), (n, 2), about a place that need not be known.

    e is taken to be a sum of `pairs` vibrations; sampled at intervals T of about a quarter of a turn it then obeys
    e(t + 2 pairs T) = a_1 e(t) + a_2 e(t + T) + .. + constant (Prony).
    """
    dt = t[1] - t[0]
    lag = max(1, int(round(0.5 * np.pi / whirl_guess / dt)))
    order = 2 * pairs
    rows, sides = [], []
    for axis in range(2):
        x = e[:, axis]
        n = len(x) - order * lag
        constant = np.zeros((n, 2))
        constant[:, axis] = np.ptp(x)
        rows.append(np.column_stack([x[k * lag:k * lag + n] for k in range(order)] + [constant]))
        sides.append(x[order * lag:])
    factors = np.linalg.lstsq(np.vstack(rows), np.concatenate(sides), rcond=None)[0][:order]
    values = np.log(np.roots(np.append(1, -factors[::-1])).astype(complex)) / (lag * dt)
    return max(values[values.imag > 0.2 * whirl_guess], key=lambda s: s.real)


def observed(program, rotor, speed, settings, whirl_guess, folder):
    """Growth + i frequency [1/s] of the left journal in a run, and its distance from its middle place in the end [um]."""
    begin = rotor.settle + rotor.approach
    points = [[0, rotor.from_speed], [rotor.settle, rotor.from_speed], [begin, speed], [begin + HOLD + 1, speed]]
    table = "{table: {points: %s, x_unit: s, y_unit: rpm}}" % points
    hersey(program, "run", os.path.join(HERE, rotor.model), "--output", folder, "--force", "--set", f"drives.motor.speed={table}",
           "--set", f"simulation.duration={begin + HOLD}s", "--set", "output.fields_every=1s", *settings)
    with h5py.File(os.path.join(folder, "results.h5")) as file:
        t, e = file["time"][:], file["bearings/left/eccentricity"][:]
    kept = t > begin + 0.03
    last = e[t > t[-1] - 2 * np.pi / whirl_guess]
    return least_stable_of(t[kept], e[kept], whirl_guess, rotor.pairs), 1e6 * np.ptp(last, axis=0).max() / 2


def crossing(speeds, growth):
    """Speed [rpm] where growth passes zero."""
    for k in range(len(speeds) - 1):
        if growth[k] < 0 <= growth[k + 1]:
            return speeds[k] - growth[k] * (speeds[k + 1] - speeds[k]) / (growth[k + 1] - growth[k])
    sys.exit("the growth does not change its sign between these speeds")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("rotor", nargs="?", default="rigid", choices=("rigid", "flexible"))
    parser.add_argument("--cavitation", default="reynolds")
    parser.add_argument("--grid", type=lambda text: "{circumferential: %d, axial: %d}" % tuple(int(n) for n in text.split("x")),
                        help="of the films, such as 32x7, in run and prediction; as in the model if not given")
    parser.add_argument("--settle", type=float, help="before the speed changes; the shorter, the larger is the orbit that grows")
    parser.add_argument("--within", type=float)
    parser.add_argument("--speeds", type=lambda text: tuple(float(part) for part in text.split(",")), help="in rpm")
    arguments = parser.parse_args()
    rotor = RIGID if arguments.rotor == "rigid" else FLEXIBLE
    if arguments.settle is not None:
        rotor = dataclasses.replace(rotor, settle=arguments.settle)
    speeds = arguments.speeds or rotor.speeds
    film = ["--set", f"cavitation={arguments.cavitation}"]
    if arguments.grid is not None:
        for bearing in ("left", "right"):
            film += ["--set", f"bearings.{bearing}.grid={arguments.grid}"]
    settings = [*film, "--set", f"simulation.step={rotor.step}ms"]

    print(f"{arguments.rotor} rotor, {arguments.cavitation} condition")
    print("   speed    growth [1/s]          whirl ratio           orbit at the end")
    print("   [rpm]    predicted      run    predicted      run    [um]")
    growth = []
    with tempfile.TemporaryDirectory() as folder:
        for speed in speeds:
            linear = predicted(rotor, *film_coefficients(arguments.program, rotor, speed, film))
            run, orbit = observed(arguments.program, rotor, speed, settings, linear.imag, folder)
            growth.append((linear.real, run.real))
            omega = speed * np.pi / 30
            print(f"{speed:8g} {linear.real:12.2f} {run.real:8.2f} {linear.imag / omega:12.4f} {run.imag / omega:8.4f} {orbit:10.3f}")
    linear, run = (crossing(speeds, column) for column in zip(*growth))
    share = run / linear - 1
    print(f"threshold: predicted {linear:.0f} rpm, in the run {run:.0f} rpm: {100 * share:+.2f} %")
    if arguments.within is not None and abs(share) > arguments.within:
        sys.exit(f"further apart than {100 * arguments.within:g} %")


if __name__ == "__main__":
    main()
