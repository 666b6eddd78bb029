#!/usr/bin/python3
"""One number in every output: figures of `hersey bearing` as JSON, as CSV and printed; figures of a run as JSON, in the printed table and in the report;
rows of the results file and of the report.

    outputs_test.py HERSEY [Class.test_name]

By machine over the figures there are: a new one is compared without a word here.
"""

import base64
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import machine_models  # noqa: E402
import models  # noqa: E402
import runs  # noqa: E402
import tree as trees  # noqa: E402

HERSEY = os.path.abspath(sys.argv.pop(1))

# Printed units in SI; temperatures are compared as printed.
SI = {"": 1, "rpm": math.pi / 30, "deg": math.pi / 180, "°": math.pi / 180, "um": 1e-6, "µm": 1e-6, "mm": 1e-3, "MPa": 1e6, "mm^3/s": 1e-9, "mm³/s": 1e-9,
      "mm^3": 1e-9, "mm/s": 1e-3, "mW": 1e-3, "kW": 1e3, "kN": 1e3, "N·mm": 1e-3, "W/mm²": 1e6, "ms": 1e-3, "µs": 1e-6, "mJ": 1e-3, "kJ": 1e3, "%": 0.01, "mm²": 1e-6}

# Half of the last of the five digits that tables show, and of the ten of a CSV file.
OF_TABLE, OF_CSV = 0.6e-4, 1e-9

LINE = re.compile(r"  (\S.*?) {2,}(-?\d\S*)(?:  (\S+))?(?: {2,}.*)?$")

FIGURE = re.compile(r"  +(\S.*?) {2,}(-?\d[\d.e+-]*)(?:  (\S+))?(?: {2,}.*)?$")  # of a bearing by itself: what belongs to another is indented


def report_of(path):
    """The first run in a report's embedded data."""
    with open(path, encoding="utf-8") as file:
        text = re.search(r'<script id="hersey-data" type="application/json">(.*?)</script>', file.read(), re.S)[1]
    return json.loads(text)["runs"][0]


def numbers_in(file):
    names = []
    file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" else None)
    return names


def place_of(dataset):
    """One dataset may have several names."""
    return h5py.h5o.get_info(dataset.id).addr


def differing(values, dataset):
    """What of a dataset a report shows otherwise than the results have it: to single precision, or to the step of its scale."""
    shown = np.frombuffer(base64.b64decode(dataset["data"]), dataset["type"].replace("f", "<f").replace("u", "<u"))
    if list(dataset["shape"]) != list(values.shape):
        return f"shape {values.shape} shown as {dataset['shape']}"
    allowed = 1e-6 * np.abs(values).max(initial=0.0, where=np.isfinite(values))
    if "step" in dataset:
        low, step = (np.frombuffer(base64.b64decode(dataset[key]), "<f4") for key in ("low", "step"))
        layers = [-1] + [1] * (values.ndim - 1)
        allowed += 0.51 * np.abs(step).max(initial=0.0)
        shown = low.astype(float).reshape(layers) + step.astype(float).reshape(layers) * shown.reshape(values.shape)
    shown = shown.reshape(values.shape)
    finite = np.isfinite(values)
    apart = np.abs(shown[finite] - values[finite]).max(initial=0.0)
    return "" if apart <= allowed else f"up to {apart:.6g} apart"


def in_si(number, unit):
    return float(number) * SI.get(unit or "", 1)


