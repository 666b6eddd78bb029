#!/usr/bin/python3
"""The results file as other programs see it: units, names, dimensions, xarray, the reference page, equal bits."""

import fcntl
import glob
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

HERSEY = os.path.abspath(sys.argv.pop(1))
SOURCE = os.path.abspath(sys.argv.pop(1))
PAGE = os.path.join(SOURCE, "docs/results-file.md")

# Short runs that hold every kind of part: rigid and flexible bodies, beams, films, contacts, cycles, modes.
ENGINE = ["--set", "simulation.cycle.period=4deg", "--set", "simulation.cycle.most=1", "--set",
          "simulation.cycle.until_converged=0"]
RUNS = {
    "engine": ENGINE,
    "four_bar": ["--set", "simulation.duration=10ms"],
    "geared_rotors": ["--set", "simulation.duration=1ms"],
    "ball_drop": ["--set", "simulation.duration=10ms"],
    "spinning_rod": ["--set", "simulation.duration=20ms"],
    "flexible_slider_crank": ["--set", "simulation.duration=1ms"],
    "examples/conrod_pressure/static.yaml": [],
    "examples/flexible_rotor/modes.yaml": [],
    "examples/hot_pedestal/with_shaft.yaml": ["--set", "simulation.duration=0.2ms", "--set", "bearings.main.grid.circumferential=36",
                                              "--set", "bearings.main.grid.axial=7"],
    "examples/oil_whirl/unbalance.yaml": ["--set", "study.parameters.speed=[9000rpm]", "--set", "bearings.left.grid.circumferential=24",
                                          "--set", "bearings.right.grid.circumferential=24"],
    "examples/plane_slider/carriage.yaml": ["--set", "simulation.duration=2ms", "--set",
                                            "simulation.cycle={period: 1 ms, most: 2}", "--set",
                                            "bearings.pad.thermal={model: film, supply_temperature: 40 degC}"],
    "examples/tilting_pads/model.yaml": [],
    "tests/results_file/pads.yaml": [],
    "oil_circuit": ["--set", "simulation.duration=2ms"],
    "examples/piston/rings.yaml": ["--set", "simulation.duration=2deg", "--set", "simulation.cycle.period=1deg"],
    "examples/oil_circuit/passing_hole.yaml": ["--set", "simulation.duration=2ms", "--set",
                                                "circuit.elements.crank.course=through_axis"],
    "examples/oil_circuit/warm.yaml": [],
    "wear": ["--set", "simulation.duration=2ms", "--set",
             "bearings.bush.wear.running_in={roughness: 0.3 um, depth: 0.5 um}"],
    "tests/results_file/thrust.yaml": [],
    "tests/results_file/every_line.yaml": ["--step-error", "--set", "simulation.duration=0.5ms"],
}
# Lines that no run of seconds has: films on elastic surfaces, modes of meshed bodies, meshes as shapes of ground; and those of FMUs,
# which tests/fmu/import_test.py compares.
RARE = {"/bearings/<b>/fields/shell_displacement", "/bearings/<b>/fields/journal_displacement",
        "/modes/fields/<b>_amplitudes_shape", "/ground/shapes/<s>/corners", "/ground/shapes/<s>/triangles",
        "/fmus/<u>/<input>", "/fmus/<u>/<output>"}
_folder = tempfile.TemporaryDirectory(prefix="hersey-results-")
# Each test is a process of its own: what one has run serves the others, as long as program and models are the same.
KEPT = os.path.join(os.path.dirname(HERSEY), "kept-results")
_files, _lines = {}, []


def run(example, name, *arguments, **environment):
    """Runs an example, as `name`, and returns its results file."""
    out = os.path.join(_folder.name, name)
    model = example if example.endswith(".yaml") else f"examples/{example}/model.yaml"
    done = subprocess.run([HERSEY, "run", os.path.join(SOURCE, model), "--output", out,
                           "--force", *arguments], capture_output=True, text=True, timeout=600, check=False,
                          env={**os.environ, **environment})
    if done.returncode != 0:
        raise RuntimeError(f"{example}: {done.stderr}")
    return glob.glob(os.path.join(out, "*.h5"))[0]


def content_of_runs():
    """A hash of all that these runs depend on."""
    known = hashlib.sha256(repr(RUNS).encode())
    inputs = glob.glob(os.path.join(SOURCE, "examples", "**", "*.*"), recursive=True)
    for path in (HERSEY, os.path.join(SOURCE, "tests/results_file/every_line.yaml"), *sorted(inputs)):
        with open(path, "rb") as file:
            known.update(file.read())
    return known.hexdigest()[:16]


