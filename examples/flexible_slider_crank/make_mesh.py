#!/usr/bin/env python3
"""Writes rod.inp: a square bar of linear hexahedra with node sets on its ends, in millimetres."""

LENGTH, SIDE = 300.0, 20.0
CELLS, ACROSS = 20, 2


def node(i, j, k):
    return 1 + i + (CELLS + 1) * (j + (ACROSS + 1) * k)


def main():
    lines = ["** A bar of 300 x 20 x 20 mm along x, its axis on y = z = 0", "*NODE"]
    corners = [(i, j, k) for k in range(ACROSS + 1) for j in range(ACROSS + 1) for i in range(CELLS + 1)]
    for i, j, k in corners:
        x, y, z = LENGTH * i / CELLS, SIDE * (j / ACROSS - 0.5), SIDE * (k / ACROSS - 0.5)
        lines.append(f"{node(i, j, k)}, {x:g}, {y:g}, {z:g}")
    lines.append("*ELEMENT, TYPE=C3D8I, ELSET=rod")
    label = 0
    for k in range(ACROSS):
        for j in range(ACROSS):
            for i in range(CELLS):
                label += 1
                ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
                eight = [node(i + a, j + b, k + c) for c in (0, 1) for a, b in ring]
                lines.append(", ".join(str(n) for n in [label] + eight))
    for name, at in (("crank_end", 0), ("piston_end", CELLS)):
        lines.append(f"*NSET, NSET={name}")
        lines.append(", ".join(str(node(at, j, k)) for k in range(ACROSS + 1) for j in range(ACROSS + 1)))
    lines += ["*MATERIAL, NAME=steel", "*ELASTIC", "210000, 0.3", "*DENSITY", "7.85e-9",
              "*SOLID SECTION, ELSET=rod, MATERIAL=steel"]
    with open("rod.inp", "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
