#!/usr/bin/python3
"""What the place of a feature's borders between the nodes does to load and flow.

A bearing is turned as a whole, groove, pocket and load, by quarters of a cell: nothing in it changes, and what changes in
the answer is what the grid makes of borders that lie between its nodes. Printed are the means over these four and the
range between them, on grids of twice the fineness each.

Usage: feature_borders.py HERSEY [FOLDER]
exit code 0 if from 60 to 240 nodes the ranges of fed features and round pockets fall to an eighth or below 0.01 %.
"""

import json
import os
import subprocess
import sys
import tempfile

MODEL = """hersey: 1
lubricants:
  oil: {{viscosity: 27.7 mPa.s}}
bearings:
  main:
    diameter: 100 mm
    width: 80 mm
    radial_clearance: 145 um
    lubricant: oil
    features: {{{features}}}
    grid: {{circumferential: {around}, axial: {along}}}
    shear_force: torque_only
    operating_point: {{journal_speed: 2000 rpm, eccentricity_ratio: 0.7, eccentricity_angle: {load} deg}}
"""
FED_GROOVE = "groove: {{shape: axial_groove, angle: {:g} deg, arc: 19 deg, length: 50 mm, pressure: 70 kPa, depth: 5 mm}}"
FED_HOLE = "hole: {{shape: hole, angle: {:g} deg, diameter: 22 mm, pressure: 170 kPa, depth: 5 mm}}"
POCKET = "pocket: {{shape: axial_groove, angle: {:g} deg, arc: 19 deg, length: 50 mm, depth: {}}}"
ROUND = "pocket: {{shape: hole, angle: {:g} deg, diameter: 22 mm, depth: 100 um}}"
GRIDS = ((60, 13), (120, 25), (240, 49))
FIGURES = {"load": 1, "side_flow": 1e9}  # printed in N and mm^3/s


def solved(hersey, features, around, along, turned):
    with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
        file.write(MODEL.format(features=", ".join(features), around=around, along=along, load=230 + turned))
        file.flush()
        run = subprocess.run([hersey, "bearing", file.name, "--json"], capture_output=True, text=True, check=True)
    figures = json.loads(run.stdout)["solutions"][0]["figures"]
    return [scale * figures[name]["value"] for name, scale in FIGURES.items()]


def cases():
    yield "fed groove", True, lambda turned: [FED_GROOVE.format(turned)]
    yield "fed hole", True, lambda turned: [FED_HOLE.format(turned)]
    for name, falls, pocket in (("pocket of 100 um", False, POCKET.replace("{}}}", "100 um}}")),
                                ("pocket of 2 mm", False, POCKET.replace("{}}}", "2 mm}}")), ("round pocket", True, ROUND)):
        yield name, falls, lambda turned, pocket=pocket: [FED_GROOVE.format(30 + turned), pocket.format(190 + turned)]


def main():
    hersey, status = os.path.abspath(sys.argv[1]), 0
    print(f"{'':18}{'grid':>9}" + "".join(f"{name:>12}{'range, %':>10}" for name in FIGURES))
    for name, falls, features in cases():
        ranges = []
        for around, along in GRIDS:
            turned = [360 / around * k / 4 for k in range(4)]
            columns = list(zip(*(solved(hersey, features(t), around, along, t) for t in turned)))
            means = [sum(column) / len(column) for column in columns]
            ranges.append([100 * (max(c) - min(c)) / m for c, m in zip(columns, means)])
            print(f"{name:18}{around:5} x{along:3}" + "".join(f"{m:12.5g}{r:10.3f}" for m, r in zip(means, ranges[-1])))
        if falls and any(last > max(first / 8, 0.01) for first, last in zip(ranges[0], ranges[-1])):
            print(f"  {name}: falls too little")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
