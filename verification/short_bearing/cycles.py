"""Limit cycles of the rotor of rotor.py by shooting, and along the speed through their folds by arc length; periodic motion by harmonic balance."""

import numpy as np
from rotor import Rotor, threshold
from scipy.integrate import solve_ivp

STEP = 1e-7


class Cycle:
    """A limit cycle: its start, period [rad of the shaft], s, Floquet multipliers, and the direction of its branch in (start, period, s)."""

    def __init__(self, start, period, s, multipliers=None, tangent=None):
        self.start, self.period, self.s, self.multipliers, self.tangent = start, period, s, multipliers, tangent

    def is_stable(self):
        values = list(self.multipliers)
        values.pop(int(np.argmin([abs(value - 1) for value in values])))  # that of a shift in time
        return max(abs(value) for value in values) < 1

    def orbit(self, gamma, film, points=2000):
        """x, y, x', y' at equal times of a period."""
        t = np.arange(points) * self.period / points
        rotor = Rotor(gamma, self.s, film)
        return solve_ivp(rotor.rates, (0, self.period), self.start, method="DOP853", rtol=1e-11, atol=1e-13, t_eval=t).y


def end_and_derivatives(gamma, s, film, start, period):
    """Ends of a period of the start and its neighbours, all in one integration: end, its derivative by the start, and by s."""
    starts = np.array([start] + [start + sign * STEP * np.eye(4)[k] for k in range(4) for sign in (1, -1)] + [start, start]).T
    speeds = np.array([s] * 9 + [s + 1e-6, s - 1e-6])
    rotor = Rotor(gamma, speeds, film)
    rates = lambda t, z: np.asarray(rotor.rates(t, z.reshape(4, -1))).ravel()
    with np.errstate(invalid="ignore"):  # trials that leave the bearing
        ends = solve_ivp(rates, (0, period), starts.ravel(), method="DOP853", rtol=1e-11, atol=1e-13).y[:, -1].reshape(4, -1)
    by_start = np.array([(ends[:, 1 + 2 * k] - ends[:, 2 + 2 * k]) / (2 * STEP) for k in range(4)]).T
    return ends[:, 0], by_start, (ends[:, 9] - ends[:, 10]) / 2e-6


def correct(gamma, film, guess, plane, value, most=12):
    """The cycle on plane . (start, period, s) = value whose start lies across the flow of the guess; None where Newton's method fails."""
    z = np.array([*guess.start, guess.period, guess.s])
    section = Rotor(gamma, guess.s, film).rates(0, guess.start)
    for _ in range(most):
        if not (np.hypot(z[0], z[1]) < 0.9999 and z[4] > 0 and z[5] > 0):
            return None
        end, by_start, by_s = end_and_derivatives(gamma, z[5], film, z[:4], z[4])
        flow = Rotor(gamma, z[5], film).rates(0, end)
        residual = np.array([*(end - z[:4]), section @ (z[:4] - guess.start), plane @ z - value])
        matrix = np.zeros((6, 6))
        matrix[:4] = np.column_stack([by_start - np.eye(4), flow, by_s])
        matrix[4, :4] = section
        matrix[5] = plane
        change = np.linalg.solve(matrix, residual)
        z = z - change
        if np.max(abs(change)) < 1e-8:
            tangent = np.linalg.solve(matrix, np.eye(6)[5])
            return Cycle(z[:4], z[4], z[5], np.linalg.eigvals(by_start), tangent / np.linalg.norm(tangent))
    return None


def newborn(gamma, film, size=0.01):
    """A small limit cycle beside the threshold: that of the linear motion there, of the given size."""
    s, _, ratio = threshold(gamma)
    rotor = Rotor(gamma, s, film)
    values, vectors = np.linalg.eig(rotor.jacobian(rotor.equilibrium()))
    way = vectors[:, np.argmin(abs(values - 1j * ratio))].real
    way = way / np.linalg.norm(way[:2])
    start = rotor.equilibrium() + size * way
    plane = np.array([*way, 0, 0])
    return correct(gamma, film, Cycle(start, 2 * np.pi / ratio, s), plane, plane[:4] @ start)


def branch(gamma, film, first, towards, until, step=0.02, largest=0.05, most=400):
    """Cycles from the first on, along the branch in the direction `towards` (a sign: of s, or of size), until until(cycle)."""
    found = [first]
    direction = first.tangent * np.sign(towards(first.tangent))
    while len(found) < most and not until(found[-1]):
        last = found[-1]
        z = np.array([*last.start, last.period, last.s]) + step * direction
        cycle = correct(gamma, film, Cycle(z[:4], z[4], z[5]), direction, direction @ z, most=6)
        if cycle is None or np.dot(cycle.tangent * np.sign(cycle.tangent @ direction), direction) < 0.9:
            step /= 2
            if step < 1e-6:
                break
            continue
        direction = cycle.tangent * np.sign(cycle.tangent @ direction)
        found.append(cycle)
        step = min(1.4 * step, largest)
    return found


