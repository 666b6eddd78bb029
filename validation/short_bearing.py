#!/usr/bin/python3
"""Oil whirl and unbalance of a rotor in short bearings by the program and by verification/short_bearing (docs/validation.md): thresholds, the kind of
their bifurcations, limit cycles over the speed, folds, and an orbit by harmonic balance, shooting and waiting.

Usage: short_bearing.py HERSEY OUTPUT   (OUTPUT is not needed)
exit code 0 if all differences are within the bounds of docs/validation.md.
"""

import functools
import os
import sys
import time

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
for folder in ("../verification/short_bearing", "../tests/cli"):
    sys.path.insert(0, os.path.join(HERE, folder))

hersey_program = sys.argv[1]
sys.argv = [sys.argv[0], hersey_program]  # what the test's module reads

import models  # noqa: E402
import short_bearing_rotor_test as ours  # noqa: E402
from cycles import HarmonicBalance, branch, correct, fold_between, newborn  # noqa: E402
from rotor import Rotor, lyapunov, threshold_of_eccentricity  # noqa: E402
from scipy.optimize import brentq  # noqa: E402

failed = []


def within(what, value, bound):
    if not abs(value) <= bound:
        failed.append(f"{what}: {value:.3g}, more than {bound:g}")
    return value


def row(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def thresholds():
    print("\nThreshold at a static eccentricity ratio e: s = omega sqrt(c/g), whirl ratio; differences of hersey")
    row("e", "s", "whirl", "closed form", "L/D 0.1", "0.05", "to 0", "whirl, to 0")
    for e in (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7):
        s, gamma, ratio = threshold_of_eccentricity(e)
        closed = ours.threshold_by_hersey(lambda at: models.on_closed_form(gamma, at, Rotor(gamma, at).equilibrium()), s)
        films = [np.array(ours.threshold_by_hersey(lambda at: models.on_film(gamma, at, width, grid=(240, 9)), s)) for width in (0.1, 0.05)]
        limit = ours.extrapolated(*films)
        within(f"threshold of the closed form at {e}", closed[0] / s - 1, 2e-5)
        within(f"threshold of films at {e}", limit[0] / s - 1, 5e-3)
        row(e, f"{s:.4f}", f"{ratio:.4f}", f"{closed[0] / s - 1:.1e}", *(f"{100 * (one[0] / s - 1):.2f} %" for one in films),
            f"{100 * (limit[0] / s - 1):.3f} %", f"{100 * (limit[1] / ratio - 1):.3f} %")


def kinds():
    changes = {film: brentq(lambda e: lyapunov(threshold_of_eccentricity(e)[1], film), *near) for film, near in {"moving": (0.1, 0.2), "fixed": (0.25, 0.4)}.items()}
    print(f"\nThe first Lyapunov coefficient changes its sign at e = {changes['moving']:.4f}, with a half film that does not move at {changes['fixed']:.4f}")
    row("e", "coefficient", "closed form: cycle beside the threshold", "multiplier")
    case = ours.KindOfBifurcation()
    for e in (0.05, 0.1, 0.12, 0.16, 0.2, 0.3, 0.5):
        s, gamma, ratio = threshold_of_eccentricity(e)
        kind = lyapunov(gamma, "moving")
        side, multiplier = case.of(lambda at, start: models.on_closed_form(gamma, at, start, simulation=""), gamma, s, ratio, e)
        within(f"kind at {e}", 0 if np.sign(side) == -np.sign(kind) == -np.sign(multiplier - 1) else 1, 0)
        row(e, f"{kind:.4f}", f"{100 * side:+.4f} %", f"{multiplier:.4f}")


@functools.lru_cache
def cycles_of(e):
    """Limit cycles from the threshold on, through their folds, to 1.25 times its speed."""
    s, gamma, _ = threshold_of_eccentricity(e)
    first = newborn(gamma, "moving", 0.1)
    rest = Rotor(gamma, s).equilibrium()
    return branch(gamma, "moving", first, lambda t: t[:4] @ (first.start - rest), lambda one: one.s > 1.25 * s and one.is_stable(), largest=0.1)


def sizes_of(cycle, gamma):
    x, y, _, _ = cycle.orbit(gamma, "moving", 256)
    return np.abs([ours.spectrum(x), ours.spectrum(y)])


def limit_cycles():
    print("\nLimit cycles: period in revolutions, largest eccentricity ratio; differences of hersey in the period and in the harmonics of x and y")
    row("e at the threshold", "s over threshold", "period", "e max", "stable", "closed form: period", "orbit", "film: period", "first harmonics")
    for e, shares in {0.1: (1.04, 1.2), 0.2: (1.006, 1.05), 0.3: (1.005, 1.02, 1.04, 1.1), 0.5: (1.02, 1.08, 1.2)}.items():
        s, gamma, _ = threshold_of_eccentricity(e)
        for share in shares:
            near = min((one for one in cycles_of(e) if one.is_stable()), key=lambda one: abs(one.s / s - share))
            cycle = near
            for at in np.linspace(near.s, share * s, 4)[1:]:
                cycle = correct(gamma, "moving", cycle, ours.AT_SPEED, at)
            sizes = sizes_of(cycle, gamma)
            about = cycle.period / (2 * np.pi)
            by_steps = [ours.limit_cycle_by_hersey(models.on_closed_form(gamma, share * s, cycle.start, simulation=models.shooting(n, about, True)), n) for n in (144, 288)]
            period = ours.extrapolated(by_steps[0][0], by_steps[1][0]) / cycle.period - 1
            orbit = np.max(abs(ours.extrapolated(by_steps[0][1], by_steps[1][1]) - sizes)) / np.max(sizes[:, 1])
            by_width = []
            for width in (0.1, 0.05):
                at = share * ours.threshold_by_hersey(lambda at: models.on_film(gamma, at, width, grid=(240, 9)), s)[0]
                by_width.append(ours.limit_cycle_by_hersey(models.on_film(gamma, at, width, cycle.start, grid=(240, 9), simulation=models.shooting(144, about, True, 1e-5)), 144))
            film_period = ours.extrapolated(by_width[0][0], by_width[1][0]) / cycle.period - 1
            first_harmonics = np.max(abs(ours.extrapolated(by_width[0][1], by_width[1][1])[:, 1] / sizes[:, 1] - 1))
            within(f"period on the closed form, {e}, {share}", period, 1e-4)
            within(f"orbit on the closed form, {e}, {share}", orbit, 1e-4)
            within(f"period on films, {e}, {share}", film_period, 1e-2)
            within(f"orbit on films, {e}, {share}", first_harmonics, 1e-2)
            x, y, _, _ = cycle.orbit(gamma, "moving")
            row(e, share, f"{about:.4f}", f"{np.max(np.hypot(x, y)):.4f}", "yes" if cycle.is_stable() else "no", f"{period:.1e}", f"{orbit:.1e}", f"{100 * film_period:.2f} %",
                f"{100 * first_harmonics:.2f} %")


def folds():
    print("\nFolds of the limit cycle: s over the threshold; differences of hersey at 72 and 144 steps a period, extrapolated")
    row("e at the threshold", "s over threshold", "e max", "72 steps", "144", "extrapolated")
    for e in (0.1, 0.2, 0.3):
        s, gamma, _ = threshold_of_eccentricity(e)
        found = cycles_of(e)
        for k in range(2, len(found) - 1):
            if (found[k].s - found[k - 1].s) * (found[k + 1].s - found[k].s) > 0:
                continue
            before, behind = found[k - 1], found[k + 1]
            fold = fold_between(gamma, "moving", before, behind)
            # From the side that comes first on the branch, over the fold and back to its speed.
            sign = np.sign(fold.s - before.s)
            start = before
            values = []
            for steps in (72, 144):
                text = models.on_closed_form(gamma, start.s, start.start, simulation=models.shooting(steps, start.period / (2 * np.pi), True))
                far = fold.s + sign * max(abs(fold.s - start.s), 1e-3 * s)
                result, _ = ours.hersey(text, "orbits", "--along", f"w={start.s * models.RATE}:{far * models.RATE}", "--step", 0.2, "--tolerance", 1e-6, "--multipliers", 1, "--most", 45)
                values += [one["value"] / models.RATE for one in result["bifurcations"] if one["kind"] == "fold"][:1]
            if len(values) < 2:
                failed.append(f"fold at {fold.s / s:.5f} of {e}: not found ({result['message']})")
                continue
            limit = ours.extrapolated(*values)
            within(f"fold of {e}", limit / fold.s - 1, 1e-4)
            x, y, _, _ = fold.orbit(gamma, "moving")
            row(e, f"{fold.s / s:.5f}", f"{np.max(np.hypot(x, y)):.4f}", *(f"{value / fold.s - 1:.1e}" for value in values), f"{limit / fold.s - 1:.1e}")


class Rubbing(Rotor):
    """The same with a stop that yields, at 0.45 of the clearance, with friction: a kink."""

    stiffness, gap, friction = 50.0, 0.45, 0.1

    def rates(self, t, state):
        rates = np.array(super().rates(t, state))
        x, y = state[:2]
        e = np.sqrt(x * x + y * y)
        push = self.stiffness / self.s**2 * np.maximum(e - self.gap, 0) / e
        rates[2] -= push * (x - self.friction * y)
        rates[3] -= push * (y + self.friction * x)
        return rates


def stop_in_hersey():
    push = f"(max(0, sqrt((turning.x^2 + turning.y^2)*{models.CLEARANCE**-2:.17g}) - {Rubbing.gap})/sqrt(turning.x^2 + turning.y^2))"
    newton = Rubbing.stiffness * models.MASS * models.GRAVITY
    return [f'stop_{axis}: {{type: force, body: rotor, direction: {axis}, magnitude: {{expression: "-{newton:.17g}*{push}*({way})", unit: N}}}}'
            for axis, way in (("x", f"turning.x - {Rubbing.friction}*turning.y"), ("y", f"turning.y + {Rubbing.friction}*turning.x"))]


def balance(kind, gamma, s, unbalance, harmonics, samples, guess=None):
    for share in (0.3, 0.6, 1.0) if guess is None else (1.0,):
        X, Y, iterations = HarmonicBalance(kind(gamma, s, "moving", share * unbalance), harmonics, samples).solve(guess)
        guess = X, Y
    return np.array([X, Y]), iterations


def orbit_of(spectra):
    k = np.arange(spectra.shape[1])
    return (np.exp(1j * np.outer(np.arange(512) * 2 * np.pi / 512, k)) @ spectra.T).real


def three_ways():
    s, gamma, _ = threshold_of_eccentricity(0.3)
    s *= 0.9
    print("\nUnbalance of 0.3 c at 0.9 of the threshold of e = 0.3: deviation from the exact orbit as a share of its size")
    for name, kind, more in (("short bearing", Rotor, ()), ("and a stop, rubbed at every passage", Rubbing, stop_in_hersey())):
        exact, _ = balance(kind, gamma, s, 0.3, 192, 4096)
        truth = orbit_of(exact)
        size = np.max(np.ptp(truth, axis=0))
        print(f"{name}: harmonic balance")
        row("harmonics", "deviation")
        for harmonics in (2, 4, 6, 7, 8, 11, 13, 16, 24, 32, 52):
            found, _ = balance(kind, gamma, s, 0.3, harmonics, 4096, exact)
            row(harmonics, f"{np.max(abs(orbit_of(found) - truth)) / size:.1e}")
        print(f"{name}: hersey")
        row("steps a revolution", "shooting", "extrapolated", "waiting 100 revolutions", "extrapolated", "revolutions run by shooting", "time [s]")
        start = exact[0, 0].real, exact[1, 0].real, 0, 0
        coarser = None
        for steps in (72, 144, 288):
            deviations, now = [], []
            for simulation in (models.shooting(steps), models.waiting(steps, 100)):
                begin = time.time()
                text = models.on_closed_form(gamma, s, start, 0.3, simulation, more)
                summary, (_, rows) = ours.hersey(text, "run")
                now.append(rows[-steps:])
                deviations.append(time.time() - begin)
                if simulation.startswith("simulation:\n  cycle"):
                    periods = summary["runs"][0]["lead_in_cycles"] + summary["runs"][0]["cycles"]
            spectra = [np.array([ours.spectrum(last[:, k] / models.CLEARANCE, 32) * np.exp(-1j * np.arange(32) * last[0, 2]) for k in range(2)]) for last in now]
            orbits = [orbit_of(one) for one in spectra]
            plain = [np.max(abs(one - truth)) / size for one in orbits]
            limits = ["", ""] if coarser is None else [np.max(abs(ours.extrapolated(a, b) - truth)) / size for a, b in zip(coarser, orbits)]
            coarser = orbits
            row(steps, f"{plain[0]:.1e}", limits[0] and f"{limits[0]:.1e}", f"{plain[1]:.1e}", limits[1] and f"{limits[1]:.1e}", periods, " / ".join(f"{d:.1f}" for d in deviations))
        for limit in limits:
            within(f"{name}, extrapolated", limit, 1e-4)
        if not more:
            films = [ours.Unbalance().by_hersey(models.on_film(gamma, s, width, start, 0.3, (120, 9), models.shooting(288, tolerance=1e-5)), 288) for width in (0.2, 0.1)]
            film = np.max(abs(orbit_of(ours.extrapolated(*films)) - truth)) / size
            within("film, L/D to 0", film, 1e-2)
            print(f"films of L/D 0.2 and 0.1, 288 steps: {', '.join(f'{np.max(abs(orbit_of(one) - truth)) / size:.1e}' for one in films)}; to 0: {film:.1e}")


if __name__ == "__main__":
    for part in (thresholds, kinds, limit_cycles, folds, three_ways):
        part()
    for line in failed:
        print(line)
    sys.exit(1 if failed else 0)
