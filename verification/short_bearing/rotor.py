"""A rigid rotor in short bearings whose forces are closed forms: equilibrium, threshold, kind of bifurcation, limit cycles.

Lengths are shares of the clearance c, times are angles omega t of the shaft; y points up, and from x to y is the shaft's rotation. A bearing of
radius R and width L that carries a rotor of mass m has

    x'' = gamma/s f_x,    y'' = gamma/s f_y - 1/s^2,    gamma = mu R L^3/(2 m c^2 sqrt(c g)),    s = omega sqrt(c/g),

f being its force over mu omega R L^3/(2 c^2), that of the pressure of Ocvirk's short bearing with its squeeze,

    p ~ ((y + 2 x') cos(phi) - (x - 2 y') sin(phi))/h^3,    h = 1 - x cos(phi) - y sin(phi),

where it is positive: `film="moving"`, a half circle that turns with the journal's motion, Guembel's condition; or `film="fixed"`, on the half circle
behind the widest gap wherever the journal goes, which many studies of its bifurcations take. No line of hersey is in here.
"""

import numpy as np
from scipy.optimize import brentq


def force_of_moving_film(x, y, vx, vy):
    """f where the pressure is positive, by derivatives of the integral of 1/h over that half circle (Booker's integrals)."""
    a, b = y + 2 * vx, x - 2 * vy
    A = np.sqrt(a * a + b * b) + 1e-300
    u, v = (x * a - y * b) / A, (x * b + y * a) / A  # displacement along the middle of the half circle, and across
    s2 = 1 - x * x - y * y
    s = np.sqrt(s2)
    J = 2 / s * (np.pi / 2 + np.arctan(u / s))
    V = (2 + u * J) / s2
    F = v / (1 - v * v)
    return -(J * a + 3 * A * V * x - 2 * F * b) / (2 * s2), -(-J * b + 3 * A * V * y - 2 * F * a) / (2 * s2)


def force_of_fixed_film(x, y, vx, vy):
    """f on the half circle behind the widest gap, radial and tangential (Hamrock; Khonsari and Booser)."""
    e = np.sqrt(x * x + y * y)
    rate, whirl = (x * vx + y * vy) / e, (x * vy - y * vx) / (e * e)
    q = 1 - e * e
    radial = -2 * e * e * (1 - 2 * whirl) / q**2 - np.pi * (1 + 2 * e * e) * rate / q**2.5
    tangential = np.pi * e * (1 - 2 * whirl) / (2 * q**1.5) + 4 * e * rate / q**2
    return (radial * x - tangential * y) / e, (radial * y + tangential * x) / e


FORCES = {"moving": force_of_moving_film, "fixed": force_of_fixed_film}


def force_by_quadrature(x, y, vx, vy, points=200000):
    """f of the moving film by summing the pressure, to check the closed form."""
    phi = (np.arange(points) + 0.5) * 2 * np.pi / points
    p = np.maximum((y + 2 * vx) * np.cos(phi) - (x - 2 * vy) * np.sin(phi), 0) / (1 - x * np.cos(phi) - y * np.sin(phi)) ** 3
    return tuple(-np.sum(p * direction(phi)) * 2 * np.pi / points for direction in (np.cos, np.sin))


class Rotor:
    """gamma and s of a balanced rotor, or of one with its mass centre u of a clearance off its axis."""

    def __init__(self, gamma, s, film="moving", unbalance=0.0):
        self.gamma, self.s, self.force, self.film, self.unbalance = gamma, s, FORCES[film], film, unbalance

    def rates(self, t, state):
        x, y, vx, vy = state
        fx, fy = self.force(x, y, vx, vy)
        k = self.gamma / self.s
        return np.array([vx, vy, k * fx + self.unbalance * np.cos(t), k * fy - 1 / self.s**2 + self.unbalance * np.sin(t)])

    def eccentricity(self):
        """Static eccentricity ratio."""
        return brentq(lambda e: load(e) * self.gamma * self.s - 1, 1e-6, 1 - 1e-9, xtol=1e-15)

    def equilibrium(self):
        e = self.eccentricity()
        radial, tangential = -2 * e * e / (1 - e * e) ** 2, np.pi * e / (2 * (1 - e * e) ** 1.5)
        # The force on the shaft, radial along e and tangential ahead of it, points to +y.
        angle = np.pi / 2 - np.arctan2(tangential, radial)
        return np.array([e * np.cos(angle), e * np.sin(angle), 0, 0])

    def jacobian(self, state, h=1e-5):
        """Of the rates, by central differences of fourth order."""
        columns = []
        for k in range(4):
            d = h * np.eye(4)[k]
            columns.append((8 * (self.rates(0, state + d) - self.rates(0, state - d)) - self.rates(0, state + 2 * d) + self.rates(0, state - 2 * d)) / (12 * h))
        return np.array(columns).T


