#!/usr/bin/python3
"""The copy of results as netCDF: the same numbers, by the CF conventions, as other programs read it.

python netcdf_test.py HERSEY [tests]

No checker of the CF conventions is packaged for Debian: what their conformance document requires of such a file stands here, by sections.
Programs that are not installed are skipped, with their name.
"""

import ctypes
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unicodedata
import unittest

import h5py
import numpy as np

HERSEY = os.path.abspath(sys.argv.pop(1))
ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")  # 2.3 of the conventions
BARE = b"This is a netCDF dimension but not a netCDF variable."
RUNS = {  # temperatures, restrictors, couplings, a study; cycles and flexible bodies; frequencies, some of them equal; pads
    "every_line": ["tests/results_file/every_line.yaml", "--step-error", "--set", "simulation.duration=0.5ms"],
    "engine": ["examples/engine/model.yaml", "--set", "simulation.cycle.period=4deg", "--set", "simulation.cycle.most=1", "--set",
               "simulation.cycle.until_converged=0"],
    "modes": ["examples/flexible_rotor/modes.yaml"],
    "pads": ["tests/results_file/pads.yaml"],
}


def hersey(*arguments, expect=0):
    done = subprocess.run([HERSEY, *map(str, arguments)], capture_output=True, text=True, timeout=600, stdin=subprocess.DEVNULL, check=False)
    assert done.returncode == expect, f"{arguments}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def variables(file):
    """Path of each dataset under the name it was made with: dimensions have links in other groups."""
    found = {}

    def visit(group):
        for name, item in group.items():
            if isinstance(item, h5py.Group):
                visit(item)
            elif item.attrs.get("path", f"{group.name.rstrip('/')}/{name}".encode()).decode() == f"{group.name.rstrip('/')}/{name}":
                found[f"{group.name.rstrip('/')}/{name}"] = item

    visit(file)
    return found


def is_bare(data):
    return data.attrs.get("NAME", b"").startswith(BARE)


def is_scale(data):
    return data.attrs.get("CLASS") == b"DIMENSION_SCALE"


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


class Udunits:
    """The library by which the conventions define units."""

    def __init__(self):
        self.library = ctypes.CDLL("libudunits2.so.0")
        for name in ("ut_read_xml", "ut_parse"):
            getattr(self.library, name).restype = ctypes.c_void_p
        self.library.ut_parse.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]
        self.library.ut_set_error_message_handler.argtypes = [ctypes.c_void_p]
        self.library.ut_set_error_message_handler(ctypes.cast(self.library.ut_ignore, ctypes.c_void_p))
        self.system = self.library.ut_read_xml(None)

    def knows(self, unit):
        return bool(self.library.ut_parse(self.system, unit.encode(), 2))  # UT_UTF8


