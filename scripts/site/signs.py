"""Drawings of frames, angles and signs."""

import math

import matplotlib.pyplot as plot
from matplotlib.patches import Arc, Circle

INK, BLUE, RED, GREEN = "#222222", "#1f4e9c", "#b3261e", "#2e7d32"


def unit(degrees):
    return math.cos(math.radians(degrees)), math.sin(math.radians(degrees))


def arrow(axes, start, end, colour, label="", offset=(0, 0)):
    axes.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "shrinkA": 0, "shrinkB": 0, "linewidth": 1.4})
    if label:
        axes.text(end[0] + offset[0], end[1] + offset[1], label, color=colour, ha="center", va="center", fontsize=9)


def angle(axes, centre, radius, start, end, colour, label, counter=True):
    """An arc with its head at `end`."""
    low, high = (start, end) if counter else (end, start)
    axes.add_patch(Arc(centre, 2 * radius, 2 * radius, theta1=low, theta2=high, color=colour, linewidth=1.2))
    x, y = unit(end)
    back = unit(end + (-6 if counter else 6))
    axes.annotate("", (centre[0] + radius * x, centre[1] + radius * y), (centre[0] + radius * back[0], centre[1] + radius * back[1]),
                  arrowprops={"arrowstyle": "-|>", "color": colour, "shrinkA": 0, "shrinkB": 0})
    x, y = unit((start + end) / 2)
    axes.text(centre[0] + (radius + 0.16) * x, centre[1] + (radius + 0.13) * y, label, color=colour, ha="center", va="center", fontsize=9)


def bare(axes, size):
    axes.set(aspect="equal", xticks=[], yticks=[], xlim=(-size, size), ylim=(-size, size))
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set_visible(False)


def bore(axes, epsilon, direction, load):
    """A journal in its bore, the gap enlarged."""
    c = 0.3
    x, y = unit(direction)
    e = (epsilon * c * x, epsilon * c * y)
    axes.add_patch(Circle((0, 0), 1 + c, fill=False, color=INK, linewidth=1.6))
    axes.add_patch(Circle(e, 1, color="#d7dbe3", ec=INK, linewidth=1.2))
    axes.plot([0, e[0]], [0, e[1]], "o-", color=RED, markersize=3, linewidth=1.4)
    lx, ly = unit(load)
    arrow(axes, (e[0], e[1]), (e[0] + 0.75 * lx, e[1] + 0.75 * ly), BLUE, "load", (0.28, 0.05))
    angle(axes, e, 0.72, 120, 200, GREEN, "")
    axes.text(e[0] - 0.42, e[1] + 0.3, "turns", color=GREEN, fontsize=8, ha="center")
    bare(axes, 1.5)