def results(example):
    if example not in _files:
        folder = os.path.join(KEPT, content_of_runs())
        kept = os.path.join(folder, os.path.basename(example) + ".h5")
        os.makedirs(folder, exist_ok=True)
        with open(kept + ".lock", "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)  # who comes second waits for what the first is making
            if not os.path.exists(kept):
                made = run(example, os.path.basename(example), *RUNS[example])
                for old in glob.glob(os.path.join(KEPT, "*")):
                    if old != folder:
                        shutil.rmtree(old, ignore_errors=True)
                half = kept + ".half"  # whole files only, whatever ends this process
                shutil.copy(made, half)
                os.replace(half, kept)
        _files[example] = kept
    return _files[example]


def datasets(file):
    """Path of each dataset under the name it was made with, and the dataset."""
    found = {}

    def visit(group):
        for name, item in group.items():
            path = f"{group.name.rstrip('/')}/{name}"
            if isinstance(item, h5py.Group):
                visit(item)
            elif item.attrs.get("path", path.encode()).decode() == path:
                found[path] = item

    visit(file)
    return found


class ResultsFile(unittest.TestCase):
    def test_every_dataset_has_unit_and_long_name(self):
        for example in RUNS:
            with h5py.File(results(example)) as file:
                for path, data in datasets(file).items():
                    with self.subTest(example=example, dataset=path):
                        self.assertTrue(data.attrs.get("units"))
                        self.assertTrue(data.attrs.get("long_name"))

    def test_every_dimension_is_a_named_scale_of_its_group(self):
        for example in RUNS:
            with h5py.File(results(example)) as file:
                for path, data in datasets(file).items():
                    if data.attrs.get("CLASS") == b"DIMENSION_SCALE" or data.shape == ():
                        continue
                    for axis, dimension in enumerate(data.dims):
                        with self.subTest(example=example, dataset=path, axis=axis):
                            self.assertEqual(len(dimension), 1)
                            scale = dimension[0]
                            self.assertEqual(scale.shape, (data.shape[axis],))
                            name = scale.attrs["NAME"].decode()
                            self.assertEqual(data.parent[name], scale)

    def test_films_open_in_xarray(self):
        import xarray

        file = results("engine")
        with h5py.File(file) as content:
            bearing = next(iter(content["bearings"]))
        with xarray.open_dataset(file, group=f"bearings/{bearing}", engine="h5netcdf") as film:
            self.assertEqual(film["h_min"].dims, ("time",))
            self.assertEqual(film["force"].dims, ("time", "xyz"))
            self.assertEqual(film["h_min_around"].dims, ("time", "phi"))
            self.assertIn("time", film.coords)
            self.assertEqual(film["h_min"].attrs["units"], "m")
            self.assertEqual(float(film["force"].sel(xyz="x")[0]), float(film["force"][0, 0]))
        with xarray.open_dataset(file, group=f"bearings/{bearing}/fields", engine="h5netcdf") as fields:
            self.assertEqual(fields["pressure"].dims, ("time", "phi", "z"))
            self.assertEqual(fields["z"].attrs["units"], "m")

    def test_every_group_opens_in_xarray(self):
        import xarray

        seen = set()
        for example in RUNS:
            file = results(example)
            with h5py.File(file) as content:
                kinds = {contents(content[path]): path for path in groups(content)}  # groups alike open alike
            new = {kind: path for kind, path in kinds.items() if kind not in seen}
            seen |= set(new)
            for group in new.values():
                with self.subTest(example=example, group=group):
                    with xarray.open_dataset(file, group=group, engine="h5netcdf") as opened:
                        opened.load()
                        self.assertFalse([name for name in opened.dims if name.startswith("phony")])

    def test_the_reference_page_lists_every_dataset(self):
        patterns = documented()
        for example in RUNS:
            with h5py.File(results(example)) as file:
                for path in datasets(file):
                    with self.subTest(example=example, dataset=path):
                        self.assertTrue(any(re.fullmatch(pattern, path) for pattern in patterns), path)

    def test_every_dataset_is_in_the_tables_with_its_unit_and_text(self):
        for example in RUNS:
            with h5py.File(results(example)) as file:
                for path, data in datasets(file).items():
                    lines = [line for line in tables() if line.kind != "attribute" and re.fullmatch(line.path, path)]
                    unit, text = data.attrs["units"], data.attrs["long_name"]
                    with self.subTest(example=example, dataset=path, unit=unit, text=text):
                        self.assertTrue(any(unit in line.units and (line.is_dimension or re.fullmatch(line.text, text))
                                            for line in lines))

    def test_every_attribute_of_a_group_is_in_the_tables(self):
        attributes = [line.path for line in tables() if line.kind == "attribute"]
        for example in RUNS:
            with h5py.File(results(example)) as file:
                for path in groups(file):
                    for name in file[path].attrs:
                        with self.subTest(example=example, group=path, attribute=name):
                            name = f"{path.rstrip('/')}/{name}"
                            self.assertTrue(any(re.fullmatch(pattern, name) for pattern in attributes))

    def test_every_line_of_the_tables_is_in_some_run(self):
        found = set()
        for example in RUNS:
            with h5py.File(results(example)) as file:
                found |= set(datasets(file))
                for path in groups(file):
                    found |= {f"{path.rstrip('/')}/{name}" for name in file[path].attrs}
        for line in tables():
            with self.subTest(line=line.name):
                self.assertTrue(line.name in RARE or any(re.fullmatch(line.path, path) for path in found))

    def test_results_are_the_same_for_any_number_of_threads(self):
        files = [run("engine", f"threads{n}", *ENGINE, "--threads", str(n))
                 for n in (1, 2, 5)]
        self.assert_same_bits(files)

    def test_results_are_the_same_for_any_number_of_blas_threads(self):
        files = [run("flexible_slider_crank", f"blas{n}", *RUNS["flexible_slider_crank"], OPENBLAS_NUM_THREADS=str(n),
                     OMP_NUM_THREADS=str(n)) for n in (1, 2, 3)]
        self.assert_same_bits(files)

    def assert_same_bits(self, files):
        with h5py.File(files[0]) as first:
            expected = datasets(first)
            for other in files[1:]:
                with h5py.File(other) as file:
                    self.assertEqual(set(datasets(file)), set(expected))
                    for path, data in datasets(file).items():
                        if h5py.check_string_dtype(data.dtype) is None:
                            with self.subTest(dataset=path):
                                self.assertTrue(np.array_equal(data[()], expected[path][()], equal_nan=True))


class Line:
    """A quantity of the tables that results are written by, its paths and texts as regular expressions."""

    def __init__(self, group, quantity):
        self.kind, self.units, self.name = quantity["kind"], quantity["units"], group["path"] + quantity["name"]
        self.path, self.text = pattern_of(self.name), pattern_of(quantity["text"])
        self.is_dimension = quantity.get("note", "").startswith("dimension of")


def pattern_of(text):
    """<b> stands for one name."""
    return re.sub(r"<[a-z_]+>", "[^/]+", re.escape(text))


def tables():
    """All lines of `hersey schema --results`."""
    if not _lines:
        done = subprocess.run([HERSEY, "schema", "--results"], capture_output=True, text=True, check=True)
        _lines.extend(Line(group, quantity) for group in json.loads(done.stdout)["groups"]
                      for quantity in group["quantities"])
    return _lines


def groups(file):
    """Paths of all groups."""
    found = ["/"]
    file.visititems(lambda name, item: found.append("/" + name) if isinstance(item, h5py.Group) else None)
    return found


def contents(group):
    """Names of what a group itself holds, of data with how many dimensions they have."""
    return tuple((name, getattr(item, "ndim", None)) for name, item in group.items())


def documented():
    """Regular expressions of the paths in the page's tables: <b> is one name, ... any number of them."""
    patterns, prefix = [], ""
    with open(PAGE, encoding="utf-8") as page:
        for line in page:
            cells = line.split("|")
            if len(cells) < 3 or cells[2].strip() == "attribute":
                continue
            if heading := re.search(r"in `(/[^`]*/)`", cells[1]):
                prefix = heading[1]
                continue
            folder = prefix
            for name in re.findall(r"`([^`]+)`", cells[1]):
                path = name if name.startswith("/") else (prefix if "/" in name else folder) + name
                folder = path[: path.rfind("/") + 1]  # of the names that follow in this row
                escaped = re.escape(path).replace(re.escape("..."), ".+")
                patterns.append(re.sub(r"<[a-z_]+>", "[^/]+", escaped))
    return patterns


if __name__ == "__main__":
    unittest.main()