def fold_between(gamma, film, before, behind):
    """The cycle between two of a branch at which s turns back, by the secant of the branch's direction."""
    def on(cycle, fraction, direction, length):
        z = np.array([*cycle.start, cycle.period, cycle.s]) + fraction * length * direction
        return correct(gamma, film, Cycle(z[:4], z[4], z[5]), direction, direction @ z)

    for _ in range(30):
        direction = before.tangent * np.sign(before.tangent @ np.array([*(behind.start - before.start), behind.period - before.period, behind.s - before.s]))
        length = direction @ np.array([*(behind.start - before.start), behind.period - before.period, behind.s - before.s])
        a = direction[5]
        b = (behind.tangent * np.sign(behind.tangent @ direction))[5]
        middle = on(before, min(max(a / (a - b), 0.02), 0.98), direction, length)
        m = (middle.tangent * np.sign(middle.tangent @ direction))[5]
        if abs(m) < 1e-9:
            break
        if m * a > 0:
            before = middle
        else:
            behind = middle
    return middle


class HarmonicBalance:
    """Periodic motion of an unbalanced rotor as sums of harmonics, forces by the alternating frequency-time method (Cameron and Griffin, 1989)."""

    def __init__(self, rotor, harmonics, samples=None):
        self.rotor, self.H = rotor, harmonics
        self.N = samples or 2 ** int(np.ceil(np.log2(8 * harmonics + 8)))
        self.orders = np.arange(harmonics + 1)

    def motion(self, unknown):
        X, Y = unknown.reshape(2, -1)
        return [self.to_time(X), self.to_time(Y), self.to_time(1j * self.orders * self.spectrum(X), True), self.to_time(1j * self.orders * self.spectrum(Y), True)]

    def spectrum(self, reals):
        """x(t) = Re sum_k X_k exp(i k t), X_0 real."""
        H = self.H
        return np.concatenate([[reals[0]], reals[1 : H + 1] + 1j * reals[H + 1 :]])

    def reals(self, spectrum):
        return np.concatenate([[spectrum[0].real], spectrum[1:].real, spectrum[1:].imag])

    def to_time(self, values, is_spectrum=False):
        spectrum = values if is_spectrum else self.spectrum(values)
        full = np.zeros(self.N // 2 + 1, complex)
        full[: self.H + 1] = spectrum
        full[0] *= 2
        return np.fft.irfft(full, self.N) * self.N / 2

    def to_spectrum(self, values):
        spectrum = np.fft.rfft(values)[: self.H + 1] * 2 / self.N
        spectrum[0] /= 2
        return spectrum

    def residual(self, unknown):
        x, y, vx, vy = self.motion(unknown)
        t = 2 * np.pi * np.arange(self.N) / self.N
        _, _, ax, ay = self.rotor.rates(t, [x, y, vx, vy])
        X, Y = (self.spectrum(part) for part in unknown.reshape(2, -1))
        return np.concatenate([self.reals(-self.orders**2 * X - self.to_spectrum(ax)), self.reals(-self.orders**2 * Y - self.to_spectrum(ay))])

    def jacobian(self, unknown, h=1e-6):
        """By derivatives of the forces at each sample, carried into the frequency domain."""
        state = self.motion(unknown)
        t = 2 * np.pi * np.arange(self.N) / self.N
        basis = np.eye(2 * self.H + 1)
        waves = np.array([self.to_time(row) for row in basis])
        waves_rate = np.array([self.to_time(1j * self.orders * self.spectrum(row), True) for row in basis])
        n = 2 * self.H + 1
        result = np.zeros((2 * n, 2 * n))
        slopes = []
        for k in range(4):
            up, down = [list(state) for _ in range(2)]
            up[k], down[k] = state[k] + h, state[k] - h
            slopes.append([(a - b) / (2 * h) for a, b in zip(self.rotor.rates(t, up)[2:], self.rotor.rates(t, down)[2:])])
        for of in range(2):
            for by in range(2):
                columns = slopes[by][of] * waves + slopes[2 + by][of] * waves_rate
                block = -np.array([self.reals(self.to_spectrum(column)) for column in columns]).T
                if of == by:
                    block += np.diag(-np.concatenate([[0], self.orders[1:] ** 2, self.orders[1:] ** 2]).astype(float))
                result[of * n : of * n + n, by * n : by * n + n] = block
        return result

    def solve(self, guess=None, most=100):
        """Spectra X_0..X_H and Y_0..Y_H, and the number of Newton iterations."""
        n = 2 * self.H + 1
        unknown = np.zeros(2 * n)
        if guess is None:
            unknown[0], unknown[n] = self.rotor.equilibrium()[:2]
        else:
            for place, spectrum in zip((0, n), guess):
                kept = np.zeros(self.H + 1, complex)
                kept[: min(len(spectrum), self.H + 1)] = spectrum[: self.H + 1]
                unknown[place : place + n] = self.reals(kept)
        for iteration in range(1, most):
            residual = self.residual(unknown)
            change = np.linalg.solve(self.jacobian(unknown), -residual)
            share = 1.0
            while share > 1e-3:
                x, y, _, _ = self.motion(unknown + share * change)
                if np.max(x * x + y * y) < 0.999 and np.linalg.norm(self.residual(unknown + share * change)) < 1.5 * np.linalg.norm(residual) + 1e-12:
                    break
                share /= 2
            unknown = unknown + share * change
            if np.max(abs(change)) < 1e-11:
                X, Y = (self.spectrum(part) for part in unknown.reshape(2, -1))
                return X, Y, iteration
        raise RuntimeError("harmonic balance found no solution")
