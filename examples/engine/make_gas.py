#!/usr/bin/env python3
"""make_gas.py [FILE]: writes gas_pressure.csv, the pressure on the piston over four strokes above the atmosphere.

A cylinder without friction, leaks or waves: constant pressure while a valve is open, compression and expansion with
p V^n = constant, heat released by Wiebe's function in between, an exponential blow-down when the exhaust valve opens. The heat
is added to an ideal gas of constant kappa: dp = (kappa - 1)/V dQ - n p/V dV.
"""

import math
import sys

BORE, STROKE, ROD = 0.075, 0.080, 0.140  # [m]
COMPRESSION = 9.5  # ratio of the volumes
ATMOSPHERE, INTAKE, EXHAUST = 1.013e5, 0.85e5, 1.10e5  # [Pa]
POLYTROPIC, KAPPA = 1.33, 1.33
HEAT = 620.0  # released in a cycle [J]
START, LENGTH = 345.0, 55.0  # of the heat release, 360 is ignition's top dead centre [deg]
OPENS, FALL = 500.0, 20.0  # exhaust valve, and how fast the pressure falls then [deg]
STEP = 1  # of the table [deg]
FINE = 100  # steps of the integration in one of the table


def volume(angle):
    """Of the cylinder at a crank angle [deg]; 0 is top dead centre."""
    r = STROKE / 2
    s = math.sin(math.radians(angle))
    down = r + ROD - r * math.cos(math.radians(angle)) - math.sqrt(ROD**2 - (r * s) ** 2)
    area = math.pi / 4 * BORE**2
    return area * (STROKE / (COMPRESSION - 1) + down)


def burnt(angle):
    """Share of the heat released: Wiebe's function with a = 6.9, m = 2."""
    x = min(max((angle - START) / LENGTH, 0), 1)
    return 1 - math.exp(-6.9 * x**3)


def pressures():
    """Absolute pressure [Pa] at every STEP degrees of 0..720."""
    p, found = INTAKE, []
    for k in range(720 // STEP):
        angle = k * STEP
        if angle < 30:  # valves overlap: from the exhaust stroke's pressure to the intake's
            p = EXHAUST + (INTAKE - EXHAUST) * 0.5 * (1 - math.cos(math.pi * angle / 30))
        elif angle < 180:
            p = INTAKE
        found.append(p)
        if angle < 180:
            continue
        for j in range(FINE):
            a, b = (angle + STEP * (j + i) / FINE for i in (0, 1))
            if a < OPENS:
                va, vb = volume(a), volume(b)
                p = p * (va / vb) ** POLYTROPIC + (KAPPA - 1) / vb * HEAT * (burnt(b) - burnt(a))
            else:
                p += (EXHAUST - p) * (1 - math.exp(-STEP / FINE / FALL))
    return found


def main():
    table = pressures()
    with open(sys.argv[1] if len(sys.argv) > 1 else "gas_pressure.csv", "w", encoding="ascii") as file:
        file.write("angle [deg], pressure [bar]\n")
        for k, p in enumerate(table + table[:1]):
            file.write(f"{k * STEP}, {(p - ATMOSPHERE) / 1e5:.4f}\n")
    work = sum(0.5 * (a + b) * (volume((k + 1) * STEP) - volume(k * STEP))
               for k, (a, b) in enumerate(zip(table, table[1:] + table[:1])))
    peak = max(range(len(table)), key=table.__getitem__)
    print(f"peak {(table[peak] - ATMOSPHERE) / 1e5:.1f} bar at {peak * STEP} deg, work of the gas {work:.1f} J")


if __name__ == "__main__":
    main()