def load(e):
    """|f| of a journal at rest at e."""
    q = 1 - e * e
    return e / (2 * q * q) * np.sqrt(16 * e * e + np.pi**2 * q)


def coefficients(e):
    """Stiffness and damping of f at the static eccentricity e, axes as above: K = -df/dr, C = -df/dr'."""
    A = Rotor(1 / load(e), 1).jacobian(Rotor(1 / load(e), 1).equilibrium()) * load(e)
    return -A[2:, :2], -A[2:, 2:]


def threshold_of_eccentricity(e):
    """(s, gamma, whirl ratio) at which a rotor whose journal floats at e begins to whirl, by Lund's equivalent stiffness; s is None where none does."""
    K, C = coefficients(e)
    k_eq = (K[0, 0] * C[1, 1] + K[1, 1] * C[0, 0] - K[0, 1] * C[1, 0] - K[1, 0] * C[0, 1]) / (C[0, 0] + C[1, 1])
    ratio2 = ((k_eq - K[0, 0]) * (k_eq - K[1, 1]) - K[0, 1] * K[1, 0]) / np.linalg.det(C)
    if ratio2 <= 0:
        return None, None, None
    # k_eq gamma/s = ratio2 and gamma s load = 1.
    gamma_over_s = ratio2 / k_eq
    gamma_s = 1 / load(e)
    return np.sqrt(gamma_s / gamma_over_s), np.sqrt(gamma_s * gamma_over_s), np.sqrt(ratio2)


def threshold(gamma):
    """(s, eccentricity, whirl ratio) at which a rotor with this gamma begins to whirl as it gains speed."""
    e = brentq(lambda e: threshold_of_eccentricity(e)[1] / gamma - 1, 1e-3, 0.74, xtol=1e-14)
    s, _, ratio = threshold_of_eccentricity(e)
    return s, e, ratio


def lyapunov(gamma, film, h=4e-3):
    """First Lyapunov coefficient at the threshold (Kuznetsov): negative, the limit cycle is stable and beyond it; positive, unstable and before it."""
    s, e, ratio = threshold(gamma)
    rotor = Rotor(gamma, s, film)
    x0 = rotor.equilibrium()
    A = rotor.jacobian(x0)
    values, right = np.linalg.eig(A)
    k = np.argmin(abs(values - 1j * ratio))
    q, w = right[:, k], values[k].imag
    values, left = np.linalg.eig(A.T)
    p = left[:, np.argmin(abs(values + 1j * ratio))]
    p = p / np.conj(np.vdot(p, q))
    F = lambda d: rotor.rates(0, x0 + d)

    def second(a):
        return (-F(2 * h * a) + 16 * F(h * a) - 30 * F(0 * a) + 16 * F(-h * a) - F(-2 * h * a)) / (12 * h * h)

    def third(a):
        return (-F(3 * h * a) + 8 * F(2 * h * a) - 13 * F(h * a) + 13 * F(-h * a) - 8 * F(-2 * h * a) + F(-3 * h * a)) / (8 * h**3)

    def real_b(a, b):
        return (second(a + b) - second(a - b)) / 4

    def b_of(a, b):
        return real_b(a.real, b.real) - real_b(a.imag, b.imag) + 1j * (real_b(a.real, b.imag) + real_b(a.imag, b.real))

    r, i = q.real, q.imag
    # C(q, q, conj q) of real directions.
    rri = (third(r + i) - third(r - i) - 2 * third(i)) / 6
    rii = (third(r + i) + third(r - i) - 2 * third(r)) / 6
    c = third(r) + rii + 1j * (third(i) + rri)
    inner = b_of(q, np.linalg.solve(A, b_of(q, np.conj(q))))
    outer = b_of(np.conj(q), np.linalg.solve(2j * w * np.eye(4) - A, b_of(q, q)))
    return (np.vdot(p, c - 2 * inner + outer)).real / (2 * w)