class Outputs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="hersey-outputs-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_a_bearings_table_has_the_numbers_of_its_json(self):
        for name in ("PLAIN", "FULL", "HOT", "GLOBAL"):
            table = os.path.join(self.folder, name + ".csv")
            ending, figures = trees.bearing(HERSEY, trees.load(getattr(models, name)), self.folder, "--no-grid-error", "--csv", table)
            self.assertEqual(ending.kind, "answer", ending.text)
            with open(table, encoding="utf-8") as file:
                header, row = list(csv.reader(file, skipinitialspace=True))[:2]
            self.assertGreater(len(header), 30)
            for title, text in zip(header, row):
                key, _, unit = title.rstrip("]").partition(" [")
                value = figures.get(key, (None, ""))[0]
                if isinstance(value, float) and text and unit != "degC":
                    with self.subTest(f"{name} {key}"):
                        self.assertLessEqual(abs(in_si(text, unit) - value), OF_CSV * abs(value) + 1e-300)

    def test_a_bearings_printed_table_has_the_numbers_of_its_json(self):
        for name in ("PLAIN", "FULL", "HOT", "GLOBAL"):
            model = trees.write(trees.load(getattr(models, name)), self.folder)
            words = [HERSEY, "bearing", model, "--no-grid-error", "--jobs", "1"]
            printed = subprocess.run(words, capture_output=True, text=True, check=True).stdout
            document = json.loads(subprocess.run([*words, "--json"], capture_output=True, text=True, check=True).stdout)
            figures = [f for f in document["solutions"][0]["figures"].values() if isinstance(f["value"], float)]
            reported = [(match[1], in_si(match[2], match[3])) for match in map(FIGURE.match, printed.splitlines()) if match]
            self.assertGreater(len(reported), 30)

            def is_same(figure, line):
                return figure.get("label", figure["name"]).strip() == line[0] and abs(line[1] - figure["value"]) <= OF_TABLE * abs(figure["value"])

            for figure in figures:
                with self.subTest(f"{name} {figure['name']}"):
                    self.assertTrue(any(is_same(figure, line) for line in reported), f"{figure['value']} {figure['unit']}")
            for line in reported:
                with self.subTest(f"{name} printed {line[0]}"):
                    self.assertTrue(any(is_same(figure, line) for figure in figures), line[1])

    def test_a_runs_table_has_the_numbers_of_its_json(self):
        for name in ("CRANK", "ROTOR", "WORKSHOP", "WHIP"):
            ending, _ = runs.run(HERSEY, trees.load(getattr(machine_models, name)), self.folder, name)
            summary = [s for s in ending.document["summary"] if s["group"] != "computing" and isinstance(s["value"], float)]
            printed = self.printed(os.path.join(self.folder, name, "results.h5"))
            for figure in summary:
                with self.subTest(f"{name} {figure['name']}"):
                    reported = printed.get(figure["name"], [])
                    self.assertTrue(any(abs(value - figure["value"]) <= OF_TABLE * abs(figure["value"]) for value in reported),
                                    f"{figure['value']} {figure['unit']}, printed {reported}")

    def test_a_report_has_the_numbers_of_its_results(self):
        for name in ("CRANK", "ROTOR", "WORKSHOP", "WHIP"):
            ending, _ = runs.run(HERSEY, trees.load(getattr(machine_models, name)), self.folder, name)
            run = report_of(os.path.join(self.folder, name, "report.html"))
            self.assertEqual(run["series_stride"], 1)
            with h5py.File(os.path.join(self.folder, name, "results.h5")) as file:
                for path, dataset in run["datasets"].items():
                    with self.subTest(f"{name} {path}"):
                        self.assertEqual(differing(file[path][...], dataset), "")
                reported = {place_of(file[path]) for path in run["datasets"]}
                self.assertEqual([path for path in numbers_in(file) if place_of(file[path]) not in reported], [])
            for figure, shown in zip(ending.document["summary"], run["summary"]):
                if figure["group"] != "computing" and isinstance(figure["value"], float):
                    with self.subTest(f"{name} {figure['name']}"):
                        self.assertEqual(figure["name"], shown["name"])
                        value = in_si(shown["value"], shown["unit"])
                        self.assertLessEqual(abs(value - figure["value"]), OF_CSV * abs(figure["value"]))

    def printed(self, results):
        """{name: its values in SI} of all lines of the closing table."""
        done = subprocess.run([HERSEY, "report", "--all", results], capture_output=True, text=True, check=True)
        lines = {}
        for line in done.stdout.splitlines():
            if match := LINE.match(line):
                lines.setdefault(match[1], []).append(in_si(match[2], match[3]))
        return lines


if __name__ == "__main__":
    unittest.main()