class Copies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory(prefix="hersey-netcdf-"))
        cls.files = {}

    def copies(self, only=None):
        """Results and copy of each run."""
        for name, arguments in RUNS.items():
            if only and name not in only:
                continue
            if name not in self.files:
                out = os.path.join(self.folder, name)
                hersey("run", os.path.join(ROOT, arguments[0]), "--output", out, *arguments[1:])
                results = next(os.path.join(out, file) for file in os.listdir(out) if file.endswith(".h5"))
                target = os.path.join(self.folder, name + ".nc")
                self.files[name] = (results, target, json.loads(hersey("export", results, "--netcdf", target, "--json")))
            yield name, *self.files[name]

    def test_numbers_are_those_of_the_results(self):
        for name, results, target, printed in self.copies():
            with h5py.File(results) as file, h5py.File(target) as copy:
                expected, found, left_out = variables(file), variables(copy), []
                for path, data in expected.items():
                    with self.subTest(run=name, dataset=path):
                        if data.attrs["units"] == "SI":
                            left_out += [] if "column_units" in data.attrs else [path]
                            self.assertNotIn(path, found)
                            for k, unit in enumerate(data.attrs.get("column_units", [])):
                                column = found[f"{path}_{data.parent['coordinate'].asstr()[k]}"]
                                self.assertEqual(column.attrs["units"].decode(), unit)
                                self.assertTrue(np.array_equal(column[()], data[:, k]))
                        elif h5py.check_string_dtype(data.dtype) is None and data.size > 0:
                            self.assertEqual(found[path].dtype, data.dtype)
                            self.assertTrue(np.array_equal(found[path][()], data[()], equal_nan=True))
                            self.assertEqual(text(found[path].attrs["long_name"]), data.attrs["long_name"])
                self.assertEqual(sorted(left_out), printed["left_out"])
                # Texts lie in characters; labels of a dimension under a name of their own.
                self.assertEqual(b"".join(copy["model"][()]).rstrip(b"\0").decode(), file["model"][()].decode())
                if "xyz_name" in found:
                    self.assertEqual([b"".join(row) for row in copy["xyz_name"][()]], list(file["xyz"][()]))

    def test_attributes_are_those_of_the_results(self):
        for name, results, target, _ in self.copies():
            with h5py.File(results) as file, h5py.File(target) as copy:
                def same(path, group):
                    if not isinstance(group, h5py.Group):
                        return
                    for key, value in group.attrs.items():
                        found = copy[path].attrs[re.sub(r"[^A-Za-z0-9_.-]", "_", key)]
                        with self.subTest(run=name, group=path, attribute=key):
                            if isinstance(value, str):
                                self.assertEqual("" if isinstance(found, h5py.Empty) else text(found), value)
                            elif isinstance(value, np.ndarray) and value.dtype == object:
                                self.assertEqual(text(found), ", ".join(value))
                            elif not isinstance(value, h5py.Empty):
                                self.assertEqual(found, value)

                same("/", file)
                file.visititems(same)
                self.assertRegex(text(copy.attrs["source"]), r"hersey \d")
                self.assertRegex(text(copy.attrs["history"]), r"\d{4}-\d\d-\d\dT[0-9:]+Z run\n\d{4}-\d\d-\d\dT[0-9:]+Z hersey export")

    def test_it_is_a_file_by_the_conventions(self):
        udunits = Udunits()
        for name, _, target, printed in self.copies():
            with h5py.File(target) as file:
                def attributes(path, item):
                    for key, value in item.attrs.items():
                        with self.subTest(run=name, object=path, attribute=key):
                            if isinstance(value, bytes):  # 2.2: text in UTF-8 in the composed form, of fixed length or scalar
                                self.assertEqual(unicodedata.normalize("NFC", value.decode()), value.decode())
                            elif key not in ("DIMENSION_LIST", "_FillValue") and not isinstance(value, h5py.Empty):
                                self.assertIsInstance(value, (float, np.floating))
                            if path != "/":
                                self.assertNotIn(key, ("Conventions", "external_variables"))  # 2.7

                attributes("/", file)
                file.visititems(attributes)
                self.assertEqual(file.attrs["Conventions"], printed["conventions"].encode())  # 2.6.1
                self.assertEqual(printed["conventions"], "CF-1.11")
                count = 0
                for path, data in variables(file).items():
                    count += not is_bare(data)
                    with self.subTest(run=name, variable=path):
                        # 2.3, a recommendation: groups keep the names of the results, "shaft.disc" of a frame
                        self.assertRegex(path.rpartition("/")[2], rf"^{NAME.pattern}$")
                        if not is_bare(data):
                            self.variable(path, data, udunits)
                self.assertEqual(count, printed["variables"])

    def variable(self, path, data, udunits):
        dimensions = [path] if is_scale(data) else [text(data.dims[axis][0].attrs["path"]) for axis in range(data.ndim)]
        self.assertEqual(len({name.rpartition("/")[2] for name in dimensions}), data.ndim)  # 2.4
        for name in dimensions:  # 2.7: each is found in the variable's own group
            self.assertEqual(data.parent[name.rpartition("/")[2]], data.file[name])
        self.assertTrue(text(data.attrs["long_name"]))  # 3.2
        if data.dtype.kind == "S":  # 2.5: no text is called as its dimension
            self.assertEqual(data.dtype.itemsize, 1)
            self.assertNotIn("units", data.attrs)
            self.assertNotIn(path, dimensions)
            return
        unit = text(data.attrs["units"])
        self.assertTrue(udunits.knows(unit), unit)  # 3.1
        if re.search("[A-Za-z]", unit):
            self.assertNotRegex(unit, r"(^|[ ./*])[0-9]")
        is_temperature = "K" in unit or unit == "degC"
        self.assertEqual("units_metadata" in data.attrs, is_temperature)
        if is_temperature:
            self.assertIn(data.attrs["units_metadata"], (b"temperature: on_scale", b"temperature: difference"))
        if is_scale(data):  # 5: numbers that rise or fall, without gaps
            self.assertEqual(data.ndim, 1)
            steps = np.diff(data[()])
            self.assertTrue((steps > 0).all() or (steps < 0).all())
            self.assertNotIn("_FillValue", data.attrs)
        elif np.isnan(data[()]).any():  # 2.5.1
            self.assertEqual(data.attrs["_FillValue"].dtype, data.dtype)
            self.assertTrue(np.isnan(data.attrs["_FillValue"]).all())
        else:
            self.assertNotIn("_FillValue", data.attrs)
        for name in text(data.attrs.get("coordinates", b"")).split():  # 5: auxiliary coordinates lie on dimensions of the variable
            beside = data.parent[name]
            own = [text(beside.dims[axis][0].attrs["path"]) for axis in range(beside.ndim)]
            self.assertLessEqual(set(own[:1] if beside.dtype.kind == "S" else own), set(dimensions))

    def test_frequencies_are_no_dimension(self):
        for _, _, target, _ in self.copies(["modes"]):
            with h5py.File(target) as file:
                fields = file["modes/fields"]
                if is_scale(fields["frequency"]):
                    steps = np.diff(fields["frequency"][()])
                    self.assertTrue((steps > 0).all())
                else:
                    self.assertEqual(fields["damping_ratio"].attrs["coordinates"].decode().split()[0], "frequency")

    def test_the_netcdf_library_reads_all_of_it(self):
        try:
            import netCDF4
        except ImportError:
            self.skipTest("python3-netcdf4 is not installed")
        for name, _, target, _ in self.copies():
            with netCDF4.Dataset(target) as file, h5py.File(target) as expected:
                found = set()

                def visit(group):
                    for key, variable in group.variables.items():
                        path = f"{group.path.rstrip('/')}/{key}"
                        with self.subTest(run=name, variable=path):
                            self.assertFalse([one for one in variable.dimensions if one.startswith("phony")])
                            variable.set_auto_maskandscale(False)
                            variable.set_auto_chartostring(False)
                            self.assertTrue(np.array_equal(variable[...], expected[path][()], equal_nan=variable.dtype.kind == "f"))
                        found.add(path)
                    for child in group.groups.values():
                        visit(child)

                visit(file)
                self.assertLessEqual({path for path, data in variables(expected).items() if not is_bare(data)}, found)

    def test_xarray_has_names_and_units(self):
        import xarray

        for engine in ("h5netcdf", "netcdf4"):
            if engine == "netcdf4" and subprocess.run([sys.executable, "-c", "import netCDF4"], capture_output=True, check=False).returncode:
                self.skipTest("python3-netcdf4 is not installed")
            for _, _, target, _ in self.copies(["every_line"]):
                with xarray.open_dataset(target, group="bearings/main", engine=engine) as film:
                    self.assertEqual(film["h_min"].dims, ("time",))
                    self.assertEqual(film["force"].dims, ("time", "xyz"))
                    self.assertEqual(film["h_min"].attrs["units"], "m")
                    self.assertEqual([text(one) for one in film["xyz_name"].values], ["x", "y", "z"])
                    self.assertEqual(film["time"].dtype.kind, "f")  # time since the start is no date
                with xarray.open_dataset(target, group="bearings/main/fields", engine=engine) as fields:
                    self.assertEqual(fields["pressure"].dims, ("time", "phi", "z"))
                    self.assertEqual(fields["temperature"].attrs["units"], "degC")

    def test_octave_reads_numbers_texts_and_units(self):
        if not shutil.which("octave-cli") or subprocess.run(["octave-cli", "--eval", "pkg load netcdf"], capture_output=True,
                                                            check=False).returncode:
            self.skipTest("octave and octave-netcdf are not installed")
        for _, _, target, _ in self.copies(["every_line"]):
            with h5py.File(target) as file:
                thinnest = file["bearings/main/h_min"][()].min()
                title = file.attrs["title"].decode()
            script = f"""
                pkg load netcdf
                h = ncread("{target}", "/bearings/main/h_min");
                printf("%.17g\\n", min(h));
                printf("%s\\n", ncreadatt("{target}", "/bearings/main/h_min", "units"));
                printf("%s\\n", ncreadatt("{target}", "/bearings/main/h_min", "long_name"));
                printf("%s\\n", ncreadatt("{target}", "/", "title"));
                printf("%s\\n", ncread("{target}", "/bearings/main/xyz_name"));
                printf("%d ", size(ncread("{target}", "/bearings/main/fields/pressure")));
            """  # its ncinfo fails on every file whose groups differ
            done = subprocess.run(["octave-cli", "--eval", script], capture_output=True, text=True, timeout=120, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            lines = done.stdout.splitlines()
            self.assertEqual(float(lines[0]), thinnest)
            self.assertEqual(lines[1:5], ["m", "smallest film thickness beside features with depth, edges included", title, "xyz"])
            self.assertRegex(lines[5], r"^11 48 \d+")  # the fastest dimension first

    def test_programs_of_others_read_it(self):
        missing = []
        for _, _, target, _ in self.copies(["every_line"]):
            for program, *arguments in (["ncdump", "-h", target], ["ncks", "-m", "-g", "/bearings/main/fields", "-v", "pressure", target]):
                if not shutil.which(program):
                    missing.append(program)
                    continue
                done = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=120, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertRegex(done.stdout, r'pressure:units = "Pa"')
            if not shutil.which("Rscript") or subprocess.run(["Rscript", "-e", "library(hdf5r)"], capture_output=True, check=False).returncode:
                missing.append("hdf5r")
                continue
            script = f'f <- hdf5r::H5File$new("{target}", mode = "r"); h <- f[["bearings/main/h_min"]]; ' \
                     'cat(hdf5r::h5attr(h, "units"), all(h[] > 0), hdf5r::h5attr(f, "Conventions"))'
            done = subprocess.run(["Rscript", "-e", script], capture_output=True, text=True, timeout=120, check=False)
            self.assertEqual(done.stdout.split(), ["m", "TRUE", "CF-1.11"], done.stderr)
        if missing:
            self.skipTest(f"not installed: {', '.join(missing)}")

    def test_lists_of_large_machines_are_kept(self):
        """HDF5 keeps attributes of more than 64 kB apart: names of the coordinates of a thousand bodies are longer."""
        names = [f"joint_{k}.translation_x" for k in range(4000)]
        source, target = os.path.join(self.folder, "large.h5"), os.path.join(self.folder, "large.nc")
        with h5py.File(source, "w") as file:
            file.attrs["format"], file.attrs["format_version"], file.attrs["status"] = "hersey-results", 1, "completed"
            file.create_group("modes").attrs["coordinates"] = names
            file.attrs["study_parameters"] = names
            time = file.create_dataset("time", data=np.arange(3.0), maxshape=(None,))
            time.attrs["units"], time.attrs["long_name"] = "s", "time"
            time.make_scale("time")
            time.attrs["path"] = np.bytes_("/time")
        hersey("export", source, "--netcdf", target)
        with h5py.File(target) as file:
            self.assertEqual(file["modes"].attrs["coordinates"].decode().split(", "), names)
            self.assertEqual(file.attrs["study_parameters"].decode().split(", "), names)
            self.assertEqual(list(file["time"]), [0, 1, 2])

    def test_faults_say_what_is_allowed(self):
        for _, results, target, _ in self.copies(["pads"]):
            self.assertIn("--force", hersey("export", results, "--netcdf", target, expect=2))
            hersey("export", results, "--netcdf", target, "--force")
            self.assertIn("--films", hersey("export", results, "--netcdf", target, "--films", "a.vtkhdf", expect=2))
            self.assertIn("--netcdf", hersey("export", results, expect=2))
            self.assertIn(".h5", hersey("export", os.path.join(ROOT, RUNS["pads"][0]), "--netcdf", "a.nc", expect=2))
            self.assertIn(".nc", hersey("export", results, "--netcdf", "a.h5", expect=2))  # 2.1 of the conventions
            itself = os.path.join(self.folder, "itself.nc")
            os.link(results, itself)
            self.assertIn("file of its own", hersey("export", results, "--netcdf", itself, "--force", expect=2))
            nowhere = os.path.join(self.folder, "nowhere", "a.nc")
            self.assertIn("cannot be written", hersey("export", results, "--netcdf", nowhere, expect=2))


if __name__ == "__main__":
    unittest.main()