def bearing_signs():
    figure, (left, right) = plot.subplots(1, 2, figsize=(9, 4.4), gridspec_kw={"width_ratios": [1.25, 1]})
    c, epsilon, direction = 0.32, 0.62, -40
    ex, ey = unit(direction)
    e = (epsilon * c * ex, epsilon * c * ey)
    left.add_patch(Circle((0, 0), 1 + c, fill=False, color=INK, linewidth=1.8))
    left.add_patch(Circle(e, 1, color="#e3e7ee", ec=INK, linewidth=1.2))
    arrow(left, (0, 0), (1.72, 0), INK, "x", (0.1, 0))
    arrow(left, (0, 0), (0, 1.72), INK, "y", (0.12, 0))
    px, py = unit(115)
    left.plot([0, 1.5 * px], [0, 1.5 * py], color=BLUE, linewidth=1, linestyle=":")
    angle(left, (0, 0), 1.46, 0, 115, BLUE, "phi")
    gap = unit(150)
    left.annotate("", ((1 + c) * gap[0], (1 + c) * gap[1]), (e[0] + 0.96 * gap[0] - 0.04, e[1] + 0.98 * gap[1] + 0.02),
                  arrowprops={"arrowstyle": "<->", "color": GREEN})
    left.text(-1.0, 0.44, "h", color=GREEN)
    left.plot([0, e[0]], [0, e[1]], "o-", color=RED, markersize=4, linewidth=1.6)
    left.text(e[0] / 2 - 0.07, e[1] / 2 - 0.12, "e", color=RED)
    arrow(left, e, (e[0], e[1] - 0.8), BLUE, "load", (-0.2, 0.1))
    end = (1 + c) * ex, (1 + c) * ey
    left.plot([e[0], end[0]], [e[1], end[1]], color=RED, linewidth=0.8, linestyle="--")
    left.text(end[0] + 0.2, end[1] - 0.1, "h_min", color=RED, fontsize=9)
    angle(left, e, 0.5, -90, direction, INK, "")
    left.text(e[0] + 0.2, e[1] - 0.64, "attitude", fontsize=8)
    angle(left, e, 0.8, 150, 215, GREEN, "")
    left.text(e[0] - 0.36, e[1] + 0.05, "omega > 0", color=GREEN, fontsize=8, ha="center")
    left.text(0, -1.52, "along z: seen against the axis, z towards you", fontsize=8, ha="center", color=INK)
    bare(left, 1.9)
    right.set_title("cut along the axis", fontsize=9)
    right.plot([-1.2, 1.2], [1, 1], color=INK, linewidth=1.8)
    right.plot([-1.2, 1.2], [-1, -1], color=INK, linewidth=1.8)
    tilt = 0.1
    for side in (-0.78, 0.78):
        right.plot([-1.5, 1.5], [side - 0.1 - 1.5 * tilt, side - 0.1 + 1.5 * tilt], color=INK, linewidth=1.2)
    right.plot([-1.7, 1.7], [-0.1 - 1.7 * tilt, -0.1 + 1.7 * tilt], color=RED, linewidth=1, linestyle="-.")
    arrow(right, (0, 0), (1.75, 0), INK, "z", (0.1, 0))
    arrow(right, (0, 0), (0, 1.5), INK, "y", (0.12, 0))
    right.text(1.1, 0.2, "tilt t_y > 0", color=RED, fontsize=8)
    right.annotate("", (-1.2, -1.25), (1.2, -1.25), arrowprops={"arrowstyle": "<->", "color": INK})
    right.text(0, -1.45, "width L; z = 0 at mid-width", fontsize=8, ha="center")
    bare(right, 1.9)
    return figure


def frame_signs():
    figure, axes = plot.subplots(figsize=(7, 3.4))

    def frame(origin, turn, name, colour):
        for degrees, axis in ((0, "x"), (90, "y")):
            x, y = unit(turn + degrees)
            arrow(axes, origin, (origin[0] + 0.8 * x, origin[1] + 0.8 * y), colour, f"{axis}_{name}", (0.14 * x, 0.14 * y))
        axes.plot(*origin, "o", color=colour, markersize=4)

    a, b = (-1.8, -0.8), (0.9, 0.0)
    frame(a, 0, "A", INK)
    frame(b, 30, "B", BLUE)
    arrow(axes, a, b, RED)
    axes.text(-0.35, -0.5, "r_AB_E: from A's origin to B's,\nin the axes of E", color=RED, ha="left", va="top", fontsize=8)
    angle(axes, b, 0.95, 0, 30, GREEN, "")
    axes.plot([b[0], b[0] + 1.15], [b[1], b[1]], color=GREEN, linewidth=0.8, linestyle=":")
    axes.text(b[0] + 1.1, b[1] + 0.27, "R_AB: components in B to components in A", color=GREEN, fontsize=8)
    axes.text(-1.0, 1.05, "X_AC = X_AB X_BC: adjacent letters cancel\nV_AB_E: velocity of B relative to A, [omega; v], in the axes of E", fontsize=8, color=INK)
    axes.set(aspect="equal", xticks=[], yticks=[], xlim=(-2.6, 4.2), ylim=(-1.3, 1.5))
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    return figure
